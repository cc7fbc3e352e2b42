#pragma once
/// How many neighbours a disc can have, and how many discs and row entries a rank.
///
/// 32 bits for indices halve what the hot kernel reads of them; more than 2^31 entries on one rank would need 40 GB of rows and
/// more.
#include <cstdint>
#include <stdexcept>

namespace clathra {

/// The longest row. Around a disc there is room for pi / asin(1 / (n + 1)) of an n-th of its size: 66 of a twentieth, 94 of a
/// twenty-ninth.
inline constexpr int longest_row = 96;

/// A rank has more than it can number. Other ranks may not.
struct TooManyToNumber : std::length_error {
  using std::length_error::length_error;
};

/// Row entries and discs of a rank are numbered by 32 bits: at most 2^31 - 1 entries, and half a billion discs (up to four cells
/// each). @throws TooManyToNumber with the number
void require_countable(std::int64_t entries, std::int64_t discs);

}  // namespace clathra
