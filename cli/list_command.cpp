#include <fmt/format.h>

#include <algorithm>
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

namespace crossgrain::inline cli {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

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
  for (const auto& table : {fieldTable(), cartesianFieldTable()})
    for (const FieldSpec& field : table)
      if (listed.insert(field.name).second)
        rows.push_back({{"name", field.name}, {"unit", field.unit}, {"what", field.definition}});
  return rows;
}

json listEndpoints(const fs::path&) {
  json rows = json::array();
  for (const EndpointSpec& endpoint : endpointTable())
    rows.push_back(
        {{"name", endpoint.name}, {"unit", endpoint.unit}, {"what", endpoint.definition}});
  for (const RegionNumber& number : regionNumbers())
    rows.push_back({{"name", number.name},
                    {"unit", number.unit},
                    {"what", std::string(number.definition) + "; a quantity for [[endpoints]]"}});
  return rows;
}

json listMeasures(const fs::path&) {
  json rows = json::array();
  for (const StabilityMeasure& measure : stabilityMeasures())
    rows.push_back({{"name", measure.name}, {"unit", measure.unit}, {"what", measure.what}});
  return rows;
}

json listKeys(const fs::path&) {
  json rows = json::array();
  for (const CaseKey& key : caseKeys())
    rows.push_back({{"section", key.section},
                    {"key", key.key},
                    {"unit", key.unit},
                    {"default", key.usual},
                    {"what", key.meaning}});
  return rows;
}

/// What can be listed, and the columns that the text has.
struct Subject {
  std::string name;
  json (*rows)(const fs::path& folder);
  std::vector<const char*> columns;
};

const std::vector<Subject>& subjects() {
  static const std::vector<Subject> all = {
      {"cases", listCases, {"name", "kind", "file", "what"}},
      {"fields", listFields, {"name", "unit", "what"}},
      {"endpoints", listEndpoints, {"name", "unit", "what"}},
      {"measures", listMeasures, {"name", "unit", "what"}},
      {"keys", listKeys, {"section", "key", "unit", "default", "what"}}};
  return all;
}

/// Characters, not bytes: names of units are not all ASCII.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

/// Columns side by side, the last one open.
void print(const json& rows, const std::vector<const char*>& columns) {
  for (const json& row : rows) {
    std::string line;
    for (const char* column : columns) {
      const std::string text = row[column];
      line += text;
      if (column == columns.back()) continue;
      std::size_t widest = 0;
      for (const json& each : rows)
        widest = std::max(widest, width(each[column].get<std::string>()));
      line.append(widest + 2 - width(text), ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    fmt::print("{}\n", line);
  }
}

int list(const CommandLine& line, const std::string& subject, const fs::path& folder) {
  std::vector<std::string> names;
  for (const Subject& each : subjects()) names.push_back(each.name);
  const auto asked = std::ranges::find(subjects(), subject, &Subject::name);
  if (asked == subjects().end())
    throw BadInput(
        fmt::format("list: there is nothing called '{}'{}", subject, suggestion(subject, names)));
  const json rows = asked->rows(folder);
  if (line.json)
    fmt::print("{}\n", rows.dump(2));
  else
    print(rows, asked->columns);
  return exitHeld;
}

Action declareList(CLI::App& app, CommandLine& line) {
  const auto subject = std::make_shared<std::string>();
  addArgument(app, "what", *subject, "what is to be listed",
              "cases|fields|endpoints|measures|keys");
  addInputs(app, line, "folder", "of the cases to be listed (default: cases, here or as installed)",
            0, 1);
  addFlag(app, "--json", line.json, "as JSON");
  return [&line, subject] {
    return list(line, *subject,
                line.inputs.empty() ? hereOrInstalled("cases") : line.inputs.front());
  };
}

}  // namespace

extern const Command listCommand = {
    "list", "cases, fields of profiles.csv, endpoints, measures of hard cases, keys of case files",
    "crossgrain list cases\n"
    "crossgrain list keys --json",
    declareList};

}  // namespace crossgrain::inline cli
