#include "domain/measurement/principal_axes.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

namespace clathra {

PrincipalAxes principal_axes(double xx, double yy, double xy) {
  Eigen::Matrix2d tensor;
  tensor << xx, xy, xy, yy;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> const axes(tensor);  // in ascending order
  Eigen::Vector2d const major = axes.eigenvectors().col(1);
  double angle = std::atan2(major.y(), major.x());
  if (angle < 0) angle += std::numbers::pi;
  return {axes.eigenvalues()(1), axes.eigenvalues()(0), angle < std::numbers::pi ? angle : 0};
}

PrincipalAxes principal_stress(Snapshot const& s) {
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < s.radius.size(); ++i) {
    double const area = std::numbers::pi * double(s.radius[i]) * double(s.radius[i]);
    xx += area * double(s.stress_xx[i]);
    yy += area * double(s.stress_yy[i]);
    xy += area * double(s.stress_xy[i]);
  }
  double const box = (s.right - s.left) * (s.top - s.bottom);
  return box > 0 ? principal_axes(xx / box, yy / box, xy / box) : PrincipalAxes{};
}

}  // namespace clathra
