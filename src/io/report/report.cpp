#include "io/report/report.hpp"

#include <fmt/format.h>

#include "io/report/curves.hpp"
#include "io/report/markup.hpp"
#include "io/report/summary_table.hpp"
#include "io/text_file.hpp"

namespace clathra {
namespace {

std::string title_of(std::vector<RunResults> const& runs) {
  return runs.size() == 1 ? "Biaxial compression: " + runs.front().name
                          : fmt::format("Biaxial compression: {} runs", runs.size());
}

}  // namespace

void write_report(std::vector<std::filesystem::path> const& run_folders, std::filesystem::path const& html) {
  std::vector<RunResults> const runs = read_runs(run_folders);
  std::string body = "<h1>" + escaped(title_of(runs)) + "</h1>\n<p class=\"lead\">" + escaped(summary_sentence(runs)) + "</p>\n";
  body += warning_list(runs);
  body += "<h2>Summary</h2>\n" + summary_table(runs);
  body += "<h2>Curves</h2>\n" + side_by_side(curve_figures(runs));
  if (std::string const energy = energy_figures(runs); !energy.empty()) body += "<h2>Energy</h2>\n" + side_by_side(energy);
  replace_text_file(html, page(title_of(runs), body));
}

}  // namespace clathra
