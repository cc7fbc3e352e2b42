/// Same bits for any thread count and any order of the input. ctest runs this file with one and with two threads; the golden
/// values below are what makes the two comparable.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "domain/generation/random.hpp"
#include "domain/simulation/simulation.hpp"
#include "small_test.hpp"

namespace clathra {
namespace {

/// The same specimen with its discs in another order.
Specimen shuffled(Specimen specimen) {
  std::vector<std::size_t> order(specimen.size());
  std::iota(order.begin(), order.end(), 0);
  shuffle(order, 7, 1);
  Specimen const original = specimen;
  for (std::size_t i = 0; i < order.size(); ++i) {
    specimen.id[i] = original.id[order[i]];
    specimen.x[i] = original.x[order[i]];
    specimen.y[i] = original.y[order[i]];
    specimen.angle[i] = original.angle[order[i]];
    specimen.vx[i] = original.vx[order[i]];
    specimen.vy[i] = original.vy[order[i]];
    specimen.omega[i] = original.omega[order[i]];
    specimen.radius[i] = original.radius[order[i]];
  }
  shuffle(specimen.contacts, 7, 2);
  return specimen;
}

struct Outcome {
  std::uint64_t hash = 0;
  std::vector<HistoryRow> rows;
};

Outcome shear(Specimen const& specimen, Scene const& scene = small_test()) {
  BiaxialTest test(scene, specimen, {});
  Outcome outcome;
  while (!test.finished()) {
    while (!test.advance(100)) {
    }
    outcome.rows.push_back(test.record());
  }
  outcome.hash = test.state_hash();
  return outcome;
}

Outcome const& sheared() {
  static Outcome const outcome = shear(small_specimen());
  return outcome;
}

/// Every column of a row as text that tells any two bit patterns apart.
std::string exact_text(HistoryRow const& row) {
  std::string text;
  for_each_column(row, [&](char const* name, auto const& value) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>) {
      char buffer[64];
      std::snprintf(buffer, sizeof buffer, "%s=%a ", name, static_cast<double>(value));
      text += buffer;
    } else {
      text += value + " ";
    }
  });
  return text;
}

TEST(Determinism, ASpecimenShearedThroughBreakageHasTheGoldenState) {
  EXPECT_GT(sheared().rows.back().broken[BreakMode::rolling], 50);
  EXPECT_EQ(sheared().hash, 0x1fc737c3a5c36fc6ULL) << std::hex << sheared().hash;
}

TEST(Determinism, TheOrderOfTheInputDoesNotShow) {
  Outcome const other = shear(shuffled(small_specimen()));
  EXPECT_EQ(other.hash, sheared().hash);
  ASSERT_EQ(other.rows.size(), sheared().rows.size());
  for (std::size_t i = 0; i < other.rows.size(); ++i)
    EXPECT_EQ(exact_text(other.rows[i]), exact_text(sheared().rows[i])) << "record " << i;
}

TEST(Determinism, WhatIsWrittenDoesNotShowInTheState) {
  Scene scene = small_test();
  scene.output.records = 7;
  scene.output.snapshots = 3;
  scene.output.snapshots_at = {0.0123};
  scene.output.energy = true;
  scene.output.events = false;
  Outcome const other = shear(small_specimen(), scene);
  EXPECT_EQ(other.rows.size(), 7u);
  EXPECT_EQ(other.hash, sheared().hash);
  // What a row has of the steps since the row before is of other steps.
  HistoryRow last = other.rows.back(), same = sheared().rows.back();
  last.largest_q_Pa = same.largest_q_Pa, last.largest_q_eps1 = same.largest_q_eps1, last.dilation_deg = same.dilation_deg;
  EXPECT_EQ(exact_text(last), exact_text(same));
}

TEST(Determinism, AChangedBitChangesTheHash) {
  Specimen other = small_specimen();
  other.x[0] = std::nextafter(other.x[0], 1.0);
  SimulationLaws const laws;
  EXPECT_NE(Simulation(other, laws, 1e-5).assembly().hash(), Simulation(small_specimen(), laws, 1e-5).assembly().hash());
}

}  // namespace
}  // namespace clathra
