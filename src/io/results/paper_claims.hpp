#pragma once
/// What Jiang et al. (2017) say of their tests, as claims that tests of ours can meet or miss.
#include <map>
#include <string>
#include <vector>

#include "domain/measurement/claims.hpp"
#include "domain/measurement/snapshot.hpp"
#include "io/results/run_results.hpp"

namespace clathra {

/// Which tests there are. The paper: sand and 26, 41, 55 % at 1, 2, 3 MPa, and five critical thicknesses at 1 MPa.
struct PaperDesign {
  std::vector<int> saturations{26, 41, 55};           ///< of bonded tests [%], ascending
  std::vector<int> stresses{1, 2, 3};                 ///< [MPa], ascending
  std::vector<double> thicknesses{13.7e-6, 16.8e-6};  ///< [m] of Fig. 17 beside those of the saturations
};
inline constexpr double paper_strains[] = {0.0254, 0.0338, 0.0671, 0.1504};  ///< of its pictures
inline constexpr double paper_end = 0.1504;

/// "sand_1MPa", "s55_3MPa", "h13.7um_1MPa": a group of tests.
std::string paper_cell(int saturation, int stress);
std::string paper_cell(double thickness);
/// The cell in words: "55 %, 3 MPa", "sand, 1 MPa", "h_max = 13.7 um, 1 MPa".
std::string paper_label(std::string const& cell);
/// "sand", "s55": what has an envelope.
std::string paper_material(int saturation);

/// Numbers of the tests by cell or material, name and seed.
class PaperNumbers {
 public:
  void add(std::string const& cell, std::uint64_t seed, std::map<std::string, double> const& numbers);
  SeedNumbers const& of(std::string const& cell, std::string const& name) const;  ///< empty where there are none

 private:
  std::map<std::string, std::map<std::string, SeedNumbers>> numbers_;
};

/// What the claims need of one test, from its history: peak_q_Pa, peak_eps1, top_eps1, residual_q_Pa, brittleness, largest_eps_v,
/// end_of_contraction_eps1, dilation, q_share_at_6.71, residual_slope, breakage_place. Those that it has.
std::map<std::string, double> numbers_of_history(HistoryTable const& history);

/// All claims, also those of which there are no numbers. @param d50  [m]
std::vector<Claim> paper_claims(PaperDesign const& design, PaperNumbers const& numbers, double d50);

}  // namespace clathra
