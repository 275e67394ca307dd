#include "reports/common/page.hpp"

#include <fmt/format.h>

#include <kainjow/mustache.hpp>
#include <stdexcept>

#include "reports/common/base64.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/svg.hpp"
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
  const std::string words = view.is_string() ? view.get<std::string>() : std::string();
  return words.empty() ? mustache::data{false} : mustache::data{words};
}

/// The caption is HTML.
Json imageView(const Illustrations& shown, const std::string& file, const std::string& alt,
               const std::string& caption) {
  const auto svg = readFile(shown.plots / (file + ".svg"));
  if (!svg) return nullptr;
  return {{"file", file}, {"alt", alt}, {"caption", caption}, {"image", base64(compactSvg(*svg))}};
}

std::string joined(const std::vector<std::string>& parts) {
  std::string result;
  for (const std::string& part : parts)
    if (!part.empty()) result += (result.empty() ? "" : " · ") + part;
  return result;
}

std::string machineInWords(const Machine& machine) {
  return joined({machine.cpu, machine.cores > 0 ? counted(machine.cores, "core") : std::string(),
                 machine.os});
}

}  // namespace

std::string render(const std::string& name, const Json& view) {
  mustache::data data = toMustache(view);
  for (const auto& [part, content] : templates())
    if (part.starts_with("part_"))
      data.set(part, mustache::data{mustache::partial{[&content = content] { return content; }}});
  mustache::mustache page(templates().at(name));
  std::string result = page.render(data);
  if (!page.is_valid())
    throw std::logic_error(fmt::format("template {}: {}", name, page.error_message()));
  return result;
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

Json commonView(const ResultsHead& head, std::optional<double> elapsed,
                const std::vector<std::string>& notes, const Illustrations& shown) {
  const CaseHead& setup = head.setup;
  const std::string heading =
      setup.variant.empty() ? setup.name : setup.name + ", " + setup.variant;
  const std::string machine = machineInWords(head.machine);
  const bool averages = head.kind == kindAverage || head.kind == kindRev;
  return {
      {"style", templates().at("style.css")},
      {"title", "crossgrain " + head.kind + ": " + heading},
      {"kicker", "crossgrain " + head.kind},
      {"heading", heading},
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
  for (const Figure& figure : shown.figures)
    if (figure.name.starts_with(prefix))
      if (Json view = imageView(shown, figure.name, figure.title, mathHtml(figure.caption));
          !view.is_null())
        views.push_back(std::move(view));
  return views;
}

Json pictureViews(const Illustrations& shown, Picture::Shows shows) {
  Json views = Json::array();
  for (const Picture& picture : shown.pictures)
    if (picture.shows == shows)
      if (Json view = imageView(shown, picture.name, picture.title,
                                mustache::html_escape(picture.engine) + ". " + picture.scale);
          !view.is_null())
        views.push_back(std::move(view));
  return views;
}

}  // namespace crossgrain::reports
