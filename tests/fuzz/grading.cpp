/// Any text is a grading curve or is refused with a reason; a curve has sizes in order, d50 among them.
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "domain/scene/grading_file.hpp"
#include "require.hpp"

using namespace clathra;

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string_view const text(reinterpret_cast<char const*>(data), size);
  try {
    Grading const curve = parse_grading(text, "fuzz.csv");
    require(curve.smallest() > 0 && curve.smallest() <= curve.d50() && curve.d50() <= curve.largest());
    auto const sizes = curve.diameters(4);
    for (std::size_t k = 1; k < sizes.size(); ++k) require(sizes[k - 1] <= sizes[k]);
    require(sizes.front() >= curve.smallest() * (1 - 1e-9) && sizes.back() <= curve.largest() * (1 + 1e-9));
  } catch (std::invalid_argument const& error) {
    require(std::string_view(error.what()).starts_with("fuzz.csv"));
  }
  return 0;
}
