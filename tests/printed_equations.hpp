#pragma once
/// The equations of Jiang et al. (2017) as they are printed, in long double: written apart from src/kernels to check it.
#include <cmath>

namespace clathra::printed {

using Exact = long double;

/// Eq. 3 times d50, saturation 0..1.
inline Exact critical_thickness(Exact saturation, Exact d50) {
  if (saturation <= 0.2L) return 0;
  if (saturation > 0.7L) return 0.1L * d50;
  return d50 * (-0.3268L * saturation * saturation + 0.4879L * saturation - 0.0815L);
}

/// Eq. 2.
inline Exact width(Exact r, Exact h_max, Exact h) { return std::sqrt(4 * r * r - (2 * r - h_max + h) * (2 * r - h_max + h)); }

/// Eq. 5.
inline Exact area(Exact r, Exact h_max, Exact h) {
  Exact const B = width(r, h_max, h);
  return (h_max + h) * B / 2 + B * r - 2 * r * r * std::atan(B / std::sqrt(4 * r * r - B * B));
}

/// Eqs. 15a and 15b.
inline Exact R_t(Exact B, Exact h) { return 1.421e7L * B + 2.67e5L * h - 160.2L; }
inline Exact R_c(Exact B, Exact h) { return 2.571e7L * B - 4.18e6L * h + 2508; }

/// Eqs. 10a to 10d.
inline Exact f_s(Exact h) { return 2.05L - 0.89L * std::exp(-(1000 * h - 1.15L) * (1000 * h - 1.15L)); }
inline Exact K_s(Exact h) { return 0.41L - 61.07L * h; }
inline Exact f_r(Exact h) { return 2.05L - 0.92L * std::exp(-(1000 * h - 1.15L) * (1000 * h - 1.15L)); }
inline Exact K_r(Exact h) { return 0.83L - 146.36L * h; }

/// Eqs. 9a and 9b; the second is R_r / L_r, as printed without a length.
inline Exact R_s(Exact F_n, Exact B, Exact h) {
  Exact const part = F_n + R_t(B, h);
  return f_s(h) * K_s(h) * part * std::pow(std::log((R_c(B, h) + R_t(B, h)) / part), 0.59L);
}
inline Exact R_r(Exact F_n, Exact B, Exact h) { return R_s(F_n, B, h) / (f_s(h) * K_s(h)) * f_r(h) * K_r(h); }

/// Eqs. 17, 16, 20 and 21.
inline Exact k_mh(Exact B, Exact E_m, Exact h_0) { return B * E_m / h_0; }
inline Exact k_bn(Exact k_n, Exact k) { return k_n * k / (k_n + 2 * k); }
inline Exact k_bs(Exact k_n, Exact k) { return 2 * k_bn(k_n, k) / 3; }
inline Exact k_bm(Exact B, Exact E_m, Exact h_0) { return k_mh(B, E_m, h_0) * B * B / 12; }

}  // namespace clathra::printed

namespace clathra {

/// The critical thickness at a saturation [%] of discs of d50 = 0.1694 mm.
inline double h_max_of(double saturation) {
  return static_cast<double>(printed::critical_thickness(saturation / 100, 0.1694e-3L));
}

}  // namespace clathra
