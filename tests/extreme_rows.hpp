#pragma once
/// Rows of the table of extremes in perf/reports/0.1/stability.md: what was tried, what came out, what had to. perf/extremes.sh
/// prints them.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace clathra {

/// Appends a row to the file that CLATHRA_EXTREME_ROWS names, if it names one.
inline void print_row(std::string const& what, std::string const& measured, std::string const& bound) {
  char const* const path = std::getenv("CLATHRA_EXTREME_ROWS");
  if (!path) return;
  std::FILE* const file = std::fopen(path, "a");
  ASSERT_NE(file, nullptr) << path;
  std::fprintf(file, "| %s | %s | %s |\n", what.c_str(), measured.c_str(), bound.c_str());
  std::fclose(file);
}

inline std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// A row whose number lies between two bounds. @param quantity  what the number is, with its unit
inline void expect_row(std::string const& what, std::string const& quantity, double measured, double least, double most) {
  EXPECT_GE(measured, least) << what << ": " << quantity;
  EXPECT_LE(measured, most) << what << ": " << quantity;
  std::string const bound = least == most    ? "= " + short_text(least)
                            : least <= -1e99 ? "<= " + short_text(most)
                            : most >= 1e99   ? ">= " + short_text(least)
                                             : short_text(least) + " to " + short_text(most);
  print_row(what, quantity + " " + short_text(measured), bound);
}

/// A row that must end with an error of this kind whose message names `reason`.
template <class Error, class Work>
void expect_refusal(std::string const& what, std::string const& reason, Work const& work) {
  try {
    work();
    ADD_FAILURE() << what << ": went on";
  } catch (Error const& error) {
    std::string const text = error.what();
    EXPECT_NE(text.find(reason), std::string::npos) << what << ": " << text;
    print_row(what, "refused: " + text.substr(0, 110) + (text.size() > 110 ? "..." : ""), "names \"" + reason + "\"");
  }
}

}  // namespace clathra
