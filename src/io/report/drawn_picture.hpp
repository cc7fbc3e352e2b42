#pragma once
/// Pictures of snapshots in a page that has only so much room.
#include <functional>
#include <string>
#include <vector>

#include "domain/measurement/snapshot.hpp"
#include "io/report/figure.hpp"
#include "io/report/maps.hpp"

namespace clathra {

/// A picture to be made: what of, how many pixels a grain is worth, and who draws it.
struct Picture {
  MapView view;
  double grain;  ///< mean diameter [m]
  std::string alt;
  std::function<Canvas(MapView const&)> draw;
  DrawnData data;
  double pixels_per_grain = 24;
};

/// As high as `bytes` of PNG allow, but no higher than is of use, and at most 1400 pixels.
Piece drawn(Picture const& wanted, std::size_t bytes);

/// The particles in a view behind a map, read again from their snapshot once they are wanted.
/// @param column  that their values are, if any
DrawnData particles_behind(std::filesystem::path const& snapshot, std::string const& series, MapView const& view,
                           std::string const& column = "", std::vector<float> values = {});

/// The pairs behind a map by their state: those that are or were bonded, or those that carry a normal force.
enum class ShownPairs { bonds, forces };
DrawnData pairs_behind(std::filesystem::path const& snapshot, std::string const& series, ShownPairs which);

/// "ε₁ = 3.38 %"
std::string strain_text(Snapshot const& s);

/// The modes of breakage in a legend.
Piece mode_entries();

/// A round number that at most two of a hundred values exceed; 0 where none is finite.
double upper_end(std::vector<float> values);

}  // namespace clathra
