/// The stages before the shear are recorded: what their rows say agrees with what the test says of them.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "small_test.hpp"

namespace clathra {
namespace {

class ConsolidationRows : public testing::Test {
 protected:
  /// Hydrate forms before the consolidation, of which there is then one.
  static Scene bonded_first() {
    Scene scene = small_test();
    scene.bond.after_consolidation = false;
    return scene;
  }
  static std::vector<HistoryRow> rows_of_stage(BiaxialTest const& test, std::string const& stage) {
    std::vector<HistoryRow> rows;
    for (HistoryRow const& row : test.consolidation())
      if (row.stage == stage) rows.push_back(row);
    return rows;
  }
  /// The area follows from the void ratio as from the strains, whose place to start from is the first row.
  static void expect_strains_of_void_ratios(std::vector<HistoryRow> const& rows) {
    for (HistoryRow const& row : rows)
      EXPECT_NEAR(row.eps_v, std::log((1 + rows.front().void_ratio) / (1 + row.void_ratio)), 1e-12) << row.step;
  }
};

TEST_F(ConsolidationRows, IsRecordedFromThePreparationToTheConfiningStress) {
  Scene const scene = bonded_first();
  BiaxialTest test(scene, small_specimen(), {});
  std::vector<HistoryRow> const& rows = test.consolidation();
  ASSERT_GT(rows.size(), 40u);
  for (HistoryRow const& row : rows) EXPECT_EQ(row.stage, "consolidation");
  HistoryRow const &first = rows.front(), &last = rows.back();
  EXPECT_EQ(first.step, 0);
  EXPECT_EQ(first.eps1, 0);
  EXPECT_EQ(first.time_s, 0);
  EXPECT_NEAR(first.p_Pa, scene.specimen.preparation_stress, 0.02 * scene.specimen.preparation_stress);
  EXPECT_NEAR(last.p_Pa, scene.test.confining_stress, 0.005 * scene.test.confining_stress);
  EXPECT_EQ(first.void_ratio, test.preparation().at("void_ratio_before_consolidation"));
  EXPECT_EQ(last.void_ratio, test.preparation().at("void_ratio_after_consolidation"));
  EXPECT_EQ(static_cast<double>(last.step), test.preparation().at("consolidation_steps"));
  EXPECT_EQ(static_cast<double>(last.broken.total()), test.preparation().at("broken_in_consolidation"));
  EXPECT_EQ(last.bonds_intact + static_cast<std::int64_t>(last.broken.total()), first.bonds_intact);
  expect_strains_of_void_ratios(rows);
  for (std::size_t k = 1; k < rows.size(); ++k) {
    EXPECT_GT(rows[k].step, rows[k - 1].step);
    EXPECT_GT(rows[k].time_s, rows[k - 1].time_s);
    EXPECT_LT(std::abs(rows[k].p_Pa - rows[k - 1].p_Pa), 0.03 * scene.test.confining_stress) << "no part of the curve is missing";
  }
}

/// Both pairs of walls close at the same rate, I = 2e-4, until the stress is nearly reached.
TEST_F(ConsolidationRows, SaysHowFastItIs) {
  Scene const scene = bonded_first();
  BiaxialTest const test(scene, small_specimen(), {});
  HistoryRow const* middle = nullptr;
  for (HistoryRow const& row : test.consolidation())
    if (middle == nullptr && row.p_Pa > 0.5 * scene.test.confining_stress) middle = &row;
  ASSERT_NE(middle, nullptr);
  double const at_target = middle->inertial_number * std::sqrt(middle->sigma3_Pa / scene.test.confining_stress);
  EXPECT_NEAR(at_target, 2e-4, 2e-6);
}

TEST_F(ConsolidationRows, BeforeAndAfterHydrateFormsAreTwoStages) {
  BiaxialTest test(small_test(), small_specimen(), {});
  std::vector<HistoryRow> const sand = rows_of_stage(test, "consolidation"),
                                hydrate = rows_of_stage(test, "consolidation with hydrate");
  ASSERT_GE(sand.size(), 2u);
  ASSERT_GE(hydrate.size(), 2u);
  EXPECT_EQ(sand.size() + hydrate.size(), test.consolidation().size());
  EXPECT_EQ(sand.back().bonds_intact, 0);
  EXPECT_EQ(static_cast<double>(hydrate.front().bonds_intact), test.preparation().at("bonds"));
  EXPECT_NEAR(hydrate.front().void_ratio, sand.back().void_ratio, 1e-12);
  expect_strains_of_void_ratios(sand);
  expect_strains_of_void_ratios(hydrate);
  EXPECT_EQ(test.record().stage, "shear");
}

TEST_F(ConsolidationRows, EndsWhereTheShearBegins) {
  BiaxialTest test(bonded_first(), small_specimen(), {});
  HistoryRow const last = test.consolidation().back(), shear = test.record();
  EXPECT_EQ(shear.stage, "shear");
  EXPECT_EQ(shear.step, 0);
  EXPECT_EQ(shear.eps1, 0);
  EXPECT_EQ(shear.eps_v, 0);
  EXPECT_EQ(shear.void_ratio, last.void_ratio);
  EXPECT_EQ(shear.bonds_intact, last.bonds_intact);
  EXPECT_EQ(shear.sigma3_Pa, last.sigma3_Pa);
  BiaxialTest resumed(bonded_first(), test.state(), {});
  EXPECT_TRUE(resumed.consolidation().empty());
  EXPECT_EQ(resumed.record().stage, "shear");
}

/// A test that is looked at every so many steps, and taken apart and put together each time.
struct TakenApart {
  std::vector<HistoryRow> rows;
  int restarts_in_consolidation = 0;
  std::uint64_t hash_at_loading = 0;
};

TakenApart consolidated_in_parts(Scene const& scene, std::int64_t pace, bool restart) {
  auto test = std::make_unique<BiaxialTest>(BiaxialTest::to_consolidate(scene, small_specimen()));
  TakenApart course;
  course.rows.push_back(test->record());
  while (test->consolidates()) {
    if (restart) {
      test = std::make_unique<BiaxialTest>(scene, test->state(), Ranks{});
      ++course.restarts_in_consolidation;
    }
    if (test->advance(pace) && test->consolidates()) course.rows.push_back(test->record());
  }
  course.hash_at_loading = test->state_hash();
  return course;
}

TEST_F(ConsolidationRows, KnowNeitherThePaceOfTheCallerNorRestarts) {
  for (Precision const precision : {Precision::full, Precision::mixed}) {
    Scene scene = small_test();
    scene.run.precision = precision;
    BiaxialTest const whole(scene, small_specimen(), ProgressCallback());
    for (auto const& [pace, restart] :
         {std::pair{std::int64_t{7}, false}, {std::int64_t{333}, true}, {std::int64_t{5000}, true}}) {
      TakenApart const parts = consolidated_in_parts(scene, pace, restart);
      EXPECT_EQ(parts.hash_at_loading, whole.state_hash()) << pace;
      ASSERT_EQ(parts.rows.size(), whole.consolidation().size()) << pace;
      EXPECT_TRUE(!restart || parts.restarts_in_consolidation > 5);
      for (std::size_t i = 0; i < parts.rows.size(); ++i) {
        HistoryRow const &one = parts.rows[i], &other = whole.consolidation()[i];
        EXPECT_EQ(one.stage, other.stage) << i;
        EXPECT_EQ(one.step, other.step) << i;
        EXPECT_EQ(one.eps_v, other.eps_v) << i;
        EXPECT_EQ(one.p_Pa, other.p_Pa) << i;
        EXPECT_EQ(one.inertial_number, other.inertial_number) << i;
      }
    }
  }
}

}  // namespace
}  // namespace clathra
