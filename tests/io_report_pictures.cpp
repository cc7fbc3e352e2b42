/// The pictures of the report: that a pixel is what the snapshot holds.
#include <gtest/gtest.h>
#include <png.h>

#include <chrono>
#include <cmath>
#include <random>

#include "domain/measurement/fabric.hpp"
#include "io/report/colours.hpp"
#include "io/report/grading_figure.hpp"
#include "io/report/map_figures.hpp"
#include "io/report/maps.hpp"
#include "io/report/markup.hpp"
#include "io/report/png.hpp"
#include "io/report/report.hpp"
#include "report_runs.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// A PNG as libpng reads it.
struct Decoded {
  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;
  explicit Decoded(std::string const& png) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_memory(&image, png.data(), png.size()), 0);
    image.format = PNG_FORMAT_RGB;
    bytes.resize(PNG_IMAGE_SIZE(image));
    EXPECT_NE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr), 0);
    width = static_cast<int>(image.width), height = static_cast<int>(image.height);
  }
  Rgb at(double x, double y) const {
    std::size_t const place = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    return {bytes[place], bytes[place + 1], bytes[place + 2]};
  }
};

MapView whole(Snapshot const& s, int pixels) {
  MapView view = view_of({&s});
  view.pixels = pixels;
  return view;
}

TEST(ReportPictures, ShowEveryBondInTheColourOfItsState) {
  Snapshot s = made_up_lattice(8, 8);
  for (std::size_t k = 0; k < s.state.size(); ++k) s.state[k] = static_cast<std::uint8_t>(k % contact_state_count);
  MapView const view = whole(s, 800);
  Decoded const picture(png_bytes(bond_map(s, view)));
  EXPECT_EQ(picture.height, 800);
  for (std::size_t k = 0; k < s.state.size(); ++k) {
    auto const a = static_cast<std::size_t>(s.a[k]), b = static_cast<std::size_t>(s.b[k]);
    Rgb const pixel = picture.at(view.x((s.x[a] + s.x[b]) / 2), view.y((s.y[a] + s.y[b]) / 2));
    auto const state = static_cast<ContactState>(s.state[k]);
    if (state == ContactState::contact)
      EXPECT_EQ(pixel, (Rgb{255, 255, 255})) << k;
    else if (state == ContactState::bonded)
      EXPECT_LT(pixel.red, 250) << "a thin line is mixed with the paper, " << k;
    else
      EXPECT_EQ(pixel, state_colour(state)) << k;
  }
}

TEST(ReportPictures, MarkABrokenBondNoLongerThanItWas) {
  Snapshot s = made_up_lattice(9, 9);
  s.a = {0}, s.b = {8}, s.normal_force = {0}, s.width = {0};
  s.state = {static_cast<std::uint8_t>(broken_in(BreakMode::tension))};
  MapView const view = whole(s, 450);
  Canvas const canvas = bond_map(s, view);
  auto const pixel = [&](std::size_t disc) { return canvas.pixel(int(view.x(s.x[disc])), int(view.y(s.y[disc]))); };
  EXPECT_EQ(pixel(4), state_colour(broken_in(BreakMode::tension))) << "in the middle between the grains";
  EXPECT_EQ(pixel(2), (Rgb{255, 255, 255}));
}

TEST(ReportPictures, DrawGrainsAndForcesWhereTheyAre) {
  Snapshot s = made_up_lattice(6, 6);
  s.radius[7] *= 0.5f;
  MapView const view = whole(s, 600);
  EXPECT_LT(view.y(s.top), view.y(s.bottom)) << "up is up";
  Canvas const grains = grain_map(s, view);
  auto const at = [&](Canvas const& c, double x, double y) { return c.pixel(int(view.x(x)), int(view.y(y))); };
  EXPECT_EQ(at(grains, s.x[7], s.y[7]), ramp(0)) << "the smallest";
  EXPECT_EQ(at(grains, s.x[8], s.y[8]), ramp(1));
  s.normal_force.assign(s.a.size(), 0.0f);
  s.normal_force[0] = 5, s.normal_force[20] = -5;
  Canvas const forces = force_map(s, view);
  auto const middle = [&](std::size_t k) {
    auto const a = static_cast<std::size_t>(s.a[k]), b = static_cast<std::size_t>(s.b[k]);
    return at(forces, (s.x[a] + s.x[b]) / 2, (s.y[a] + s.y[b]) / 2);
  };
  EXPECT_EQ(middle(0), map_colours::pressing);
  EXPECT_EQ(middle(20), map_colours::pulling);
  EXPECT_EQ(middle(10), (Rgb{255, 255, 255})) << "no force, no line";
  std::vector<float> values(s.x.size(), 0.0f);
  values[9] = 2, values[10] = NAN;
  Canvas const field = value_map(s, values, 2, view);
  EXPECT_EQ(at(field, s.x[9], s.y[9]), ramp(1));
  EXPECT_EQ(at(field, s.x[10], s.y[10]), map_colours::unknown);
}

TEST(ReportPictures, DrawNothingOutsideAndNothingThatIsNoNumber) {
  Canvas canvas(20, 10);
  for (double const wild : {-1e300, 1e300, std::nan(""), HUGE_VAL}) {
    canvas.disc(wild, 5, 3, colours::blue);
    canvas.disc(5, wild, 3, colours::blue);
    canvas.disc(500, 500, 3, colours::blue);
    canvas.line(wild, 2, wild, 4, 2, colours::blue);
  }
  for (Rgb const pixel : canvas.pixels()) EXPECT_EQ(pixel, (Rgb{255, 255, 255}));
  canvas.disc(10.5, 5.5, 0.1, colours::black);
  EXPECT_NEAR(canvas.pixel(10, 5).red, 255 * (1 - 0.04), 1) << "a particle of a fifth of a pixel is a pale pixel";
}

TEST(ReportPictures, KeepTheirFlatColoursWhenThereAreMoreThanAPaletteHolds) {
  Canvas canvas(256, 64);
  for (int i = 0; i < 4000; ++i)
    canvas.line(i % 256, 0, (i * 7) % 256, 32, 0.3, {std::uint8_t(i), std::uint8_t(i / 3), std::uint8_t(i / 7)});
  canvas.line(0, 48, 256, 48, 20, colours::vermilion);
  Decoded const picture(png_bytes(canvas));
  EXPECT_EQ(picture.at(100, 48), colours::vermilion);
  double error = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 256; ++x) error += std::abs(picture.at(x, y).green - canvas.pixel(x, y).green) / (256.0 * 64);
  EXPECT_LT(error, 8);
}

TEST(ReportPage, WritesNumbersForPeople) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(-1234567), "−1,234,567");
  EXPECT_EQ(grouped(NAN), "–");
  EXPECT_EQ(with_minus("-0.00"), "0.00");
  EXPECT_EQ(with_minus("-0.01"), "−0.01");
}

TEST(ReportPage, MakesTextHarmless) {
  EXPECT_EQ(escaped("a<b>&\"c\""), "a&lt;b&gt;&amp;&quot;c&quot;");
  EXPECT_EQ(escaped("\xff\x01 σ₃ \xe2\x82"), "?? σ₃ ??");
}

TEST(ReportPictures, AreTextInThePage) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\x00\xfe", 3)), "/wD+");
}

/// Weak contacts are most of those that lie across the strong ones: without them the fabric looks more directed than it is.
TEST(ReportRose, CountsContactsThatAreTooWeakForTheDigitsOfASnapshot) {
  fs::path const file = fs::temp_directory_path() / ("clathra_rose_" + std::to_string(::getpid()) + ".h5");
  Snapshot s = made_up_lattice(30, 30);
  std::size_t weak = 0, gone = 0;
  for (std::size_t k = 0; k < s.a.size(); ++k) {
    bool const upright = s.b[k] != s.a[k] + 1;
    s.state[k] = static_cast<std::uint8_t>(k % 3 == 0 ? broken_in(BreakMode::rolling) : ContactState::contact);
    s.normal_force[k] = upright ? 100 : 0.01, s.gap[k] = -1e-3 * s.normal_force[k] * s.d50 / 100;
    if (k % 9 == 0) s.normal_force[k] = 0, s.gap[k] = 1e-6 * s.d50, ++gone;
    if (k % 9 != 0 && !upright) ++weak;
  }
  write_snapshot(file, s);
  Snapshot const back = read_snapshot(file);
  fs::remove(file);
  EXPECT_GE(static_cast<std::size_t>(std::count(back.normal_force.begin(), back.normal_force.end(), 0.0)), weak + gone)
      << "they are rounded to 0";
  Rose const rose = rose_of(back, ContactSet::touching);
  EXPECT_EQ(rose.pairs, s.a.size() - gone);
  EXPECT_NEAR(rose.normals[0], 9, 0.1) << "across";
}

TEST(ReportGrading, CountsMassByTheAreaOfDiscs) {
  Curve const curve = grading_curve({1e-3f, 1e-3f, 1e-3f, 1e-3f, 2e-3f}, "a", {});
  EXPECT_NEAR(curve.x.front(), 2, 1e-6);
  EXPECT_NEAR(curve.x.back(), 4, 1e-6);
  EXPECT_NEAR(curve.y.front(), 0, 1e-9);
  EXPECT_NEAR(curve.y[3], 37.5, 1e-9);
  EXPECT_NEAR(curve.y.back(), 100, 1e-9);
}

TEST(ReportSnapshots, AreThoseAtTheStartThePeakAndTheEnd) {
  using IdIndex = std::vector<std::size_t>;
  EXPECT_EQ(shown_snapshots({0, 10, 20, 30}, 12), (IdIndex{0, 1, 3}));
  EXPECT_EQ(shown_snapshots({0, 10, 20, 30}, 1), (IdIndex{0, 3}));
  EXPECT_EQ(shown_snapshots({0, 10, 20, 30}, 29), (IdIndex{0, 3}));
  EXPECT_EQ(shown_snapshots({0}, 29), (IdIndex{0}));
}

TEST(ReportLong, OfAMillionDiscsIsWrittenInHalfAMinute) {
  fs::path const folder = fs::temp_directory_path() / ("clathra_report_million_" + std::to_string(::getpid()));
  write_made_up_run(folder, {});
  Snapshot grains = made_up_lattice(700, 1430);
  std::mt19937 random(1);  // no two grains alike, which makes large pictures
  std::uniform_real_distribution<float> any(0.3f, 1.0f);
  for (float& radius : grains.radius) radius *= any(random);
  for (double& force : grains.normal_force) force = double(any(random) * any(random)) - 0.3;
  for (std::uint8_t& state : grains.state) state = std::uint8_t(random() % contact_state_count);
  write_made_up_snapshots(folder, grains, 0.2);
  auto const start = std::chrono::steady_clock::now();
  write_report({folder}, folder / "report.html");
  std::chrono::duration<double> const seconds = std::chrono::steady_clock::now() - start;
  EXPECT_LT(seconds.count(), 30);
  EXPECT_LT(fs::file_size(folder / "report.html"), 5'000'000u);
  RecordProperty("seconds", std::to_string(seconds.count()));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace clathra
