/// Peak and dilation of a test are those of all its steps, however many rows are written.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "domain/measurement/test_numbers.hpp"
#include "small_test.hpp"

namespace clathra {
namespace {

struct Columns {
  std::vector<double> eps1, eps_v, q, sigma3, intact, largest_q, largest_q_eps1, dilation;
  void add(HistoryRow const& row) {
    eps1.push_back(row.eps1), eps_v.push_back(row.eps_v), q.push_back(row.q_Pa), sigma3.push_back(row.sigma3_Pa);
    intact.push_back(row.bonds_intact_pct), largest_q.push_back(row.largest_q_Pa), largest_q_eps1.push_back(row.largest_q_eps1);
    dilation.push_back(row.dilation_deg);
  }
  TestNumbers numbers() const { return test_numbers({eps1, eps_v, q, sigma3, intact, largest_q, largest_q_eps1, dilation}); }
};

/// The numbers of a test with so many rows; the second half by a test that goes on from the state of the first, taken between two
/// rows.
TestNumbers numbers_with(int records, bool taken_apart = false) {
  Scene scene = small_test();
  scene.test.inertial_number = 5e-4;
  scene.output.records = records;
  auto test = std::make_unique<BiaxialTest>(scene, small_specimen(), nullptr);
  Columns columns;
  columns.add(test->record());
  while (!test->finished()) {
    if (taken_apart && test->fraction() > 0.5) {
      taken_apart = false;
      (void)test->advance(7);
      test = std::make_unique<BiaxialTest>(scene, test->state(), Ranks{});
    }
    if (test->advance(1'000'000)) columns.add(test->record());
  }
  return columns.numbers();
}

TEST(Numbers, OfPeakAndDilationAreThoseOfAllSteps) {
  TestNumbers const fine = numbers_with(4000);
  ASSERT_TRUE(fine.dilation_angle);
  EXPECT_TRUE(fine.passed_peak);
  for (int const records : {3, 40, 300}) {
    for (bool const taken_apart : {false, true}) {
      TestNumbers const n = numbers_with(records, taken_apart);
      EXPECT_EQ(n.peak_q, fine.peak_q) << records;
      EXPECT_EQ(n.peak_eps1, fine.peak_eps1) << records;
      EXPECT_EQ(n.dilation_angle, fine.dilation_angle) << records;
    }
  }
}

/// Step by step, the largest q of any step is what is kept.
TEST(Numbers, OfThePeakMissNoStep) {
  Scene scene = small_test();
  scene.test.axial_strain = 2e-3;
  scene.output.records = 1;
  BiaxialTest whole(scene, small_specimen(), {}), stepped(scene, small_specimen(), {});
  (void)whole.record();
  double largest = stepped.record().q_Pa, eps1 = 0;
  while (!stepped.finished()) {
    (void)stepped.advance(1);
    HistoryRow const now = stepped.record();
    if (now.q_Pa > largest) largest = now.q_Pa, eps1 = now.eps1;
  }
  while (!whole.finished()) (void)whole.advance(1'000'000);
  HistoryRow const row = whole.record();
  EXPECT_EQ(row.largest_q_Pa, largest);
  EXPECT_EQ(row.largest_q_eps1, eps1);
}

}  // namespace
}  // namespace clathra
