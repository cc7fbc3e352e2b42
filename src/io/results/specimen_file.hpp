#pragma once
/// Specimen files: HDF5, made by `clathra generate` and by every run, read again by later runs.
#include <cstdint>
#include <filesystem>

#include "domain/parallel/ranks.hpp"
#include "domain/scene/specimen.hpp"
#include "io/errors/problems.hpp"
#include "io/formats/text_file.hpp"

namespace clathra {

/// Writes a specimen under a temporary name, flushes it to the disk and renames it: the name never holds a part of a file.
/// @param share  this rank's part; the file is the same for any number of ranks
/// @throws FileProblem cannot_create or io_error
void write_specimen(std::filesystem::path const& path, Specimen share, Ranks const& ranks = {},
                    Existing existing = Existing::replaced);

/// Reads a specimen and checks it: sizes, ids 0..N-1 once each, finite numbers, radii > 0, contacts between discs of the file.
/// @return this rank's part: a block of ids
/// @throws FileProblem file_missing or bad_input, on all ranks the same
Specimen read_specimen(std::filesystem::path const& path, Ranks const& ranks = {});

/// A hash of all discs and contacts, bit for bit, whatever order they are stored in. It is not the state hash of a run, which is
/// taken of the arrays of the simulation.
std::uint64_t specimen_hash(Specimen const& specimen);

}  // namespace clathra
