/// Grading files as laboratories have them: what is read to the same curve, what is refused with which words, what is warned of.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "command.hpp"
#include "domain/scene/grading_file.hpp"
#include "domain/scene/specimen_design.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;

struct Case {
  char const* name;
  std::string text;
  std::string message = "";  ///< of what is refused, behind the name of the file
};

Grading const sand({0.1 * 1e-3, 0.15 * 1e-3, 0.17 * 1e-3, 0.2 * 1e-3, 0.24 * 1e-3}, {0, 0.3, 0.5, 0.8, 1});

void expect_sand(Case const& given) {
  try {
    Grading const grading = parse_grading(given.text, "sand.csv");
    EXPECT_EQ(grading.diameters(50), sand.diameters(50)) << given.name;
    EXPECT_EQ(grading.smallest(), sand.smallest()) << given.name;
    EXPECT_EQ(grading.largest(), sand.largest()) << given.name;
  } catch (std::invalid_argument const& problem) {
    ADD_FAILURE() << given.name << ": " << problem.what();
  }
}

void expect_refused(Case const& given) {
  try {
    parse_grading(given.text, "sand.csv");
    ADD_FAILURE() << given.name << " was read";
  } catch (std::invalid_argument const& problem) {
    std::string const message = problem.what();
    EXPECT_EQ(message.substr(0, 8 + given.message.size()), "sand.csv" + given.message) << given.name << "\n" << message;
  }
}

std::string const rows = "0.1,0\n0.15,30\n0.17,50\n0.2,80\n0.24,100\n", plain = "d_mm,percent_finer\n" + rows;

TEST(GradingFile, IsReadHoweverItIsWrittenWhereThatIsUnambiguous) {
  for (Case const& given : {
           Case{"plain", plain},
           Case{"coarse first", "d_mm,percent_finer\n0.24,100\n0.2,80\n0.17,50\n0.15,30\n0.1,0"},
           Case{"semicolons and decimal commas", "d_mm;percent_finer\n0,1;0\n0,15;30\n0,17;50\n0,2;80\n0,24;100\n"},
           Case{"tabs and decimal commas", "d_mm\tpercent_finer\n0,1\t0,0\n0,15\t30\n0,17\t50\n0,2\t80\n0,24\t100\n"},
           Case{"decimal commas in quotes",
                "d_mm,percent_finer\n\"0,1\",0\n\"0,15\",\"30,0\"\n\"0,17\",50\n\"0,2\",80\n\"0,24\",100\n"},
           Case{"blanks", "d_mm  percent_finer\n 0.1 0\n0.15\t30 \n0.17   50\n0.2 80\n0.24 100\n"},
           Case{"mark of UTF-8", "\xef\xbb\xbf" + plain},
           Case{"CR LF", "d_mm,percent_finer\r\n0.1,0\r\n0.15,30\r\n0.17,50\r\n0.2,80\r\n0.24,100\r\n"},
           Case{"CR", "d_mm,percent_finer\r0.1,0\r0.15,30\r0.17,50\r0.2,80\r0.24,100\r"},
           Case{"quotes", "\"d (mm)\",\"finer, \"\"dry\"\" (%)\",\"percent finer\"\n" +
                              "0.1,,\"0\"\n0.15,,30\n0.17,,50\n0.2,x,80\n0.24,,100\n"s},
           Case{"comments and blank lines", "\n# Sand 12\n  # dry\n\n" + plain + "\n,,\n# end"},
           Case{"empty columns", "d_mm,percent_finer,,\n0.1,0,,\n0.15,30\n0.17,50,\n0.2,80,,\n0.24,100,,\n"},
           Case{"a row twice", "d_mm,percent_finer\n0.1,0\n0.15,30\n0.150,30.0\n0.17,50\n0.2,80\n0.24,100\n"},
           Case{"percent signs", "d_mm,percent_finer\n0.1,0%\n0.15,30 %\n0.17,50\n0.2,80 %\n0.24,100 %\n"},
           Case{"empty sieves at both ends", "d_mm,percent_finer\n0.001,0\n0.05,0\n" + rows + "0.5,100\n4.75,100\n"},
       })
    expect_sand(given);
}

TEST(GradingFile, FindsItsColumnsByTheirNames) {
  for (char const* const names :
       {"d_mm,percent_finer", "D (mm),% Finer", "diameter_mm,finer_pct", "Sieve size [mm],Percent Passing (%)", "size mm,passing",
        "grain diameter in mm,cumulative percent finer by mass", "mm,finer"})
    expect_sand({names, names + ("\n" + rows)});
  for (Case const& given : {
           Case{"masses beside", "d_mm,mass_g,percent_finer\n0.1,7,0\n0.15,30,30\n0.17,9,50\n0.2,1,80\n0.24,3,100\n"},
           Case{"retained beside", "percent_retained,% passing,size_mm\n7,0,0.1\n30,30,0.15\n9,50,0.17\n1,80,0.2\n3,100,0.24\n"},
           Case{"sieve numbers beside",
                "Sieve,Opening (mm),% Passing\npan,0.1,0\n100,0.15,30\n90,0.17,50\n75,0.2,80\n60,0.24,100\n"},
           Case{"cumulative retained", "d_mm,cumulative_percent_retained\n0.24,0\n0.2,20\n0.17,50\n0.15,70\n0.1,100\n"},
           Case{"no-break spaces",
                "d_mm;finer\n0.1;\xc2\xa0"
                "0\n0.15; 30\n0.17;\xc2\xa0"
                "50\n0.2;80\n0.24;100\xc2\xa0\n"},
           Case{"coarser", "d_mm,% coarser\n0.24,0\n0.2,20\n0.17,50\n0.15,70\n0.1,100\n"},
           Case{"fractions, said", "d_mm,fraction_finer\n0.1,0\n0.15,0.3\n0.17,.5\n0.2,0.8\n0.24,1\n"},
           Case{"fractions, not said to be per cent", "d_mm,finer\n0.1,0\n0.15,0.3\n0.17,.5\n0.2,0.8\n0.24,1.0\n"},
       })
    expect_sand(given);
  std::string const rows_um = "\n100,0\n240,100\n";
  for (char const* const names : {"d_um,finer", "size_um,finer", "d (\xc2\xb5m),finer", "d (\xce\xbcm),finer", "d (\xb5m),finer"})
    EXPECT_EQ(parse_grading(names + rows_um, names).largest(), 240 * 1e-6) << names;
  EXPECT_EQ(parse_grading("d_m,finer\n0.01,0\n0.024,100\n", "m").largest(), 0.024);
}

TEST(GradingFile, IsRefusedWithTheNameThatIsNotUnderstood) {
  for (Case const& given : {
           Case{"masses alone", "d_mm,mass_g\n" + rows, ":1: 'mass_g' says masses, not what is finer than each size"},
           Case{"mass that passes", "d_mm,mass passing\n" + rows, ":1: 'mass passing' says masses"},
           Case{"retained", "d_mm,percent_retained\n" + rows,
                ":1: 'percent_retained' may be what each sieve holds for itself: give what passes it, or say "
                "cumulative_percent_retained"},
           Case{"other names", "# x\na,b\n1,2\n", ":2: no column says the sizes: the header is 'a,b'; understood are d_mm, "},
           Case{"no share", "d_mm,b\n" + rows,
                ":1: no column says what is finer than each size: the header is 'd_mm,b'; understood"},
           Case{"no unit", "d,percent_finer\n" + rows, ":1: 'd' says no unit of the sizes that is understood (mm, um, m): "},
           Case{"two sizes", "d_mm,size_um,finer\n1,2,3\n", ":1: both 'd_mm' and 'size_um' name the diameter"},
           Case{"two units", "d_mm (um),finer\n1,2\n", ":1: 'd_mm (um)' states two units"},
           Case{"per mille", "d_mm,\xe2\x80\xb0 finer\n1,2\n", ":1: '\xe2\x80\xb0 finer' is in per mille"},
           Case{"per mille in words", "d_mm,finer per mille\n1,2\n", ":1: 'finer per mille' is in per mille"},
           Case{"two shares", "d_mm,finer,passing\n1,2,3\n", ":1: both 'finer' and 'passing' name what is finer"},
           Case{"title", "Sand 12\n" + plain, ":1: no column says the sizes: the header is 'Sand 12'; "},
           Case{"no header", rows, ":1: there is no header above '0.1,0': put d_mm,percent_finer there"},
           Case{"header in a comment", "# " + plain,
                ":2: there is no header above '0.1,0': put d_mm,percent_finer there, or take the '#' of line 1 away if that is "
                "it"},
       })
    expect_refused(given);
}

TEST(GradingFile, IsRefusedWhereItIsNoTableOfNumbers) {
  for (Case const& given : {
           Case{"UTF-16", "\xff\xfe" + "d\0_\0"s, ": is in UTF-16: save it as CSV in UTF-8"},
           Case{"UTF-16 without a mark", "d\0_\0m\0"s, ": holds bytes of zero, as UTF-16"},
           Case{"spreadsheet", "PK\x03\x04z", ": is a spreadsheet (.xlsx, .ods)"},
           Case{"empty", "# x\n\n", ": is empty"},
           Case{"no rows", "\nd_mm,percent_finer\n", ":2: no rows under the header"},
           Case{"no number", plain + "0.3,x\n", ":7: column 2 needs a number, got 'x' in '0.3,x'"},
           Case{"no cell", plain + "0.3\n", ":7: '0.3' has 1 of 2 cells: the header is cut at ','"},
           Case{"another separator", "d_mm;percent_finer\n0.1,0\n", ":2: '0.1,0' has 1 of 2 cells: the header is cut at ';'"},
           Case{"decimal commas between commas", "d_mm,percent_finer\n0,1,0\n",
                ":2: '0,1,0' has 3 of 2 cells: beside decimal commas columns need ';' or tabs between them"},
           Case{"both decimal signs", "d_mm;finer\n0,1;0\n0.2;100\n", ":2: '0,1' has a comma, line 3 a decimal point"},
           Case{"thousands", "d_um;finer\n1,000;0\n2,000;100\n", ":2: '1,000' may be a thousand times what it is with"},
           Case{"open quote", "d_mm,finer\n\"0.1,0\n", ":2: a quote has no end on its line"},
           Case{"sieve number", "Sieve,d_mm,finer\n#4,4.75,100\n", ":2: '#4,4.75,100' may be a comment or the row of a sieve"},
       })
    expect_refused(given);
}

TEST(GradingFile, IsRefusedWhereItsNumbersAreNoGrading) {
  std::string const head = "d_mm,percent_finer\n\n";
  for (Case const& given : {
           Case{"last sieve", head + "0.1,0\n0.15,30\n4.75,99.8\n",
                ":5: the coarsest sieve of 4.75 mm lets 99.8 % through: add the size that all pass, with 100 % finer"},
           Case{"first sieve", head + "0.1,8.3\n0.15,30\n0.2,100\n",
                ":3: the finest sieve of 0.1 mm lets 8.3 % through: add the size below which there is nothing, with 0 % finer"},
           Case{"one size", head + "0.1,100\n", ":3: the finest sieve of 0.1 mm lets 100 % through"},
           Case{"vertical step", head + "0.1,0\n0.15,30\n0.15,35\n0.2,100\n",
                ":5: 0.15 mm has 35 % here, 30 % on line 4: a curve has no vertical step"},
           Case{"fractions", head + "0.1,0\n0.15,0.083\n0.2,1\n",
                ":5: no more than 1 % in the whole column: these look like fractions; write per cent, or name it fraction_finer"},
           Case{"per cent", "d_mm,finer_fraction\n0.1,0\n0.15,8.3\n0.2,100\n",
                ":4: fractions are 0 to 1, got 100: these look like per cent; name the column percent_finer"},
           Case{"fractions that do not end", "d_mm,finer\n0.1,0\n0.2,0.998\n", ":3: the coarsest sieve of 0.2 mm lets 99.8 %"},
           Case{"slip in a size", head + "0.1,0\n0.15,30\n0.017,50\n0.2,100\n",
                ":5: the sizes neither grow nor fall from line to line: 0.017 mm here, 0.1 mm on line 3"},
           Case{"falling", head + "0.1,0\n0.15,30\n0.17,20\n0.2,100\n",
                ":5: 0.17 mm lets 20 % through, less than the finer sieve of line 4 (0.15 mm lets 30 % through)"},
           Case{"retained named finer", head + "0.1,100\n0.2,0\n",
                ":4: 0.2 mm lets 0 % through, less than the finer sieve of line 3 (0.1 mm lets 100 % through): what is finer and "
                "what is retained may be mixed up"},
           Case{"size of 0", head + "0,0\n0.2,100\n", ":3: a size must be above 0, got '0'"},
           Case{"above 100", head + "0.1,0\n0.2,120\n", ":4: what is finer must be 0 to 100 %, got '120'"},
           Case{"sizes in um", head + "100,0\n240,100\n",
                ":1: half of its grains are finer than 154.919 mm, no soil is: its sizes are in another unit than the column "
                "'d_mm' "
                "says"},
           Case{"sizes in m", head + "1e-5,0\n2.4e-5,100\n", ":1: half of its grains are finer than 1.54919e-05 mm"},
           Case{"no sizes", head + "1e300,0\n1e301,100\n", ":1: half of its grains are finer than "},
           Case{"one per cent", "d_mm,finer\n0.1,0 %\n0.15,0.3 %\n0.24,1 %\n", ":4: no more than 1 % in the whole column"},
           Case{"per cent among fractions", "d_mm,fraction_finer\n0.1,0 %\n0.24,100 %\n",
                ":2: '0 %' is in per cent, the column 'fraction_finer' in fractions: name it percent_finer, or write fractions"},
           Case{"below 0", head + "0.1,-1\n0.2,100\n", ":3: what is finer must be 0 to 100 %, got '-1'"},
       })
    expect_refused(given);
}

class GradingFileOfAScene : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder);
    std::ofstream(folder / "sand.toml") << "[specimen]\nparticles = 300\n[grading]\nfile = \"sand.csv\"\n";
  }
  void TearDown() override { fs::remove_all(folder); }

  CommandResult check(std::string const& grading, std::string const& more = "") {
    std::ofstream(folder / "sand.csv") << grading;
    return run_clathra("check '" + (folder / "sand.toml").string() + "' --particle-steps-per-second 1e6 " + more);
  }
  /// The warnings alone.
  std::string warned(CommandResult const& result) {
    EXPECT_EQ(result.code, 0) << result.output;
    auto const last = result.output.rfind("warning: ");
    return last == std::string::npos ? "" : result.output.substr(last, result.output.find('\n', last) - last);
  }

  fs::path const folder = fs::temp_directory_path() / ("clathra_grading_" + std::to_string(::getpid()));
};

TEST_F(GradingFileOfAScene, IsScaledToItsStatedMedianWithoutMovingABit) {
  ASSERT_EQ(check(plain).code, 0);
  GradingScene scene;
  scene.file = (folder / "sand.csv").string();
  EXPECT_EQ(Grading::of(scene).diameters(100), sand.scaled(sand.stated_d50() / sand.d50()).diameters(100));
}

TEST_F(GradingFileOfAScene, IsRefusedByCheckAtItsLine) {
  CommandResult const result = check("d_mm,percent_finer\n0.1,8.3\n0.2,100\n");
  EXPECT_EQ(result.code, 65) << result.output;
  EXPECT_TRUE(says(result, "sand.csv:2: the finest sieve of 0.1 mm lets 8.3 % through"));
}

TEST_F(GradingFileOfAScene, HasNoDiscsOfItsEmptySieves) {
  CommandResult const result = check("d_mm,percent_finer\n0.001,0\n" + rows + "4.75,100\n"), usual = check(plain);
  EXPECT_EQ(warned(result), "");
  EXPECT_EQ(result.output, usual.output) << "box, time step, memory";
}

TEST_F(GradingFileOfAScene, IsWarnedOfWhereItsMedianHangsOnAPlateau) {
  for (char const* const share : {"49.9", "50", "50.4"})
    EXPECT_EQ(warned(check("d_mm,finer\n0.4,0\n0.5,"s + share + "\n2.08," + share + "\n2.4,100\n")).substr(0, 55),
              "warning: the grading has hardly any grains around 50 %:")
        << share;
  EXPECT_EQ(warned(check("d_mm,finer\n0.4,0\n0.5,45\n2.08,45\n2.4,100\n")), "") << "flat elsewhere";
  EXPECT_EQ(warned(check("d_mm,finer\n0.05,0\n1,100\n", "--set specimen.particles=30000")), "") << "wide, but not flat";
}

TEST_F(GradingFileOfAScene, IsWarnedOfWhereItsDiscsAreEqual) {
  std::string const wanted = "warning: the particles are as good as equal (d90 / d10 = ";
  EXPECT_EQ(warned(check("d_mm,finer\n0.2,0\n0.21,100\n")).substr(0, wanted.size()), wanted);
  EXPECT_EQ(warned(check("d_mm,finer\n0.2,0\n0.23,100\n")), "");
  EXPECT_EQ(
      warned(run_clathra("check '" CLATHRA_EXAMPLES "/quick.toml' --set grading.table=uniform --particle-steps-per-second 1e6"))
          .substr(0, wanted.size()),
      wanted);
}

}  // namespace
}  // namespace clathra
