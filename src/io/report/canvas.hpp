#pragma once
/// A picture of discs and lines, drawn with smooth edges.
#include <cstdint>
#include <vector>

namespace clathra {

struct Rgb {
  std::uint8_t red = 0, green = 0, blue = 0;
  friend bool operator==(Rgb const&, Rgb const&) = default;
};

/// A white picture. Coordinates are in pixels from the left upper corner, x to the right and y down; the centre of the first
/// pixel is (0.5, 0.5). What is thinner than a pixel is drawn one pixel wide and paler in proportion, so that a million discs
/// give the right mean tone. Parts outside the picture are not drawn.
class Canvas {
 public:
  Canvas(int width, int height);

  void disc(double x, double y, double radius, Rgb colour);
  void line(double x0, double y0, double x1, double y1, double width, Rgb colour);  ///< with round ends

  int width() const { return width_; }
  int height() const { return height_; }
  Rgb pixel(int x, int y) const { return pixels_[index(x, y)]; }
  std::vector<Rgb> const& pixels() const { return pixels_; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  void blend(int x, int y, double cover, Rgb colour);

  int width_, height_;
  std::vector<Rgb> pixels_;
};

}  // namespace clathra
