#include "io/results/stage_numbers.hpp"

namespace clathra {
namespace {

struct StageNumber {
  std::string_view stage, name, meaning;
};

// A line a number; the unit stands at the end of its name, strains and ratios have none.
// clang-format off
constexpr StageNumber numbers[] = {
    {"generate", "particles", "particles of the specimen"},
    {"generate", "void_ratio", "void ratio that the specimen was made with, at rest under specimen.preparation_stress"},
    {"generate", "void_ratio_wanted", "void ratio at which the generator aimed"},
    {"generate", "void_ratio_at_test", "void ratio at the start of the shear, to which specimen.void_ratio applies here"},
    {"generate", "layer_void_ratio_sd", "standard deviation of the void ratio over the layers"},
    {"generate", "d50_m", "median diameter by mass of the particles made"},
    {"generate", "d50_wanted_m", "median diameter of the grading"},
    {"generate", "grading_distance", "largest difference of the percent finer between particles and grading, as a part of 1"},
    {"generate", "generation_friction", "friction coefficient between grains with which the void ratio was reached; the test has grains.friction"},
    {"generate", "generation_rolling_width_factor", "rolling width factor while the specimen was made; the test has grains.rolling_width_factor"},
    {"generate", "stress_x_Pa", "lateral stress at rest"},
    {"generate", "stress_y_Pa", "vertical stress at rest"},
    {"generate", "unbalanced", "mean resultant force on a particle over the mean contact force, at rest"},
    {"generate", "deep_overlap_share", "part of the contacts that overlap by more than 10 % of the smaller radius"},
    {"generate", "width_m", "width of the specimen made"},
    {"generate", "height_m", "height of the specimen made"},

    {"prepare", "h_max_m", "critical thickness: the largest gap that a bond spans (Eq. 3)"},
    {"prepare", "bonds", "bonds formed"},
    {"prepare", "bonds_per_particle", "bonds over particles: half the bonds that a particle has on average"},
    {"prepare", "pairs_without_tensile_strength", "pairs within h_max that got no bond, because its tensile strength R_t would not be positive"},
    {"prepare", "pairs_beyond_fit", "pairs within h_max that got no bond, because its gap is beyond the range for which R_c, K_s and K_r are fitted"},
    {"prepare", "bond_area_m2", "area of all bonds in the plane"},
    {"prepare", "areal_saturation", "area of all bonds over the area of the voids"},
    {"prepare", "areal_saturation_demanded", "what Eq. 4 asks for instead: saturation - 20 %; met where bond.critical_thickness_from = \"bond_area\""},
    {"prepare", "void_ratio_before_consolidation", "void ratio before test.confining_stress acted"},
    {"prepare", "void_ratio_after_consolidation", "void ratio at rest under test.confining_stress, where the shear begins"},
    {"prepare", "broken_in_consolidation", "bonds that broke before the shear"},
    {"prepare", "consolidation_steps", "time steps of the consolidation"},
    {"prepare", "consolidated_unbalanced", "mean resultant force on a particle over the mean contact force, where the shear begins"},
    {"prepare", "at_rest", "1 where the consolidation came to rest, else 0"},
    {"prepare", "time_step_s", "time step at the start of the shear"},
    {"prepare", "time_step_limit_s", "largest stable time step there, of which time_step_s is a share"},
    {"prepare", "time_step_margin", "time step at which the fastest oscillation there would become unstable, over time_step_s"},
    {"prepare", "added_mass_share", "mass that run.mass_scaled_fraction added, over the true mass"},
    {"prepare", "bytes_per_particle", "memory that the simulation holds"},
    {"prepare", "strain_rate_per_s", "axial strain rate of the test"},
    {"prepare", "rate_share", "part of the rate of test.inertial_number to which test.max_platen_wave_stress has lowered it"},
    {"prepare", "quasi_static", "1 where rate, rest and balance of forces were within their limits to the end of what was sheared, else 0"},

    {"plan", "particles", "particles of the test"},
    {"plan", "steps", "time steps that the shear needs at its first time step"},
    {"plan", "time_step_s", "time step at the start of the shear"},
    {"plan", "strain_rate_per_s", "axial strain rate of the test"},
    {"plan", "inertial_number", "I = strain rate * d50 * sqrt(density / confining stress)"},
    {"plan", "platen_wave_stress", "W: stress of the wave that a platen sends out over the confining stress"},
    {"plan", "width_m", "width where the shear begins"},
    {"plan", "height_m", "height where the shear begins"},

    {"shear", "records", "rows of the shear in history.csv"},
    {"shear", "peak_q_Pa", "largest q = sigma1 - sigma3 of all steps"},
    {"shear", "peak_eps1", "axial strain where q is largest"},
    {"shear", "peak_passed", "1 where q has fallen by 2 % after its largest value, else 0: then the peak may lie beyond the test"},
    {"shear", "peak_eps_v", "volumetric strain there, contraction positive"},
    {"shear", "peak_bonds_intact_pct", "bonds intact there, of those at the start"},
    {"shear", "residual_q_Pa", "mean of q over the records from residual_from_eps1 on"},
    {"shear", "residual_from_eps1", "12 % where a test goes to about 15 %, else where its last fifth begins"},
    {"shear", "secant_modulus_Pa", "E50: half the largest q over the axial strain where q first gets there"},
    {"shear", "dilation_angle_deg", "largest dilation angle over stretches of 1 % of axial strain"},
    {"shear", "largest_eps_v", "largest contraction of the records"},
    {"shear", "largest_eps_v_eps1", "axial strain there"},
    {"shear", "end_eps1", "axial strain of the last record"},
    {"shear", "end_eps_v", "volumetric strain of the last record"},
    {"shear", "end_bonds_intact_pct", "bonds intact at the last record, of those at the start"},
    {"shear", "broken_tension", "bonds broken in tension"},
    {"shear", "broken_shear", "bonds broken in shear"},
    {"shear", "broken_compression", "bonds broken in compression"},
    {"shear", "broken_rolling", "bonds broken by rolling"},
    {"shear", "broken_dissolved", "bonds that left as their hydrate was lost"},
    {"shear", "energy_residual", "part of the boundary work that no account of the energy balance has"},
    {"shear", "checks", "checks made, one each 0.02 % of axial strain"},
    {"shear", "mean_unbalanced", "mean over the checks of: mean resultant force on a particle over the mean contact force"},
    {"shear", "largest_unbalanced", "the largest of that ratio"},
    {"shear", "checks_unbalanced", "checks in which that ratio was above 0.01"},
    {"shear", "sigma3_held", "part of the checks with sigma3 within 1 % of test.confining_stress"},
    {"shear", "sigma3_error", "sigma3 furthest off, over what it should be"},
    {"shear", "stress_mismatch", "largest difference of q on the walls and in the contacts, over p"},
    {"shear", "checks_fast", "checks in which the kinetic energy was above 0.05 of the elastic energy"},
    {"shear", "largest_kinetic_share", "largest kinetic over elastic energy"},
    {"shear", "largest_sigma1_Pa", "largest vertical stress of the checks"},
    {"shear", "deep_overlap_share", "largest part of the contacts that overlap by more than 10 % of the smaller radius"},
    {"shear", "deep_overlap_eps1", "axial strain there"},
    {"shear", "deepest_overlap", "deepest overlap of the checks over the smaller radius"},
    {"shear", "smallest_time_step_s", "smallest time step of the checks"},
    {"shear", "largest_time_step_s", "largest time step of the checks"},
    {"shear", "time_step_renewals", "how often the time step was chosen anew, since the specimen was prepared"},
    {"shear", "steps", "time steps of the stage"},
    {"shear", "quasi_static", "1 where rate, rest and balance of forces were within their limits in this stage and before it, else 0"},
    {"shear", "path", "path of the axial strain within the stage, back and forth"},
    {"shear", "strain_eps1", "change of the axial strain in the stage"},
    {"shear", "strain_eps_v", "change of the volumetric strain in the stage"},
    {"shear", "start_eps1", "axial strain since the consolidation at its beginning"},
    {"shear", "start_sigma1_Pa", "vertical stress there"},
    {"shear", "start_sigma3_Pa", "lateral stress there"},
    {"shear", "start_void_ratio", "void ratio there"},
    {"shear", "end_sigma1_Pa", "vertical stress at its end"},
    {"shear", "end_sigma3_Pa", "lateral stress there"},
    {"shear", "end_void_ratio", "void ratio there"},
    {"shear", "bulk_modulus_Pa", "change of p = (sigma1 + sigma3) / 2 over change of the volumetric strain"},
    {"shear", "constrained_modulus_Pa", "M_oed: change of sigma1 over change of the axial strain, without lateral strain"},
    {"shear", "k0", "sigma3 / sigma1 at the end, without lateral strain"},
    {"shear", "k0_of_increments", "change of sigma3 over change of sigma1 over the second half of the rows"},
    {"shear", "secant_stiffness_Pa", "E_ur: change of q over change of the axial strain, first row to last"},
    {"shear", "largest_q_Pa", "largest q of the stage, of all steps"},
    {"shear", "unsettled", "1 where it went on without rest, as allow_unsettled let it"},
    {"shear", "turns", "how often the rate turned round"},
    {"shear", "damping_ratio", "area of the last loop of q over eps1, over 4 pi times the triangle below its half amplitudes"},
    {"shear", "strain_per_cycle", "axial strain by which a cycle begins further than the one before, mean"},
    {"shear", "largest_pore_pressure_Pa", "u = sigma3 at the beginning - sigma3, total lateral stress constant"},
    {"shear", "largest_pore_pressure_ratio", "r_u = u over sigma3 at the beginning"},
    {"shear", "phase_transformation_p_Pa", "least p, where p rises again by 1 % after it"},
    {"shear", "phase_transformation_eps1", "axial strain there"},
    {"shear", "failed", "1 where the specimen did not bear its dead load, 0 where it came to rest under it; not given where the stage ended before"},
    {"shear", "failed_eps1", "axial strain where that was seen first"},
    {"shear", "failed_q_Pa", "q there"},
    {"shear", "failed_p_Pa", "p there"},
    {"shear", "failed_temperature_degC", "temperature of the hydrate there"},
    {"shear", "failed_pore_pressure_Pa", "pore pressure there"},
    {"shear", "failed_saturation", "saturation there"},
    {"shear", "end_temperature_degC", "temperature of the hydrate at the end of a stage that changes it"},
    {"shear", "end_pore_pressure_Pa", "pore pressure there"},
    {"shear", "end_saturation", "saturation there"},
};
// clang-format on

constexpr std::string_view steps_name = "particle_steps", to_peak = "_to_peak";

}  // namespace

std::string meaning_of(std::string_view stage, std::string_view name) {
  if (name == steps_name) return "particles times time steps";
  bool const loading = stage != "generate" && stage != "prepare" && stage != "plan";
  if (loading) stage = "shear";
  bool const before_peak = loading && name.ends_with(to_peak);
  std::string_view const whole = before_peak ? name.substr(0, name.size() - to_peak.size()) : name;
  for (StageNumber const& number : numbers)
    if (number.stage == stage && number.name == whole)
      return std::string(number.meaning) + (before_peak ? ", up to the largest q" : "");
  return {};
}

}  // namespace clathra
