#pragma once
/// Pages on made-up runs, and what is drawn on them.
#include <gtest/gtest.h>

#include <functional>
#include <regex>

#include "io/report/report.hpp"
#include "report_runs.hpp"

namespace clathra {

namespace fs = std::filesystem;

class ReportPageTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  std::string page_on(std::vector<fs::path> const& runs) const {
    write_report(runs, folder / "report.html");
    return content_of(folder / "report.html");
  }
  fs::path made(std::string const& name, MadeUpTest const& test = {}) const {
    write_made_up_run(folder / name, test);
    return folder / name;
  }
  static ExitCode code_of(std::function<void()> const& act, std::string* message = nullptr) {
    try {
      act();
    } catch (FileProblem const& problem) {
      if (message) *message = problem.what();
      return problem.code;
    }
    return ExitCode::done;
  }

  fs::path const folder = fs::temp_directory_path() / ("clathra_report_" + std::to_string(::getpid()));
};

/// The curves of the plot with this title, back in the units of its axes.
inline std::vector<std::vector<std::pair<double, double>>> curves_of(std::string const& page, std::string const& title) {
  auto const numbers = [](std::string const& text) {
    std::vector<double> list;
    std::istringstream stream(std::regex_replace(text, std::regex(","), " "));
    for (double value; stream >> value;) list.push_back(value);
    return list;
  };
  std::string const from = page.substr(page.find("<title>" + title));
  std::string const plot = from.substr(0, from.find("</svg>"));
  std::smatch found;
  if (!std::regex_search(plot, found, std::regex("data-x=\"(.*?)\" data-y=\"(.*?)\" data-frame=\"(.*?)\""))) return {};
  auto const x = numbers(found[1]), y = numbers(found[2]), frame = numbers(found[3]);
  std::vector<std::vector<std::pair<double, double>>> curves;
  std::regex const polyline("<polyline [^>]*points=\"(.*?)\"");
  for (std::sregex_iterator match(plot.begin(), plot.end(), polyline), end; match != end; ++match) {
    auto const places = numbers((*match)[1]);
    curves.emplace_back();
    for (std::size_t i = 0; i + 1 < places.size(); i += 2)
      curves.back().emplace_back(x[0] + (places[i] - frame[0]) / frame[2] * (x[1] - x[0]),
                                 y[1] - (places[i + 1] - frame[1]) / frame[3] * (y[1] - y[0]));
  }
  return curves;
}

}  // namespace clathra
