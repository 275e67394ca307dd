#include "cases/start_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "cases/case.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cases {
namespace {

enum Column : std::size_t { x, y, radius, vx, vy, spin, mass, inertia, fixed, columnCount };
const std::array<std::string, columnCount> columnNames = {"x",    "y",    "radius",  "vx",   "vy",
                                                          "spin", "mass", "inertia", "fixed"};
constexpr std::size_t neededColumns = 3;  // the first ones

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const auto begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::vector<std::string_view> cellsOf(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0;;) {
    const auto comma = line.find(',', begin);
    cells.push_back(trimmed(line.substr(begin, comma - begin)));
    if (comma == std::string_view::npos) return cells;
    begin = comma + 1;
  }
}

class StartReader {
 public:
  StartReader(const std::filesystem::path& file, const DiskDefaults& defaults)
      : file_(file), defaults_(defaults) {}

  Start read(std::string_view text) {
    constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";  // spreadsheets begin with it
    if (text.starts_with(byteOrderMark)) text.remove_prefix(byteOrderMark.size());
    while (!text.empty()) {
      const auto end = text.find('\n');
      readLine(trimmed(text.substr(0, end)));
      text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    }
    if (columns_.empty()) failFile("has no line of column names, as x,y,radius");
    if (start_.disks.size() == 0) failFile("has no disks that move");
    return std::move(start_);
  }

 private:
  void readLine(std::string_view line) {
    ++line_;
    if (line.empty() || line.front() == '#') return;
    const auto cells = cellsOf(line);
    columns_.empty() ? readNames(cells) : readDisk(cells);
  }

  void readNames(const std::vector<std::string_view>& names) {
    for (const std::string_view name : names) {
      const auto found = std::ranges::find(columnNames, name);
      if (found == columnNames.end())
        fail(fmt::format("\"{}\" is no column{}", name, suggestion(name, columnNames)));
      const auto column = static_cast<Column>(found - columnNames.begin());
      if (std::ranges::find(columns_, column) != columns_.end())
        fail(fmt::format("two columns are called {}", name));
      columns_.push_back(column);
    }
    for (std::size_t need = 0; need < neededColumns; ++need)
      if (std::ranges::find(columns_, need) == columns_.end())
        fail(fmt::format("there is no column {}", columnNames[need]));
  }

  double number(std::string_view text, Column column) {
    double value = 0.0;
    // Tables have a plus sign where from_chars has none.
    const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
    const auto [end, error] =
        std::from_chars(text.data() + (plus ? 1 : 0), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      fail(fmt::format("{} = {}: must be a number", columnNames[column],
                       text.empty() ? "nothing" : std::string(text)));
    return value;
  }

  void readDisk(const std::vector<std::string_view>& cells) {
    if (cells.size() != columns_.size())
      fail(fmt::format("has {} values for {} columns", cells.size(), columns_.size()));
    std::array<std::optional<double>, columnCount> values;
    for (std::size_t k = 0; k < cells.size(); ++k)
      values[columns_[k]] = number(cells[k], columns_[k]);
    for (const Column column : {radius, mass, inertia})
      if (values[column] && !(*values[column] > 0.0))
        fail(fmt::format("{} = {}: must be > 0", columnNames[column], *values[column]));
    const double stands = values[fixed].value_or(0.0);
    if (stands != 0.0 && stands != 1.0) fail(fmt::format("fixed = {}: must be 0 or 1", stands));
    if (start_.disks.size() + start_.fixedRadius.size() >= static_cast<std::size_t>(mostDisks))
      fail(fmt::format("these are more than the {} disks that a case may have", mostDisks));
    const Vec2 position(*values[x], *values[y]);
    if (stands == 1.0) {
      start_.fixedPosition.push_back(position);
      start_.fixedRadius.push_back(*values[radius]);
      return;
    }
    Disks& disks = start_.disks;
    const double a = *values[radius], m = values[mass] ? *values[mass] : defaults_.mass(a);
    disks.position.push_back(position);
    disks.radius.push_back(a);
    disks.velocity.emplace_back(values[vx].value_or(0.0), values[vy].value_or(0.0));
    disks.spin.push_back(values[spin].value_or(0.0));
    disks.mass.push_back(m);
    disks.inertia.push_back(values[inertia].value_or(defaults_.inertiaFactor * m * a * a));
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw BadInput(fmt::format("{}:{}: {}", file_.string(), line_, what));
  }
  [[noreturn]] void failFile(const char* what) const {
    throw BadInput(fmt::format("{}: {}", file_.string(), what));
  }

  const std::filesystem::path& file_;
  const DiskDefaults& defaults_;
  std::vector<Column> columns_;
  Start start_;
  int line_ = 0;
};

}  // namespace

Start readStart(const std::filesystem::path& file, const DiskDefaults& defaults) {
  if (file.extension() != ".csv") return {readPacking(file, defaults).disks, {}, {}};
  const auto text = readFile(file);
  if (!text) throw BadInput(file.string() + ": cannot be read");
  return StartReader(file, defaults).read(*text);
}

}  // namespace crossgrain::inline cases
