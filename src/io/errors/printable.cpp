#include "io/errors/printable.hpp"

#include <fmt/format.h>

#include <iterator>

namespace clathra {
namespace {

/// The number of a character from its UTF-8 sequence.
unsigned code_point(std::string_view sequence) {
  auto const lead = static_cast<unsigned char>(sequence.front());
  unsigned point = sequence.size() == 1 ? lead : lead & (0xffu >> (sequence.size() + 1));
  for (char const c : sequence.substr(1)) point = point << 6 | (static_cast<unsigned char>(c) & 0x3fu);
  return point;
}

/// Control characters, line and paragraph separators, and what turns the direction of the text around it.
bool commands_a_terminal(unsigned point) {
  return point < 0x20 || (point >= 0x7f && point < 0xa0) || point == 0x200e || point == 0x200f ||
         (point >= 0x2028 && point <= 0x202e) || (point >= 0x2066 && point <= 0x2069);
}

}  // namespace

std::size_t sequence_length(std::string_view text) {
  auto const lead = static_cast<unsigned char>(text.front());
  std::size_t const length = lead < 0x80                   ? 1
                             : lead >= 0xc2 && lead < 0xe0 ? 2
                             : lead >= 0xe0 && lead < 0xf0 ? 3
                             : lead >= 0xf0 && lead < 0xf5 ? 4
                                                           : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return 0;
  return length;
}

std::string printable(std::string_view text, std::string_view kept) {
  std::string safe;
  while (!text.empty()) {
    std::size_t const length = sequence_length(text);
    std::string_view const piece = text.substr(0, length == 0 ? 1 : length);
    bool const stays = kept.find(piece.front()) != kept.npos;
    if (length > 0 && (stays || !commands_a_terminal(code_point(piece))))
      safe += piece;
    else
      for (char const c : piece) fmt::format_to(std::back_inserter(safe), "\\x{:02x}", static_cast<unsigned char>(c));
    text.remove_prefix(piece.size());
  }
  return safe;
}

}  // namespace clathra
