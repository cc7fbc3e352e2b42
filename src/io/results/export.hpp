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

/// The discs with their shear_strain(), or the pairs as lines, as a VTK unstructured grid (.vtu, raw appended binary).
std::string particles_vtu(Snapshot const& snapshot);
std::string contacts_vtu(Snapshot const& snapshot);

/// The same as comma-separated tables with units in the column names; discs and pairs name discs by id.
std::string particles_csv(Snapshot const& snapshot);
std::string contacts_csv(Snapshot const& snapshot);

/// "contact", "bonded", "broken_tension", ...
std::string_view contact_state_name(std::uint8_t state);

/// Writes a snapshot into `folder` under names made of its step ("particles_000000012345.vtu"). @return the files written
/// @throws FileProblem cannot_create or io_error
std::vector<std::filesystem::path> export_snapshot(Snapshot const& snapshot, ExportFormat format,
                                                   std::filesystem::path const& folder);

/// The same for the snapshots of a run, in their order. VTK files get an index each, `particles.pvd` and `contacts.pvd`, that
/// viewers open as a series; its time is the axial strain. @return the files written
std::vector<std::filesystem::path> export_series(std::vector<std::filesystem::path> const& snapshots, ExportFormat format,
                                                 std::filesystem::path const& folder);

}  // namespace clathra
