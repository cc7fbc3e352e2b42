#pragma once
/// The pieces of the page: text, legends, figures, tables, and the page itself.
#include <string>
#include <string_view>
#include <vector>

#include "io/report/canvas.hpp"
#include "io/report/colours.hpp"
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
std::string line_entry(Stroke const& stroke, std::string const& name);
std::string patch_entry(Rgb colour, std::string const& name);
std::string legend(std::string const& entries);
std::string legend(std::vector<Curve> const& curves);

/// A bar of the ramp's colours with the numbers at its ends.
std::string colour_bar(std::string const& title, std::string const& low, std::string const& high);

/// A picture as <img> with its bytes in the page.
std::string picture(std::string const& png, Canvas const& canvas, std::string const& alt);

/// A figure with a heading and a caption. @param wide  over the whole width of the page
std::string figure(std::string const& heading, std::string const& drawing, std::string const& caption, bool wide = false);

/// A table of words and numbers, escaped; its columns begin at the left.
std::string table(std::vector<std::string> const& head, std::vector<std::vector<std::string>> const& rows);

/// Figures or pictures beside each other where there is room.
std::string side_by_side(std::string const& contents);

/// Stands in the head of each page.
inline constexpr std::string_view page_mark = "<meta name=\"generator\" content=\"clathra\">";

/// The whole page with its style.
std::string page(std::string const& title, std::string const& body);

}  // namespace clathra
