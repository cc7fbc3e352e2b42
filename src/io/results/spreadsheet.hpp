#pragma once
/// Tables of results in the units of laboratories, for spreadsheets; the files of runs and studies themselves stay in SI.
#include <string>

namespace clathra {

/// A table of a run or a study (history.csv, study.csv) with stresses in kPa, moduli in MPa and strains in %; the headings say
/// so: "q_kPa", "secant_modulus_MPa", "eps1_pct". Other columns, and cells that are no numbers, are left as they are.
std::string spreadsheet_csv(std::string const& csv);

}  // namespace clathra
