#pragma once
/// Figures from one description: in the page as HTML, and each as a file of its own with the numbers behind it.
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace clathra {

/// What is drawn, as SVG between (0, 0) and (width, height).
struct Drawing {
  double width = 0, height = 0;
  std::string svg;
};

/// The numbers behind a drawing as CSV, made only where they are wanted.
struct DrawnData {
  std::string head;  ///< "series,eps1,q_Pa"
  std::function<std::string()> rows;
};

/// Columns of equally many numbers under one name.
struct DataColumns {
  std::string name;
  std::vector<std::vector<double>> columns;
};
/// A row for each place of the columns, the name first.
std::string data_rows(std::vector<DataColumns> const& series);

/// A figure as it becomes a file.
struct Figure {
  std::string heading, caption;
  Drawing box;
  std::vector<DrawnData> data;  ///< all with the same head
};

/// A part of a page: its HTML, and what of it becomes files.
struct Piece {
  std::string html;
  std::vector<Drawing> boxes;   ///< of a figure that is being put together, from the left or from above
  std::vector<DrawnData> data;  ///< of that figure
  std::vector<Figure> figures;  ///< that are complete

  Piece() = default;
  Piece(std::string text) : html(std::move(text)) {}
  Piece(char const* text) : html(text) {}
  bool empty() const { return html.empty(); }
  Piece& operator+=(Piece other);
  friend Piece operator+(Piece a, Piece b) { return std::move(a += std::move(b)); }
};

/// The style of what is drawn, in the page and in files.
extern std::string_view const drawing_style;

/// An inline SVG. @param classes  of the element
Piece drawing(Drawing box, std::string const& classes, std::string const& title, std::string const& description, DrawnData data);

/// Boxes beside each other, below each other, and in lines that are full at a width.
Drawing row_of(std::vector<Drawing> const& boxes);
Drawing column_of(std::vector<Drawing> const& boxes);
Drawing lines_of(std::vector<Drawing> const& boxes, double width);

/// A line of text that is not yet escaped. @param at  "start", "middle" or "end" of the box  @param width  0 = as the text needs
Drawing text_box(std::string const& text, char const* at = "start", double width = 0);

/// The figure as an SVG that needs nothing but itself.
std::string svg_file(Figure const& figure);
/// Its numbers. Empty where there are none.
std::string csv_file(Figure const& figure);

/// Makes a folder for figures, or makes sure that it is one. @throws FileProblem; cannot_create where it holds anything else
void claim_figures(std::filesystem::path const& folder);

/// Writes the figures into a folder of their own as 01-name.svg and 01-name.csv, in place of those of an earlier call.
/// @return the SVGs  @throws FileProblem, as claim_figures()
std::vector<std::filesystem::path> write_figures(std::vector<Figure> const& figures, std::filesystem::path const& folder);

}  // namespace clathra
