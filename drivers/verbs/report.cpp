/// `clathra report`: one page on one run or several.
#include "io/report/report.hpp"

#include <fmt/format.h>

#include <memory>

#include "io/formats/text_file.hpp"
#include "io/report/markup.hpp"
#include "io/results/numbers_file.hpp"
#include "machine/figure_files.hpp"
#include "terminal/print.hpp"
#include "verbs/scene_options.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

struct ReportOptions {
  std::vector<std::filesystem::path> runs;
  std::filesystem::path html, json, figures, data;
};

ExitCode report(ReportOptions const& options) {
  std::optional<LaboratoryData> data;
  if (!options.data.empty()) data = read_laboratory_data(options.data);
  constexpr char instead[] = "name another file";
  if (!options.json.empty()) require_own_file(options.json, "\"clathra numbers\"", instead);
  if (!options.html.empty()) require_own_file(options.html, page_mark, instead);
  if (!options.figures.empty()) claim_figures(options.figures);
  if (!options.json.empty()) write_numbers(read_runs(options.runs), options.json);
  if (!options.json.empty() && options.html.empty() && options.figures.empty())
    return print_result(options.json.string() + " is written\n");
  std::filesystem::path html = options.html;
  if (html.empty()) html = options.runs.size() == 1 ? options.runs.front() / "report.html" : "report.html";
  std::vector<Figure> const figures = write_report(options.runs, html, data);
  return print_result((options.json.empty() ? "" : options.json.string() + " is written\n") + html.string() + " is written\n" +
                      (options.figures.empty() ? "" : write_figure_files(figures, options.figures)));
}

}  // namespace

void add_report(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<ReportOptions>();
  CLI::App* const verb = program.add_subcommand("report", "Draw the results of one run, or of several over each other");
  verb->add_option("runs", options->runs, "folders of runs")->required()->type_name("DIR");
  verb->add_option("-o,--output", options->html,
                   "page to write (default: report.html in the folder of the run; for several runs in the current folder)")
      ->type_name("FILE")
      ->check(CLI::Validator(name_problem, ""));
  verb->add_option("--numbers", options->json,
                   "write the numbers of the runs and of their envelopes to this file; the page only with -o or --figures")
      ->type_name("FILE")
      ->check(CLI::Validator(name_problem, ""));
  add_figures_option(*verb, options->figures);
  add_data_option(*verb, options->data);
  verb->footer("Example: clathra report out/s26 out/s41 out/s55 -o out/compared.html --figures out/figures");
  verb->callback([options, &chosen] { chosen = [options] { return report(*options); }; });
}

}  // namespace clathra
