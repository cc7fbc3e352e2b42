#pragma once
/// Which columns of a grading file hold the sizes and what is finer, by the names that laboratories give them.
#include <vector>

#include "domain/scene/foreign_table.hpp"

namespace clathra {

enum class ShareUnit { unsaid, percent, fraction };

struct GradingColumns {
  std::size_t diameter = 0, share = 0;  ///< places of the columns
  double metre = 0;                     ///< unit of the diameters [m]
  ShareUnit unit = ShareUnit::unsaid;
  bool retained = false;  ///< the shares are those that stay above a sieve, not those that pass
};

/// @throws std::invalid_argument as refuse_line(), where there is not one column of each by its name
GradingColumns find_grading_columns(ForeignRow const& header);

}  // namespace clathra
