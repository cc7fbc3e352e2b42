#pragma once
/// Snapshots in the formats of other programs.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "domain/measurement/snapshot.hpp"

namespace clathra {

enum class ExportFormat { lammpsdump, vtu, csv };

/// The discs as a LAMMPS text dump (ITEM: ATOMS id type x y z radius vx vy vz omegaz sxx syy sxy coordination), SI units, z = 0.
std::string lammps_dump(Snapshot const& snapshot);

/// The discs, or the pairs as lines, as a VTK unstructured grid (.vtu, raw appended binary).
std::string discs_vtu(Snapshot const& snapshot);
std::string pairs_vtu(Snapshot const& snapshot);

/// The same as comma-separated tables with units in the column names; discs and pairs name discs by id.
std::string discs_csv(Snapshot const& snapshot);
std::string pairs_csv(Snapshot const& snapshot);

/// "contact", "bonded", "broken_tension", ...
std::string_view contact_state_name(std::uint8_t state);

/// Writes a snapshot into `folder` under names made of its step ("discs_000000012345.vtu"). @return the files written
/// @throws FileProblem cannot_create or io_error
std::vector<std::filesystem::path> export_snapshot(Snapshot const& snapshot, ExportFormat format,
                                                   std::filesystem::path const& folder);

}  // namespace clathra
