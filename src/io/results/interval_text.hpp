#pragma once
/// Numbers with the interval that they are known to.
#include <string>

#include "domain/measurement/confidence.hpp"

namespace clathra {

/// "3.04 ± 0.12": both rounded to the second digit of the error; never "-0". @param error  0 or more
std::string with_error(double value, double error);

/// A mean and half of its 95 % interval; the mean alone, to four digits, of a single value. @param factor  of both, for the unit
std::string interval_text(MeanInterval const& mean, double factor);

}  // namespace clathra
