#include "reports/common/page.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <kainjow/mustache.hpp>
#include <stdexcept>

#include "reports/common/figure_data.hpp"
#include "reports/common/headings.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/svg.hpp"
#include "reports/common/svg_style.hpp"
#include "reports/common/templates.hpp"
#include "results/head_fields.hpp"
#include "results/schema.hpp"
#include "support/files.hpp"

namespace crossgrain::reports {

namespace {

namespace mustache = kainjow::mustache;

/// Empty text and null become false, so that a template can ask whether they are there.
mustache::data toMustache(const Json& view) {
  if (view.is_object()) {
    mustache::data object;
    for (const auto& [key, value] : view.items()) object.set(key, toMustache(value));
    return object;
  }
  if (view.is_array()) {
    mustache::data array{mustache::data::type::list};
    for (const Json& value : view) array.push_back(toMustache(value));
    return array;
  }
  if (view.is_boolean()) return mustache::data{view.get<bool>()};
  if (view.is_number_integer()) return mustache::data{view.dump()};
  if (view.is_number()) return mustache::data{readable(view.get<double>())};
  const std::string words = view.is_string() ? view.get<std::string>() : std::string();
  return words.empty() ? mustache::data{false} : mustache::data{words};
}

/// Sentences of the masthead as HTML.
Json withSymbols(Json view) {
  for (const char* key : {"lead", "sentences", "notes"}) {
    if (!view.contains(key)) continue;
    Json& words = view[key];
    if (words.is_string()) words = symbolsHtml(words.get<std::string>());
    if (!words.is_array()) continue;
    for (Json& sentence : words)
      if (sentence.is_string()) sentence = symbolsHtml(sentence.get<std::string>());
  }
  return view;
}

/// Of a plot: as wide as its letters need to stay readable, and no wider than they look well.
/// Pictures have no letters.
void addWidths(Json& view, const std::string& svg) {
  const std::size_t at = svg.find("width=\"");
  if (at == std::string::npos) return;
  const double width = std::strtod(svg.c_str() + at + std::string_view("width=\"").size(), nullptr);
  if (!(width > 0.0)) return;
  constexpr double smallest = 12.0, readableOnes = 11.0;  // letters in figure_script.cpp [px]
  constexpr double column = 640.0;                        // of a figure beside another [px]
  view["least"] = fmt::format("{:.0f}", std::ceil(width * readableOnes / smallest));
  view["most"] = fmt::format("{:.0f}", 1.35 * width);
  view["wide"] = width > column;
}

/// As text of a script element: no tag or comment can begin or end in it.
std::string forScript(const Json& data) {
  std::string text = data.dump();
  for (std::size_t at = 0; (at = text.find_first_of("<>", at)) != std::string::npos;)
    text.replace(at, 1, text[at] == '<' ? "\\u003c" : "\\u003e");
  return text;
}

/// Of the page, for all its figures.
Json legendView(const std::vector<Figure>& figures) {
  Json entries = Json::array();
  for (const LegendEntry& entry : sharedLegend(figures))
    entries.push_back(
        {{"name", entry.name}, {"colour", entry.style.colour}, {"dashed", entry.style.dashed}});
  return entries;
}

/// The caption is HTML.
/// @param top  of the picture that is left out [px]
Json imageView(const Illustrations& shown, const std::string& file, const std::string& alt,
               const std::string& caption, int top = 0) {
  const auto svg = readFile(shown.plots / (file + ".svg"));
  if (!svg) return nullptr;
  return {{"file", file},
          {"alt", alt},
          {"caption", caption},
          {"image", svgAddress(styledByClasses(compactSvg(withoutTop(*svg, top))))},
          {"wide", false},
          {"least", ""},
          {"most", ""},
          {"data", ""},
          {"engine", ""}};
}

std::string joined(const std::vector<std::string>& parts) {
  std::string result;
  for (const std::string& part : parts)
    if (!part.empty()) result += (result.empty() ? "" : " · ") + part;
  return result;
}

std::string headingOf(const CaseHead& setup) {
  return setup.variant.empty() ? setup.name : setup.name + ", " + setup.variant;
}

std::string machineInWords(const Machine& machine) {
  return joined({machine.cpu, machine.cores > 0 ? counted(machine.cores, "core") : std::string(),
                 machine.os});
}

}  // namespace

std::string render(const std::string& name, const Json& view) {
  mustache::data data = toMustache(withSymbols(view));
  for (const auto& [part, content] : templates())
    if (part.starts_with("part_"))
      data.set(part, mustache::data{mustache::partial{[&content = content] { return content; }}});
  mustache::mustache page(templates().at(name));
  std::string result = page.render(data);
  if (!page.is_valid())
    throw std::logic_error(fmt::format("template {}: {}", name, page.error_message()));
  return pageWithSymbols(withAnchors(result));
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string titleOf(const ResultsHead& head) {
  return fmt::format("crossgrain {}: {}", head.kind, headingOf(head.setup));
}

Json commonView(const ResultsHead& head, std::optional<double> elapsed,
                const std::vector<std::string>& notes, const Illustrations& shown) {
  const CaseHead& setup = head.setup;
  const std::string machine = machineInWords(head.machine);
  const Json legend = shown.missing ? Json::array() : legendView(shown.figures);
  const bool averages = head.kind == kindAverage || head.kind == kindRev;
  return {
      {"style", templates().at("style.css")},
      {"script", templates().at("controls.js") + templates().at("figures.js") +
                     templates().at("tables.js") + templates().at("pictures.js")},
      {"legend", legend},
      {"hasLegend", !legend.empty()},
      {"title", titleOf(head)},
      {"kicker", "crossgrain " + head.kind},
      {"heading", headingOf(setup)},
      {"meta", joined({head.started, elapsed ? "took " + readableDuration(elapsed) : std::string(),
                       "crossgrain " + head.version, machine})},
      {"notes", notes},
      {"hasNotes", !notes.empty()},
      {"plotsMissing", shown.missing.value_or("")},
      {"caseHeading",
       averages ? "The case: its cell, rings and weights" : "The case as it was run"},
      {"toml", setup.toml},
      {"caseFile", setup.file},
      {"command", head.command},
      {"version", head.version},
      {"machine", machine}};
}

Json figureViews(const Illustrations& shown, std::string_view prefix) {
  Json views = Json::array();
  if (shown.missing) return views;
  const std::vector<LegendEntry> legend = sharedLegend(shown.figures);
  for (const Figure& figure : shown.figures) {
    if (!figure.name.starts_with(prefix)) continue;
    const std::string axes = readFile(shown.plots / (figure.name + ".axes")).value_or("");
    Json view = imageView(shown, figure.name, figure.title, mathHtml(figure.caption),
                          keyRoom(figure, axes, legend));
    if (view.is_null()) continue;
    addWidths(view, *readFile(shown.plots / (figure.name + ".svg")));
    if (const Json data = figureData(figure, axes, legend); !data.is_null())
      view["data"] = forScript(data);
    views.push_back(std::move(view));
  }
  return views;
}

Json pictureViews(const Illustrations& shown, Picture::Shows shows) {
  Json views = Json::array();
  for (const Picture& picture : shown.pictures)
    if (picture.shows == shows)
      if (Json view = imageView(shown, picture.name, picture.title,
                                mustache::html_escape(picture.engine) + ". " + picture.scale);
          !view.is_null()) {
        // Pictures of one scene, to be put upon each other.
        if (shows != Picture::Shows::worst) view["engine"] = picture.engine;
        views.push_back(std::move(view));
      }
  return views;
}

}  // namespace crossgrain::reports
