/// `clathra export`: snapshots for other programs.
#include "io/results/export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>

#include "io/results/snapshot_file.hpp"
#include "print.hpp"
#include "verbs.hpp"

namespace clathra {
namespace {

struct ExportOptions {
  std::filesystem::path source, folder;
  std::string format;
};

struct NamedFormat {
  std::string_view name;
  ExportFormat format;
  char const* what;
};
constexpr NamedFormat formats[] = {{"lammpsdump", ExportFormat::lammpsdump, "discs as a LAMMPS text dump"},
                                   {"vtu", ExportFormat::vtu, "VTK"},
                                   {"csv", ExportFormat::csv, "tables"}};

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

ExitCode export_snapshots(ExportOptions const& options) {
  std::error_code error;
  bool const is_run = std::filesystem::is_directory(options.source, error);
  std::vector<std::filesystem::path> files{options.source};
  if (is_run) files = snapshot_files(options.source);
  if (files.empty())
    throw FileProblem(ExitCode::file_missing, options.source,
                      "has no snapshots (snap/*.h5); output.snapshots says how many a run writes");
  std::filesystem::path folder = options.folder;
  if (folder.empty()) folder = (is_run ? options.source : folder_of_run(options.source)) / "export";
  ExportFormat const format = find_format(options.format)->format;
  std::size_t count = 0;
  for (std::filesystem::path const& file : files) count += export_snapshot(read_snapshot(file), format, folder).size();
  return print_result(fmt::format("{} file{} written to {}\n", count, count == 1 ? "" : "s", folder.string()));
}

}  // namespace

void add_export(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<ExportOptions>();
  CLI::App* const verb = program.add_subcommand("export", "Write snapshots in the formats of other programs");
  verb->add_option("source", options->source, "folder of a run, or one of its snapshots")->required();
  verb->add_option("--to", options->format, list_of_formats())
      ->required()
      ->check(CLI::Validator(format_problem, "{lammpsdump,vtu,csv}"))
      ->type_name("FORMAT");
  verb->add_option("-o,--output", options->folder, "folder to write to (default: export/ in the folder of the run)")
      ->type_name("DIR")
      ->check(CLI::Validator(name_problem, ""));
  verb->footer("Example: clathra export out/quick --to vtu");
  verb->callback([options, &chosen] { chosen = [options] { return export_snapshots(*options); }; });
}

}  // namespace clathra
