#pragma once
/// What stands in the HDF5 file of a checkpoint.
#include <filesystem>

#include "domain/biaxial/biaxial_test.hpp"
#include "domain/parallel/ranks.hpp"
#include "domain/scene/scene.hpp"
#include "io/errors/problems.hpp"

namespace clathra {

/// Only this one is read.
inline constexpr std::int64_t checkpoint_version = 9;

/// @throws FileProblem cannot_create or io_error
void write_checkpoint_content(std::filesystem::path const& path, Scene const& scene, TestState const& state, Ranks const& ranks);

/// This rank's rows, checked: sizes, ids, finite numbers. Not collective. @throws FileProblem
TestState read_checkpoint_content(std::filesystem::path const& path, Scene const& scene, Ranks const& ranks);

}  // namespace clathra
