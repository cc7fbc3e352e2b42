#include "io/report/markup.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "io/errors/printable.hpp"
#include "io/report/png.hpp"

namespace clathra {
namespace {

constexpr char style[] = R"css(
:root{--ink:#1d2429;--soft:#5a666e;--rule:#d5dbdf;--panel:#f6f8f9}
*{box-sizing:border-box}
body{margin:0 auto;padding:1.2rem clamp(.7rem,3vw,2.2rem) 3rem;max-width:1240px;color:var(--ink);background:#fff;
font:16px/1.5 system-ui,"Segoe UI","Noto Sans","DejaVu Sans",Helvetica,Arial,sans-serif;overflow-wrap:break-word}
h1{font-size:clamp(1.35rem,4.5vw,1.9rem);line-height:1.2;margin:.2rem 0 .6rem}
h2{font-size:1.25rem;margin:2.2rem 0 .7rem;border-bottom:1px solid var(--rule);padding-bottom:.25rem}
h3{font-size:1rem;margin:0 0 .5rem}
.lead{font-size:1.08rem;max-width:62em;margin:.3rem 0 1rem}
.soft,footer{color:var(--soft);font-size:.9rem}
.scroll{overflow-x:auto;width:fit-content;max-width:100%;border:1px solid var(--rule);border-radius:6px}
table{border-collapse:collapse;font-size:.92rem}
th,td{padding:.32rem .7rem;text-align:right;border-top:1px solid var(--rule);vertical-align:top}
thead th{border-top:0;background:var(--panel);white-space:nowrap}
tbody th,thead th:first-child{text-align:left;font-weight:500;position:sticky;left:0;background:var(--panel);min-width:9.5em}
thead th{font-weight:650}
td{font-variant-numeric:tabular-nums}
.unit{color:var(--soft);font-weight:400;white-space:nowrap}
.warn{background:#fff6e0;border-left:4px solid #e69f00;padding:.5rem .9rem;border-radius:4px}
.warn ul{margin:.2rem 0;padding-left:1.2rem}
.beside{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,430px),1fr));gap:1.1rem;align-items:start}
figure{margin:0;padding:.85rem .9rem;border:1px solid var(--rule);border-radius:6px;min-width:0;break-inside:avoid}
figure.wide{grid-column:1/-1}
figcaption{font-size:.9rem;line-height:1.45;color:#39434a;margin-top:.5rem;max-width:75em}
.plot{display:block;width:100%;height:auto;max-width:680px;margin:0 auto}
.legend{display:flex;flex-wrap:wrap;gap:.15rem 1.1rem;list-style:none;margin:.5rem 0 0;padding:0;font-size:.9rem}
.legend li{display:flex;align-items:center;gap:.45rem}
.legend svg{flex:none}
.bar{max-width:26em;margin:.6rem 0 0;font-size:.9rem}
.bar i{display:block;height:.8rem;border-radius:2px}
.bar span{display:flex;justify-content:space-between}
.multiples{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,270px),1fr));gap:.8rem}
.multiples .plot{font-size:24px;overflow:visible}.multiples .title{display:none}.multiples+h3{margin-top:1.1rem}.multiples figure{padding:.5rem .5rem .2rem}.multiples h3{margin:0 0 .2rem}
.words td,.words th{text-align:left}.sure td>span{white-space:nowrap}.sure thead th{white-space:normal}
.sure tbody th{max-width:15em;overflow-wrap:anywhere}.sure td .unit{display:block;white-space:normal}.scroll+.beside{margin-top:1.1rem}
.strip{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,210px),1fr));gap:.9rem}
.strip>div{min-width:0}
.stack{display:grid;gap:.9rem;align-content:start}
.strip p{margin:.3rem 0 0;font-size:.9rem;text-align:center}
.strip img,.strip .rose{display:block;width:100%;height:auto;max-height:88vh;object-fit:contain}
.strip .stack img{max-height:42vh}.strip .rose{max-height:26rem}
@media(max-width:520px){.strip{grid-template-columns:repeat(auto-fit,minmax(150px,1fr))}figure{padding:.6rem .55rem}
th,td{padding:.3rem .45rem}.plot{font-size:16.5px}.rose{font-size:22px}
thead th,td{white-space:normal;overflow-wrap:anywhere}
.several{width:auto}.several :is(table,tbody,tr,th){display:block}.several thead{display:none}
.several tbody th{position:static;font-weight:650}.several td{display:flex;justify-content:space-between;gap:1rem;border-top:0}
.several td::before{content:attr(data-run);flex:0 1 auto;min-width:30%;text-align:left;color:var(--soft)}}
@media print{body{max-width:none}.beside{grid-template-columns:1fr 1fr}}
)css";

std::string row(std::string const& tag, std::vector<std::string> const& cells) {
  std::string text = "<tr>";
  for (std::string const& cell : cells) text += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
  return text + "</tr>\n";
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string safe;
  while (!text.empty()) {
    std::size_t const length = sequence_length(text);
    char const c = text.front();
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else if (length == 0 || (length == 1 && static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t'))
      safe += '?';
    else
      safe += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return safe;
}

std::string grouped(double whole_number) {
  if (!std::isfinite(whole_number)) return "–";
  std::string digits = fmt::format("{:.0f}", whole_number);
  std::size_t const first = digits.front() == '-' ? 1 : 0;
  for (std::size_t at = digits.size(); at > first + 3;) digits.insert(at -= 3, 1, ',');
  return with_minus(digits);
}

std::string with_minus(std::string const& number) {
  if (!number.starts_with('-')) return number;
  bool const zero = number.find_first_not_of("-0.") == std::string::npos;
  return (zero ? "" : "−") + number.substr(1);
}

std::string dash_attribute(Stroke const& stroke) {
  return stroke.dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", stroke.dash);
}

namespace {

constexpr double file_width = 480;  // of legends and bars in files

/// An entry of a legend: a mark of this size and its name.
Piece entry(Drawing const& mark, std::string const& name) {
  Piece piece(fmt::format("<li><svg width=\"{0:g}\" height=\"{1:g}\" aria-hidden=\"true\">{2}</svg>{3}</li>", mark.width,
                          mark.height, mark.svg, escaped(name)));
  constexpr double middle = 10;
  Drawing const lowered{mark.width, 2 * middle,
                        fmt::format("<g transform=\"translate(0 {:g})\">{}</g>", middle - mark.height / 2, mark.svg)};
  piece.boxes.push_back(row_of({lowered, text_box(name)}));
  return piece;
}

/// The boxes of a piece become one, within other HTML.
Piece joined(Piece piece, Drawing (*join)(std::vector<Drawing> const&), std::string const& before, std::string const& after) {
  piece.html = before + piece.html + after;
  piece.boxes = {join(piece.boxes)};
  return piece;
}

}  // namespace

Piece line_entry(Stroke const& stroke, std::string const& name) {
  return entry({40, 10,
                fmt::format("<path d=\"M0 5h40\" stroke=\"{}\" stroke-width=\"{:g}\"{}/>", hex(stroke.colour), stroke.width + 0.5,
                            dash_attribute(stroke))},
               name);
}

Piece patch_entry(Rgb colour, std::string const& name) {
  return entry({14, 14, fmt::format("<rect width=\"14\" height=\"14\" rx=\"2\" fill=\"{}\"/>", hex(colour))}, name);
}

Piece legend(Piece entries) {
  if (entries.empty()) return entries;
  auto const lines = [](std::vector<Drawing> const& boxes) { return lines_of(boxes, file_width); };
  return joined(std::move(entries), lines, "<ul class=\"legend\">", "</ul>\n");
}

Piece legend(std::vector<Curve> const& curves) {
  Piece entries;
  std::set<std::string> named;
  for (Curve const& curve : curves)
    if (named.insert(curve.name).second) entries += line_entry(curve.stroke, curve.name);
  return legend(std::move(entries));
}

Piece colour_bar(std::string const& title, std::string const& low, std::string const& high) {
  Piece piece(fmt::format("<div class=\"bar\">{}<i style=\"background:{}\"></i><span><b>{}</b><b>{}</b></span></div>\n",
                          escaped(title), ramp_css(), escaped(low), escaped(high)));
  constexpr double height = 13;
  constexpr int steps = 120;
  std::string bar;
  for (int i = 0; i < steps; ++i)
    bar += fmt::format("<rect x=\"{:g}\" width=\"{:g}\" height=\"{:g}\" fill=\"{}\"/>", file_width / steps * i,
                       file_width / steps + 0.5, height, hex(ramp((i + 0.5) / steps)));
  Drawing ends = text_box(low, "start", file_width);
  ends.svg += text_box(high, "end", file_width).svg;
  piece.boxes.push_back(column_of({text_box(title), {file_width, height, bar}, ends}));
  return piece;
}

Piece picture(std::string const& png, Canvas const& canvas, std::string const& alt, DrawnData data) {
  std::string const source = "data:image/png;base64," + base64(png);
  Piece piece(fmt::format("<img width=\"{}\" height=\"{}\" alt=\"{}\" src=\"{}\">", canvas.width(), canvas.height(), escaped(alt),
                          source));
  constexpr double width = 240;
  double const height = width * canvas.height() / canvas.width();
  piece.boxes.push_back(
      {width, height, fmt::format("<image width=\"{:g}\" height=\"{:g}\" xlink:href=\"{}\"/>", width, height, source)});
  piece.data.push_back(std::move(data));
  return piece;
}

Piece titled(Piece picture, std::string const& text) {
  picture.boxes.push_back(text_box(text, "middle", picture.boxes.front().width));
  return joined(std::move(picture), column_of, "<div>", "<p>" + escaped(text) + "</p></div>\n");
}

Piece strip(Piece contents) { return joined(std::move(contents), row_of, "<div class=\"strip\">\n", "</div>\n"); }

Piece stack(Piece contents) { return joined(std::move(contents), column_of, "<div class=\"stack\">", "</div>"); }

Piece figure(std::string const& heading, Piece contents, std::string const& caption, bool wide) {
  Piece piece(fmt::format("<figure{}><h3>{}</h3>\n{}{}</figure>\n", wide ? " class=\"wide\"" : "", escaped(heading),
                          contents.html, caption.empty() ? "" : "<figcaption>" + escaped(caption) + "</figcaption>"));
  piece.figures.push_back({heading, caption, column_of(contents.boxes), std::move(contents.data)});
  return piece;
}

std::string table(std::vector<std::string> const& head, std::vector<std::vector<std::string>> const& rows) {
  std::string body;
  for (std::vector<std::string> const& cells : rows) body += row("td", cells);
  return "<div class=\"scroll words\"><table><thead>" + row("th", head) + "</thead><tbody>\n" + body + "</tbody></table></div>\n";
}

Piece side_by_side(Piece contents) { return "<div class=\"beside\">\n" + std::move(contents) + "</div>\n"; }

std::string page(std::string const& title, std::string const& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\">\n<meta name=\"color-scheme\" content=\"light\">{}<title>{}</title>\n"
      "<style>{}{}</style></head>\n<body>\n{}</body></html>\n",
      page_mark, escaped(title), drawing_style, style, body);
}

}  // namespace clathra
