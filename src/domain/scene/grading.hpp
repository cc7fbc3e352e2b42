#pragma once
/// Grading curves: percent finer by mass against diameter, and the disc sizes that represent them.
#include <string>
#include <vector>

#include "domain/scene/scene.hpp"

namespace clathra {

/// The median diameters that grains which rest on one another may have [m].
inline constexpr double smallest_d50 = 1e-7, largest_d50 = 0.1;

/// Diameters of a grading at mass fractions that tell what tests of it are like [m].
struct CurveSizes {
  double d10 = 0, d49 = 0, d50 = 0, d51 = 0, d90 = 0;
};

/// A grading curve, linear in log(diameter) between its points. In 2D mass fraction is area fraction.
class Grading {
 public:
  /// @param diameters increasing [m];  @param finer fraction finer, from 0 to 1, not decreasing
  /// Points at 0 % below the last of these, and at 100 % above the first of those, are cut: no disc has such a size.
  /// @throws std::invalid_argument with the offending row
  Grading(std::vector<double> diameters, std::vector<double> finer);

  /// Toyoura sand, d50 = 0.1694 mm, Cu about 1.5 (0.1 to 0.3 mm).
  static Grading toyoura();
  /// All discs of one diameter [m].
  static Grading uniform(double diameter);
  /// The grading of a scene, scaled to its d50; where it states none, to the curve's own as one would write it (stated_d50()), so
  /// that stating that changes no bit.
  static Grading of(GradingScene const& scene);

  double diameter_finer(double fraction) const;  ///< d_x [m] for a mass fraction x
  double d50() const { return diameter_finer(0.5); }
  CurveSizes sizes() const {
    return {diameter_finer(0.1), diameter_finer(0.49), d50(), diameter_finer(0.51), diameter_finer(0.9)};
  }
  double stated_d50() const;  ///< d50 to nine digits [m]
  double smallest() const { return diameters_.front(); }
  double largest() const { return diameters_.back(); }
  double finer_than(double diameter) const;  ///< mass fraction finer than a diameter [m]
  /// Mean disc area pi/4 <d^2> over the number distribution [m^2]; N discs have N times it.
  double mean_disc_area() const;
  Grading scaled(double factor) const;

  /// `count` diameters [m] at the mid-quantiles of the number distribution, increasing: the sample of that size nearest to the
  /// curve.
  std::vector<double> diameters(std::size_t count) const;

 private:
  void cut_empty_ends();

  std::vector<double> diameters_, finer_;
  std::vector<double> number_;  // number of discs finer, up to a factor, at each point
};

}  // namespace clathra
