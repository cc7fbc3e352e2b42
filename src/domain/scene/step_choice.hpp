#pragma once
/// How the time step of a stage is chosen.
#include <cstdint>

namespace clathra {

/// `adaptive`: a share of the limit of stability, which is bounded from below by the largest eigenvalue of the springs to come
/// (kernels/stability.hpp) and bounded anew while discs move. `fixed`: a share of the estimate from each disc's own springs when
/// the stage begins, lowered only where that bound asks for it.
enum class TimeStepRule : std::int8_t { adaptive, fixed };

inline constexpr double usual_share_of_limit = 0.95;  ///< the limit is a bound; the rest is for contacts that turn as they move
inline constexpr double usual_share_of_estimate = 0.7;

struct StepChoice {
  TimeStepRule rule = TimeStepRule::adaptive;
  double safety = usual_share_of_limit;  ///< dt over the limit, or over the estimate
};

}  // namespace clathra
