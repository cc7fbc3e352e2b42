#pragma once
/// What the discs of a simulation obey.
#include "kernels/forces.hpp"
#include "kernels/integrate.hpp"
#include "kernels/wall_forces.hpp"

namespace clathra {

/// Heavier discs than their size makes them, for longer time steps: what is quasi-static does not depend on masses.
struct MassScaling {
  Real inertia = 1;       ///< factor of all moments of inertia
  Real least_radius = 0;  ///< smaller discs have the mass of a disc of this radius [m], and its part in their moment of inertia
};

/// Features follow from it: rolling moments, bonds, a separate bond history, accounts of dissipation exist only if asked for
/// here.
struct SimulationLaws {
  ContactLaws contact;
  WallLaw wall;
  MotionLaw motion;
  MassScaling scaling;  ///< of a specimen that is taken over
  Precision precision = Precision::full;
  ContactFeatures features() const {
    bool const shears = contact.grain.friction > 0 && contact.grain.shear_stiffness > 0;
    return {shears || contact.bond_kind == BondKind::replace,
            contact.grain.shape_factor > 0,
            contact.bond_kind != BondKind::none,
            contact.bond_kind == BondKind::parallel,
            {}};
  }
  ContactFeatures features_of_rows() const {
    ContactFeatures kept = features();
    kept.format.precision = precision;
    return kept;
  }
  DissipationKinds losses() const {
    ContactFeatures const f = features();
    return {f.shear || wall.friction > 0, f.rolling, contact.grain.damping_ratio > 0 || wall.damping_ratio > 0, f.bonds,
            motion.damping > 0};
  }
};

/// Whether histories come to the same forces, but for the rolling of grain contacts.
bool same_stiffness(ContactLaws const& a, ContactLaws const& b);

/// How many times as large the square of the largest frequency may become, with the factor of local damping, when laws follow
/// others: no spring network vibrates faster by more than its springs became stiffer.
Real stiffening(SimulationLaws const& before, SimulationLaws const& after);

}  // namespace clathra
