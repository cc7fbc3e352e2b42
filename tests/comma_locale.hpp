#pragma once
/// A locale that writes 0,5 for 0.5, for C and for streams, as a program that calls std::locale("") may have one.
#include <stdlib.h>
#include <unistd.h>

#include <clocale>
#include <cstring>
#include <filesystem>
#include <locale>
#include <string>

namespace clathra {

/// Set while it lives. Few machines have such a locale ready; Debian's package `locales` has the sources to make one.
class CommaLocale {
 public:
  CommaLocale() {
    for (char const* const name : {"de_DE.UTF-8", "fr_FR.UTF-8", "nl_NL.UTF-8"})
      if (set(name)) return;
    std::string const make = "localedef -i de_DE -f UTF-8 '" + (folder_ / "de_DE.UTF-8").string() + "'";
    std::filesystem::create_directories(folder_);
    if (std::system(make.c_str()) != 0) return;
    ::setenv("LOCPATH", folder_.c_str(), 1);
    (void)set("de_DE.UTF-8");
  }
  CommaLocale(CommaLocale const&) = delete;
  ~CommaLocale() {
    std::setlocale(LC_ALL, "C");
    std::locale::global(before_);
    ::unsetenv("LOCPATH");
    std::filesystem::remove_all(folder_);
  }
  /// True where C itself now writes a comma.
  bool works() const { return std::strcmp(std::localeconv()->decimal_point, ",") == 0; }

 private:
  static bool set(char const* name) {
    if (!std::setlocale(LC_ALL, name)) return false;
    std::locale::global(std::locale(name));
    return true;
  }

  std::locale before_;
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("clathra_locale_" + std::to_string(::getpid()));
};

}  // namespace clathra
