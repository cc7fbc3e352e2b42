#pragma once
/// Broken bonds as columns of an HDF5 file, in its group `events`: step, id_a, id_b and mode, and their details where there are
/// some. Where they broke is written by those who know to what digit.
#include "domain/simulation/break_event.hpp"
#include "io/formats/hdf5_file.hpp"

namespace clathra {

void write_event_columns(Hdf5File& file, BreakEvents const& events);

/// Events without positions, detailed where the file has details. @throws FileProblem bad_input, also where a mode is none of
/// BreakMode's
BreakEvents read_event_columns(Hdf5File const& file, RowRange const& rows);

}  // namespace clathra
