#pragma once
/// Specimen files: HDF5, made by `clathra generate` and by every run, read again by later runs.
#include <cstdint>
#include <filesystem>

#include "domain/measurement/specimen_facts.hpp"
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

/// A specimen that was read, and what its discs show.
struct CheckedSpecimen {
  Specimen specimen;
  SpecimenFacts facts;
};

/// Reads a specimen and checks it: what must be there, sizes, ids 0..N-1 once each, finite numbers, radii > 0, contacts between
/// discs of the file, and that discs and numbers agree (require_sound()). Collective.
/// @return this rank's part: a block of ids
/// @throws FileProblem file_missing or bad_input, on all ranks the same
CheckedSpecimen read_checked_specimen(std::filesystem::path const& path, Ranks const& ranks = {});
/// The same where nobody asks for the facts.
Specimen read_specimen(std::filesystem::path const& path, Ranks const& ranks = {});

/// A hash of all discs and contacts, bit for bit, whatever order they are stored in. It is not the state hash of a run, which is
/// taken of the arrays of the simulation.
std::uint64_t specimen_hash(Specimen const& specimen);

}  // namespace clathra
