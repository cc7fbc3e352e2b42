#pragma once
/// This program once more, as a child.
#include <string>
#include <vector>

namespace clathra {

/// "0.1.0 (4f3a2b1c9d8e)": version and git revision, with a digest of what was changed since where the sources were not
/// committed.
std::string own_version();

/// The same with what it was built with: Kokkos and its backend, MPI, HDF5, instruction set; a line each.
std::string version_and_libraries();

/// Where the pages are that texts call docs/NAME.md: the folder that they are installed in with this program, else in words.
std::string pages_folder();

/// Runs this program with other arguments and returns what it prints to stdout; its stderr is ours.
/// @throws std::runtime_error where it cannot be started or does not end with exit code 0
std::string output_of_own_program(std::vector<std::string> const& arguments);

}  // namespace clathra
