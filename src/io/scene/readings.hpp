#pragma once
/// Named readings of what the seed paper leaves open. A reading is a set of scene keys: it stands in for the defaults of those
/// that a scene does not state itself.
#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "domain/scene/scene.hpp"

namespace clathra {

/// A key and the value that the reading gives it, as a scene states it.
struct ReadingKey {
  std::string_view key, value;
};

struct Reading {
  std::string_view name;  ///< of the key bond.reading
  std::string_view what;  ///< a sentence without full stop
  std::array<ReadingKey, 9> keys;
};

/// All readings, the default one first: what it says are the defaults of Scene{}. All of them say the same keys.
std::span<Reading const> readings();

/// Their names, in the same order: what bond.reading may be.
std::span<std::string_view const> reading_names();

/// The reading of a name of reading_names().
Reading const& reading_of(std::string_view name);

/// Sets the keys of a reading but for those that are `stated` otherwise.
void apply_reading(Reading const& reading, Scene& scene, std::function<bool(std::string_view)> const& stated);

/// What they are, and a table with a column a reading.
std::string readings_markdown();

}  // namespace clathra
