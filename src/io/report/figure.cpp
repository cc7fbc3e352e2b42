#include "io/report/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <regex>
#include <system_error>

#include "io/errors/problems.hpp"
#include "io/formats/csv_text.hpp"
#include "io/formats/text_file.hpp"
#include "io/report/markup.hpp"
#include "io/results/output_folder.hpp"

namespace clathra {

std::string_view const drawing_style = R"css(
.plot{font-family:system-ui,"Noto Sans","DejaVu Sans",sans-serif;font-size:13px}
.plot text{fill:#1d2429}
.plot .grid path{stroke:#e4e8ea;fill:none}
.plot .frame{fill:none;stroke:#7c878e}
.plot .curves{fill:none;stroke-linejoin:round;stroke-linecap:butt}
)css";

namespace {

constexpr double gap = 14, text_height = 20, mean_letter = 7.6;  // of the font above

void move_all(auto& from, auto& to) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

/// A picture in it may be large, so it is copied once.
void add_moved(std::string& svg, Drawing const& box, double x, double y) {
  svg += fmt::format("<g transform=\"translate({:g} {:g})\">", x, y);
  svg += box.svg;
  svg += "</g>\n";
}

/// "stress-and-strain": what may stand in any file's name.
std::string file_name(std::string const& heading) {
  constexpr std::size_t longest = 60;
  std::string name;
  for (char const c : heading) {
    bool const letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (letter)
      name += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  name.resize(std::min(name.size(), longest));
  while (name.ends_with('-')) name.pop_back();
  return name;
}

/// Removes the figures of an earlier call from a folder that is ours.
void remove_figures(std::filesystem::path const& folder) {
  static std::regex const numbered("[0-9]{2,}-.*[.](svg|pdf|csv)");
  std::error_code error;
  for (auto const& entry : std::filesystem::directory_iterator(folder, error))
    if (!error && std::regex_match(entry.path().filename().string(), numbered)) std::filesystem::remove(entry.path(), error);
  if (error) throw FileProblem(ExitCode::io_error, folder, "figures of an earlier call cannot be removed: " + error.message());
}

}  // namespace

Piece& Piece::operator+=(Piece other) {
  html += other.html;
  move_all(other.boxes, boxes);
  move_all(other.data, data);
  move_all(other.figures, figures);
  return *this;
}

std::string data_rows(std::vector<DataColumns> const& series) {
  std::string text;
  for (DataColumns const& one : series) {
    std::string const name = csv_cell(one.name);
    for (std::size_t i = 0; i < one.columns.front().size(); ++i) {
      text += name;
      for (std::vector<double> const& column : one.columns) fmt::format_to(std::back_inserter(text), ",{}", column[i]);
      text += '\n';
    }
  }
  return text;
}

Piece drawing(Drawing box, std::string const& classes, std::string const& title, std::string const& description, DrawnData data) {
  Piece piece(
      fmt::format("<svg class=\"{}\" viewBox=\"0 0 {:g} {:.0f}\" role=\"img\"><title>{}</title><desc>{}</desc>\n{}</svg>\n",
                  classes, box.width, box.height, escaped(title), escaped(description), box.svg));
  piece.boxes.push_back(std::move(box));
  piece.data.push_back(std::move(data));
  return piece;
}

Drawing row_of(std::vector<Drawing> const& boxes) {
  Drawing row;
  for (Drawing const& box : boxes) {
    if (row.width > 0) row.width += gap;
    add_moved(row.svg, box, row.width, 0);
    row.width += box.width;
    row.height = std::max(row.height, box.height);
  }
  return row;
}

Drawing column_of(std::vector<Drawing> const& boxes) {
  Drawing column;
  for (Drawing const& box : boxes) {
    if (column.height > 0) column.height += gap / 2;
    add_moved(column.svg, box, 0, column.height);
    column.height += box.height;
    column.width = std::max(column.width, box.width);
  }
  return column;
}

Drawing lines_of(std::vector<Drawing> const& boxes, double width) {
  std::vector<Drawing> lines, line;
  double taken = 0;
  for (Drawing const& box : boxes) {
    if (!line.empty() && taken + gap + box.width > width) {
      lines.push_back(row_of(line));
      line.clear();
      taken = 0;
    }
    taken += box.width + (line.empty() ? 0 : gap);
    line.push_back(box);
  }
  if (!line.empty()) lines.push_back(row_of(line));
  return column_of(lines);
}

Drawing text_box(std::string const& text, char const* at, double width) {
  auto const letters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; });
  if (width == 0) width = mean_letter * static_cast<double>(letters);
  double const x = at == std::string("start") ? 0 : at == std::string("end") ? width : width / 2;
  return {width, text_height, fmt::format("<text x=\"{:g}\" y=\"15\" text-anchor=\"{}\">{}</text>", x, at, escaped(text))};
}

std::string svg_file(Figure const& figure) {
  double const width = figure.box.width + 2 * gap, height = figure.box.height + 2 * gap;
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\" class=\"plot\">\n<title>{2}</title>\n<desc>{3}</desc>\n<style>{4}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      width, height, escaped(figure.heading), escaped(figure.caption), drawing_style);
  add_moved(text, figure.box, gap, gap);
  return text + "</svg>\n";
}

std::string csv_file(Figure const& figure) {
  if (figure.data.empty()) return "";
  std::string text = figure.data.front().head + "\n";
  for (DrawnData const& part : figure.data) text += part.rows();
  return text;
}

void claim_figures(std::filesystem::path const& folder) { claim_folder(folder, "report --figures"); }

std::vector<std::filesystem::path> write_figures(std::vector<Figure> const& figures, std::filesystem::path const& folder) {
  claim_figures(folder);
  remove_figures(folder);
  std::vector<std::filesystem::path> written;
  for (Figure const& figure : figures) {
    std::string const name = fmt::format("{:02}-{}", written.size() + 1, file_name(figure.heading));
    replace_text_file(folder / (name + ".csv"), csv_file(figure));
    written.push_back(folder / (name + ".svg"));
    replace_text_file(written.back(), svg_file(figure));
  }
  return written;
}

}  // namespace clathra
