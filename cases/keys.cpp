#include "cases/keys.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

namespace crossgrain::inline cases {

extern const char* const caseDocument;  // cases/README.md, see key_document.cpp.in

namespace {

/// Text of Markdown without its marks: `code` as it is, "\|" as "|".
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text)
    if (c != '`' && c != '\\') out += c;
  const auto first = out.find_first_not_of(' ');
  return first == std::string::npos ? "" : out.substr(first, out.find_last_not_of(' ') - first + 1);
}

/// The cells of "| a | b |"; none for what is not a row of a table.
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> row;
  if (!line.starts_with('|')) return row;
  std::size_t from = 1;
  for (std::size_t at = 1; at < line.size(); ++at)
    if (line[at] == '|' && line[at - 1] != '\\') {
      row.push_back(line.substr(from, at - from));
      from = at + 1;
    }
  return row;
}

/// The names in "`stack`, `chain`".
std::vector<std::string> names(const std::string& cell) {
  std::vector<std::string> list;
  for (auto open = cell.find('`'); open != std::string::npos; open = cell.find('`', open + 1)) {
    const auto close = cell.find('`', open + 1);
    list.push_back(cell.substr(open + 1, close - open - 1));
    open = close;
  }
  return list;
}

/// "law" of "### `[law]`"; empty for another heading.
std::string sectionOf(const std::string& heading) {
  const auto open = heading.find("`["), close = heading.find("]", open);
  if (open == std::string::npos || close == std::string::npos) return "";
  const auto begin = heading.find_first_not_of('[', open + 1);
  return heading.substr(begin, close - begin);
}

/// The name of a column: a table of conventions lists values, its default first.
bool isColumn(const std::string& title, std::string_view name) {
  return title == name || (name == "default" && title == "values, default first");
}

std::vector<CaseKey> readDocument() {
  std::vector<CaseKey> keys;
  std::istringstream document(caseDocument);
  std::string section;
  std::vector<std::string> titles;
  for (std::string line; std::getline(document, line);) {
    if (line.starts_with('#')) section = sectionOf(line);
    const std::vector<std::string> row = cells(line);
    if (row.empty()) titles.clear();
    if (row.empty() || section.empty()) continue;
    if (titles.empty()) {
      for (const std::string& title : row) titles.push_back(plain(title));
      continue;
    }
    if (titles.front() != "key" || row.front().starts_with("---")) continue;
    CaseKey key{section, "", "", "–", ""};
    for (std::size_t k = 1; k < std::min(row.size(), titles.size()); ++k) {
      if (isColumn(titles[k], "unit")) key.unit = plain(row[k]);
      if (isColumn(titles[k], "default")) key.usual = plain(row[k]);
      if (isColumn(titles[k], "meaning")) key.meaning = plain(row[k]);
    }
    for (const std::string& name : names(row.front())) {
      key.key = name;
      keys.push_back(key);
    }
  }
  return keys;
}

}  // namespace

const std::vector<CaseKey>& caseKeys() {
  static const std::vector<CaseKey> keys = readDocument();
  return keys;
}

}  // namespace crossgrain::inline cases
