/// Errors of settings and the choice among them, against planted errors and noise.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "domain/measurement/confidence.hpp"
#include "tune/setting_search.hpp"

namespace clathra {
namespace {

constexpr double ratio = 10.0 / 3;

/// Values of specimens at a rate whose error is a rate^order: each specimen has its own limit, and each run its chaos.
struct Planted {
  double order = 1, coefficient = 100, noise = 0.004, specimens = 0.05;
  std::uint64_t study = 1;

  double error(double rate, double numerics = 0) const { return coefficient * std::pow(rate, order) + numerics; }
  double value(std::uint64_t seed, double rate, double numerics = 0) const {
    std::mt19937_64 of_specimen(study * 1000003 + seed),
        of_run(study * 7919 + seed * 104729 + static_cast<std::uint64_t>(rate * 1e9) * 31 +
               static_cast<std::uint64_t>(std::llround((numerics + 1) * 1e6)));
    std::normal_distribution<double> scatter;
    of_run.discard(3);
    double const limit = 5e6 * (1 + specimens * scatter(of_specimen));
    scatter.reset();
    return limit * (1 + error(rate, numerics)) + 5e6 * noise * scatter(of_run);
  }
  SeedValues values(int seeds, double rate, double numerics = 0) const {
    SeedValues all;
    for (int seed = 1; seed <= seeds; ++seed)
      all[static_cast<std::uint64_t>(seed)] = value(static_cast<std::uint64_t>(seed), rate, numerics);
    return all;
  }
};

SettingError error_of(Planted const& planted, int seeds, double rate) {
  SeedValues const fast = planted.values(seeds, 3e-4), slow = planted.values(seeds, 3e-4 / ratio);
  return *setting_error(planted.values(seeds, rate), {fast, slow, ratio});
}

TEST(SettingError, IsThatOfRichardson) {
  // y = 10 + 2 I and 20 + 2 I: exact in the limit, however fast.
  SeedValues const fast{{1, 12}, {2, 22}}, slow{{1, 11}, {2, 21}}, faster{{1, 14}, {2, 24}, {7, 1}};
  SettingError const e = *setting_error(faster, {fast, slow, 2});
  EXPECT_EQ(e.seeds, 2) << "the third is at this rate only";
  EXPECT_DOUBLE_EQ(e.error, 4.0 / 15);
  EXPECT_DOUBLE_EQ(e.remainder, 1.0 / 15);
  EXPECT_DOUBLE_EQ(e.scatter, 0);
  EXPECT_DOUBLE_EQ(e.half_width, 1.0 / 15);
  EXPECT_DOUBLE_EQ(setting_error(slow, {fast, slow, 2})->error, 1.0 / 15) << "the slower rate's own error";
  // Seeds that disagree: errors of 2 and 4, with t for one degree of freedom.
  SeedValues const level{{1, 10}, {2, 10}};
  SettingError const apart = *setting_error({{1, 12}, {2, 14}}, {level, level, 2});
  EXPECT_DOUBLE_EQ(apart.error, 0.3);
  EXPECT_NEAR(apart.half_width, 12.706204736174698 * std::sqrt(2.0) / std::sqrt(2.0) / 10, 1e-12);
}

TEST(SettingError, NeedsTwoSeedsAndALimitThatIsNotZero) {
  SeedValues const one{{1, 12}}, zero{{1, 0}, {2, 0}};
  EXPECT_FALSE(setting_error(one, {one, one, 3}));
  EXPECT_FALSE(setting_error({{1, 1}, {2, 1}}, {zero, zero, 3}));
}

TEST(SettingError, HoldsTheTruthInAtLeast93PercentOfPlantedStudiesOfAnyOrderFromTheStatedOneOn) {
  for (double const order : {std::log((ratio + 1) / 2) / std::log(ratio), 0.7, 1.0, 1.4, 2.0})
    for (int const seeds : {3, 5, 12}) {
      Planted planted;
      planted.order = order;
      planted.coefficient = 0.02 / std::pow(1e-3, order);  // 2 % at I = 1e-3
      constexpr int studies = 600;
      int holding = 0;
      for (int study = 1; study <= studies; ++study) {
        planted.study = static_cast<std::uint64_t>(study);
        SettingError const e = error_of(planted, seeds, 1e-3);
        holding += std::fabs(e.error - planted.error(1e-3)) <= e.half_width ? 1 : 0;
      }
      EXPECT_GE(holding, 0.93 * studies) << "order " << order << ", " << seeds << " seeds";
    }
}

TEST(SettingError, HasTheWidthOfStudentWhereTheLimitIsReached) {
  Planted planted;
  planted.coefficient = 0;
  planted.specimens = 0;  // chaos alone
  double wide = 0;
  constexpr int studies = 400;
  for (int study = 1; study <= studies; ++study) {
    planted.study = static_cast<std::uint64_t>(study);
    SettingError const e = error_of(planted, 8, 1e-3);
    wide += (e.half_width - std::fabs(e.remainder)) / studies;
  }
  double const r = 1 / (ratio - 1), noise = planted.noise * std::sqrt(1 + (1 + r) * (1 + r) + r * r);
  double const mean_deviation = noise * std::sqrt(2.0 / 7) * std::tgamma(4.0) / std::tgamma(3.5);  // of eight normal values
  EXPECT_NEAR(wide, students_half_width(mean_deviation, 8), 0.05 * wide);
}

TEST(ErrorVerdict, AsksForTheWholeInterval) {
  SettingError e;
  e.error = -0.01, e.half_width = 0.005;
  EXPECT_EQ(verdict_on(e, 0.015), ErrorVerdict::within);
  EXPECT_EQ(verdict_on(e, 0.0149), ErrorVerdict::open);
  EXPECT_EQ(verdict_on(e, 0.0051), ErrorVerdict::open);
  EXPECT_EQ(verdict_on(e, 0.0049), ErrorVerdict::outside);
}

TEST(SeedsNeeded, AreTheFewestWhoseIntervalFits) {
  SettingError e;
  e.seeds = 5, e.error = 0.004, e.remainder = 0.001, e.scatter = 0.01;
  int const needed = *seeds_needed(e, 0.01);
  EXPECT_LE(students_half_width(e.scatter, needed), 0.005);
  EXPECT_GT(students_half_width(e.scatter, needed - 1), 0.005);
  EXPECT_EQ(needed, 18);
  e.error = 0.0095;
  EXPECT_FALSE(seeds_needed(e, 0.01)) << "the mean and the remainder fill the tolerance";
}

// --- The search.

struct Numerics {
  double error, cost;
};
constexpr Numerics numerics[] = {{0, 2}, {0.001, 1}, {-0.004, 0.5}, {0.03, 0.3}};
constexpr double rates[] = {3e-3, 1e-3, 3e-4, 1e-4, 3e-5};

std::vector<Trial> planted_trials() {
  std::vector<Trial> trials;
  for (double const rate : rates)
    for (Numerics const& n : numerics) {
      Trial trial;
      trial.rate = rate;
      trial.cost = n.cost * 1e-3 / rate;
      trial.on_ladder = &n == numerics;
      trials.push_back(trial);
    }
  return trials;
}
double true_error(Planted const& planted, std::size_t trial) {
  return planted.error(rates[trial / std::size(numerics)], numerics[trial % std::size(numerics)].error);
}

/// Runs a search to its end. @param most  runs, after which there is no time for more seeds
int run_search(SettingSearch& search, Planted const& planted, int most = 100000) {
  int runs = 0;
  while (std::optional<RunRequest> const request = search.next()) {
    if (runs > most) {
      search.stop_growing();
      if (search.choice() || runs > 2 * most) break;
      continue;
    }
    for (std::size_t const i : request->trials)
      for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(request->seeds); ++seed) {
        auto const added = search.trials()[i].values.try_emplace(
            seed, planted.value(seed, search.trials()[i].rate, numerics[i % std::size(numerics)].error));
        runs += added.second ? 1 : 0;
      }
  }
  return runs;
}

TEST(SettingSearch, FindsTheCheapestSettingWhereThereIsNoNoise) {
  Planted planted;
  planted.noise = 0;
  planted.coefficient = 20;  // 6, 2, 0.6, 0.2 % at the rates
  struct Case {
    double tolerance;
    std::size_t rate, numerics;
  };
  for (Case const& c : {Case{0.1, 0, 3}, Case{0.025, 1, 2}, Case{0.009, 2, 2}, Case{0.004, 3, 2}}) {
    SettingSearch search(c.tolerance, planted_trials());
    run_search(search, planted);
    ASSERT_TRUE(search.choice()) << c.tolerance;
    EXPECT_EQ(*search.choice(), c.rate * std::size(numerics) + c.numerics) << c.tolerance;
  }
}

TEST(SettingSearch, ChoosesNoSettingBeyondTheToleranceInMoreThan5PercentOfPlantedStudies) {
  for (double const tolerance : {0.01, 0.02, 0.05}) {
    constexpr int studies = 200;
    int chosen = 0, beyond = 0;
    for (int study = 1; study <= studies; ++study) {
      Planted planted;
      planted.study = static_cast<std::uint64_t>(study);
      // Errors on and around the tolerance, where a choice by chance would be most often a wrong one.
      planted.coefficient = tolerance * (0.5 + 0.01 * study) / 1e-3;
      SettingSearch search(tolerance, planted_trials());
      run_search(search, planted);
      if (!search.choice()) continue;
      ++chosen;
      beyond += std::fabs(true_error(planted, *search.choice())) > tolerance ? 1 : 0;
    }
    EXPECT_GE(chosen, 0.9 * studies) << tolerance;
    EXPECT_LE(beyond, 0.05 * studies) << tolerance;
  }
}

TEST(SettingSearch, SaysWhatIsNeededWhereTheNoiseIsTooLargeAndNeverGuesses) {
  Planted planted;
  planted.noise = 0.1;
  planted.coefficient = 1;
  SettingSearch search(0.01, planted_trials());
  int const runs = run_search(search, planted, 40);
  EXPECT_FALSE(search.choice());
  EXPECT_LT(runs, 100);
  // 1.8 sigma a seed and a room of 1 % less the remainder: some 1,500 seeds.
  planted.noise = 0.01;
  SettingSearch less(0.02, planted_trials());
  run_search(less, planted, 20);
  if (!less.choice()) {
    ASSERT_TRUE(less.undecided());
    EXPECT_GT(less.undecided()->second, 5);
  }
}

TEST(SettingSearch, LeavesOutWhatCannotBeRunAndGivesUpWithoutTheSlowRates) {
  Planted planted;
  planted.noise = 0;
  planted.coefficient = 20;
  SettingSearch search(0.025, planted_trials());
  search.trials()[1 * std::size(numerics) + 2].failed = true;
  run_search(search, planted);
  EXPECT_EQ(*search.choice(), 1 * std::size(numerics) + 1u);
  SettingSearch broken(0.025, planted_trials());
  broken.trials()[2 * std::size(numerics)].failed = true;
  EXPECT_FALSE(broken.next());
  EXPECT_FALSE(broken.choice());
}

TEST(SettingSearch, KeepsWhatItKnowsWhereASlowerRateCannotBeRunAnyMore) {
  Planted planted;
  planted.noise = 0;
  planted.coefficient = 20;  // 2 % at 1e-3, which a slower rate would show to be within 2.5 %
  for (bool const fails : {false, true}) {
    SettingSearch search(0.025, planted_trials());
    while (std::optional<RunRequest> const request = search.next()) {
      if (search.slow() == 3 * std::size(numerics) && search.trials()[search.slow()].values.empty()) {
        if (fails)
          search.trials()[search.slow()].failed = true;
        else
          search.stop_growing();
        continue;
      }
      for (std::size_t const i : request->trials)
        search.trials()[i].values =
            planted.values(request->seeds, search.trials()[i].rate, numerics[i % std::size(numerics)].error);
    }
    ASSERT_TRUE(search.choice());
    EXPECT_EQ(*search.choice(), 2 * std::size(numerics) + 2) << "of 3e-4, with the slowest at that rate";
  }
}

TEST(SettingSearch, RunsASlowerRateWhereTheLimitIsNotKnownWellEnough) {
  Planted planted;
  planted.noise = 0;
  planted.coefficient = 80;  // 0.8 % at 1e-4 and as much uncertainty
  SettingSearch search(0.01, planted_trials());
  run_search(search, planted);
  EXPECT_EQ(search.slow(), 4 * std::size(numerics));
  ASSERT_TRUE(search.choice());
  EXPECT_LE(std::fabs(true_error(planted, *search.choice())), 0.01);
}

}  // namespace
}  // namespace clathra
