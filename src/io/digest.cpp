#include "io/digest.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <new>
#include <system_error>
#include <vector>

#include "io/problems.hpp"

namespace clathra {
namespace {

std::string hexadecimal(XXH128_hash_t digest) { return fmt::format("{:016x}{:016x}", digest.high64, digest.low64); }

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
struct FreeState {
  void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
};

}  // namespace

std::string text_digest(std::string_view text) { return hexadecimal(XXH3_128bits(text.data(), text.size())); }

std::string file_digest(std::filesystem::path const& path) {
  std::unique_ptr<std::FILE, CloseFile> const file(std::fopen(path.c_str(), "rb"));
  if (!file) throw FileProblem(ExitCode::file_missing, path, "cannot be opened: " + std::generic_category().message(errno));
  std::unique_ptr<XXH3_state_t, FreeState> const state(XXH3_createState());
  if (!state) throw std::bad_alloc();
  XXH3_128bits_reset(state.get());
  std::vector<char> buffer(1 << 20);
  while (std::size_t const count = std::fread(buffer.data(), 1, buffer.size(), file.get()))
    XXH3_128bits_update(state.get(), buffer.data(), count);
  if (std::ferror(file.get())) throw FileProblem(ExitCode::io_error, path, "cannot be read");
  return hexadecimal(XXH3_128bits_digest(state.get()));
}

}  // namespace clathra
