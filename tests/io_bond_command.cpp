#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.hpp"
#include "golden_bonds.hpp"
#include "kernels/lane.hpp"
#include "printed_number.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;

nlohmann::json bond(std::string const& arguments) {
  CommandResult const result = run_clathra("bond --preset first_crack --json " + arguments);
  EXPECT_EQ(result.code, 0) << result.output;
  return nlohmann::json::parse(result.output.substr(result.output.find('{')));  // after notes, which go to stderr
}

/// Options for a bond; lengths in um, pressure in MPa, density in g/cm^3.
std::string bond_arguments(double S, double r1, double r2, double gap, double T, double sigma_w, double rho, double F_n,
                           bool printed) {
  std::array<char, 512> text;
  std::snprintf(
      text.data(), text.size(),
      "--saturation %.17g --d50 '0.1694 mm' --r1 '%.17g um' --r2 '%.17g um' --gap '%.17g um' --temperature '%.17g degC' "
      "--pore-pressure '%.17g MPa' --hydrate-density '%.17g g/cm^3' --normal-force '%.17g N/m' --strength-from %s",
      S, r1, r2, gap, T, sigma_w, rho, F_n, printed ? "printed" : "conditions");
  return text.data();
}

/// The equations as they stand in the paper, written down once more and independently, without the forms that avoid cancellation.
struct PaperBond {
  double h_max, r, B, h0, area, q_c, q_t, E_m, R_t, R_c, k_mh, k_bn, k_bm, f_s, K_s, f_r, K_r, R_s, R_r;
  PaperBond(double S, double d50, double r1, double r2, double h, double T, double sigma_w, double rho, double F_n,
            bool printed) {
    using real = long double;
    real const ratio = S <= 0.2 ? 0 : S <= 0.7 ? -0.3268L * S * S + 0.4879L * S - 0.0815L : 0.1L;
    real const hm = ratio * d50, rr = 2 * static_cast<real>(r1) * r2 / (static_cast<real>(r1) + r2), pa = 1.01e5L, kn = 3e8L;
    real const b = std::sqrt(4 * rr * rr - (2 * rr - hm + h) * (2 * rr - hm + h));
    real const thick = (h + hm) / 2;
    real const s = 0.5L * (hm + h) * b + b * rr - 2 * rr * rr * std::atan(b / std::sqrt(4 * rr * rr - b * b));
    real const qc = pa * (0.81L * sigma_w / pa - 2.08L * T + 184.16L * rho / 1000 - 134.65L);
    real const qt = pa * (0.45L * sigma_w / pa - 1.15L * T + 101.75L * rho / 1000 - 74.39L);
    real const em = pa * (3 * sigma_w / pa - 1.98L * T + 4950.50L * rho / 1000 - 1821.78L);
    real const rt = printed ? 1.421e7L * b + 2.67e5L * h - 160.2L : 3 * b * qt + 2.67e5L * (h - 0.6e-3L);
    real const rc = printed ? 2.571e7L * b - 4.18e6L * h + 2508 : 3 * b * qc - 4.18e6L * (h - 0.6e-3L);
    real const kmh = b * em / thick, bell = std::exp(-(1000.0L * h - 1.15L) * (1000.0L * h - 1.15L));
    real const fs = 2.05L - 0.89L * bell, fr = 2.05L - 0.92L * bell, ks = 0.41L - 61.07L * h, kr = 0.83L - 146.36L * h;
    real const shape = (F_n + rt) * std::pow(std::log((rc + rt) / (F_n + rt)), 0.59L);
    auto const d = [](real value) { return static_cast<double>(value); };
    h_max = d(hm), r = d(rr), B = d(b), h0 = d(thick), area = d(s), q_c = d(qc), q_t = d(qt), E_m = d(em), R_t = d(rt),
    R_c = d(rc);
    k_mh = d(kmh), k_bn = d(kn * kmh / (kn + 2 * kmh)), k_bm = d(em * b * b * b / (12 * thick));
    f_s = d(fs), K_s = d(ks), f_r = d(fr), K_r = d(kr), R_s = d(fs * ks * shape), R_r = d(fr * kr * shape);
  }
};

void expect_close(nlohmann::json const& json, char const* key, double wanted, double tolerance) {
  EXPECT_NEAR(json.at(key).get<double>(), wanted, tolerance * std::fabs(wanted)) << key;
}

TEST(BondCommand, PrintsExactlyTheKeysItIsKnownFor) {
  auto const json = nlohmann::ordered_json::parse(
      run_clathra("bond --saturation 0.41 --d50 \"0.1694 mm\" --r1 \"0.0847 mm\" --r2 \"0.0847 mm\" --gap \"2 um\" --temperature "
                  "\"5 degC\" --pore-pressure \"8 MPa\" --hydrate-density \"0.9 g/cm^3\" --normal-force \"200 N/m\" --json")
          .output);
  std::string keys;
  for (auto const& [key, value] : json.items()) keys += key + " ";
  EXPECT_EQ(keys,
            "bonded h_max_m common_radius_m gap_m B_m h0_m area_m2 q_c_Pa q_t_Pa E_m_Pa R_t_N_per_m R_c_N_per_m "
            "k_mh_N_per_m2 k_bn_N_per_m2 k_bs_N_per_m2 k_bm_N_per_rad f_s K_s f_r K_r R_s_N_per_m R_r_per_length_N_per_m ");
  EXPECT_EQ(json["bonded"], true);
}

TEST(BondCommand, AgreesWithTheEquationsEvaluatedIndependently) {
  struct Case {
    double S, r1, r2, gap, T, sigma_w, rho, F_n;
  };
  Case const cases[] = {{0.41, 84.7, 84.7, 2, 5, 8, 0.9, 200},  {0.26, 84.7, 84.7, 0, 5, 8, 0.9, 0},
                        {0.55, 50, 150, 3.7, 5, 8, 0.9, 1000},  {0.70, 84.7, 60, 1, 1, 5, 0.9, -100},
                        {0.9, 150, 150, 10, 4, 13, 0.84, 2000}, {0.3, 120, 90, 0.5, 3, 9, 0.88, 50},
                        {0.55, 84.7, 84.7, 0, 5, 8, 0.9, 4000}};
  for (Case const& c : cases)
    for (bool const printed : {false, true}) {
      auto const json = bond(bond_arguments(c.S, c.r1, c.r2, c.gap, c.T, c.sigma_w, c.rho, c.F_n, printed));
      PaperBond const paper(c.S, 0.1694e-3, c.r1 * 1e-6, c.r2 * 1e-6, c.gap * 1e-6, c.T, c.sigma_w * 1e6, c.rho * 1e3, c.F_n,
                            printed);
      constexpr double tolerance = 1e-9;
      for (auto const& [key, wanted] : {std::pair{"h_max_m", paper.h_max},
                                        {"common_radius_m", paper.r},
                                        {"B_m", paper.B},
                                        {"h0_m", paper.h0},
                                        {"area_m2", paper.area},
                                        {"q_c_Pa", paper.q_c},
                                        {"q_t_Pa", paper.q_t},
                                        {"E_m_Pa", paper.E_m},
                                        {"R_t_N_per_m", paper.R_t},
                                        {"R_c_N_per_m", paper.R_c},
                                        {"k_mh_N_per_m2", paper.k_mh},
                                        {"k_bn_N_per_m2", paper.k_bn},
                                        {"k_bs_N_per_m2", paper.k_bn * 2 / 3},
                                        {"k_bm_N_per_rad", paper.k_bm},
                                        {"f_s", paper.f_s},
                                        {"K_s", paper.K_s},
                                        {"f_r", paper.f_r},
                                        {"K_r", paper.K_r},
                                        {"R_s_N_per_m", paper.R_s},
                                        {"R_r_per_length_N_per_m", paper.R_r}})
        expect_close(json, key, wanted, tolerance);
    }
}

TEST(BondCommand, ReproducesTheGoldenNumbersOfUnequalDiscs) {
  auto const json = bond("--saturation \"41 %\" --r1 \"0.05 mm\" --r2 \"0.15 mm\" --gap \"2 um\" --strength-from printed");
  struct Golden {
    char const *key, *value;
  };
  for (Golden const& golden : {Golden{"common_radius_m", "7.5e-5"},
                               {"B_m", "50.55e-6"},
                               {"h0_m", "6.387e-6"},
                               {"R_t_N_per_m", "558.7"},
                               {"R_c_N_per_m", "3799"},
                               {"k_mh_N_per_m2", "2.287e9"},
                               {"k_bn_N_per_m2", "1.408e8"},
                               {"k_bs_N_per_m2", "9.385e7"},
                               {"k_bm_N_per_rad", "0.4871"},
                               {"f_s", "1.812"},
                               {"K_s", "0.4099"},
                               {"f_r", "1.804"},
                               {"K_r", "0.8297"},
                               {"area_m2", "2.472e-10"}})
    EXPECT_TRUE(agrees(json.at(golden.key).get<double>(), golden.value)) << golden.key;
}

TEST(BondCommand, ReproducesTheEnvelopeTable) {
  for (golden::Envelope const& row : golden::envelopes) {
    double const S = row.saturation / 100, gap = row.share * (-0.3268 * S * S + 0.4879 * S - 0.0815) * 169.4;
    auto const expect = [&](double F_n, char const* shear, char const* rolling) {
      auto const json = bond(bond_arguments(S, 84.7, 84.7, gap, 5, 8, 0.9, F_n, true));
      EXPECT_TRUE(agrees(json.at("R_s_N_per_m").get<double>(), shear)) << row.saturation << " " << row.share << " " << F_n;
      if (!rolling) return;
      EXPECT_TRUE(agrees(json.at("R_r_per_length_N_per_m").get<double>(), rolling))
          << row.saturation << " " << row.share << " " << F_n;
    };
    expect(0, row.shear_0, row.rolling_0);
    expect(100, row.shear_100, nullptr);
    expect(200, row.shear_200, row.rolling_200);
    expect(500, row.shear_500, nullptr);
    expect(1000, row.shear_1000, row.rolling_1000);
  }
}

TEST(BondCommand, OutsideTheEnvelopeNothingIsLeft) {
  auto const pulled = bond("--saturation 0.41 --normal-force \"-700 N/m\"");
  EXPECT_EQ(pulled["R_s_N_per_m"], 0);
  EXPECT_EQ(pulled["R_r_per_length_N_per_m"], 0);
  EXPECT_EQ(bond("--saturation 0.41 --normal-force \"5 kN/m\"")["R_s_N_per_m"], 0);
  EXPECT_EQ(bond("--saturation 0.41 --gap \"11 um\"")["bonded"], false);
  EXPECT_EQ(bond("--saturation 0.2")["bonded"], false);
  EXPECT_EQ(bond("--saturation 0.41 --gap \"-2 um\"")["gap_m"], 0);
}

TEST(BondCommand, RefusesNonsenseWithTheRightCode) {
  EXPECT_EQ(run_clathra("bond").code, 64);
  EXPECT_EQ(run_clathra("bond --saturation 0.41 --strength-from guessed").code, 64);
  CommandResult const length = run_clathra("bond --saturation 0.41 --pore-pressure \"8 mm\"");
  EXPECT_EQ(length.code, 64);
  EXPECT_NE(length.output.find("--pore-pressure: error: needs a pressure, got a length ('8 mm'); example: \"1 MPa\""),
            std::string::npos)
      << length.output;
  CommandResult const percent = run_clathra("bond --saturation 41");
  EXPECT_EQ(percent.code, 64);
  EXPECT_TRUE(
      says(percent, "--saturation: error: must lie between 0 and 1, got 41; this looks like percent: write 0.41 or \"41 %\""));
  CommandResult const radius = run_clathra("bond --saturation 0.41 --r1 \"0 mm\"");
  EXPECT_EQ(radius.code, 64);
  EXPECT_TRUE(says(radius, "--r1: error: must be above 0"));
}

TEST(CommandLine, EndsEveryHelpWithAnExample) {
  for (char const* const verb : {"", "run", "check", "generate", "bond", "info"}) {
    CommandResult const help = run_clathra(std::string(verb) + " --help");
    EXPECT_EQ(help.code, 0);
    EXPECT_NE(help.output.find("Example: clathra "), std::string::npos) << verb;
  }
}

TEST(CommandLine, BondSaysWhereItsEquationsWereNotFitted) {
  EXPECT_TRUE(says(run_clathra("bond --saturation 0.55 --temperature '-50 degC'"),
                   "note: strength and stiffness of hydrate are extrapolated"));
  EXPECT_EQ(run_clathra("bond --saturation 0.55").output.find("note"), std::string::npos);
}

TEST(CommandLine, HasOneCodeForEachKindOfFailure) {
  EXPECT_TRUE(says(run_clathra(""), "clathra: a command is required: init, schema, check, run, "));
  EXPECT_TRUE(says(run_clathra("--quiet"), "clathra: a command is required before --quiet: init, "));
  for (char const* const none : {"", "--quiet"}) EXPECT_EQ(run_clathra(none).code, 64);
  CommandResult const misspelt = run_clathra("rum quick.toml");
  EXPECT_EQ(misspelt.code, 64);
  EXPECT_NE(misspelt.output.find("there is no command 'rum'; did you mean 'run'?"), std::string::npos) << misspelt.output;
  EXPECT_EQ(run_clathra("check no_such.toml").code, 66);
  EXPECT_EQ(run_clathra("info no_such.h5").code, 66);
  EXPECT_EQ(run_clathra("check '" CLATHRA_EXAMPLES "/quick.toml' --set hydrate.saturation=26").code, 64);
  EXPECT_EQ(run_clathra("check '" CLATHRA_EXAMPLES "/quick.toml' --set test.inertial_number=0.02").code, 77);
  EXPECT_EQ(run_clathra("check '" CLATHRA_EXAMPLES "/quick.toml' --set test.inertial_number=0.02 --ignore-guards").code, 0);
  EXPECT_EQ(run_clathra("run '" CLATHRA_EXAMPLES "/quick.toml' --output /proc/none").code, 73);
}

/// 64 is the command line with all values in it, 65 what stands in a file.
TEST(CommandLine, TellsItsOwnMistakesFromThoseOfFiles) {
  std::string const scene = "'" CLATHRA_EXAMPLES "/quick.toml' ", study = "'" CLATHRA_EXAMPLES "/studies/saturations.toml' ";
  fs::path const folder = fs::temp_directory_path() / ("clathra_codes_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "wrong.toml") << "[hydrate]\nsaturation = 26\n";
  std::ofstream(folder / "wrong_study.toml") << "scene = \"wrong.toml\"\nseeds = 1\n";
  std::ofstream(folder / "no_goal.toml") << "scene = \"wrong.toml\"\nprecision_target = \"peak_q=2\"\n";
  for (std::string const& arguments : std::vector<std::string>{
           "check " + scene + "--set test.axial_strain=15", "run " + scene + "--set grains.kn=1", "generate " + scene + "--set x",
           "study " + study + "--dry-run --set grains.friction=wet", "study " + study + "--dry-run --precision-target peak_q=2",
           "study " + study + "--dry-run --max-seeds 5", "tune " + scene + "--set grains.friction=-1",
           "tune " + scene + "--tolerance 5", "tune " + scene + "--quantity nothing", "reproduce --dry-run --set grains.kn=1",
           "bond --saturation 41", "bond --saturation 0.4 --gap '1 MPa'", "check " + scene + "--ranks 0",
           "run " + scene + "--max-walltime soon"})
    EXPECT_EQ(run_clathra(arguments).code, 64) << arguments;
  auto const file = [&](char const* name) { return "'" + (folder / name).string() + "' "; };
  for (std::string const& arguments : {"check " + file("wrong.toml"), "run " + file("wrong.toml"), "tune " + file("wrong.toml"),
                                       "study --dry-run " + file("wrong_study.toml"), "study --dry-run " + file("no_goal.toml"),
                                       "check " + file("wrong.toml") + "--set grains.kn=1"})
    EXPECT_EQ(run_clathra(arguments).code, 65) << arguments;
  EXPECT_EQ(run_clathra("reproduce --dry-run --data " + file("none.csv")).code, 66);
  fs::remove_all(folder);
}

TEST(CommandLine, SuggestsPercentOfNumbersThatLookLikeIt) {
  EXPECT_TRUE(says(run_clathra("tune '" CLATHRA_EXAMPLES "/quick.toml' --tolerance 5"),
                   "--tolerance: error: must lie between 0 and 1, got 5; this looks like percent: write 0.05 or \"5 %\""));
  EXPECT_TRUE(says(run_clathra("study '" CLATHRA_EXAMPLES "/studies/saturations.toml' --precision-target peak_q=2"),
                   "write 0.02 or \"2 %\""));
}

TEST(CommandLine, ListsTheFormatsOfAnExport) {
  CommandResult const result = run_clathra("export . --to vtk");
  EXPECT_EQ(result.code, 64);
  EXPECT_NE(result.output.find("there is no format 'vtk'; there are vtu (snapshots for VTK, with .pvd series), lammpsdump ("),
            std::string::npos)
      << result.output;
  EXPECT_EQ(run_clathra("export . --to VTU").code, 66) << "in any case; there are no snapshots here";
}

TEST(CommandLine, TakesNoEmptyNameForWhatItWrites) {
  std::string const scene = CLATHRA_EXAMPLES "/quick.toml";
  for (std::string const& arguments : {"run " + scene + " --output \"\"", "generate " + scene + " -o \"\"",
                                       std::string("report . -o \"\""), std::string("export . --to csv -o \"\"")}) {
    CommandResult const result = run_clathra(arguments);
    EXPECT_EQ(result.code, 64) << arguments << result.output;
    EXPECT_NE(result.output.find("--output: the name is empty"), std::string::npos) << arguments << result.output;
  }
}

TEST(CommandLine, PricesThePapersStrainRate) {
  CommandResult const result =
      run_clathra("check '" CLATHRA_EXAMPLES "/paper/literal-s55-1mpa.toml' --set test.strain_rate=\"5 %/min\"");
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(result.output.find("7.2e-09"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("days"), std::string::npos) << result.output;
}

TEST(BenchCommand, PrintsACardOfThisMachine) {
  for (char const* const what : {"rolling", "bonded"}) {
    CommandResult const result =
        run_clathra(std::string("bench --case ") + what + " --particles 2000 --threads 1 --seconds 0.05 --json 2>/dev/null");
    ASSERT_EQ(result.code, 0) << result.output;
    auto const card = nlohmann::json::parse(result.output);
    double const discs = card["particle_steps_per_second"].get<double>(), contacts = card["contact_steps_per_s"].get<double>();
    EXPECT_GT(discs, 1e5);
    EXPECT_GT(contacts / discs, 1.2);  // pairs a disc: 1.5 to 2.2 here
    EXPECT_LT(contacts / discs, 3);
    EXPECT_GT(card["bytes_per_particle"], card["bytes_moved_per_particle_and_step"].get<double>() / 2);
    EXPECT_GT(card["search_bytes_per_particle"], 36);  // its candidates alone
    EXPECT_LT(card["search_bytes_per_particle"], 0.6 * card["bytes_per_particle"].get<double>());
    EXPECT_GT(card["bandwidth_share"], 0);
    EXPECT_LT(card["rebuild_share"], 1);
    EXPECT_EQ(card["threads"], 1);
  }
  EXPECT_EQ(run_clathra("bench --case soup").code, 64);
}

TEST(BenchCommand, PrintsATableOfSizesInBothPrecisions) {
  CommandResult const result =
      run_clathra("bench --card --case rolling --particles 4000 --threads 1 --seconds 0.05 --json 2>/dev/null");
  ASSERT_EQ(result.code, 0) << result.output;
  auto const rows = nlohmann::json::parse(result.output)["rows"];
  ASSERT_EQ(rows.size(), 4);
  for (std::size_t n = 0; n < 4; ++n) {
    double const discs = n < 2 ? 2000 : 4000;
    EXPECT_EQ(rows[n]["precision"], n % 2 == 0 ? "double" : "mixed");
    EXPECT_NEAR(rows[n]["particles"], discs, 0.1 * discs);
    double const speed = rows[n]["particle_steps_per_second"], step = rows[n]["seconds_per_step"];
    EXPECT_NEAR(speed * step, rows[n]["particles"], 1);
    EXPECT_GE(rows[n]["launches_per_step"], for_gpu ? 0.1 : 3);  // drift, contacts, walls; there a graph of sixteen steps is one
    EXPECT_LT(rows[n]["launches_per_step"], 20);
    EXPECT_GT(rows[n]["bandwidth_share"], 0);
  }
  EXPECT_LT(rows[1]["bytes_per_particle"], rows[0]["bytes_per_particle"]);
  EXPECT_EQ(run_clathra("bench --card --precision mixed").code, 64);
  EXPECT_EQ(run_clathra("bench --card --particles 1000").code, 64);
}

}  // namespace
}  // namespace clathra
