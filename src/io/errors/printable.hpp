#pragma once
/// Text of others on a terminal, which obeys control characters.
#include <string>
#include <string_view>

namespace clathra {

/// Length of the UTF-8 sequence at the beginning of a text that is not empty, 0 where there is none.
std::size_t sequence_length(std::string_view text);

/// Text with its control characters (those above ASCII and the direction marks of Unicode among them) and the bytes that are no
/// UTF-8 written as "\x1b"; done twice it changes nothing more.
/// @param kept  control characters that stay
std::string printable(std::string_view text, std::string_view kept = "");

}  // namespace clathra
