#pragma once
/// A snapshot made by hand.
#include "domain/measurement/snapshot.hpp"

namespace clathra {

/// A square lattice of equal discs in touch, each bonded to its right and upper neighbour, between walls around it.
inline Snapshot made_up_lattice(int columns, int rows, double radius = 1e-4) {
  Snapshot s;
  s.right = 2 * radius * columns, s.top = 2 * radius * rows;
  s.d50 = 2 * radius;
  auto const n = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      int const i = row * columns + column;
      s.id.push_back(i);
      s.x.push_back((2 * column + 1) * radius);
      s.y.push_back((2 * row + 1) * radius);
      for (int const other : {column + 1 < columns ? i + 1 : -1, row + 1 < rows ? i + columns : -1})
        if (other >= 0) s.a.push_back(i), s.b.push_back(other);
    }
  s.radius.assign(n, static_cast<float>(radius));
  for (auto* zero : {&s.angle, &s.vx, &s.vy, &s.omega, &s.ux, &s.uy, &s.stress_xx, &s.stress_yy, &s.stress_xy})
    zero->assign(n, 0.0f);
  for (auto* zero : {&s.coordination, &s.bonds_intact, &s.bonds_initial}) zero->assign(n, std::uint8_t{0});
  s.state.assign(s.a.size(), static_cast<std::uint8_t>(ContactState::bonded));
  s.normal_force.assign(s.a.size(), 1.0f);
  s.width.assign(s.a.size(), static_cast<float>(radius / 2));
  for (auto* zero : {&s.shear_force, &s.moment, &s.gap}) zero->assign(s.a.size(), 0.0f);
  return s;
}

}  // namespace clathra
