#pragma once
/// Pictures as PNG, and as text that can stand in a page.
#include <string>
#include <string_view>

#include "io/report/canvas.hpp"

namespace clathra {

/// A PNG with at most 256 colours: all of a picture that has no more, else the most frequent ones, each pixel with the nearest.
/// @throws std::runtime_error where libpng cannot (no memory)
std::string png_bytes(Canvas const& canvas);

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace clathra
