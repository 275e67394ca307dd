#include "reports/common/page.hpp"

#include <fmt/format.h>

#include <kainjow/mustache.hpp>
#include <stdexcept>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/report.hpp"
#include "reports/render/html.hpp"

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
    Json& words = view[key];
    if (words.is_string()) words = mathHtml(words.get<std::string>());
    if (words.is_array())
      for (Json& sentence : words) sentence = mathHtml(sentence.get<std::string>());
  }
  return view;
}

}  // namespace

std::string render(const std::string& name, const Json& view) {
  mustache::data data = toMustache(withSymbols(view));
  for (const char* part : {"part_masthead", "part_figure", "part_rebuild"})
    data.set(part, mustache::data{mustache::partial{
                       [part] { return pageFile(std::string(part) + ".mustache"); }}});
  mustache::mustache page(pageFile(name + ".mustache"));
  std::string result = page.render(data);
  if (!page.is_valid())
    throw std::logic_error(fmt::format("template {}: {}", name, page.error_message()));
  return result;
}

Json commonView(const ResultsHead& head, std::optional<double> elapsed,
                const std::vector<std::string>& notes, const Illustrations& shown) {
  Report report;
  report.head = head;
  report.elapsed = elapsed;
  return {{"headHtml", htmlHead(report)},
          {"footHtml", htmlFoot(report)},
          {"notes", notes},
          {"hasNotes", !notes.empty()},
          {"plotsMissing", shown.missing.value_or("")},
          {"caseFile", head.setup.file}};
}

void addOverview(Json& view, const Overview& overview, const std::vector<EngineRow>& engines) {
  view["matrixHtml"] = htmlMatrix(overview, engines);
  view["legendHtml"] = htmlLegend(engines);
}

Json figureViews(const Illustrations& shown, std::string_view prefix) {
  Json views = Json::array();
  if (shown.missing) return views;
  Report report;
  report.figures = shown.figures;
  for (const Figure& figure : shown.figures)
    if (figure.name.starts_with(prefix))
      if (std::string html = htmlDrawing(report, figure.name, shown.plots); !html.empty())
        views.push_back({{"file", figure.name}, {"html", std::move(html)}});
  return views;
}

}  // namespace crossgrain::reports
