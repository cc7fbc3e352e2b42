#pragma once
/// The numbers by which stages other than a shear are known, from their rows.
#include <vector>

#include "domain/scene/loading_stage.hpp"
#include "domain/scene/stage.hpp"

namespace clathra {

/// The rows of a stage, one value a record; strains natural, stresses [Pa], compression positive.
struct LoadingCurves {
  std::vector<double> eps1, eps_v, sigma1, sigma3, void_ratio;
};

/// By the names under which run.json has them, what the stage has of these:
/// - void_ratio at its beginning and end;
/// - both stresses put on: bulk_modulus_Pa = dp / d eps_v;
/// - one-dimensional compression (the other pair held): constrained_modulus_Pa = d sigma_1 / d eps_1, k0 = sigma_3 / sigma_1 at
/// the
///   end, k0_of_increments = d sigma_3 / d sigma_1 over the second half of the rows;
/// - a rate that opens: secant_stiffness_Pa = |dq / d eps_1| from its first row to its last (E_ur of unloading);
/// - turns: damping_ratio = (area of the last loop) / (4 pi (dq / 2) (d eps_1 / 2) / 2), and strain_per_cycle, what eps_1 has
/// moved
///   by between the starts of the first and the last whole cycle, over their number;
/// - constant volume: largest_pore_pressure_Pa, u = sigma_3 at the beginning - sigma_3 (total lateral stress constant),
///   largest_pore_pressure_ratio = u over sigma_3 at the beginning, and phase_transformation_p_Pa, the least p, with
///   phase_transformation_eps1, where p rises again by 1 % after it.
StageRecord loading_numbers(LoadingStage const& stage, LoadingCurves const& curves);

}  // namespace clathra
