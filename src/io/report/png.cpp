#include "io/report/png.hpp"

#include <png.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <unordered_map>
#include <vector>

namespace clathra {
namespace {

constexpr std::size_t most_colours = 256;

std::uint32_t key(Rgb c) { return std::uint32_t{c.red} << 16 | std::uint32_t{c.green} << 8 | c.blue; }

/// Colours that look alike: 5 bits a channel.
std::uint32_t bucket(Rgb c) { return (std::uint32_t{c.red} >> 3) << 10 | (std::uint32_t{c.green} >> 3) << 5 | c.blue >> 3; }

struct Counted {
  Rgb colour;
  std::size_t count = 0;
};

/// Most frequent first; equally frequent ones by value, so that a picture always gives the same bytes.
bool before(Counted const& a, Counted const& b) { return a.count != b.count ? a.count > b.count : key(a.colour) < key(b.colour); }

std::vector<Counted> counted_colours(Canvas const& canvas) {
  std::unordered_map<std::uint32_t, Counted> counts;
  Counted* entry = nullptr;  // neighbouring pixels are often alike
  for (Rgb const c : canvas.pixels()) {
    if (entry == nullptr || key(entry->colour) != key(c)) entry = &counts[key(c)];
    entry->colour = c;
    ++entry->count;
  }
  std::vector<Counted> sorted;
  for (auto const& [value, counted] : counts) sorted.push_back(counted);
  std::sort(sorted.begin(), sorted.end(), before);
  return sorted;
}

/// Of each group of colours that look alike only the most frequent one, with the count of the group. The flat colours of a
/// picture are the most frequent ones, so they stay what they are.
std::vector<Counted> merged(std::vector<Counted> const& colours) {
  std::unordered_map<std::uint32_t, std::size_t> place;
  std::vector<Counted> groups;
  for (Counted const& c : colours) {
    auto const [at, is_new] = place.try_emplace(bucket(c.colour), groups.size());
    if (is_new) groups.push_back({c.colour, 0});
    groups[at->second].count += c.count;
  }
  std::sort(groups.begin(), groups.end(), before);
  return groups;
}

int distance2(Rgb a, Rgb b) {
  int const red = a.red - b.red, green = a.green - b.green, blue = a.blue - b.blue;
  return red * red + green * green + blue * blue;
}

std::size_t nearest(std::vector<Counted> const& palette, Rgb colour) {
  std::size_t best = 0;
  int least = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < palette.size() && least > 0; ++i)
    if (int const d = distance2(palette[i].colour, colour); d < least) least = d, best = i;
  return best;
}

}  // namespace

std::string png_bytes(Canvas const& canvas) {
  std::vector<Counted> const colours = counted_colours(canvas);
  std::vector<Counted> palette = colours.size() > most_colours ? merged(colours) : colours;
  palette.resize(std::min(palette.size(), most_colours));
  std::unordered_map<std::uint32_t, std::uint8_t> place;
  for (Counted const& c : colours) place[key(c.colour)] = static_cast<std::uint8_t>(nearest(palette, c.colour));
  std::vector<std::uint8_t> pixels, map;
  pixels.reserve(canvas.pixels().size());
  Rgb last = canvas.pixels().front();
  std::uint8_t at = place[key(last)];
  for (Rgb const c : canvas.pixels()) {
    if (key(c) != key(last)) last = c, at = place[key(c)];
    pixels.push_back(at);
  }
  for (Counted const& c : palette) map.insert(map.end(), {c.colour.red, c.colour.green, c.colour.blue});

  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(canvas.width());
  image.height = static_cast<png_uint_32>(canvas.height());
  image.format = PNG_FORMAT_RGB_COLORMAP;
  image.colormap_entries = static_cast<png_uint_32>(palette.size());
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = bytes.size();
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, map.data()))
    throw std::runtime_error(std::string("a picture cannot be made: ") + image.message);
  bytes.resize(size);
  return bytes;
}

std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : std::uint8_t{0});
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace clathra
