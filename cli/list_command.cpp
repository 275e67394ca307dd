#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "averaging/fields.hpp"
#include "cases/case_files.hpp"
#include "cases/endpoints.hpp"
#include "cases/keys.hpp"
#include "cli/option_groups.hpp"
#include "stability/measures.hpp"
#include "support/bad_input.hpp"
#include "support/data_folder.hpp"
#include "support/nearest.hpp"
#include "support/terminal.hpp"

namespace crossgrain::inline cli {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

json row(std::string_view name, std::string_view unit, std::string_view what) {
  return {{"name", name}, {"unit", unit}, {"what", what}};
}

json listCases(const fs::path& folder) {
  json rows = json::array();
  for (const CaseSummary& each : casesBelow(folder))
    rows.push_back({{"name", each.name},
                    {"kind", each.kind},
                    {"file", each.file.string()},
                    {"what", each.what}});
  return rows;
}

json listFields(const fs::path&) {
  json rows = json::array();
  std::set<std::string_view> listed;
  const auto has = [](int dimension, std::string_view name) {
    return std::ranges::any_of(std::array{true, false}, [&](bool rings) {
      return std::ranges::find(fieldsIn(dimension, rings), name, &FieldSpec::name) !=
             fieldsIn(dimension, rings).end();
    });
  };
  for (const int dimension : {2, 3})
    for (const bool rings : {true, false})
      for (const FieldSpec& field : fieldsIn(dimension, rings))
        if (listed.insert(field.name).second)
          rows.push_back(
              row(field.name, field.unit,
                  std::string(field.definition) + (!has(2, field.name)   ? "; in space"
                                                   : !has(3, field.name) ? "; in the plane"
                                                                         : "")));
  return rows;
}

json listEndpoints(const fs::path&) {
  json rows = json::array();
  for (const Endpoint& endpoint : endpointTable())
    rows.push_back(row(endpoint.name, endpoint.unit, endpoint.definition));
  std::set<std::string_view> listed;
  for (const int dimension : {2, 3})
    for (const RegionNumber& number : regionNumbers(dimension))
      if (listed.insert(number.name).second)
        rows.push_back(row(number.name, number.unit,
                           std::string(number.definition) +
                               (dimension == 3 ? "; a quantity for [[endpoints]] in space"
                                               : "; a quantity for [[endpoints]]")));
  for (const int dimension : {2, 3})
    for (const RegionNumber& number : wallNumbers(dimension))
      if (listed.insert(number.name).second)
        rows.push_back(row(number.name, number.unit,
                           std::string(number.definition) +
                               "; a quantity for [[endpoints]] with `wall`" +
                               (dimension == 3 ? ", in space" : "")));
  return rows;
}

json listMeasures(const fs::path&) {
  json rows = json::array();
  for (const StabilityMeasure& measure : stabilityMeasures())
    rows.push_back(row(measure.name, measure.unit, measure.what));
  return rows;
}

json listKeys(const fs::path&) {
  const auto plain = [](std::string text) {
    std::erase(text, '`');
    return text;
  };
  json rows = json::array();
  for (const SectionInfo& section : caseSections())
    for (const KeyInfo& key : section.keys)
      rows.push_back({{"section", section.name},
                      {"key", key.name},
                      {"unit", key.unit},
                      {"default", plain(key.standard)},
                      {"values", key.values},
                      {"what", plain(key.meaning)}});
  return rows;
}

/// Lists that there are, and the columns of their text.
struct Subject {
  std::string name;
  json (*rows)(const fs::path& folder);
  std::vector<const char*> columns;
};

const std::vector<Subject> subjects = {
    {"cases", listCases, {"name", "kind", "file", "what"}},
    {"fields", listFields, {"name", "unit", "what"}},
    {"endpoints", listEndpoints, {"name", "unit", "what"}},
    {"measures", listMeasures, {"name", "unit", "what"}},
    {"keys", listKeys, {"section", "key", "unit", "default", "values", "what"}}};

/// Columns side by side, the last one in as many lines as it takes.
void print(const json& rows, const std::vector<const char*>& columns) {
  std::vector<std::string> lines(rows.size());
  std::size_t last = 0;  // where that column begins
  for (const char* const column : columns) {
    std::size_t widest = 0;
    for (const std::string& line : lines) widest = std::max(widest, displayWidth(line));
    last = column == columns.front() ? 0 : widest + 2;
    for (std::size_t k = 0; k < lines.size(); ++k)
      lines[k] = padded(lines[k], last) + rows[k][column].get<std::string>();
  }
  const std::size_t width = terminalWidth(STDOUT_FILENO), room = 24;
  for (std::string& line : lines) {
    line.erase(line.find_last_not_of(' ') + 1);
    fmt::print("{}\n", wrapped(line, width, last + room <= width ? last : 4));
  }
}

struct ListOptions {
  std::string subject;
  bool markdown = false;
};

int list(const CommandLine& line, const ListOptions& options) {
  const std::string& subject = options.subject;
  std::vector<std::string> names;
  for (const Subject& each : subjects) names.push_back(each.name);
  const auto asked = std::ranges::find(subjects, subject, &Subject::name);
  if (asked == subjects.end())
    throw BadInput(
        fmt::format("list: there is nothing called '{}'{}", subject, suggestion(subject, names)));
  if (options.markdown) {
    if (subject != "keys") throw BadInput("list: --markdown is of keys only");
    fmt::print("{}", keysInMarkdown());
    return exitPassed;
  }
  const json rows = asked->rows(line.inputs.empty() ? hereOrInstalled("cases") : line.inputs[0]);
  if (line.json)
    fmt::print("{}\n", rows.dump(2));
  else
    print(rows, asked->columns);
  return exitPassed;
}

Action declareList(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<ListOptions>();
  addArgument(app, "what", options->subject, "what is to be listed",
              "cases|fields|endpoints|measures|keys");
  addInputs(app, line, "folder", "of the cases to be listed (default: cases, here or as installed)",
            0, 1);
  addFlag(app, "--json", line.json, "as JSON");
  addFlag(app, "--markdown", options->markdown, "keys as the tables of docs/cases.md");
  return [&line, options] { return list(line, *options); };
}

}  // namespace

extern const Command listCommand = {
    "list",
    "list cases, fields of profiles.csv, endpoints, measures of hard cases or keys of case files",
    "crossgrain list cases\n"
    "crossgrain list keys --json",
    declareList};

}  // namespace crossgrain::inline cli
