#pragma once
/// One value of a scene: from text, number or truth value into its field, range-checked, and back into text.
#include <string>
#include <string_view>

#include "io/scene/schema.hpp"

namespace clathra {

/// Sets a key from text, as after `--set key=` or inside quotes in a scene file: "1 MPa", "20000", "true", "tiled".
/// @throws std::invalid_argument with a text that follows the key's name: "needs a pressure, got a length ('1 mm'); ..."
void set_from_text(Key const& key, Scene& scene, std::string_view text);

/// Whether a quantity has no unit.
bool is_bare(std::string_view text);

/// "; this looks like percent: write 0.41 or "41 %"" of a bare number that a share cannot be; nothing where it is no such.
std::string percent_hint(double value);

/// A number from 0 to 1, "0.02" or "2 %". @throws std::invalid_argument as above
double parse_share(std::string_view text);

/// Sets a key from a bare number, which is in SI units. @throws std::invalid_argument as above
void set_from_number(Key const& key, Scene& scene, double value);
void set_from_integer(Key const& key, Scene& scene, std::int64_t value);
void set_from_boolean(Key const& key, Scene& scene, bool value);

/// What a user states beside a file: as set_from_text(), but an empty text takes the key back to its default, and 0 is no value
/// where it would mean that.
void set_stated(Key const& key, Scene& scene, std::string_view text);
bool takes_back(Key const& key, std::string_view text);

/// True where the field is 0 or has no text.
bool is_zero(Key const& key, Scene const& scene);

/// True where a scene was not given the key; 0 stands for that. What a scene file may not state, see zero_problem().
bool is_not_given(Key const& key, Scene const& scene);
std::string zero_problem(Key const& key);

/// The value as a scene file states it, with quotes and unit; reads back to the same bits.
std::string value_text(Key const& key, Scene const& scene);

/// The text between the quotes of a value_text(), or all of it where it has none.
std::string unquoted(std::string_view text);

}  // namespace clathra
