#pragma once
/// A specimen at rest on the host: what generation hands to a test, and what a specimen file holds.
///
/// The one form in which discs pass between generator, file, bonding and simulation. It has no order that matters: ids say who is
/// who, so that a file, a permutation and the shares of ranks mean the same.
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include "kernels/bond_kind.hpp"

namespace clathra {

/// A pair with history, once per pair, id_a < id_b.
struct SpecimenContact {
  int id_a = 0, id_b = 0;
  double shear = 0;                        ///< F_s [N/m], equal on both sides
  double moment = 0;                       ///< M on disc a [N m/m]
  double formation_overlap = no_bond;      ///< u_0 of an intact bond [m]
  double bond_shear = 0, bond_moment = 0;  ///< of a bond in parallel to the grain contact
  bool bonded() const { return formation_overlap < 0.5 * no_bond; }
};

/// The history of a contact, number by number. Each has the name of a field of the rows (for_each_possible_history()).
struct ContactNumber {
  char const* name;
  double SpecimenContact::*of;
  char const* unit;
};
inline constexpr ContactNumber contact_numbers[] = {
    {"shear", &SpecimenContact::shear, "N/m"},
    {"moment", &SpecimenContact::moment, "N m/m"},
    {"formation_overlap", &SpecimenContact::formation_overlap, "m (1e300 = not bonded)"},
    {"bond_shear", &SpecimenContact::bond_shear, "N/m"},
    {"bond_moment", &SpecimenContact::bond_moment, "N m/m"}};

/// Contacts as rows of numbers, to send them to other ranks.
inline constexpr std::size_t numbers_of_contact = 2 + std::size(contact_numbers);
inline void append_numbers(std::vector<double>& numbers, SpecimenContact const& c) {
  numbers.insert(numbers.end(), {double(c.id_a), double(c.id_b)});
  for (ContactNumber const& number : contact_numbers) numbers.push_back(c.*number.of);
}
inline void append_contacts(std::vector<SpecimenContact>& contacts, std::vector<double> const& numbers) {
  for (auto n = numbers.begin(); n != numbers.end();) {
    SpecimenContact& c = contacts.emplace_back();
    c.id_a = static_cast<int>(*n++);
    c.id_b = static_cast<int>(*n++);
    for (ContactNumber const& number : contact_numbers) c.*number.of = *n++;
  }
}
inline bool by_ids(SpecimenContact const& a, SpecimenContact const& b) {
  return a.id_a != b.id_a ? a.id_a < b.id_a : a.id_b < b.id_b;
}

struct Specimen {
  double left = 0, right = 0, bottom = 0, top = 0;  ///< walls [m]
  bool periodic = false;                            ///< a periodic cell: no walls
  double density = 2600;                            ///< of the grains [kg/m^3]
  double d50 = 0;                                   ///< of the grading it was made from [m]
  double stress = 0;                                ///< isotropic stress it rests under [Pa]
  double void_ratio = 0;                            ///< nominal: overlaps counted twice
  double critical_thickness = 0;                    ///< h_max of its bonds [m]; 0 = unbonded
  bool separate_bonds = false;                      ///< bonds made for `parallel`
  double axial_strain = 0;                          ///< natural, through which tests have sheared it
  std::vector<int> id;                              ///< 0 .. N-1, in any order
  std::vector<double> x, y, angle, vx, vy, omega, radius;
  std::vector<SpecimenContact> contacts;
  std::string provenance;  ///< JSON text: how it was made
  std::size_t size() const { return id.size(); }
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

/// The numbers of the discs, column by column. Each has the name of a field of ParticleSoA.
struct ParticleColumn {
  char const* name;
  std::vector<double> Specimen::*of;
  char const* unit;
};
inline constexpr ParticleColumn particle_columns[] = {{"x", &Specimen::x, "m"},           {"y", &Specimen::y, "m"},
                                                      {"angle", &Specimen::angle, "rad"}, {"vx", &Specimen::vx, "m/s"},
                                                      {"vy", &Specimen::vy, "m/s"},       {"omega", &Specimen::omega, "rad/s"},
                                                      {"radius", &Specimen::radius, "m"}};

}  // namespace clathra
