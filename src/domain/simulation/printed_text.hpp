#pragma once
/// Messages with numbers in them.
#include <cstdio>
#include <string>

namespace clathra {

/// A text with up to four numbers put in.
template <class... Numbers>
std::string printed_text(char const* format, Numbers... numbers) {
  char text[320];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

}  // namespace clathra
