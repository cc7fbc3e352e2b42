#pragma once
/// Which number of a test is to be known, and how well: what `clathra study --precision-target`, its study files and `clathra
/// tune` ask for.
#include <string>
#include <string_view>
#include <vector>

namespace clathra {

/// "peak_q=2%": seeds are added until the mean of a number is known to this part of itself.
struct StudyGoal {
  std::string number;  ///< its column in study.csv
  double width = 0;
};

/// Of tests alone, or of the envelopes of tests at several stresses, too.
enum class NumbersOf { tests, envelopes };

/// Names that a number may be asked for by, without their units: "peak_q". More numbers stand in study.csv.
std::vector<std::string> number_names(NumbersOf of);

/// The column of study.csv, "peak_q_Pa", of a name with or without the unit. @throws std::invalid_argument with all names
std::string number_of_name(std::string_view name, NumbersOf of);

/// A width or a tolerance, above 0 and below 1: "0.02", "2%". @throws std::invalid_argument
double goal_width(std::string_view text);

/// Both: "peak_q=2%". @throws std::invalid_argument with what is wrong with the text
StudyGoal study_goal(std::string const& text);

}  // namespace clathra
