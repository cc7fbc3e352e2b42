#include "io/results/paper.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "domain/scene/hydrate.hpp"
#include "io/scene/scene_value.hpp"

namespace clathra {
namespace {

/// Erases the places whose groups are not among those kept.
void thin(PaperSeries& series, Paper const& paper, bool& complete) {
  PaperSeries kept = series;
  kept.groups.clear(), kept.at.clear(), kept.names.clear();
  for (std::size_t i = 0; i < series.groups.size(); ++i) {
    if (!group_of(paper, series.groups[i]) && !is_material(paper, series.groups[i])) continue;
    kept.groups.push_back(series.groups[i]);
    if (!series.at.empty()) kept.at.push_back(series.at[i]);
    if (!series.names.empty()) kept.names.push_back(series.names[i]);
  }
  complete = complete && kept.groups.size() == series.groups.size();
  series = std::move(kept);
}

void thin(std::vector<PaperSeries>& all, Paper const& paper, bool& complete) {
  for (PaperSeries& series : all) thin(series, paper, complete);
  std::erase_if(all, [](PaperSeries const& series) { return series.groups.empty(); });
}

/// What a mark without its braces stands for.
std::string mark_text(std::string const& mark, Scene const& scene, double d50) {
  if (mark.starts_with("eq3 "))
    return fmt::format("{:.4f}", critical_thickness_ratio(parse_quantity(mark.substr(4), Dimension::ratio)));
  std::size_t const in = mark.find(" in ");
  std::string const name = mark.substr(0, in), unit = in == mark.npos ? "" : mark.substr(in + 4);
  if (name == "E_m")
    return fmt::format("{:.3g}",
                       evaluate_bond(scene, d50, d50 / 2, d50 / 2, 0, 0).E_m / parse_quantity("1 " + unit, Dimension::pressure));
  Key const* const key = find_key(name);
  if (!key) throw std::invalid_argument("has '{" + mark + "}', which is no key of a scene" + key_suggestion(name));
  if (is_not_given(*key, scene)) return std::string(key->zero.substr(0, key->zero.find(',')));
  if (unit.empty()) return unquoted(value_text(*key, scene));
  auto const* const field = std::get_if<double& (*)(Scene&)>(&key->field);
  if (!field) throw std::invalid_argument("has '{" + mark + "}', which has no unit");
  Scene copy = scene;
  return fmt::format("{:g}", (*field)(copy) / parse_quantity("1 " + unit, key->dimension));
}

}  // namespace

StudyGroup const* group_of(Paper const& paper, std::string const& name) {
  auto const found =
      std::find_if(paper.groups.begin(), paper.groups.end(), [&](StudyGroup const& group) { return group.name == name; });
  return found == paper.groups.end() ? nullptr : &*found;
}

bool is_material(Paper const& paper, std::string const& name) {
  return std::any_of(paper.groups.begin(), paper.groups.end(), [&](StudyGroup const& group) { return group.material == name; });
}

void keep_only(Paper& paper, std::vector<std::string> const& groups) {
  std::erase_if(paper.groups,
                [&](StudyGroup const& group) { return std::find(groups.begin(), groups.end(), group.name) == groups.end(); });
  for (PaperClaim& claim : paper.claims)
    for (PaperPart& part : claim.parts) {
      bool complete = true;
      thin(part.series, paper, complete);
    }
  for (PaperSection& section : paper.sections)
    std::erase_if(section.figures, [&](PaperFigure& figure) {
      bool complete = true;
      thin(figure.series, paper, complete);
      return figure.only_complete && !complete;
    });
}

Scene stated_scene(Paper const& paper, StudyGroup const& group) {
  Scene scene;
  for (std::vector<Setting> const* const settings : {&paper.shared, &group.settings})
    for (auto const& [key, value] : *settings) set_stated(*find_key(key), scene, value);
  return scene;
}

PaperSeries placed(Paper const& paper, PaperSeries series, double d50) {
  if (!series.by_critical_thickness) return series;
  std::vector<std::pair<double, std::string>> places;
  for (std::string const& name : series.groups) {
    Scene const scene = stated_scene(paper, *group_of(paper, name));
    places.emplace_back(scene.bond.critical_thickness_from == CriticalThicknessFrom::given
                            ? 1e6 * scene.bond.critical_thickness
                            : 1e6 * critical_thickness_ratio(scene.hydrate.saturation) * d50,
                        name);
  }
  std::sort(places.begin(), places.end());
  series.groups.clear();
  for (auto const& [place, name] : places) series.at.push_back(place), series.groups.push_back(name);
  return series;
}

std::string label_of(Paper const& paper, std::string const& name) {
  auto const label = paper.labels.find(name);
  return label == paper.labels.end() ? name : label->second;
}

std::string place_name(Paper const& paper, PaperSeries const& series, std::size_t i) {
  if (!series.names.empty()) return series.names[i];
  if (!series.at.empty()) return fmt::format("{:g}", series.at[i]);
  return label_of(paper, series.groups[i]);
}

std::string filled(std::string text, std::map<std::string, std::string> const& values) {
  for (auto const& [name, value] : values) {
    std::string const mark = "{" + name + "}";
    for (std::size_t at = text.find(mark); at != text.npos; at = text.find(mark, at + value.size()))
      text.replace(at, mark.size(), value);
  }
  return text;
}

std::string cell_text(std::string const& cell, Scene const& scene, double d50) {
  std::string text;
  for (std::size_t at = 0; at != cell.npos;) {
    std::size_t const open = cell.find('{', at), close = cell.find('}', open);
    text += cell.substr(at, open == cell.npos ? open : open - at);
    if (open != cell.npos) text += mark_text(cell.substr(open + 1, close - open - 1), scene, d50);
    at = close == cell.npos ? close : close + 1;
  }
  return text;
}

}  // namespace clathra
