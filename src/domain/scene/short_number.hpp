#pragma once
/// Numbers in messages.
#include <cstdio>
#include <string>

namespace clathra {

/// A number to so many significant digits, without zeros behind.
inline std::string short_number(double value, int digits = 3) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace clathra
