/// Verdicts on claims: intervals against bounds, and seeds kept together.
#include <gtest/gtest.h>

#include <cmath>

#include "domain/measurement/claims.hpp"

namespace clathra {
namespace {

ClaimPart part(SeedNumbers values, double low, double high) { return {"", "", std::move(values), low, high}; }

TEST(Claims, APartPassesOrFailsOnlyWhereItsWholeIntervalDoes) {
  // 1, 2, 3: mean 2, half width 4.3027 / sqrt(3) = 2.4841.
  SeedNumbers const values{{1, 1}, {2, 2}, {3, 3}};
  EXPECT_EQ(part(values, -0.49, no_bound).verdict(), Verdict::pass);
  EXPECT_EQ(part(values, -0.48, no_bound).verdict(), Verdict::undetermined);
  EXPECT_EQ(part(values, 4.48, no_bound).verdict(), Verdict::undetermined);
  EXPECT_EQ(part(values, 4.49, no_bound).verdict(), Verdict::fail);
  EXPECT_EQ(part(values, -no_bound, -0.49).verdict(), Verdict::fail);
  EXPECT_EQ(part(values, -1, 5).verdict(), Verdict::pass);
  EXPECT_TRUE(part(values, 1.9, 2.1).mean_is_inside());
  EXPECT_FALSE(part(values, 2.1, 3).mean_is_inside());
}

TEST(Claims, OneSeedOrNoneSaysNothingUnlessTheNumberIsExact) {
  EXPECT_EQ(part({{1, 5}}, 0, no_bound).verdict(), Verdict::undetermined);
  EXPECT_TRUE(part({{1, 5}}, 0, no_bound).mean_is_inside());
  EXPECT_EQ(part({}, 0, no_bound).verdict(), Verdict::undetermined);
  EXPECT_FALSE(part({}, 0, no_bound).mean_is_inside());
  ClaimPart exact = part({{0, 5}}, 0, 4);
  exact.exact = true;
  EXPECT_EQ(exact.verdict(), Verdict::fail);
}

TEST(Claims, DifferencesArePairedBySeed) {
  // Specimens differ by 10 and more, the treatment adds 1 to each: paired, the interval is nothing wide.
  SeedNumbers const before{{1, 10}, {2, 20}, {3, 35}, {7, 1}}, after{{1, 11}, {2, 21}, {3, 36}, {9, 5}};
  SeedNumbers const difference = rise(before, after);
  EXPECT_EQ(difference, (SeedNumbers{{1, 1}, {2, 1}, {3, 1}}));
  EXPECT_EQ(part(difference, 0.5, no_bound).verdict(), Verdict::pass);
}

TEST(Claims, AClaimSumsUpItsParts) {
  SeedNumbers const one{{1, 1}, {2, 1}};
  ClaimPart const good = part(one, 0, 2), bad = part(one, 2, 3), open = part({{1, 1}}, 0, 2);
  EXPECT_EQ((Claim{"", "", {good, good}}.verdict()), Verdict::pass);
  EXPECT_EQ((Claim{"", "", {bad, bad}}.verdict()), Verdict::fail);
  EXPECT_EQ((Claim{"", "", {good, bad, open}}.verdict()), Verdict::partial);
  EXPECT_EQ((Claim{"", "", {good, open}}.verdict()), Verdict::undetermined);
  EXPECT_EQ((Claim{"", "", {}}.verdict()), Verdict::undetermined);
  EXPECT_DOUBLE_EQ((Claim{"", "", {good, bad, open, open}}.share_inside()), 0.75);
}

}  // namespace
}  // namespace clathra
