#pragma once
/// UTF-8, character by character.
#include <cstddef>
#include <string_view>

namespace clathra {

/// How many bytes the UTF-8 character at `at` has; 0 where there is none: stray, cut or overlong bytes, half a pair of UTF-16.
inline std::size_t utf8_length(std::string_view line, std::size_t at) {
  auto const byte = [&](std::size_t k) { return at + k < line.size() ? static_cast<unsigned char>(line[at + k]) : 0u; };
  unsigned const first = byte(0), second = byte(1);
  std::size_t const length = first < 0x80 ? 1 : first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xc0u) != 0x80u) return 0;
  bool const overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90),
             outside = (first == 0xed && second > 0x9f) || (first == 0xf4 && second > 0x8f);
  return overlong || outside ? 0 : length;
}

}  // namespace clathra
