#pragma once
/// The pairs that carry force, once each, as a list; and what they do to each disc. For files and pictures, not for the time
/// step.
#include "kernels/forces.hpp"
#include "kernels/wall_forces.hpp"

namespace clathra {

/// Pairs that touch or are bonded, by index a < b of their discs, sorted by (a, place in the row of a). b may be a ghost; the
/// pair is then listed by the rank that owns the disc with the smaller id.
struct PairList {
  int size = 0;
  Field<int> a, b;            ///< [size]
  Field<int> bonded;          ///< [size] 1 where a bond is intact
  Field<Real> normal, shear;  ///< [size] total force of grain contact and bond [N/m], compression positive
  Field<Real> moment;         ///< [size] on disc a [N m/m]
  Field<Real> gap;            ///< [size] surface to surface [m], negative = overlap
  Field<Real> width;          ///< [size] B of the bond [m], 0 without one
};
PairList list_pairs(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws);

/// What acts on each disc.
struct DiscLoads {
  Field<float> stress_xx,
      stress_yy;               ///< [owned] mean stress of the disc, compression positive [Pa]: sum of arm x force over pi r^2
  Field<float> stress_xy;      ///< [owned] its symmetric part
  Field<int> active_contacts;  ///< [owned] pairs and walls that carry force
  Field<int> bonds;            ///< [owned] intact bonds
};
DiscLoads disc_loads(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, Walls const& walls,
                     WallContacts const& wall_contacts, WallLaw const& wall_law);

}  // namespace clathra
