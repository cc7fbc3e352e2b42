/// `clathra export`: snapshots and tables for other programs.
#include "io/results/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>

#include "io/formats/text_file.hpp"
#include "io/results/snapshot_file.hpp"
#include "io/results/spreadsheet.hpp"
#include "terminal/print.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

struct ExportOptions {
  std::filesystem::path source, folder;
  std::string format;
};

/// Without a format of snapshots: the tables of a run or a study.
struct NamedFormat {
  std::string_view name;
  std::optional<ExportFormat> format;
  char const* what;
};
constexpr NamedFormat formats[] = {{"vtu", ExportFormat::vtu, "snapshots for VTK, with .pvd series"},
                                   {"lammpsdump", ExportFormat::lammpsdump, "particles as LAMMPS text dumps"},
                                   {"csv", ExportFormat::csv, "snapshots as tables"},
                                   {"spreadsheet", std::nullopt, "history.csv or study.csv in kPa, MPa and %"}};

NamedFormat const* find_format(std::string const& name) {
  auto const found = std::find_if(std::begin(formats), std::end(formats),
                                  [&](NamedFormat const& format) { return format.name == CLI::detail::to_lower(name); });
  return found == std::end(formats) ? nullptr : found;
}

/// "lammpsdump (discs as a LAMMPS text dump), vtu (VTK), csv (tables)"
std::string list_of_formats() {
  std::string text;
  for (NamedFormat const& format : formats) text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", format.name, format.what);
  return text;
}

std::string format_problem(std::string const& name) {
  return find_format(name) ? "" : fmt::format("there is no format '{}'; there are {}", name, list_of_formats());
}

/// Of a snapshot: where its snap/ lies, or its own folder if it was moved out of there.
std::filesystem::path folder_of_run(std::filesystem::path const& snapshot) {
  std::filesystem::path const folder = std::filesystem::absolute(snapshot).parent_path();
  return std::filesystem::proximate(folder.filename() == "snap" ? folder.parent_path() : folder);
}

/// Tables of a run or a study that are there.
ExitCode export_tables(ExportOptions const& options) {
  std::filesystem::path const folder = options.folder.empty() ? options.source / "export" : options.folder;
  std::string text;
  for (char const* const name : {"history.csv", "study.csv"}) {
    std::error_code error;
    if (!std::filesystem::exists(options.source / name, error)) continue;
    std::filesystem::create_directories(folder, error);
    if (error) throw FileProblem(ExitCode::cannot_create, folder, error.message());
    constexpr std::size_t largest_table = std::size_t{1} << 30;
    std::filesystem::path const table = folder / (std::filesystem::path(name).stem().string() + "-spreadsheet.csv");
    replace_text_file(table, spreadsheet_csv(read_text_file(options.source / name, largest_table)));
    text += fmt::format("{} is written\n", table.string());
  }
  if (text.empty()) throw FileProblem(ExitCode::file_missing, options.source, "has neither history.csv nor study.csv");
  return print_result(text);
}

ExitCode export_snapshots(ExportOptions const& options, ExportFormat format) {
  std::error_code error;
  bool const is_run = std::filesystem::is_directory(options.source, error);
  std::filesystem::path folder = options.folder;
  if (folder.empty()) folder = (is_run ? options.source : folder_of_run(options.source)) / "export";
  std::vector<std::filesystem::path> const files = is_run ? snapshot_files(options.source) : std::vector{options.source};
  if (files.empty())
    throw FileProblem(ExitCode::file_missing, options.source,
                      "has no snapshots (snap/*.h5); output.snapshots says how many a run writes");
  std::size_t const count =
      is_run ? export_series(files, format, folder).size() : export_snapshot(read_snapshot(files.front()), format, folder).size();
  return print_result(fmt::format("{} file{} written to {}\n", count, count == 1 ? "" : "s", folder.string()));
}

ExitCode export_results(ExportOptions const& options) {
  std::optional<ExportFormat> const format = find_format(options.format)->format;
  return format ? export_snapshots(options, *format) : export_tables(options);
}

}  // namespace

void add_export(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<ExportOptions>();
  CLI::App* const verb = program.add_subcommand("export", "Write snapshots and tables for other programs");
  verb->add_option("source", options->source, "folder of a run or a study, or a snapshot")->required();
  verb->add_option("--to", options->format, list_of_formats())
      ->required()
      ->check(CLI::Validator(format_problem, "{vtu,lammpsdump,csv,spreadsheet}"))
      ->type_name("FORMAT");
  verb->add_option("-o,--output", options->folder, "folder to write to (default: export/ in the folder of the run)")
      ->type_name("DIR")
      ->check(CLI::Validator(name_problem, ""));
  verb->footer("Example: clathra export out/quick --to vtu");
  verb->callback([options, &chosen] { chosen = [options] { return export_results(*options); }; });
}

}  // namespace clathra
