#pragma once
/// How much memory a run may take.
#include <filesystem>

namespace clathra {

/// What can be had without swapping, and within the limits of the control groups that this process is in (batch systems and
/// containers set them): bytes. What a group keeps of files in memory counts as free.
/// @param root  where the file systems /proc and /sys are
double available_memory(std::filesystem::path const& root = "/");

}  // namespace clathra
