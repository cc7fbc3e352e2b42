/// The report: what its curves and numbers show of a history, what it does with several runs, and with damaged ones.
#include <gtest/gtest.h>

#include "command.hpp"
#include "domain/measurement/test_numbers.hpp"
#include "io/report/plot.hpp"
#include "io/report/seed_bands.hpp"
#include "io/report/study_report.hpp"
#include "io/results/run_results.hpp"
#include "report_page.hpp"

namespace clathra {
namespace {

using Report = ReportPageTest;

TEST_F(Report, DrawsTheHistoryWhereItsAxesSay) {
  MadeUpTest const test;
  auto const curves = curves_of(page_on({made("a", test)}), "Deviator stress");
  ASSERT_EQ(curves.size(), 1u);
  ASSERT_EQ(curves[0].size(), made_up_records + 1u);
  for (int i = 0; i <= made_up_records; ++i) {
    double const eps1 = made_up_strain * i / made_up_records;
    EXPECT_NEAR(curves[0][static_cast<std::size_t>(i)].first, 100 * eps1, 0.01);
    EXPECT_NEAR(curves[0][static_cast<std::size_t>(i)].second, test.q(eps1) * 1e-6, 0.01);
  }
  auto const volume = curves_of(content_of(folder / "report.html"), "Volumetric strain");
  EXPECT_NEAR(volume[0].back().second, -1.5, 0.01) << "compression is positive";
}

TEST_F(Report, DrawsTheConsolidationApartFromTheShear) {
  MadeUpTest with;
  with.consolidation = true;
  std::string const plain = page_on({made("a")}), page = page_on({made("a", with)});
  EXPECT_EQ(plain.find("Void ratio against mean stress"), std::string::npos) << "nothing was recorded";
  auto const curves = curves_of(page, "Void ratio against mean stress");
  ASSERT_EQ(curves.size(), 1u);
  ASSERT_EQ(curves[0].size(), static_cast<std::size_t>(made_up_consolidation));
  for (int i = 0; i < made_up_consolidation; ++i)
    EXPECT_NEAR(curves[0][static_cast<std::size_t>(i)].second, 0.26 - 0.001 * i, 1e-4);
  EXPECT_NE(page.find("e 0.26 at 0.05 MPa, 0.241 at 1 MPa"), std::string::npos);
  EXPECT_EQ(curves_of(page, "Deviator stress"), curves_of(plain, "Deviator stress"));
  HistoryTable const history(folder / "a" / "history.csv");
  EXPECT_EQ(history.rows(), made_up_records + 1u);
  EXPECT_EQ(history["eps1"].front(), 0);
  EXPECT_EQ(history.before("eps1"), std::vector<double>(made_up_consolidation, 1.0));
  EXPECT_TRUE(history.before("no such column").empty());
  std::string const rows = content_of(folder / "a" / "history.csv");
  for (char const* const taken : {"void_ratio", "p_Pa"}) {
    std::ofstream(folder / "a" / "history.csv") << std::regex_replace(rows, std::regex(taken), "other");
    EXPECT_EQ(page_on({folder / "a"}).find("Void ratio against mean stress"), std::string::npos) << "without " << taken;
  }
  std::ofstream(folder / "a" / "history.csv") << std::regex_replace(rows, std::regex("0[.]2[456][0-9]*"), "0.25");
  EXPECT_EQ(page_on({folder / "a"}).find("Void ratio against mean stress"), std::string::npos) << "a flat line";
}

TEST(ReportPlot, AnAxisHasNoEmptyStripBelowACurveThatStartsAHairBelowZero) {
  Range q;
  q.include({-0.001, 6.4});
  EXPECT_EQ(q.axis({"q"}).from, 0);
  q.include(-0.5);
  EXPECT_LT(q.axis({"q"}).from, -0.4);
}

TEST_F(Report, ThinsALongCurveButKeepsItsPeak) {
  fs::path const run = made("a");
  HistoryFile history(run / "history.csv", false);
  for (int i = 0; i <= 50000; ++i) {
    HistoryRow row;
    row.eps1 = made_up_strain * i / 50000;
    row.q_Pa = i == 33333 ? 4e6 : 1e6;
    history.write(row);
  }
  history.close();
  auto const curve = curves_of(page_on({run}), "Deviator stress").at(0);
  EXPECT_LE(curve.size(), 1000u);
  auto const peak = std::max_element(curve.begin(), curve.end(), [](auto a, auto b) { return a.second < b.second; });
  EXPECT_NEAR(peak->second, 4, 0.01);
  EXPECT_NEAR(peak->first, 10, 0.01);
  EXPECT_NEAR(curve.back().first, 15, 0.01);
}

TEST_F(Report, KnowsATestByItsNumbers) {
  TestNumbers const n = test_numbers(HistoryTable(made("a") / "history.csv").curves());
  EXPECT_DOUBLE_EQ(n.peak_q, 5e6);
  EXPECT_DOUBLE_EQ(n.peak_eps1, 0.02);
  EXPECT_NEAR(n.residual_q, 2e6, 1);
  EXPECT_DOUBLE_EQ(n.residual_from, 0.12);
  ASSERT_TRUE(n.secant_modulus);
  EXPECT_NEAR(*n.secant_modulus, 5e6 / 0.02, 1) << "q rises along a straight line";
  EXPECT_NEAR(n.eps_v_end, -0.015, 1e-12);
  EXPECT_NEAR(n.intact_end, 40, 1e-12);
  EXPECT_TRUE(n.passed_peak);
}

TEST_F(Report, ShowsTheSummaryAndTheWarningsWithHarmlessText) {
  std::string const page = page_on({made("a <script>")});
  EXPECT_NE(page.find("<td>5.000</td>"), std::string::npos) << "peak q";
  EXPECT_NE(page.find("<td>2.000 (12–15 %)</td>"), std::string::npos) << "residual q";
  EXPECT_NE(page.find("<td>250</td>"), std::string::npos) << "E50";
  EXPECT_NE(page.find("<td>0x0000000000000abc</td>"), std::string::npos);
  EXPECT_NE(
      page.find(
          "<td>law thickness_dependent<br>contact_coupling parallel<br>rolling_lever 0.25 B<br>thickness_mapping identity<br>"
          "strength_from conditions</td>"),
      std::string::npos);
  EXPECT_NE(page.find("the &lt;wall&gt; is &quot;near&quot;"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
}

TEST_F(Report, LaysSeveralRunsOverEachOther) {
  MadeUpTest sand;
  sand.saturation = 0;
  std::string const page = page_on({made("x/a"), made("y/a"), made("sand", sand)});
  EXPECT_EQ(curves_of(page, "Deviator stress").size(), 3u);
  EXPECT_EQ(curves_of(page, "Share of intact bonds").size(), 2u) << "clean sand has none";
  EXPECT_NE(page.find("<th>" + (folder / "x/a").string() + "</th>"), std::string::npos) << "equal names become paths";
  EXPECT_NE(page.find("<th>sand</th>"), std::string::npos);
  EXPECT_NE(page.find("sand: clean sand, 1 MPa"), std::string::npos);
}

TEST_F(Report, LeavesOutWhatThereIsNotAndSaysWhy) {
  std::string const page = page_on({made("a")});
  EXPECT_NE(page.find("There are no pictures of a: without snapshots"), std::string::npos);
  EXPECT_EQ(page.find("<img"), std::string::npos);
  EXPECT_EQ(page.find("Where the work went"), std::string::npos) << "no ledger";
  EXPECT_EQ(page.find("Mohr"), std::string::npos) << "one confining stress";
}

TEST_F(Report, StacksTheLedgerUpToTheWork) {
  MadeUpTest test;
  test.energy = true;
  std::string const page = page_on({made("a", test)});
  EXPECT_NE(page.find("Where the work went"), std::string::npos);
  auto const curves = curves_of(page, "Energy balance");
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_NEAR(curves[0].back().second, 300, 1);
  std::regex const areas("<polygon data-name");
  EXPECT_EQ(std::distance(std::sregex_iterator(page.begin(), page.end(), areas), std::sregex_iterator()), 5);
}

TEST_F(Report, NeedsNothingFromOutside) {
  fs::path const run = made("a");
  write_made_up_snapshots(run, made_up_lattice(20, 40), 0.2);
  std::string const page = page_on({run});
  for (char const* const forbidden : {"http:", "https:", "//cdn", "<script", "<link", "url(", "@import", "file:"})
    EXPECT_EQ(page.find(forbidden), std::string::npos) << forbidden;
  std::regex const source("src=\"(.{0,22})");
  for (std::sregex_iterator match(page.begin(), page.end(), source), end; match != end; ++match)
    EXPECT_EQ((*match)[1], "data:image/png;base64,");
  EXPECT_NE(page.find("alt=\"Intact and broken bonds at"), std::string::npos);
  EXPECT_NE(page.find("Where it sheared"), std::string::npos);
  EXPECT_NE(page.find("Grading curve"), std::string::npos);
  EXPECT_NE(page.find("Directions of contacts and forces"), std::string::npos);
}

TEST_F(Report, CallsTheLargestStressNoPeakWhileItRises) {
  MadeUpTest rising;
  rising.peak_eps1 = 0.2;
  for (auto const& [name, test] : {std::pair("peaked", MadeUpTest{}), std::pair("rising", rising)})
    write_made_up_snapshots(made(name, test), made_up_lattice(5, 5), 0.3);
  EXPECT_NE(page_on({folder / "peaked"}).find("through the grains near the peak:"), std::string::npos);
  std::string const page = page_on({folder / "rising"});
  EXPECT_NE(page.find("through the grains near the largest q so far, which no peak follows yet:"), std::string::npos);
  EXPECT_EQ(page.find("near the peak"), std::string::npos);
  EXPECT_NE(page_on({folder / "peaked", folder / "rising"}).find("it was still rising at the end of 1 of them"),
            std::string::npos);
}

/// Two members of one group, of which the second has no peak.
class StudyPage : public Report {
 protected:
  std::string page_on_study() const {
    MadeUpTest second;
    second.peak_eps1 = 0.2;
    second.breaking = 3;
    std::vector<fs::path> const folders = {made("first"), made("second", second)};
    Study study;
    study.file = "two.toml";
    study.seeds = {1, 2};
    study.groups = {{"all", {}, "all"}};
    std::vector<MemberResult> members(2);
    for (std::size_t i = 0; i < 2; ++i) {
      double const sign = i == 0 ? 1 : -1;
      members[i].seed = i + 1;
      members[i].state = MemberState::finished;
      members[i].numbers = {{"peak_q_Pa", 5e6 + sign * 1e5}, {"largest_eps_v", sign * 0.003 - 0.0001}};
      members[i].numbers["peak_passed"] = i == 0 ? 1 : 0;
      if (i == 0) members[i].peak = members[i].residual = FailureStress{6e6, 1e6};
    }
    write_study_report(study, members, folders, folder / "study.html");
    return content_of(folder / "study.html");
  }
};

TEST_F(StudyPage, SaysWhichMembersHaveNoPeak) {
  std::string const page = page_on_study();
  EXPECT_NE(page.find("<small class=\"unit\">(1 of 2 still rising)</small>"), std::string::npos);
  EXPECT_NE(page.find("q still rises at the end of 1 of 2 members (all-seed2): it has not fallen by 2 %"), std::string::npos);
}

TEST_F(StudyPage, RoundsItsNumbersToTheirIntervals) {
  std::string const page = page_on_study();
  EXPECT_NE(page.find("<span>5.0 ± 1.3<"), std::string::npos);
  EXPECT_NE(page.find("<span>0.0 ± 3.8<"), std::string::npos) << "-0.01, without a sign";
}

TEST_F(StudyPage, KeepsTheBandsOfEachGroupInItsPicture) {
  (void)page_on_study();
  Study study;
  study.file = "two.toml";
  study.groups = {{"a", {}, "a"}, {"b", {}, "b"}};
  std::vector<MemberResult> members(4);
  std::vector<fs::path> folders;
  for (std::size_t i = 0; i < members.size(); ++i) {
    members[i].group = i / 2;
    members[i].seed = i % 2 + 1;
    members[i].state = MemberState::finished;
    members[i].numbers["peak_q_Pa"] = 5e6;
    folders.push_back(folder / (i % 2 == 0 ? "first" : "second"));
  }
  write_study_report(study, members, folders, folder / "groups.html");
  std::string const page = content_of(folder / "groups.html");
  std::istringstream small(page.substr(page.find("<h2>Each group</h2>")));
  double height = 0;
  int points = 0;
  for (std::string line; std::getline(small, line);) {
    if (std::size_t const box = line.find("viewBox=\"0 0 "); box != std::string::npos)
      ASSERT_EQ(std::sscanf(line.c_str() + box, "viewBox=\"0 0 %*f %lf", &height), 1) << line;
    if (!line.starts_with("<polygon ")) continue;
    std::istringstream numbers(line.substr(line.find("points=\"") + 8));
    double x = 0, y = 0;
    for (char comma = 0; numbers >> x >> comma >> y; ++points) {
      EXPECT_GE(y, 0) << line;
      EXPECT_LE(y, height) << line;
    }
  }
  EXPECT_GT(points, 100);
}

TEST_F(StudyPage, CutsItsBandsWhereNoValuesArePossible) {
  std::string const page = page_on_study();
  EXPECT_NE(page.find("at each strain, as far as such values are possible. Of 2 seeds it is wide: 9.0 standard deviations to "
                      "either side; of 5 it would be 1.2."),
            std::string::npos);
  std::vector<SeedBand> const bands = seed_bands(read_runs({folder / "first", folder / "second"}));
  constexpr std::size_t q = 0, broken_shear = 6;
  ASSERT_STREQ(curve_columns[broken_shear], "broken_shear");
  EXPECT_EQ(bands[broken_shear].low.back(), 0);
  EXPECT_GT(bands[broken_shear].high.back(), 3.0 * made_up_records);
  EXPECT_TRUE(bands[broken_shear].cut);
  EXPECT_FALSE(bands[q].cut);
  EXPECT_LT(bands[q].low.back(), 0) << "a deviator stress can be negative";
  EXPECT_EQ(possible_range("bonds_intact_pct").cut(120), 100);
}

TEST_F(Report, OfEightRunsWithPicturesFitsIntoFiveMegabytes) {
  std::vector<fs::path> runs;
  for (int i = 0; i < 9; ++i) {
    runs.push_back(made("run" + std::to_string(i)));
    write_made_up_snapshots(runs.back(), made_up_lattice(60, 120), 0.3);
  }
  std::string const page = page_on(runs);
  EXPECT_LT(page.size(), 5'000'000u);
  EXPECT_NE(page.find("Pictures are shown of the first 8 runs"), std::string::npos);
}

TEST_F(Report, NamesWhatIsWrongWithARun) {
  std::string message;
  EXPECT_EQ(code_of([&] { page_on({folder / "none"}); }), ExitCode::file_missing);
  fs::path const run = made("a");
  std::string const history = content_of(run / "history.csv"), record = content_of(run / "run.json");
  auto const with_history = [&](std::string const& text) {
    std::ofstream(run / "history.csv") << text;
    return code_of([&] { page_on({run}); }, &message);
  };
  EXPECT_EQ(with_history(history + "1,2,3\n"), ExitCode::bad_input);
  EXPECT_NE(message.find("line 303: 3 cells, the header has 28"), std::string::npos) << message;
  EXPECT_EQ(with_history(std::regex_replace(history, std::regex("\nshear,100,0,"), "\nshear,100,zero,")), ExitCode::bad_input);
  EXPECT_NE(message.find("line 3: 'zero' in column time_s is no number"), std::string::npos) << message;
  EXPECT_EQ(with_history(std::regex_replace(history, std::regex("q_Pa|,sigma3_Pa"), ",r_Pa")), ExitCode::bad_input);
  EXPECT_NE(message.find("line 1: there is no column q_Pa, nor sigma1_Pa and sigma3_Pa"), std::string::npos) << message;
  EXPECT_EQ(with_history(std::regex_replace(history, std::regex("eps1"), "e1")), ExitCode::bad_input);
  EXPECT_NE(message.find("line 1: there is no column eps1"), std::string::npos) << message;
  EXPECT_EQ(with_history(std::regex_replace(history, std::regex("p_Pa"), "q_Pa")), ExitCode::bad_input);
  EXPECT_NE(message.find("line 1: two columns have the name 'q_Pa'"), std::string::npos) << message;
  EXPECT_EQ(with_history(history.substr(0, history.find('\n') + 1)), ExitCode::bad_input) << "no rows";
  EXPECT_EQ(with_history(""), ExitCode::bad_input);
  EXPECT_EQ(with_history(history + "1,2,3"), ExitCode::done) << "a row that is being written";
  std::ofstream(run / "run.json") << "{\"scene\": [";
  EXPECT_EQ(code_of([&] { page_on({run}); }), ExitCode::bad_input);
  fs::remove(run / "run.json");
  EXPECT_EQ(code_of([&] { page_on({run}); }), ExitCode::file_missing);
  std::ofstream(run / "run.json") << record;
  EXPECT_EQ(code_of([&] { write_report({run}, folder / "none" / "r.html"); }), ExitCode::cannot_create);
}

/// A table of some columns of a history, which lines of a spreadsheet or an older program could be.
std::string columns_of(std::string const& history, std::vector<std::string> const& wanted) {
  std::istringstream lines(history);
  std::vector<std::size_t> places;
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (places.empty())
      for (std::string const& name : wanted)
        places.push_back(static_cast<std::size_t>(std::find(cells.begin(), cells.end(), name) - cells.begin()));
    for (std::size_t i = 0; i < places.size(); ++i) text += (i > 0 ? "," : "") + cells.at(places[i]);
    text += '\n';
  }
  return text;
}

TEST_F(Report, DrawsWhatAHistoryWithFewerColumnsHasAndSaysWhatIsLeftOut) {
  fs::path const run = made("a");
  std::string const history = content_of(run / "history.csv");
  std::ofstream(run / "history.csv") << columns_of(history, {"step", "eps1", "sigma1_Pa", "sigma3_Pa", "eps_v"});
  std::string const page = page_on({run});
  EXPECT_NE(page.find("The history.csv of a has no void_ratio, bonds_intact, bonds_intact_pct, broken_tension, "), page.npos);
  EXPECT_NEAR(curves_of(page, "Deviator stress").at(0)[40].second, 5, 0.01) << "sigma1 - sigma3";
  EXPECT_NE(page.find("<td>5.000</td>"), page.npos) << "peak q";
  EXPECT_EQ(page.find("<title>Share of intact bonds"), page.npos);
  EXPECT_EQ(page.find("nan"), page.npos);
  EXPECT_NE(page.find("55 % hydrate"), page.npos) << "that it was bonded is known from run.json";
  std::ofstream(run / "history.csv") << columns_of(history, {"eps1", "q_Pa", "step"});
  std::string const least = page_on({run});
  EXPECT_EQ(least.find("<title>Volumetric strain"), least.npos);
  EXPECT_EQ(least.find("nan"), least.npos);
  fs::path const other = made("b", {.sigma3 = 3e6});
  EXPECT_EQ(page_on({run, other}).find("Mohr circles"), least.npos) << "without the lateral stress there is no circle";
}

TEST_F(Report, PassesOverColumnsThatItDoesNotKnow) {
  fs::path const run = made("a");
  std::string const page = page_on({run});
  std::istringstream lines(content_of(run / "history.csv"));
  std::ofstream file(run / "history.csv");
  std::string line;
  std::getline(lines, line);
  file << "remark,remark," << line << ",band_width_m\n";
  while (std::getline(lines, line)) file << "good, ," << line << ",wide\n";
  file.close();
  EXPECT_EQ(page_on({run}), page);
}

TEST_F(Report, NamesTheRunInEachCellOfATableOfSeveral) {
  std::string const page = page_on({made("a"), made("b")});
  EXPECT_NE(page.find("<div class=\"scroll several\">"), page.npos);
  EXPECT_NE(page.find("<td data-run=\"a\">5.000</td><td data-run=\"b\">5.000</td>"), page.npos);
  EXPECT_NE(page.find(".several td::before{content:attr(data-run)"), page.npos) << "narrow screens show it";
}

TEST_F(Report, BearsARecordAndAHistoryWithHolesInThem) {
  fs::path const run = made("a");
  std::ofstream(run / "run.json") << R"({"scene": {"hydrate": {"saturation": "much"}}, "warnings": [3], "exit": 7})";
  std::string const history = content_of(run / "history.csv");
  std::size_t const row = history.find("\nshear,300,");
  std::ofstream(run / "history.csv") << history.substr(0, row)
                                     << "\nshear,300,0,nan,inf,nan,nan,nan,nan,0,0,0,1,1,1,1,1,1,1,1,1,1,1,1,nan,nan,nan,nan"
                                     << history.substr(history.find('\n', row + 1));
  std::string const page = page_on({run});
  EXPECT_EQ(curves_of(page, "Deviator stress").size(), 2u) << "the curve has a gap";
  EXPECT_EQ(page.find("points=\"nan"), std::string::npos);
  EXPECT_NE(page.find("the run is not complete: unknown"), std::string::npos);
}

TEST_F(Report, IsAVerbOfTheProgram) {
  std::string const a = made("a").string(), b = made("b").string(), html = (folder / "both.html").string();
  CommandResult const one = run_clathra("report " + a);
  EXPECT_EQ(one.code, 0) << one.output;
  EXPECT_EQ(one.output, a + "/report.html is written\n");
  EXPECT_TRUE(fs::exists(folder / "a" / "report.html"));
  CommandResult const both = run_clathra("report " + a + " " + b + " -o " + html);
  EXPECT_EQ(both.code, 0) << both.output;
  EXPECT_NE(content_of(html).find("Biaxial compression: 2 runs"), std::string::npos);
  EXPECT_EQ(run_clathra("report").code, 64);
  EXPECT_EQ(run_clathra("report " + a + "/none").code, 66);
  EXPECT_EQ(run_clathra("report " + a + " -o " + a + "/none/r.html").code, 73);
}

}  // namespace
}  // namespace clathra
