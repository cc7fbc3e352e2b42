#include "machine/figure_files.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <system_error>

#include "io/errors/problems.hpp"
#include "machine/processes.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

constexpr char unfinished[] = ".tmp";  // behind the name of a PDF until it is complete

fs::path pdf_of(fs::path const& svg) { return fs::path(svg).replace_extension(".pdf"); }

/// @throws FileProblem where the converter has failed
void finish(pid_t converter, fs::path const& pdf) {
  int status = 0;
  if (::waitpid(converter, &status, 0) != converter || status != 0)
    throw FileProblem(ExitCode::io_error, pdf, "rsvg-convert cannot make it of the .svg beside it");
  std::error_code error;
  fs::rename(pdf.string() + unfinished, pdf, error);
  if (error) throw FileProblem(ExitCode::io_error, pdf, error.message());
}

/// As many at a time as there are cores. @throws std::runtime_error where there is no converter
void write_pdfs(std::vector<fs::path> const& svgs) {
  std::size_t const at_a_time = own_cores().size();
  for (std::size_t first = 0; first < svgs.size(); first += at_a_time) {
    std::vector<std::pair<pid_t, fs::path>> running;
    for (std::size_t i = first; i < std::min(first + at_a_time, svgs.size()); ++i) {
      fs::path const pdf = pdf_of(svgs[i]);
      running.emplace_back(
          start_process({"rsvg-convert", "--format=pdf", "--output=" + pdf.string() + unfinished, "--", svgs[i].string()},
                        "/dev/null", {}),
          pdf);
    }
    for (auto const& [converter, pdf] : running) finish(converter, pdf);
  }
}

}  // namespace

std::string write_figure_files(std::vector<Figure> const& figures, fs::path const& folder) {
  std::vector<fs::path> const svgs = write_figures(figures, folder);
  std::string const written = fmt::format("{}: {} figures are written as ", folder.string(), svgs.size());
  try {
    write_pdfs(svgs);
  } catch (FileProblem const&) {
    throw;
  } catch (std::runtime_error const& problem) {
    return fmt::format("{}SVG and CSV; no PDF: {} (Debian: librsvg2-bin)\n", written, problem.what());
  }
  return written + "SVG, PDF and CSV\n";
}

}  // namespace clathra
