/// Any text is a quantity or is refused; a quantity reads back from its text to the same bits. The first byte is the dimension.
#include "domain/scene/units.hpp"

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

using namespace clathra;

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  if (size == 0) return 0;
  auto const dimension = static_cast<Dimension>(data[0] % (static_cast<int>(Dimension::line_force) + 1));
  std::string_view const text(reinterpret_cast<char const*>(data) + 1, size - 1);
  try {
    double const value = parse_quantity(text, dimension);
    double const again = parse_quantity(format_quantity(value, dimension), dimension);
    if (std::bit_cast<std::uint64_t>(value + 0.0) != std::bit_cast<std::uint64_t>(again + 0.0)) std::abort();
  } catch (std::invalid_argument const&) {
  }
  return 0;
}
