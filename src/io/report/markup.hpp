#pragma once
/// The pieces of the page: text, legends, figures, tables, and the page itself.
#include <string>
#include <string_view>
#include <vector>

#include "io/report/canvas.hpp"
#include "io/report/colours.hpp"
#include "io/report/figure.hpp"
#include "io/report/plot.hpp"

namespace clathra {

/// Text with &, <, > and quotes made harmless; bytes that are no printable ASCII and no part of UTF-8 become "?".
std::string escaped(std::string_view text);

/// "1,234,567"; a number that is not finite is a dash.
std::string grouped(double whole_number);

/// A number formatted by fmt with a true minus sign; zero has none.
std::string with_minus(std::string const& number);

/// ` stroke-dasharray="..."`, or nothing for a solid line.
std::string dash_attribute(Stroke const& stroke);

/// Entries of a legend: a piece of the line, or a patch of the colour, with its name.
Piece line_entry(Stroke const& stroke, std::string const& name);
Piece patch_entry(Rgb colour, std::string const& name);
Piece legend(Piece entries);
Piece legend(std::vector<Curve> const& curves);

/// A bar of the ramp's colours with the numbers at its ends.
Piece colour_bar(std::string const& title, std::string const& low, std::string const& high);

/// A picture as <img> with its bytes in the page.
Piece picture(std::string const& png, Canvas const& canvas, std::string const& alt, DrawnData data);

/// A picture with a line below it; pictures in a row, and below each other in such a row.
Piece titled(Piece picture, std::string const& text);
Piece strip(Piece contents);
Piece stack(Piece contents);

/// A figure with a heading and a caption. @param wide  over the whole width of the page
Piece figure(std::string const& heading, Piece contents, std::string const& caption, bool wide = false);

/// A table of words and numbers, escaped; its columns begin at the left.
std::string table(std::vector<std::string> const& head, std::vector<std::vector<std::string>> const& rows);

/// Figures or pictures beside each other where there is room.
Piece side_by_side(Piece contents);

/// Stands in the head of each page.
inline constexpr std::string_view page_mark = "<meta name=\"generator\" content=\"clathra\">";

/// The whole page with its style.
std::string page(std::string const& title, std::string const& body);

}  // namespace clathra
