#pragma once
/// How bonds lose their hydrate as the saturation falls from S_0, with which they formed, to S. Three laws, of which nobody knows
/// which one a soil follows; each takes other bonds first, and all leave none at 20 %, where Eq. 3 ends:
///
/// - critical_thickness: B of Eq. 2 with today's h_max, that of formation times Eq. 3 of S over Eq. 3 of S_0. Bonds over wide
///   gaps go first.
/// - recession: B = B_0 - 2 v t, the same length off every bond. Narrow bonds go first. The length is what the bond between two
///   touching grains of the size d50 loses by the first law, so that the two agree for this bond.
/// - uniform: R_t, R_c and E_m times ((S - 20 %) / (S_0 - 20 %))^n; the widths stay. Loaded bonds go first.
///
/// Eq. 3 jumps from 0.003 to 0 at 20 %: over hydrate.spread_of_loss above that, what is left of h_max (first law) or of every B
/// (second) falls linearly. The h_max in h_0 is that of formation.
#include "domain/scene/hydrate.hpp"

namespace clathra {

inline constexpr double least_cementing = 0.2;  ///< saturation up to which Eq. 3 has no bonds

/// h_max over that of formation when the saturation has fallen to a value: Eq. 3, whose jump at 20 % is spread linearly.
/// @param formed  saturation of formation, above 20 % + spread
double remaining_thickness(double formed, double saturation, double spread);

/// (S - 20 %) / (S_0 - 20 %), not below 0: what is left of the hydrate that cements.
double remaining_cement(double formed, double saturation);

/// Width of the bond between two touching grains of the size d50 by the law of recession [m].
/// @param formed  h_max of formation [m]
double reference_width(Scene const& scene, double d50, double formed, double saturation);

/// The saturation that has this reference width: its inverse, between 20 % and 70 %, where Eq. 3 ends.
double saturation_of_width(Scene const& scene, double d50, double formed, double width);

/// The law of bonds that have formed, when their hydrate has become another one: its temperature and pressure change the
/// strength (Eq. 13, where bond.strength_from is "conditions"), its saturation the bonds by scene.hydrate.loss.
/// @param d50  of the grains [m];  @param formed  of the hydrate as it formed
BondLaw changed_bond_law(Scene const& scene, double d50, BondLaw const& formed, HydrateScene const& now);

}  // namespace clathra
