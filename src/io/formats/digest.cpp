#include "io/formats/digest.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <new>
#include <system_error>
#include <vector>

#include "io/errors/problems.hpp"

namespace clathra {
namespace {

std::string hexadecimal(XXH128_hash_t digest) { return fmt::format("{:016x}{:016x}", digest.high64, digest.low64); }

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
constexpr std::size_t piece_size = std::size_t{1} << 20;

/// Adds the next bytes of a file, at most `limit`. @return how many there were
std::uintmax_t add_bytes(std::filesystem::path const& path, std::uintmax_t limit, RunningDigest& digest) {
  std::unique_ptr<std::FILE, CloseFile> const file(std::fopen(path.c_str(), "rb"));
  if (!file) throw FileProblem(ExitCode::file_missing, path, "cannot be opened: " + std::generic_category().message(errno));
  std::vector<char> buffer(piece_size);
  std::uintmax_t taken = 0;
  while (taken < limit) {
    std::size_t const count = std::fread(buffer.data(), 1, std::min<std::uintmax_t>(piece_size, limit - taken), file.get());
    if (count == 0) break;
    digest.add({buffer.data(), count});
    taken += count;
  }
  if (std::ferror(file.get())) throw FileProblem(ExitCode::io_error, path, "cannot be read");
  return taken;
}

}  // namespace

std::string text_digest(std::string_view text) { return hexadecimal(XXH3_128bits(text.data(), text.size())); }

struct RunningDigest::State {
  XXH3_state_t* const xxh3 = XXH3_createState();
  State() {
    if (!xxh3) throw std::bad_alloc();
    XXH3_128bits_reset(xxh3);
  }
  ~State() { XXH3_freeState(xxh3); }
  State(State const&) = delete;
  State& operator=(State const&) = delete;
};

RunningDigest::RunningDigest() : state_(std::make_unique<State>()) {}
RunningDigest::~RunningDigest() = default;
void RunningDigest::add(std::string_view piece) { XXH3_128bits_update(state_->xxh3, piece.data(), piece.size()); }
std::string RunningDigest::text() const { return hexadecimal(XXH3_128bits_digest(state_->xxh3)); }

std::string file_digest(std::filesystem::path const& path) {
  RunningDigest digest;
  add_bytes(path, UINTMAX_MAX, digest);
  return digest.text();
}

void add_first_bytes(std::filesystem::path const& path, std::uintmax_t bytes, RunningDigest& digest) {
  if (std::uintmax_t const present = add_bytes(path, bytes, digest); present < bytes)
    throw FileProblem(ExitCode::bad_input, path, fmt::format("has {} bytes, at least {} were written", present, bytes));
}

std::string file_digest(std::filesystem::path const& path, std::uintmax_t bytes) {
  RunningDigest digest;
  add_first_bytes(path, bytes, digest);
  return digest.text();
}

}  // namespace clathra
