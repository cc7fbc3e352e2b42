#include "io/report/seed_bands.hpp"

#include <algorithm>
#include <iterator>

#include "domain/measurement/confidence.hpp"
#include "domain/measurement/curve_features.hpp"

namespace clathra {
namespace {

constexpr int band_points = 200;

void add_statistics(SeedBand& band, PossibleRange const& range) {
  for (std::size_t i = 0; i < band.eps1.size(); ++i) {
    std::vector<double> values;
    for (std::vector<double> const& seed : band.seeds) values.push_back(seed[i]);
    MeanInterval const m = mean_interval(values);
    band.mean.push_back(m.mean);
    band.low.push_back(range.cut(m.low()));
    band.high.push_back(range.cut(m.high()));
    band.cut |= band.low.back() != m.low() || band.high.back() != m.high();
  }
}

}  // namespace

PossibleRange possible_range(std::string_view name) {
  if (name.ends_with("_pct")) return {0, 100};
  if (name.ends_with("friction_angle_deg")) return {0, 90};
  if (name.starts_with("broken_") || name.ends_with("_coordination") || name == "void_ratio") return {0};
  return {};
}

std::vector<SeedBand> seed_bands(std::vector<RunResults> const& runs) {
  std::vector<SeedBand> bands;
  for (char const* const column : curve_columns) {
    SeedBand band;
    bool const known = !runs.empty() && std::all_of(runs.begin(), runs.end(), [&](RunResults const& run) {
      return run.history.has(column) && run.has_peak();
    });
    if (known) {
      double end = runs.front().history["eps1"].back();
      for (RunResults const& run : runs) end = std::min(end, run.history["eps1"].back());
      for (int i = 0; i <= band_points; ++i) band.eps1.push_back(end * i / band_points);
      for (RunResults const& run : runs) {
        std::vector<double> values;
        for (double const strain : band.eps1) values.push_back(value_at(run.history["eps1"], run.history[column], strain));
        band.seeds.push_back(std::move(values));
      }
      add_statistics(band, possible_range(column));
    }
    bands.push_back(std::move(band));
  }
  return bands;
}

}  // namespace clathra
