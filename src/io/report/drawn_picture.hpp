#pragma once
/// Pictures of snapshots in a page that has only so much room.
#include <functional>
#include <string>
#include <vector>

#include "domain/measurement/snapshot.hpp"
#include "io/report/maps.hpp"

namespace clathra {

/// A picture to be made: what of, how many pixels a grain is worth, and who draws it.
struct Picture {
  MapView view;
  double grain;  ///< mean diameter [m]
  std::string alt;
  std::function<Canvas(MapView const&)> draw;
  double pixels_per_grain = 24;
};

/// As high as `bytes` of PNG allow, but no higher than is of use, and at most 1400 pixels. HTML.
std::string drawn(Picture const& wanted, std::size_t bytes);

/// "ε₁ = 3.38 %"
std::string strain_text(Snapshot const& s);

/// A picture with a line below it, and pictures in a row.
std::string titled(std::string const& image, std::string const& text);
std::string strip(std::string const& contents);

/// The modes of breakage in a legend.
std::string mode_entries();

/// A round number that at most two of a hundred values exceed; 0 where none is finite.
double upper_end(std::vector<float> values);

}  // namespace clathra
