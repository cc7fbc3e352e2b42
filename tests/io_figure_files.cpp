/// Figures as files: every one of a page, drawn alike, alone, with the numbers behind it.
#include <gtest/gtest.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <cstdlib>
#include <set>

#include "command.hpp"
#include "file_content.hpp"
#include "io/report/seed_bands.hpp"
#include "io/report/study_report.hpp"
#include "report_page.hpp"

namespace clathra {
namespace {

class FigureFiles : public ReportPageTest {
 protected:
  /// A run with everything that a page shows.
  fs::path whole_run() const {
    MadeUpTest test;
    test.energy = true;
    fs::path const run = made("a", test);
    write_made_up_snapshots(run, made_up_lattice(12, 24), 0.02);
    return run;
  }
  CommandResult report(std::string const& more, std::string const& before = "") const {
    return run_clathra("--version >/dev/null; " + before + program_in_shell + " report " + more + " --figures '" +
                       figures.string() + "'");
  }
  std::vector<std::string> files(std::string const& ending) const {
    std::vector<std::string> names;
    for (auto const& entry : fs::directory_iterator(figures))
      if (entry.path().extension() == ending) names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
  }
  std::string text_of(std::string const& name) const { return content_of(figures / name); }

  fs::path const figures = folder / "figures";
};

std::size_t count_of(std::string const& text, std::string const& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// Cells of a CSV file, of which the first one may be quoted.
std::vector<std::vector<std::string>> table_of(std::string const& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::size_t const end = line.front() == '"' ? line.rfind('"') + 1 : line.find(',');
    std::string const name = line.front() == '"' ? line.substr(1, end - 2) : line.substr(0, end);
    rows.push_back(csv_rows(line.substr(end + 1) + "\n")[0]);
    rows.back().insert(rows.back().begin(), name);
  }
  return rows;
}

TEST_F(FigureFiles, AreThereForEachFigureOfThePage) {
  std::string const run = whole_run().string();
  CommandResult const result = report(run);
  ASSERT_EQ(result.code, 0) << result.output;
  std::string const page = content_of(folder / "a" / "report.html");
  std::vector<std::string> const names = files(".svg");
  EXPECT_EQ(names.size(), count_of(page, "<figure"));
  EXPECT_EQ(names.size(), 11u);
  EXPECT_EQ(files(".csv"), names);
  EXPECT_EQ(names.front(), "01-stress-and-strain");
  EXPECT_EQ(names[3], "04-what-broke-the-bonds-a-55-hydrate-1-mpa");
  EXPECT_EQ(names.back(), "11-grading-curve");
  EXPECT_TRUE(says(result, figures.string() + ": 11 figures are written as SVG"));
}

TEST_F(FigureFiles, DrawWhatThePageDraws) {
  std::string const run = whole_run().string();
  ASSERT_EQ(report(run).code, 0);
  std::string const page = content_of(folder / "a" / "report.html");
  for (char const* const begin : {"<polyline data-name", "<polygon data-name", "data:image/png;base64,"}) {
    std::string all;
    for (std::string const& name : files(".svg")) all += text_of(name + ".svg");
    EXPECT_EQ(count_of(all, begin), count_of(page, begin)) << begin;
    std::size_t const at = page.find(begin);
    EXPECT_NE(all.find(page.substr(at, page.find_first_of("/>", at + 60) - at)), all.npos) << begin;
  }
}

TEST_F(FigureFiles, AreSvgsThatNeedNothingElse) {
  ASSERT_EQ(report(whole_run().string()).code, 0);
  for (std::string const& name : files(".svg")) {
    boost::property_tree::ptree tree;
    ASSERT_NO_THROW(boost::property_tree::read_xml((figures / (name + ".svg")).string(), tree)) << name;
    EXPECT_EQ(tree.get<std::string>("svg.<xmlattr>.xmlns"), "http://www.w3.org/2000/svg");
    EXPECT_GT(tree.get<double>("svg.<xmlattr>.width"), 200) << name;
    EXPECT_GT(tree.get<double>("svg.<xmlattr>.height"), 200) << name;
    EXPECT_EQ(tree.get<std::string>("svg.rect.<xmlattr>.fill"), "#fff");
    EXPECT_NE(tree.get<std::string>("svg.style").find("font-family"), std::string::npos);
    EXPECT_FALSE(tree.get<std::string>("svg.title").empty());
    std::string const text = text_of(name + ".svg");
    EXPECT_EQ(count_of(text, "href=\""), count_of(text, "xlink:href=\"data:image/png;base64,"));
    EXPECT_EQ(count_of(text, "url("), 0u);
    EXPECT_EQ(count_of(text, "var("), 0u);
  }
  EXPECT_NE(text_of("01-stress-and-strain.svg").find(">axial strain ε₁ [%]</text>"), std::string::npos) << "text stays text";
  EXPECT_NE(text_of("01-stress-and-strain.svg").find(">a: 55 % hydrate, 1 MPa</text>"), std::string::npos) << "the legend";
}

TEST_F(FigureFiles, HaveTheNumbersOfTheHistoryBehindThem) {
  fs::path const run = whole_run();
  ASSERT_EQ(report(run.string()).code, 0);
  auto const history = csv_rows(content_of(run / "history.csv"));
  auto const column = [&](std::string const& name) {
    return static_cast<std::size_t>(std::find(history[0].begin(), history[0].end(), name) - history[0].begin());
  };
  for (auto const& [file, name] :
       {std::pair{"01-stress-and-strain", "q_Pa"}, {"02-change-of-volume", "eps_v"}, {"03-intact-bonds", "bonds_intact_pct"}}) {
    auto const table = table_of(text_of(std::string(file) + ".csv"));
    EXPECT_EQ(table[0], (std::vector<std::string>{"series", "eps1", name}));
    ASSERT_EQ(table.size(), history.size());
    for (std::size_t i = 1; i < table.size(); ++i) {
      EXPECT_EQ(table[i][0], "a: 55 % hydrate, 1 MPa");
      EXPECT_EQ(table[i][1], history[i][column("eps1")]);
      EXPECT_EQ(table[i][2], history[i][column(name)]);
    }
  }
  for (std::string const& name : files(".csv")) {
    auto const table = table_of(text_of(name + ".csv"));
    EXPECT_GT(table.size(), 2u) << name;
    for (auto const& row : table) EXPECT_EQ(row.size(), table[0].size()) << name;
    for (std::size_t k = 1; k < table[0].size(); ++k) EXPECT_NO_THROW(static_cast<void>(std::stod(table.back()[k]))) << name;
  }
}

TEST_F(FigureFiles, HaveTheEdgesOfBandsBehindThem) {
  MadeUpTest other;
  other.peak_eps1 = 0.03;
  std::vector<fs::path> const folders = {made("first"), made("second", other)};
  Study study;
  study.file = "two.toml";
  study.groups = {{"all", {}, "all"}};
  std::vector<MemberResult> members(2);
  for (MemberResult& member : members) member.state = MemberState::finished, member.numbers["peak_q_Pa"] = 5e6;
  members[1].seed = 2;
  SeedBand const q = seed_bands(read_runs(folders))[0];
  std::vector<double> low, high;
  for (auto const& row : table_of(csv_file(write_study_report(study, members, folders, folder / "study.html").front()))) {
    if (row[0] == "all, lower edge") low.push_back(std::stod(row[2]));
    if (row[0] == "all, upper edge") high.push_back(std::stod(row[2]));
  }
  EXPECT_NE(low, high);
  EXPECT_EQ(low, q.low);
  EXPECT_EQ(high, q.high);
}

TEST_F(FigureFiles, HaveTheParticlesAndPairsOfTheMapsBehindThem) {
  fs::path const run = whole_run();
  ASSERT_EQ(report(run.string()).code, 0);
  auto const grains = table_of(text_of("06-the-specimen.csv")), bonds = table_of(text_of("07-bonds.csv")),
             strain = table_of(text_of("09-where-it-sheared.csv"));
  EXPECT_EQ(strain[0], (std::vector<std::string>{"series", "x_m", "y_m", "radius_m", "shear_strain"}));
  ASSERT_EQ(strain.size(), 12u * 24u + 1u);
  EXPECT_NEAR(std::stod(strain[100][4]), 0.02, 0.002) << "sheared by 0.02";
  EXPECT_GT(grains.size(), strain.size()) << "the details, too";
  EXPECT_NEAR(std::stod(grains[1][1]), 1e-4, 1e-6);
  EXPECT_NEAR(std::stod(grains[1][3]), 1e-4, 1e-6);
  std::set<std::string> series;
  for (auto const& row : bonds) series.insert(row[0]);
  EXPECT_EQ(series, (std::set<std::string>{"series", "ε₁ = 0 %, bonded", "ε₁ = 2 %, bonded", "ε₁ = 15 %, bonded",
                                           "ε₁ = 2 %, broken_shear", "ε₁ = 15 %, broken_shear"}));
  std::size_t const pairs = 12 * 23 + 11 * 24;
  EXPECT_EQ(bonds.size(), 3 * pairs + 1);
}

TEST_F(FigureFiles, ReplaceOnlyThoseOfAnEarlierCall) {
  std::string const a = whole_run().string(), b = made("b").string();
  ASSERT_EQ(report(a).code, 0);
  put(figures / "notes.txt", "mine");
  ASSERT_EQ(report(b).code, 0);
  EXPECT_EQ(files(".svg").size(), 4u) << "without energies and pictures; none of the other run is left";
  EXPECT_EQ(text_of("notes.txt"), "mine");
  fs::remove_all(figures);
  fs::create_directories(figures);
  put(figures / "01-mine.svg", "mine");
  fs::remove(folder / "b" / "report.html");
  CommandResult const refused = report(b);
  EXPECT_EQ(refused.code, 73) << refused.output;
  EXPECT_TRUE(says(refused, "is not empty and not of an earlier `clathra report --figures`"));
  EXPECT_EQ(text_of("01-mine.svg"), "mine");
  EXPECT_FALSE(fs::exists(folder / "b" / "report.html")) << "it is known before anything is written";
}

TEST_F(FigureFiles, SayWhyThereIsNoPdf) {
  CommandResult const result = report(made("b").string(), "PATH=/nowhere ");
  EXPECT_EQ(result.code, 0);
  EXPECT_TRUE(says(result,
                   "4 figures are written as SVG and CSV; no PDF: cannot start rsvg-convert: No such file or directory "
                   "(Debian: librsvg2-bin)\n"));
  EXPECT_TRUE(files(".pdf").empty());
}

TEST_F(FigureFiles, ArePdfsOfOnePageWhereThereIsAConverter) {
  if (std::system("rsvg-convert --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no rsvg-convert here";
  CommandResult const result = report(whole_run().string());
  EXPECT_TRUE(says(result, "11 figures are written as SVG, PDF and CSV\n"));
  EXPECT_EQ(files(".pdf"), files(".svg"));
  for (std::string const& name : files(".pdf")) {
    std::string const pdf = text_of(name + ".pdf");
    EXPECT_TRUE(pdf.starts_with("%PDF-")) << name;
    EXPECT_NE(pdf.rfind("%%EOF"), std::string::npos) << name;
    EXPECT_GT(pdf.size(), 2000u) << name;
  }
}

TEST_F(FigureFiles, AConverterThatFailsIsAnError) {
  fs::create_directories(folder / "bin");
  put(folder / "bin" / "rsvg-convert", "#!/bin/sh\nexit 1\n");
  fs::permissions(folder / "bin" / "rsvg-convert", fs::perms::owner_all);
  CommandResult const result = report(made("b").string(), "PATH='" + (folder / "bin").string() + ":/usr/bin:/bin' ");
  EXPECT_EQ(result.code, 74) << result.output;
  EXPECT_TRUE(says(result, "01-stress-and-strain.pdf: rsvg-convert cannot make it of the .svg beside it"));
}

}  // namespace
}  // namespace clathra
