#pragma once
/// Where a test stands in its list of stages.
#include <cmath>
#include <cstdint>
#include <string>

#include "domain/scene/dissociation.hpp"

namespace clathra {

/// What rows, ends and figures speak of; strains count from the consolidation, stresses are those of the walls [Pa].
struct TestValues {
  double time = 0;  ///< since the consolidation [s]
  double path = 0;  ///< of eps_1, to and fro
  double eps1 = 0, eps_v = 0, sigma1 = 0, sigma3 = 0;
  double q() const { return sigma1 - sigma3; }
  double p() const { return 0.5 * (sigma1 + sigma3); }

  /// Visits (name, number), for checkpoints.
  template <class Visit>
  void for_each_number(std::string const& of, Visit&& visit) {
    visit(of + "_time", time);
    visit(of + "_path", path);
    visit(of + "_eps1", eps1);
    visit(of + "_eps_v", eps_v);
    visit(of + "_sigma1", sigma1);
    visit(of + "_sigma3", sigma3);
  }
};

/// The abscissa of a test is the path of its axial strain, to and fro: it always grows, and is eps_1 itself where a test only
/// closes.
struct StagePlace {
  std::int64_t index = 0;       ///< of the stage
  std::int64_t first_step = 0;  ///< of the simulation, after which it began
  bool over = false;
  TestValues start;
  double path_before = 0;  ///< of the stages before
  double travelled = 0;    ///< in this one, up to the last turn or look
  double turned_at = 0;    ///< eps_1 there
  double sense = 0;        ///< 1 where a rate closes, -1 where it opens, 0 without a rate
  std::int64_t turns = 0;
  std::int64_t increment = 0, increment_began = 0;  ///< of stresses: which is on, and the step after which it was put on
  bool increment_is_due = false;                    ///< the next one, after the row of the last
  std::int64_t checks_at_rest = 0;                  ///< on end
  HydrateState hydrate_at_start, hydrate_failed;    ///< of the stage; where its specimen failed
  double hydrate_part = 0;                          ///< of its way that the hydrate has gone
  TestValues looked;                                ///< at the last look
  std::int64_t checks_slow = 0;                     ///< on end, of the strain rate
  double failing_since = -1;                        ///< time, negative where it does not fail [s]
  double risen_to = 0;                              ///< sigma_1, by the steps that count as a rise [Pa]
  double failed_eps1 = 0, failed_q = 0, failed_p = 0;
  bool failed = false, unsettled = false;

  double path_within(double eps1) const { return travelled + std::abs(eps1 - turned_at); }
  double path(double eps1) const { return path_before + path_within(eps1); }
  /// eps_1 where the path of the stage will be so long, if it goes on in this sense.
  double eps1_at(double path_within) const { return turned_at + sense * (path_within - travelled); }
  void turn(double eps1) {
    travelled = path_within(eps1);
    turned_at = eps1;
  }

  template <class Visit>
  void for_each_number(Visit&& visit) {
    visit("stage_index", index);
    visit("stage_first_step", first_step);
    visit("stage_over", over);
    start.for_each_number("stage_start", visit);
    visit("stage_path_before", path_before);
    visit("stage_travelled", travelled);
    visit("stage_turned_at", turned_at);
    visit("stage_sense", sense);
    visit("stage_turns", turns);
    visit("stage_increment", increment);
    visit("stage_increment_began", increment_began);
    visit("stage_increment_is_due", increment_is_due);
    visit("stage_checks_at_rest", checks_at_rest);
    hydrate_at_start.for_each_number("stage_hydrate_at_start", visit);
    hydrate_failed.for_each_number("stage_hydrate_failed", visit);
    visit("stage_hydrate_part", hydrate_part);
    looked.for_each_number("stage_looked", visit);
    visit("stage_checks_slow", checks_slow);
    visit("stage_failing_since", failing_since);
    visit("stage_risen_to", risen_to);
    visit("stage_failed", failed);
    visit("stage_unsettled", unsettled);
    visit("stage_failed_eps1", failed_eps1);
    visit("stage_failed_q", failed_q);
    visit("stage_failed_p", failed_p);
  }
};

}  // namespace clathra
