#pragma once
/// What can be said of a disc that cannot go on.
#include <cstdint>
#include <string>

#include "domain/simulation/assembly.hpp"

namespace clathra {

/// A fault that kernels reported, before anybody looks closer.
struct ReportedFault {
  Fault what;
  int id = -1;                 ///< the largest of the discs that met it
  std::int64_t last_good = 0;  ///< step of the last look that found no fault
};

/// The message: step and time, disc and what is wrong with it, since when, where, how many others share it, its deepest contact,
/// how long the time step is against the stable limit of the present network, and what to change. Collective; the same on all
/// ranks.
/// @param place  gets the centre of the disc, of the last neighbour search where its own is not finite [m]
std::string fault_text(Assembly const& assembly, ReportedFault const& fault, double (&place)[2]);

}  // namespace clathra
