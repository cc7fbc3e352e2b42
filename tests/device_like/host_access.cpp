#include "device_like/host_access.hpp"

#include <cxxabi.h>
#include <execinfo.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <memory>
#include <mutex>
#include <new>
#include <set>
#include <sstream>
#include <vector>

#include "device_like/space.hpp"

namespace clathra::device_like {

namespace {

constexpr std::size_t header_bytes = sizeof(Kokkos::Impl::SharedAllocationHeader);
constexpr int most_frames = 24, shown_frames = 6, most_accesses = 64;

std::size_t page_bytes() {
  static std::size_t const bytes = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return bytes;
}
std::size_t whole_pages(std::size_t bytes) { return (bytes + page_bytes() - 1) / page_bytes() * page_bytes(); }

struct Block {
  char* data;         ///< behind the page of the header
  std::size_t bytes;  ///< whole pages
  char label[48];
};
struct Access {
  char label[48];
  void* frames[most_frames];
  int depth;
};

std::mutex guard;
std::vector<Block> blocks;
bool watching = false, counting = false;
int working = 0;                 // kernels and copies under way, one within the other
Access accesses[most_accesses];  // written by a signal handler, which may allocate nothing
int access_count = 0, allocation_count = 0;
struct sigaction before;
LaunchCount::Counts launched, waited_for;
std::string last_launched;

void set_access(int rights) {
  for (Block const& block : blocks) mprotect(block.data, block.bytes, rights);
}

void on_fault(int, siginfo_t* info, void*) {
  auto* const at = static_cast<char*>(info->si_addr);
  for (Block const& block : blocks) {
    if (at < block.data || at >= block.data + block.bytes) continue;
    mprotect(block.data, block.bytes, PROT_READ | PROT_WRITE);
    if (access_count == most_accesses) return;
    Access& access = accesses[access_count++];
    std::memcpy(access.label, block.label, sizeof access.label);
    access.depth = backtrace(access.frames, most_frames);
    return;
  }
  sigaction(SIGSEGV, &before, nullptr);  // somebody else's, who now meets it again
}

void begin_work() {
  if (working++ == 0 && watching) set_access(PROT_READ | PROT_WRITE);
}
void end_work() {
  if (--working == 0 && watching) set_access(PROT_NONE);
}
template <int kind>
void begin_kernel(char const* name, std::uint32_t, std::uint64_t*) {
  static constexpr char const* kinds[] = {"for", "reduce", "scan"};
  if (counting && working == 0) {
    ++launched[std::string(kinds[kind]) + " " + name];
    last_launched = name;
    if (kind == 2) ++waited_for[name];  // all scans here have totals
  }
  begin_work();
}
void end_kernel(std::uint64_t) { end_work(); }
void begin_copy(Kokkos_Profiling_SpaceHandle to, char const*, void const*, Kokkos_Profiling_SpaceHandle from,
                char const* from_name, void const*, std::uint64_t) {
  if (counting && working == 0 && std::strcmp(from.name, space_name) == 0 && std::strcmp(to.name, space_name) != 0)
    ++waited_for[std::string("copy of ") + from_name];
  begin_work();
}

void set_hooks(bool on) {
  namespace tools = Kokkos::Tools::Experimental;
  tools::set_begin_parallel_for_callback(on ? begin_kernel<0> : nullptr);
  tools::set_begin_parallel_reduce_callback(on ? begin_kernel<1> : nullptr);
  tools::set_begin_parallel_scan_callback(on ? begin_kernel<2> : nullptr);
  tools::set_end_parallel_for_callback(on ? end_kernel : nullptr);
  tools::set_end_parallel_reduce_callback(on ? end_kernel : nullptr);
  tools::set_end_parallel_scan_callback(on ? end_kernel : nullptr);
  tools::set_begin_deep_copy_callback(on ? begin_copy : nullptr);
  tools::set_end_deep_copy_callback(on ? end_work : nullptr);
  working = 0;
}

std::string function_of(char const* symbol) {
  std::string const text(symbol);
  std::size_t const begin = text.find('('), plus = text.find('+', begin);
  if (begin == std::string::npos || plus == std::string::npos) return text;
  int status = 0;
  std::unique_ptr<char, void (*)(void*)> const name(
      abi::__cxa_demangle(text.substr(begin + 1, plus - begin - 1).c_str(), nullptr, nullptr, &status), std::free);
  return status == 0 ? std::string(name.get()).substr(0, 160) : text.substr(begin, 40);
}

}  // namespace

void* allocate(char const* label, std::size_t size) {
  std::size_t const bytes = whole_pages(size > header_bytes ? size - header_bytes : 1);
  void* const pages = mmap(nullptr, page_bytes() + bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) throw std::bad_alloc();
  Block block{static_cast<char*>(pages) + page_bytes(), bytes, {}};
  std::strncpy(block.label, label, sizeof block.label - 1);
  std::scoped_lock const lock(guard);
  blocks.push_back(block);
  if (counting) ++allocation_count;
  if (watching && working == 0) mprotect(block.data, block.bytes, PROT_NONE);
  return block.data - header_bytes;
}

void deallocate(void* memory, std::size_t) {
  char* const data = static_cast<char*>(memory) + header_bytes;
  std::scoped_lock const lock(guard);
  auto const block = std::find_if(blocks.begin(), blocks.end(), [&](Block const& b) { return b.data == data; });
  munmap(block->data - page_bytes(), page_bytes() + block->bytes);
  blocks.erase(block);
}

void note_wait_for_reduction() {
  if (counting && working == 0) ++waited_for[last_launched];
}

HostAccessWatch::HostAccessWatch() {
  void* frames[1];
  backtrace(frames, 1);  // loads what it needs, which a signal handler could not
  access_count = 0;
  struct sigaction action = {};
  action.sa_sigaction = on_fault;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSEGV, &action, &before);
  set_hooks(true);
  watching = true;
  set_access(PROT_NONE);
}

HostAccessWatch::~HostAccessWatch() {
  watching = false;
  set_hooks(false);
  set_access(PROT_READ | PROT_WRITE);
  sigaction(SIGSEGV, &before, nullptr);
}

std::string HostAccessWatch::report() const {
  std::set<std::string> lines;
  for (int k = 0; k < access_count; ++k) {
    Access const& access = accesses[k];
    std::unique_ptr<char*, void (*)(void*)> const symbols(backtrace_symbols(access.frames, access.depth), std::free);
    std::ostringstream line;
    line << "field \"" << access.label << "\" by";
    for (int f = 2; f < std::min(access.depth, 2 + shown_frames); ++f) line << "\n    " << function_of(symbols.get()[f]);
    lines.insert(line.str());
  }
  std::string text;
  for (std::string const& line : lines) text += line + "\n";
  return text;
}

LaunchCount::LaunchCount() {
  launched.clear();
  waited_for.clear();
  allocation_count = 0;
  set_hooks(true);
  counting = true;
}
LaunchCount::~LaunchCount() {
  counting = false;
  set_hooks(false);
}
LaunchCount::Counts LaunchCount::launches() const { return launched; }
LaunchCount::Counts LaunchCount::round_trips() const { return waited_for; }
int LaunchCount::allocations() const { return allocation_count; }

}  // namespace clathra::device_like
