#include "io/scene/size_warnings.hpp"

#include <fmt/format.h>

namespace clathra {

std::vector<std::string> size_warnings(CurveSizes const& sizes) {
  constexpr double widest = 1.25;     // of the sizes around d50, as factors: a curve from 1 to 1000 without a step has 1.15
  constexpr double narrowest = 1.1;   // of nearly all sizes
  constexpr double clay = 2e-6;       // and finer [m]
  constexpr double gravel = 4.75e-3;  // and coarser [m]
  auto const mm = [](double metres) { return fmt::format("{:.4g} mm", metres * 1e3); };
  std::vector<std::string> warnings;
  if (sizes.d51 > widest * sizes.d49)
    warnings.push_back(
        fmt::format("the grading has hardly any grains around 50 %: 49 % are finer than {}, 51 % finer than {}. d50 ({}), with "
                    "it the rate and the thickness of bonds, hangs on the last per cent of the curve",
                    mm(sizes.d49), mm(sizes.d51), mm(sizes.d50)));
  if (double const ratio = sizes.d90 / sizes.d10; ratio < narrowest)
    warnings.push_back(fmt::format(
        "the particles are as good as equal (d90 / d10 = {:.3g}): equal particles crystallise, strengths differ between "
        "seeds by more than a third",
        ratio));
  if (sizes.d50 < clay)
    warnings.push_back(
        fmt::format("half of the grains are finer than {}, clay by size: forces between clay particles are not modelled; are the "
                    "lengths in the right unit?",
                    mm(sizes.d50)));
  if (sizes.d50 > gravel)
    warnings.push_back(
        fmt::format("half of the grains are coarser than {}, gravel by size: are the lengths in the right unit?", mm(sizes.d50)));
  return warnings;
}

}  // namespace clathra
