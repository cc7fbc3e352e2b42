#pragma once
/// A specimen at rest on the host: what generation hands to a test, and what a specimen file holds.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace clathra {

/// A pair with history, once per pair, id_a < id_b.
struct SpecimenContact {
  int id_a = 0, id_b = 0;
  double shear = 0;                        ///< F_s [N/m], equal on both sides
  double moment = 0;                       ///< M on disc a [N m/m]
  double equilibrium = 1e300;              ///< u_0 of an intact bond [m], 1e300 = not bonded
  double bond_shear = 0, bond_moment = 0;  ///< of a bond in parallel to the grain contact
};

/// Contacts as rows of numbers, to send them to other ranks.
inline constexpr std::size_t numbers_of_contact = 7;
inline void append_numbers(std::vector<double>& numbers, SpecimenContact const& c) {
  numbers.insert(numbers.end(), {double(c.id_a), double(c.id_b), c.shear, c.moment, c.equilibrium, c.bond_shear, c.bond_moment});
}
inline void append_contacts(std::vector<SpecimenContact>& contacts, std::vector<double> const& numbers) {
  for (auto n = numbers.begin(); n != numbers.end(); n += numbers_of_contact)
    contacts.push_back({static_cast<int>(n[0]), static_cast<int>(n[1]), n[2], n[3], n[4], n[5], n[6]});
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
  std::optional<double> axial_strain = 0;           ///< natural, through which tests have sheared it; nothing: not known
  std::vector<int> id;                              ///< 0 .. N-1, in any order
  std::vector<double> x, y, angle, vx, vy, omega, radius;
  std::vector<SpecimenContact> contacts;
  std::string provenance;  ///< JSON text: how it was made
  std::size_t size() const { return id.size(); }
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

}  // namespace clathra
