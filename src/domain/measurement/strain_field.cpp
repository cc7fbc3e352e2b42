#include "domain/measurement/strain_field.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace clathra {
namespace {

/// Sums over discs for the fit of u = u_0 + G X.
struct Moments {
  double count = 0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero(), displacement = Eigen::Vector2d::Zero();  ///< sums of X and u
  Eigen::Matrix2d places = Eigen::Matrix2d::Zero();                                         ///< sum of X X^T
  Eigen::Matrix2d displacements = Eigen::Matrix2d::Zero();                                  ///< sum of u X^T

  void add(Eigen::Vector2d const& x, Eigen::Vector2d const& u) {
    count += 1, place += x, displacement += u, places += x * x.transpose(), displacements += u * x.transpose();
  }
  void add(Moments const& m) {
    count += m.count, place += m.place, displacement += m.displacement, places += m.places, displacements += m.displacements;
  }
};

/// ln(l1 / l2) of the deformation F = I + G, G the least-squares gradient of the displacements. The singular values of F are the
/// principal stretches l1 and l2; those of the places about their middle, the square roots of the eigenvalues of their scatter,
/// say whether the discs fix a gradient at all: in a line they do not.
double shear_of(Moments const& m) {
  constexpr double fewest = 6, flattest = 0.03;
  if (m.count < fewest) return not_known;
  Eigen::Matrix2d const scatter = m.places - m.place * m.place.transpose() / m.count;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> const axes(scatter);
  Eigen::Vector2d const values = axes.eigenvalues().cwiseMax(0).cwiseSqrt();
  if (!(values(0) > flattest * values(1))) return not_known;
  Eigen::Matrix2d const moved = m.displacements - m.displacement * m.place.transpose() / m.count;
  Eigen::Matrix2d const gradient =
      moved * axes.eigenvectors() * axes.eigenvalues().cwiseInverse().asDiagonal() * axes.eigenvectors().transpose();
  Eigen::Vector2d const stretches =
      Eigen::JacobiSVD<Eigen::Matrix2d>(Eigen::Matrix2d::Identity() + gradient).singularValues();  // the larger one first
  return stretches(1) > 0 ? std::log(stretches(0) / stretches(1)) : not_known;
}

/// Side of the window over which a strain is averaged [m].
double window_of(Snapshot const& s) {
  return strain_window * 2 * std::accumulate(s.radius.begin(), s.radius.end(), 0.0) / static_cast<double>(s.radius.size());
}

/// Square cells over the places where the discs were at first.
struct Cells {
  explicit Cells(Snapshot const& s) {
    size = window_of(s) / 3;
    left = bottom = std::numeric_limits<double>::max();
    double right = -left, top = -left;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      left = std::min(left, first_x(s, i)), right = std::max(right, first_x(s, i));
      bottom = std::min(bottom, first_y(s, i)), top = std::max(top, first_y(s, i));
    }
    // A disc that flew away must not ask for more cells than there are discs to fill them.
    double const most = 4 * std::sqrt(static_cast<double>(s.x.size())) + 4;
    columns = static_cast<int>(std::min(most, (right - left) / size)) + 1;
    rows = static_cast<int>(std::min(most, (top - bottom) / size)) + 1;
  }
  static double first_x(Snapshot const& s, std::size_t i) { return s.x[i] - double(s.ux[i]); }
  static double first_y(Snapshot const& s, std::size_t i) { return s.y[i] - double(s.uy[i]); }

  int column(double x) const { return std::clamp(static_cast<int>((x - left) / size), 0, columns - 1); }
  int row(double y) const { return std::clamp(static_cast<int>((y - bottom) / size), 0, rows - 1); }
  std::size_t place(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
  std::size_t count() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }

  double left, bottom, size;
  int columns, rows;
};

std::vector<double> cell_strains(Snapshot const& s, Cells const& cells) {
  std::vector<Moments> moments(cells.count());
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    double const x = Cells::first_x(s, i), y = Cells::first_y(s, i);
    moments[cells.place(cells.column(x), cells.row(y))].add({x - cells.left, y - cells.bottom},
                                                            {double(s.ux[i]), double(s.uy[i])});
  }
  std::vector<double> strains(cells.count());
  for (int row = 0; row < cells.rows; ++row)
    for (int column = 0; column < cells.columns; ++column) {
      Moments near;
      for (int r = std::max(row - 1, 0); r <= std::min(row + 1, cells.rows - 1); ++r)
        for (int c = std::max(column - 1, 0); c <= std::min(column + 1, cells.columns - 1); ++c)
          near.add(moments[cells.place(c, r)]);
      strains[cells.place(column, row)] = shear_of(near);
    }
  return strains;
}

/// Between the centres of the four cells around a point; those that are not known do not count.
double interpolated(std::vector<double> const& strains, Cells const& cells, double x, double y) {
  double const across = (x - cells.left) / cells.size - 0.5, up = (y - cells.bottom) / cells.size - 0.5;
  double const column = std::floor(across), row = std::floor(up);
  double sum = 0, weights = 0;
  for (int r = 0; r < 2; ++r)
    for (int c = 0; c < 2; ++c) {
      int const at_column = std::clamp(static_cast<int>(column) + c, 0, cells.columns - 1);
      int const at_row = std::clamp(static_cast<int>(row) + r, 0, cells.rows - 1);
      double const weight = std::abs(c - 1 + across - column) * std::abs(r - 1 + up - row);
      double const strain = strains[cells.place(at_column, at_row)];
      if (std::isfinite(strain)) sum += weight * strain, weights += weight;
    }
  return weights > 0 ? sum / weights : not_known;
}

}  // namespace

std::vector<float> shear_strain(Snapshot const& snapshot) {
  Cells const cells(snapshot);
  std::vector<double> const strains = cell_strains(snapshot, cells);
  std::vector<float> values(snapshot.x.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<float>(interpolated(strains, cells, Cells::first_x(snapshot, i), Cells::first_y(snapshot, i)));
  return values;
}

double smoothing_of_shear_strain(Snapshot const& snapshot) {
  double const window = window_of(snapshot);
  return std::sqrt(window * window / 20 + window * window / 54);
}

}  // namespace clathra
