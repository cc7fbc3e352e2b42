#pragma once
/// Statements about means over seeds, and what a few seeds say of them.
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "domain/measurement/confidence.hpp"

namespace clathra {

/// Numbers of tests that differ in their seed only, by seed.
using SeedNumbers = std::map<std::uint64_t, double>;

/// f of both numbers for each seed that has both: paired, so that what a specimen does to both cancels.
template <class F>
SeedNumbers paired(SeedNumbers const& a, SeedNumbers const& b, F const& f) {
  SeedNumbers both;
  for (auto const& [seed, value] : a)
    if (auto const other = b.find(seed); other != b.end()) both[seed] = f(value, other->second);
  return both;
}
/// b - a, seed by seed.
SeedNumbers rise(SeedNumbers const& a, SeedNumbers const& b);

/// pass: the 95 % interval of the mean lies inside the bounds; fail: outside; undetermined: neither, or there is no interval, as
/// of one seed; partial: of a claim, some of its parts pass and some fail.
enum class Verdict { pass, partial, fail, undetermined };
char const* name_of(Verdict verdict);

inline constexpr double no_bound = std::numeric_limits<double>::infinity();

/// One number with the bounds within which a claim wants it.
struct ClaimPart {
  std::string what;    ///< "peak q, 41 % - 26 %, 1 MPa"
  std::string unit;    ///< of `values`
  SeedNumbers values;  ///< finite
  double low = -no_bound, high = no_bound;
  bool exact = false;  ///< no statistic: the only value has no scatter
  std::optional<MeanInterval> mean() const;
  Verdict verdict() const;
  /// Whether the mean lies within the bounds, be it known well or not.
  bool mean_is_inside() const;
};

/// A statement of a paper with all that it asks for.
struct Claim {
  std::string id;     ///< "7"
  std::string words;  ///< what is claimed, in a sentence
  std::vector<ClaimPart> parts;
  std::string where = {};  ///< it stands: "section 5.1, Fig. 11"
  bool ours = false;       ///< what we take from there, not what is stated
  /// pass or fail where all parts do; partial where parts do both; else undetermined.
  Verdict verdict() const;
  /// Share of the parts whose mean lies within the bounds: what readings are compared by, whose tests are few.
  double share_inside() const;
};

}  // namespace clathra
