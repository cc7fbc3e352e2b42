#pragma once
/// Points of a laboratory as curves in the figures of a page.
#include <string>
#include <vector>

#include "domain/scene/scene.hpp"
#include "io/report/plot.hpp"
#include "io/results/laboratory_data.hpp"
#include "io/results/run_results.hpp"

namespace clathra {

/// What a test that is shown on a page is told by.
struct PageTest {
  double saturation = 0;        ///< [%]
  double confining_stress = 0;  ///< [Pa]
};
PageTest page_test(Scene const& scene);
std::vector<PageTest> page_tests(std::vector<RunResults> const& runs);

/// A series that states its saturation or its stress belongs to tests of the same, to half a percent and to a twentieth; others
/// belong to all.
class LaboratoryOverlay {
 public:
  LaboratoryOverlay() = default;
  LaboratoryOverlay(LaboratoryData data, std::vector<PageTest> const& tests);

  /// The series of these axes that belong to a test of the page, as dotted lines with marks.
  std::vector<Curve> over(Variable const& x, Variable const& y);
  /// A paragraph that names the series that no figure has shown; empty where there are none.
  std::string note() const;

 private:
  LaboratoryData data_;
  std::vector<bool> belongs_, shown_;
};

}  // namespace clathra
