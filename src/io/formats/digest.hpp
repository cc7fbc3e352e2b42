#pragma once
/// XXH3-128 digests in hexadecimal: which input a result came from.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace clathra {

std::string text_digest(std::string_view text);

/// The digest of a text that comes piece by piece.
class RunningDigest {
 public:
  RunningDigest();
  ~RunningDigest();
  void add(std::string_view piece);
  std::string text() const;  ///< of all that was added so far

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// @throws FileProblem file_missing or io_error
std::string file_digest(std::filesystem::path const& path);

/// Adds the first `bytes` of a file. @throws FileProblem as above, and bad_input where it has fewer
void add_first_bytes(std::filesystem::path const& path, std::uintmax_t bytes, RunningDigest& digest);
/// The digest of the first `bytes` of a file. @throws FileProblem as there
std::string file_digest(std::filesystem::path const& path, std::uintmax_t bytes);

}  // namespace clathra
