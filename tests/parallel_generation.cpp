/// Specimens are those that were asked for: void ratio, stress, rest and sizes, or a refusal with a number that works.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "domain/biaxial/scene_cost.hpp"
#include "domain/generation/compression.hpp"
#include "domain/generation/generation.hpp"
#include "domain/generation/loose_discs.hpp"
#include "domain/generation/packing.hpp"
#include "domain/measurement/disc_grading.hpp"
#include "domain/parallel/near_pairs.hpp"
#include "domain/scene/specimen_design.hpp"
#include "printed_number.hpp"
#include "scenes.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

Scene scene_of(Generator generator, double void_ratio, std::int64_t particles = 300) {
  Scene scene;
  scene.specimen.generator = generator;
  scene.specimen.particles = particles;
  scene.specimen.void_ratio = void_ratio;
  return scene;
}

void expect_as_asked(Scene const& scene) {
  GeneratedSpecimen const made = generate_specimen(scene, {});
  double const stress = scene.specimen.preparation_stress;
  EXPECT_NEAR(made.record.at("void_ratio"), scene.specimen.void_ratio, 0.001);
  EXPECT_NEAR(made.record.at("stress_x_Pa"), stress, 0.01 * stress);
  EXPECT_NEAR(made.record.at("stress_y_Pa"), stress, 0.01 * stress);
  EXPECT_LT(made.record.at("unbalanced"), 1e-3);
  EXPECT_LT(made.record.at("grading_distance"), 1e-3);
  EXPECT_EQ(made.specimen.size(), static_cast<std::size_t>(scene.specimen.particles));
  SpecimenDesign const design = design_sample(scene);
  EXPECT_NEAR(made.specimen.height() / made.specimen.width(), design.height / design.width, 0.035 * design.height / design.width);
}

class EitherGenerator : public testing::TestWithParam<Generator> {};
INSTANTIATE_TEST_SUITE_P(Specimens, EitherGenerator, testing::Values(Generator::under_compaction, Generator::compression),
                         [](auto const& with) {
                           return with.param == Generator::compression ? "Compression" : "UnderCompaction";
                         });

TEST_P(EitherGenerator, MeetsVoidRatioStressSizesAndShape) {
  for (double const void_ratio : {0.24, 0.28}) {
    SCOPED_TRACE(void_ratio);
    expect_as_asked(scene_of(GetParam(), void_ratio, 600));
  }
  Scene scene = scene_of(GetParam(), 0.24, 600);
  scene.specimen.preparation_stress = 1e6;
  expect_as_asked(scene);
}

/// What the message offers works when it is asked for.
void expect_refused_with_help(Scene scene, std::string const& why) {
  try {
    (void)generate_specimen(scene, {});
    FAIL() << "not refused: " << scene.specimen.void_ratio;
  } catch (Refused const& refusal) {
    std::string const text = refusal.what(), before = "specimen.void_ratio = ";
    EXPECT_NE(text.find(why), std::string::npos) << text;
    auto const at = text.find(before);
    ASSERT_NE(at, std::string::npos) << text;
    scene.specimen.void_ratio = std::stod(text.substr(at + before.size()));
  }
  expect_as_asked(scene);
}

TEST_P(EitherGenerator, RefusesWhatGrainsCannotHaveWithANumberThatWorks) {
  Scene scene = scene_of(GetParam(), 0.07, 300);
  expect_refused_with_help(scene, "looser than the");
  scene.specimen.void_ratio = 0.5;
  expect_refused_with_help(scene, "denser than the");
}

TEST(Compression, TellsOfAVoidRatioThatFollowsFromTheBox) {
  Scene scene = scene_of(Generator::compression, 0.165);
  SpecimenDesign const design = design_sample(scene);
  scene.specimen.width = design.width, scene.specimen.height = design.height, scene.specimen.void_ratio = 0;
  try {
    (void)generate_specimen(scene, {});
    FAIL();
  } catch (Refused const& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("follows from specimen.particles and the box"), std::string::npos)
        << refusal.what();
  }
}

/// Stiff grains of a wide grading under a high stress: what they missed in silence once.
TEST_P(EitherGenerator, MeetsADenseTargetUnderAHighStressOrRefusesIt) {
  Scene scene = scene_of(GetParam(), 0.17);
  scene.specimen.preparation_stress = 1e6;
  try {
    EXPECT_NEAR(generate_specimen(scene, {}).record.at("void_ratio"), 0.17, 0.001);
  } catch (Refused const& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("was tried and works"), std::string::npos) << refusal.what();
  }
}

/// A denser specimen of as many discs is a smaller one.
TEST(Specimens, ThatAreOfferedSayWhereTheyWouldBeTooNarrow) {
  Scene scene = scene_of(Generator::compression, 0.7, 16);
  scene.specimen.aspect_ratio = 0.5;
  SpecimenMaker const none_as_loose = [](Scene const& tried) -> GeneratedSpecimen {
    if (tried.specimen.void_ratio > 0.3) throw VoidRatioMissed("too loose", 0.3, /*is_denser=*/false);
    return {};
  };
  auto const said = [&] {
    try {
      (void)made_or_advised(scene, none_as_loose);
    } catch (Refused const& refusal) {
      return std::string(refusal.what());
    }
    return std::string("made");
  };
  EXPECT_EQ(said(), "too loose; specimen.void_ratio = 0.3 was tried and works, with more specimen.particles: " +
                        narrowness(design_sample(scene).width * std::sqrt(1.3 / 1.7),
                                   design_sample(scene).height * std::sqrt(1.3 / 1.7), design_sample(scene).grading.largest()));
  scene.specimen.particles = 300;
  EXPECT_EQ(said(), "too loose; specimen.void_ratio = 0.3 was tried and works");
}

TEST(Specimens, OfSoftGrainsAreWarnedOf) {
  Scene scene = scene_of(Generator::under_compaction, 0.24);
  EXPECT_TRUE(generate_specimen(scene, {}).warnings.empty());
  scene = scene_of(Generator::compression, 0.138);
  scene.specimen.preparation_stress = 1e6;
  scene.grains.normal_stiffness = 3e7, scene.grains.shear_stiffness = 2e7;
  std::vector<std::string> const warnings = generate_specimen(scene, {}).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("overlap by more than 10 %"), std::string::npos) << warnings[0];
}

/// A wide curve in few discs: sizes of the whole are its quantiles, and each layer has its share of all of them.
TEST(Sizes, OfAllLayersTogetherAreTheQuantilesOfTheCurve) {
  Grading const wide({0.1e-3, 0.6e-3}, {0, 1});
  constexpr std::int64_t particles = 303;
  constexpr int layers = 5;
  LooseDiscs const loose(wide, particles, layers, 1);
  std::vector<double> all;
  double least = HUGE_VAL, most = 0;
  for (int layer = 0; layer < layers; ++layer) {
    std::vector<double> const radii = loose.radii(layer);
    all.insert(all.end(), radii.begin(), radii.end());
    least = std::min(least, loose.solid_area(layer)), most = std::max(most, loose.solid_area(layer));
  }
  std::sort(all.begin(), all.end());
  std::vector<double> const wanted = wide.diameters(particles);
  ASSERT_EQ(all.size(), wanted.size());
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], 0.5 * wanted[i]);
  EXPECT_LT(most / least, 1.25);
}

TEST(Sizes, OfEqualDiscsAreOnTheirCurve) {
  EXPECT_LT(grading_distance(Grading::uniform(2e-4), std::vector<double>(300, 1e-4), {}), 1e-12);
  EXPECT_GT(grading_distance(Grading::uniform(2e-4), std::vector<double>(300, 0.9e-4), {}), 0.9);
}

/// Equal discs jam at a solid fraction of 0.547 if they are added at random: for some seeds 0.46 has no room for all.
TEST(LoosePlaces, AreFoundForEqualDiscsToo) {
  Grading const equal = Grading::uniform(2e-4);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Specimen s;
    s.right = 7 * 2e-4;
    LooseDiscs(equal, 50, 1, seed).add_layer(s, 0, 0, {});
    ASSERT_EQ(s.size(), 50u);
    EXPECT_EQ(near_pairs(s, s.size(), 0).size(), 0u) << "seed " << seed;
    for (std::size_t i = 0; i < s.size(); ++i) EXPECT_TRUE(s.y[i] >= 1e-4 && s.y[i] <= s.top - 1e-4);
  }
}

/// Chance would leave one band of this tall box a hundredth denser than the next, which a large specimen keeps.
TEST(LoosePlaces, AreNoDenserInOneBandThanInAnother) {
  Grading const sand = Grading::toyoura();
  constexpr int particles = 16'000, bands = 16;
  Specimen s;
  s.right = 0.01;
  LooseDiscs(sand, particles, 1, 1).add_layer(s, 0, 0, {});
  std::vector<double> share(bands);
  for (std::size_t i = 0; i < s.size(); ++i)
    share[static_cast<std::size_t>(bands * s.y[i] / s.height())] += 1.0 * bands / particles;
  // Those at the walls have less room for centres.
  auto const [least, most] = std::minmax_element(share.begin() + 1, share.end() - 1);
  EXPECT_LT(*most - *least, 0.04);
  double square = 0, mean = 0;
  for (auto band = share.begin() + 1; band + 1 != share.end(); ++band)
    mean += *band / (bands - 2), square += *band * *band / (bands - 2);
  EXPECT_LT(std::sqrt(square - mean * mean), 0.01);
}

/// Two sizes, a third of the sand the finer: rows of neighbours hold them up to a ratio that a scene is told of.
TEST(Sizes, MayDifferAsFarAsRowsOfNeighboursReach) {
  auto const two_sizes = [](double ratio) {
    return Grading({0.1e-3, 0.105e-3, 0.098e-3 * ratio, 0.1e-3 * ratio}, {0, 0.35, 0.35, 1});
  };
  EXPECT_NEAR(most_neighbours(Grading::uniform(1e-3), 0), 6, 1e-9);
  EXPECT_NEAR(most_neighbours(two_sizes(20), 0), 66, 0.1);
  constexpr double largest = 2e-3, bonds = 0.15e-3;
  auto const crowded = [](double ratio, double reach) { return crowding(largest / ratio, largest, reach); };
  EXPECT_EQ(crowded(20, 0), "");
  std::string const text = crowding(0.1e-3, 4e-3, 0);
  EXPECT_NE(text.find("40 times the smallest (0.1 mm)"), std::string::npos) << text;
  EXPECT_NE(text.find("may be 29.5 at most"), std::string::npos) << text;
  EXPECT_EQ(crowded(29.5, 0), "");
  // Bonds reach the second ring. The ratio that is offered fits grains as large as these.
  std::string const bonded = crowded(20, bonds);
  double const offered = number_after(bonded, "the ratio may be ");
  EXPECT_EQ(crowded(offered, bonds), "") << bonded;
  EXPECT_NE(crowded(offered + 0.2, bonds), "") << bonded;
}

/// What it says fits is what a row holds.
TEST(Sizes, TellHowWideASkinMayBe) {
  Grading const sand = Grading::toyoura();
  EXPECT_EQ(wide_skin(sand, 0), "");
  EXPECT_EQ(wide_skin(sand, 0.3e-3), "");
  std::string const text = wide_skin(sand, 1e-3);
  EXPECT_NE(text.find("within 1 mm of a grain there may be more neighbours than the 96"), std::string::npos) << text;
  EXPECT_NE(text.find("the skin may be 0.368 mm at most"), std::string::npos) << text;
  EXPECT_EQ(wide_skin(sand, 0.368e-3), "");
  EXPECT_NE(wide_skin(sand, 0.37e-3), "");
}

/// Where the fines are an eighth of the rest, specimens were once lost to rows that were too short.
TEST(Sizes, OfAGapGradedSandMakeASpecimen) {
  Scene scene = scene_of(Generator::compression, 0.2, 600);
  Grading const gap({0.1e-3, 0.105e-3, 0.8e-3, 0.84e-3}, {0, 0.35, 0.35, 1});
  SpecimenDesign design = design_sample(scene);
  design.grading = gap;
  design.width = 8e-3;
  PackedSpecimen const packed = pack_by_compression(scene, design, {});
  EXPECT_NEAR(packed.specimen.void_ratio, 0.2, 0.001);
}

/// What diverges, jams too loose or does not rest is tried at lower rates; grains that hold nothing as loose are not.
TEST(SlowerWhereItFails, TriesFourTimesWhatMayFailByChance) {
  int last = 0;
  auto const failing_until = [&](int success, auto const& failure) {
    return [&last, success, failure](int slowness) {
      last = slowness;
      if (slowness < success) throw failure;
      return 10 * slowness;
    };
  };
  EXPECT_EQ(slower_where_it_fails(failing_until(3, Diverged("crushed"))), 30);
  EXPECT_EQ(slower_where_it_fails(failing_until(4, Refused("no rest"))), 40);
  EXPECT_EQ(slower_where_it_fails(failing_until(2, VoidRatioMissed("jammed", 0.3, true))), 20);
  EXPECT_THROW(slower_where_it_fails(failing_until(5, Diverged("crushed"))), Diverged);
  EXPECT_EQ(last, 4);
  EXPECT_THROW(slower_where_it_fails(failing_until(2, VoidRatioMissed("too loose", 0.2, false))), VoidRatioMissed);
  EXPECT_EQ(last, 1);
}

/// With this seed a large disc crushed a small one against another when a wall compacted the layers.
TEST(UnderCompaction, OfAGapGradedSandMakesASpecimen) {
  fs::path const curve = fs::temp_directory_path() / ("clathra_crushed_" + std::to_string(::getpid()) + ".csv");
  std::ofstream(curve) << "d_mm,percent_finer\n0.42,0\n0.50,35\n2.08,35\n2.40,100\n";
  Scene scene = scene_of(Generator::under_compaction, 0.2, 300);
  scene.grading.file = curve.string();
  scene.run.seed = 36;
  GeneratedSpecimen const made = generate_specimen(scene, {});
  EXPECT_NEAR(made.specimen.void_ratio, 0.2, 0.001);
  EXPECT_NEAR(predict(scene).at("generation_particle_steps") / made.record.at("particle_steps"), 1, 0.5)
      << "knows how wide the curve is";
  fs::remove(curve);
}

TEST(Layers, AreStrainedAboveTheirFloorAlone) {
  Specimen const before = disordered_patch(6, 6);
  Simulation simulation(before, {}, 0.1 * grain_d50);
  double const floor = 0.5 * (before.bottom + before.top), strain = 1e-3;
  simulation.strain_above(floor, strain);
  Specimen const after = simulation.specimen();
  auto const strained = [&](double y) { return y < floor ? y : floor + (1 - strain) * (y - floor); };
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after.x[i], before.x[i]);
    EXPECT_NEAR(after.y[i], strained(before.y[i]), 1e-12 * before.top) << i;
  }
  EXPECT_EQ(after.bottom, before.bottom);
  EXPECT_NEAR(after.top, strained(before.top), 1e-12 * before.top);
}

/// Patches of a wide layer side by side: no overlap across their seams, and no gap along them either.
TEST(Patches, JoinWithoutASeam) {
  Grading const sand = Grading::toyoura();
  constexpr std::int64_t particles = 210'000;
  Specimen s;
  s.right = 0.08;
  LooseDiscs(sand, particles, 1, 1).add_layer(s, 0, 0, {});
  ASSERT_EQ(s.size(), static_cast<std::size_t>(particles));
  double const reach = sand.largest();
  for (double const seam : {s.right / 3, 2 * s.right / 3}) {
    std::vector<std::size_t> near;
    int inside = 0;  // centres within half the largest diameter
    for (std::size_t i = 0; i < s.size(); ++i) {
      if (std::abs(s.x[i] - seam) < reach) near.push_back(i);
      inside += std::abs(s.x[i] - seam) < 0.5 * reach ? 1 : 0;
    }
    double const expected = static_cast<double>(particles) * reach / s.right;
    EXPECT_NEAR(inside, expected, 4 * std::sqrt(expected));
    std::sort(near.begin(), near.end(), [&](std::size_t a, std::size_t b) { return s.y[a] < s.y[b]; });
    for (std::size_t n = 0; n < near.size(); ++n) {
      for (std::size_t m = n + 1; m < near.size() && s.y[near[m]] - s.y[near[n]] < reach; ++m) {
        double const dx = s.x[near[n]] - s.x[near[m]], dy = s.y[near[n]] - s.y[near[m]];
        ASSERT_GE(std::hypot(dx, dy), (s.radius[near[n]] + s.radius[near[m]]) * (1 - 1e-12));
      }
    }
  }
}

TEST(Layers, AreFewerWhereTheyWouldBeTooThin) {
  Scene scene = scene_of(Generator::under_compaction, 0.24, 300);
  scene.specimen.compaction_layers = 20;
  SpecimenDesign const design = design_sample(scene);
  EXPECT_EQ(compaction_layers(scene, design), 6);  // of 50 discs
  scene.specimen.particles = 0, scene.specimen.width = 26e-3, scene.specimen.height = 0.95e-3;
  EXPECT_EQ(compaction_layers(scene, design_sample(scene)), 3);  // each as high as its largest grain
}

}  // namespace
}  // namespace clathra
