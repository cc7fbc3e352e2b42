#pragma once
/// Moving a specimen between the host's form (Specimen) and the running one (Assembly).
#include "domain/scene/specimen.hpp"
#include "domain/simulation/assembly.hpp"

namespace clathra {

/// Takes over a specimen with the history of its contacts, all but the forces that it then has.
/// @param s  this rank's share of it: each disc and each contact on one rank, whichever
/// @param a  new, periodic as the specimen is
/// @throws std::invalid_argument for one without discs, or a periodic cell on several ranks; Diverged for numbers not finite
void take_over(Assembly& a, Specimen const& s);

/// Gives the pairs of an assembly the bonds that its own specimen has got. @param s  specimen_of() it, with bonds;
/// @param a  with laws of bonds
void take_bonds(Assembly& a, Specimen const& s);

/// The present state of this rank's discs on the host, ordered by id; of a pair of discs of two ranks, the one with the smaller
/// id brings the contact.
Specimen specimen_of(Assembly const& a);

}  // namespace clathra
