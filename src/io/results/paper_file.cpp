#include "io/results/paper_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "io/formats/text_file.hpp"
#include "io/scene/guarded_toml.hpp"
#include "io/scene/scene_guard.hpp"
#include "io/scene/scene_value.hpp"
#include "io/scene/toml_section.hpp"

namespace clathra {
namespace {

class PaperReader {
 public:
  explicit PaperReader(std::filesystem::path const& path) : reader_(path) { paper_.file = path; }

  Paper read(std::string const& text) {
    std::vector<Problem>& problems = reader_.problems;
    if (auto const root = parse_guarded(text, reader_.file(), problems)) read_root({1, 1, *root});
    std::stable_sort(problems.begin(), problems.end(), [](Problem const& a, Problem const& b) { return a.line < b.line; });
    if (!problems.empty()) throw SceneProblems(std::move(problems));
    return std::move(paper_);
  }

 private:
  void read_root(TomlNode const& node) {
    TomlSection root(reader_, node, "a paper");
    paper_.title = root.text("title", true);
    paper_.citation = root.text("citation");
    paper_.size = size_of(root);
    if (TomlNode const* const quick = root.find("quick")) {
      TomlSection section(reader_, *quick, "'quick'");
      paper_.quick = size_of(section);
    }
    read_strains(root);
    if (TomlNode const* const scene = root.find("scene"))
      reader_.for_each_key(*scene, "scene", [&](std::string const& name, TomlNode const& value) {
        Key const* const key = reader_.known(name, value);
        if (auto text = key ? reader_.value_of(*key, value) : std::nullopt) paper_.shared.emplace_back(name, std::move(*text));
      });
    if (TomlNode const* const groups = root.find("groups"))
      paper_.groups = reader_.read_groups(*groups, [&](std::string const& key, TomlNode const& value, StudyGroup const& group) {
        auto const* const label = value.as<std::string>();
        if (key == "label" && label) paper_.labels[group.name] = *label;
        return key == "label" && label;
      });
    if (paper_.groups.empty() && reader_.problems.empty()) root.report("", "a paper needs its tests: [groups.NAME]");
    for (StudyGroup const& group : paper_.groups) paper_.labels.emplace(group.name, group.name);
    read_series(root);
    paper_.screening = root.texts("screening");
    for (std::string const& name : paper_.screening) check_group(root, "screening", name);
    read_images(root);
    for (TomlNode const& claim : root.items("claims")) read_claim(claim);
    for (TomlNode const& section : root.items("sections")) read_section(section);
  }

  static PaperSize size_of(TomlSection& section) {
    PaperSize size{static_cast<std::int64_t>(section.number("particles").value_or(0)),
                   static_cast<int>(section.number("seeds").value_or(0))};
    if (size.particles < 100 || size.seeds < 1 || size.seeds > 10000)
      section.report("particles", "'particles' (100 or more) and 'seeds' (1 to 10000) say how large the reproduction is");
    return size;
  }

  void read_strains(TomlSection& root) {
    for (std::string const& text : root.texts("strains")) {
      try {
        paper_.strains.push_back(parse_quantity(text, Dimension::ratio));
      } catch (std::invalid_argument const& problem) {
        root.report("strains", std::string("'strains' ") + problem.what());
      }
    }
    if (!std::is_sorted(paper_.strains.begin(), paper_.strains.end())) root.report("strains", "'strains' must ascend");
  }

  void read_series(TomlSection& root) {
    TomlNode const* const all = root.find("series");
    auto const* const table = all ? all->as<TomlTable>() : nullptr;
    if (all && !table) return reader_.report(*all, "'series' holds sections: write [series.NAME]");
    for (TomlEntry const& entry : table ? SettingsReader::in_order(*table) : std::vector<TomlEntry>()) {
      TomlSection section(reader_, entry.node, "a series");
      PaperSeries series{section.text("label"), section.text("unit"), section.texts("groups"), {}, section.texts("names")};
      for (std::string const& name : series.groups) check_group(section, "groups", name);
      TomlNode const* const at = section.find("at");
      if (at && at->as<std::string>())
        series.by_critical_thickness = section.choice("at", {"critical_thickness"}).has_value();
      else
        for (TomlNode const& place : section.items("at"))
          series.at.push_back(place.as<std::int64_t>() ? static_cast<double>(*place.as<std::int64_t>())
                              : place.as<double>()     ? *place.as<double>()
                                                       : NAN);
      bool const ascends =
          std::adjacent_find(series.at.begin(), series.at.end(), [](double a, double b) { return !(a < b); }) == series.at.end();
      if (!ascends) section.report("at", "'at' of a series needs numbers that ascend, or \"critical_thickness\"");
      for (auto const& [key, count] : {std::pair("at", series.at.size()), std::pair("names", series.names.size())})
        if (count != 0 && count != series.groups.size())
          section.report(key,
                         fmt::format("'{}' has {} items, not one for each of the {} groups", key, count, series.groups.size()));
      for (std::string const& name : series.groups)
        if (series.by_critical_thickness && !group_of(paper_, name))
          section.report("groups", fmt::format("'{}' is no group, and only groups have a critical thickness", name));
      series_[entry.name] = std::move(series);
    }
  }

  /// Reports a name that is neither a group nor a material.
  void check_group(TomlSection& section, std::string_view key, std::string const& name) {
    if (group_of(paper_, name) || is_material(paper_, name)) return;
    std::vector<std::string_view> names;
    for (StudyGroup const& group : paper_.groups) {
      names.push_back(group.name);
      if (std::find(names.begin(), names.end(), group.material) == names.end()) names.push_back(group.material);
    }
    section.report(key, fmt::format("there is no group or material '{}'{}; there are {}", name.substr(0, 60),
                                    name_suggestion(name, names), fmt::join(names, ", ")));
  }

  void read_images(TomlSection& root) {
    for (TomlNode const& node : root.items("images")) {
      TomlSection section(reader_, node, "an image");
      auto const saturation = section.quantity("saturation", Dimension::ratio),
                 thickness = section.quantity("thickness", Dimension::length), d50 = section.quantity("d50", Dimension::length);
      if (saturation && thickness && d50 && *saturation >= 0 && *saturation <= 1 && *thickness > 0 && *d50 > 0)
        paper_.images.push_back({*saturation, *thickness, *d50});
      else
        section.report("", "an image has a saturation of 0 to 100 %, a thickness and a d50 above 0");
    }
  }

  /// The series that a part or figure names, and the groups that it lists itself as one more.
  std::vector<PaperSeries> series_of(TomlSection& section) {
    std::vector<PaperSeries> all;
    for (std::string const& name : section.texts("series")) {
      auto const found = series_.find(name);
      std::vector<std::string_view> names;
      for (auto const& [one, series] : series_) names.push_back(one);
      if (found != series_.end())
        all.push_back(found->second);
      else
        section.report("series", fmt::format("there is no [series.{}]{}; there are {}", name.substr(0, 60),
                                             name_suggestion(name, names), fmt::join(names, ", ")));
    }
    PaperSeries own;
    own.groups = section.texts("groups");
    for (std::string const& name : own.groups) check_group(section, "groups", name);
    if (!own.groups.empty()) all.push_back(std::move(own));
    return all;
  }

  /// @param unit  that it is shown in; nothing where the section says it, or else it is the quantity's own
  WantedNumber number_of(TomlSection& section, std::optional<std::string> const& unit = {}) {
    std::vector<std::string_view> names;
    for (Quantity const& quantity : quantities()) names.push_back(quantity.name);
    WantedNumber number;
    auto const chosen = section.choice("quantity", names);
    auto const strain = section.quantity("strain", Dimension::ratio);
    std::string const stated = unit ? *unit : section.text("unit");
    if (!chosen) return number;
    Quantity const& quantity = quantities()[*chosen];
    number.unit = unit || section.has("unit") ? stated : std::string(quantity.unit);
    number.quantity = &quantity;
    if (quantity.at_strain) {
      auto const known =
          std::find_if(paper_.strains.begin(), paper_.strains.end(), [&](double at) { return strain && is_near(at, *strain); });
      if (known == paper_.strains.end())
        section.report("strain", fmt::format("'{}' needs a 'strain', one of the paper's 'strains'", quantity.name));
      else
        number.strain = *known;
    }
    if (!quantity.at_strain && strain) section.report("strain", fmt::format("'{}' is not one of a strain", quantity.name));
    if (auto const factor = factor_to(number.unit, quantity))
      number.factor = *factor;
    else
      section.report("unit", fmt::format("'{}' cannot be shown in '{}'; its 'unit' is one of {}", quantity.name, number.unit,
                                         units_of(quantity)));
    return number;
  }

  /// A number is that of tests or of materials, and one of snapshots needs some.
  void check_number(TomlSection& section, WantedNumber const& number, std::vector<PaperSeries> const& all) {
    if (!number.quantity) return;
    bool const of_material = number.quantity->of == QuantityOf::material;
    for (PaperSeries const& series : all)
      for (std::string const& name : series.groups) {
        StudyGroup const* const group = group_of(paper_, name);
        if (of_material ? !is_material(paper_, name) : !group) {
          section.report("", fmt::format("'{}' is a number of a {}, and '{}' is none", number.quantity->name,
                                         of_material ? "material" : "group", name));
        } else if (number.quantity->of == QuantityOf::snapshots && group) {
          std::vector<double> const at = stated_scene(paper_, *group).output.snapshots_at;
          double const wanted = number.quantity->at_strain ? number.strain : paper_.strains.empty() ? NAN : paper_.strains.back();
          if (std::none_of(at.begin(), at.end(), [&](double strain) { return is_near(strain, wanted); }))
            section.report(
                "", fmt::format("'{}' needs a snapshot of '{}' at {:g} %: state output.snapshots_at, and output.snapshots = 1",
                                number.quantity->name, name, 100 * wanted));
        }
      }
  }

  void read_claim(TomlNode const& node) {
    TomlSection section(reader_, node, "a claim");
    PaperClaim claim{section.text("id", true), section.text("words", true), section.text("where"), section.flag("ours"), {}};
    for (TomlNode const& part : section.items("parts")) claim.parts.push_back(part_of(part));
    if (claim.parts.empty()) section.report("parts", fmt::format("the claim '{}' has no 'parts'", claim.id));
    if (std::any_of(paper_.claims.begin(), paper_.claims.end(), [&](PaperClaim const& c) { return c.id == claim.id; }))
      section.report("id", fmt::format("there are two claims '{}'", claim.id));
    paper_.claims.push_back(std::move(claim));
  }

  PaperPart part_of(TomlNode const& node) {
    TomlSection section(reader_, node, "a part");
    PaperPart part;
    auto const kind = section.choice("kind", {part_kinds.begin(), part_kinds.end()});
    part.kind = static_cast<PartKind>(kind.value_or(0));
    part.what = section.text("what", true);
    auto const low = section.number("low"), high = section.number("high");
    part.low = low.value_or(-no_bound);
    part.high = high.value_or(no_bound);
    if (!low && !high) section.report("", "a part needs a bound: 'low', 'high' or both");
    if (part.low > part.high) section.report("low", fmt::format("'low' is above 'high': {:g}, {:g}", part.low, part.high));
    if (!kind) return part;
    static std::vector<std::string_view> const marks[] = {{"series", "group", "at"},
                                                          {"series", "from", "to"},
                                                          {"series", "from", "to"},
                                                          {"series"},
                                                          {"series"},
                                                          {"series"},
                                                          {"saturation"}};
    check_marks(section, "what", part.what, marks[*kind]);
    if (part.kind == PartKind::critical_thickness) return part;
    part.series = series_of(section);
    if (part.series.empty()) section.report("", "a part needs 'series' or 'groups'");
    part.number = number_of(section);
    check_number(section, part.number, part.series);
    if (part.kind != PartKind::bend && part.kind != PartKind::bow) read_less(section, part);
    if (part.kind == PartKind::value) read_only_where(section, part);
    if (part.kind == PartKind::slope) part.per = section.number("per").value_or(1);
    if (part.kind < PartKind::slope) return part;
    for (PaperSeries const& series : part.series)
      if (series.at.empty() && !series.by_critical_thickness)
        section.report("", fmt::format("'{}' needs a series with 'at'", part_kinds[*kind]));
    return part;
  }

  void read_less(TomlSection& section, PaperPart& part) {
    TomlNode const* const node = section.find("less");
    if (!node) return;
    TomlSection less(reader_, *node, "'less'");
    part.less = number_of(less, part.number.unit);
    part.divided_by = less.number("divided_by").value_or(1);
    if (part.divided_by == 0) less.report("divided_by", "'divided_by' must not be 0");
    check_number(less, part.less, part.series);
  }

  void read_only_where(TomlSection& section, PaperPart& part) {
    TomlNode const* const node = section.find("only_where");
    if (!node) return;
    TomlSection where(reader_, *node, "'only_where'");
    part.only_where = number_of(where);
    auto const below = where.number("below");
    if (!below) where.report("", "'only_where' needs 'below'");
    part.below = below.value_or(0);
    check_number(where, part.only_where, part.series);
  }

  void read_section(TomlNode const& node) {
    TomlSection section(reader_, node, "a section");
    PaperSection result{section.text("heading"), {}};
    for (TomlNode const& figure : section.items("figures")) result.figures.push_back(figure_of(figure));
    paper_.sections.push_back(std::move(result));
  }

  PaperFigure figure_of(TomlNode const& node) {
    TomlSection section(reader_, node, "a figure");
    PaperFigure figure;
    auto const kind = section.choice("kind", {figure_kinds.begin(), figure_kinds.end()});
    figure.kind = static_cast<FigureKind>(kind.value_or(0));
    if (figure.kind != FigureKind::mohr_circles) figure.title = section.text("title", true);
    if (figure.kind == FigureKind::table) {
      figure.rows.push_back(section.texts("head"));
      for (TomlNode const& row : section.items("rows")) figure.rows.push_back(texts_of(row, figure.rows[0].size()));
      return figure;
    }
    if (figure.kind == FigureKind::mohr_circles) return figure;
    figure.words = section.text("words");
    figure.ours = section.text("ours");
    static std::map<FigureKind, std::vector<std::string_view>> const marks = {
        {FigureKind::specimen, {"particles", "width", "height"}}, {FigureKind::shear_strain, {"window", "bands"}}};
    check_marks(section, "ours", figure.ours, marks.count(figure.kind) ? marks.at(figure.kind) : std::vector<std::string_view>());
    if (figure.kind == FigureKind::critical_thickness) return figure;
    if (figure.kind == FigureKind::envelopes) {
      figure.axis = section.text("axis", true);
      figure.number = number_of(section);
      return figure;
    }
    figure.series = series_of(section);
    if (figure.series.empty()) section.report("", "a figure needs 'series' or 'groups'");
    if (figure.kind == FigureKind::curves) {
      figure.column = section.choice("column", {std::begin(curve_columns), std::end(curve_columns)}).value_or(0);
      figure.only_complete = section.flag("only_complete");
    }
    if (figure.kind == FigureKind::bond_shear_strength || figure.kind == FigureKind::bond_rolling_strength)
      figure.axis = section.text("axis", true);
    return figure;
  }

  /// Reports a mark in a text that nothing stands for.
  void check_marks(TomlSection& section, std::string_view key, std::string const& text,
                   std::vector<std::string_view> const& known) {
    std::map<std::string, std::string> none;
    for (std::string_view const name : known) none.emplace(name, "");
    std::string const left = filled(text, none);
    if (std::size_t const open = left.find('{'); open != left.npos)
      section.report(key, fmt::format("'{}' has '{}'; what is filled in here: {{{}}}", key,
                                      left.substr(open, left.find('}', open) + 1 - open), fmt::join(known, "}, {")));
  }

  std::vector<std::string> texts_of(TomlNode const& row, std::size_t cells) {
    std::vector<std::string> texts;
    auto const* const list = row.as<TomlList>();
    for (TomlNode const& cell : list ? *list : TomlList())
      if (auto const* const text = cell.as<std::string>()) {
        texts.push_back(*text);
        try {
          (void)cell_text(*text, Scene(), 1e-4);
        } catch (std::invalid_argument const& problem) {
          reader_.report(cell, fmt::format("a cell {}", problem.what()));
        }
      }
    if (texts.size() != cells) reader_.report(row, fmt::format("a row is a list of {} texts, as many as 'head' has", cells));
    return texts;
  }

  SettingsReader reader_;
  Paper paper_;
  std::map<std::string, PaperSeries> series_;
};

}  // namespace

Paper parse_paper(std::string const& text, std::filesystem::path const& path) { return PaperReader(path).read(text); }

Paper load_paper(std::filesystem::path const& path) { return parse_paper(read_text_file(path, largest_scene_file + 1), path); }

}  // namespace clathra
