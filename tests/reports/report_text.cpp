#include "tests/reports/report_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "reports/common/overview.hpp"

namespace crossgrain::reports {

namespace {

std::string cellText(const Cell& cell) {
  std::string text =
      cell.marked ? fmt::format("{} {}", lookOf(cell.verdict).mark, cell.text) : cell.text;
  for (const std::string& note : cell.notes) text += " // " + note;
  for (const Square& square : cell.strip) text += lookOf(square.verdict).mark;
  return text;
}

std::string blocksText(const Blocks& blocks);

struct Printer {
  std::string operator()(const Paragraph& part) const { return part.text + "\n"; }
  std::string operator()(const List& part) const {
    std::string text;
    for (const Item& item : part.items) text += fmt::format("- {}: {}\n", item.lead, item.text);
    return text;
  }
  std::string operator()(const Table& part) const {
    std::vector<std::string> names;
    for (const reports::Column& column : part.columns) names.push_back(column.name);
    std::string text = fmt::format("| {}\n", fmt::join(names, " | "));
    for (const TableRow& row : part.rows) {
      if (!row.group.empty()) text += row.group + "\n";
      std::vector<std::string> cells;
      for (const Cell& cell : row.cells) cells.push_back(cellText(cell));
      text += fmt::format("| {}\n", fmt::join(cells, " | "));
    }
    return text + (part.note.empty() ? "" : part.note + "\n");
  }
  std::string operator()(const Drawings& part) const {
    return part.names.empty() ? "" : fmt::format("[{}]\n", fmt::join(part.names, "] ["));
  }
  std::string operator()(const Code& part) const { return part.text + "\n"; }
  std::string operator()(const Heading& part) const { return "### " + part.text + "\n"; }
  std::string operator()(const Details& part) const {
    return "> " + part.summary + "\n" + blocksText(part.blocks);
  }
};

std::string blocksText(const Blocks& blocks) {
  std::string text;
  for (const Block& block : blocks) text += std::visit(Printer(), block.content);
  return text;
}

}  // namespace

namespace {

/// Caption, axes and curves of a figure, each with its number of points and the first of them.
std::string figureText(const Figure& figure) {
  std::string text = fmt::format("\n[{}] {}\n", figure.name, figure.caption);
  for (const Panel& panel : figure.panels) {
    text += fmt::format("  {} over {}:", panel.yLabel, panel.xLabel);
    for (const Curve& curve : panel.curves) {
      text += fmt::format(" {}: {}", curve.name, curve.points.size());
      if (curve.points.empty()) continue;
      const Point& first = curve.points.front();
      text += fmt::format(" from ({:.4g}, {:.4g})", first.x, first.y);
    }
    text += "\n";
  }
  return text;
}

/// The name of a table, its columns and its first and last row.
std::string tableText(const std::string& name, const std::string& content) {
  const std::size_t head = content.find('\n') + 1, first = content.find('\n', head) + 1;
  const std::size_t last = content.size() < 2 ? 0 : content.rfind('\n', content.size() - 2) + 1;
  return fmt::format("\n{}\n{}{}", name, content.substr(0, first),
                     last >= first ? content.substr(last) : "");
}

}  // namespace

std::string textOf(const Report& report) {
  std::string text = overviewMarkdown(report.overview, titleOf(report.head)) + "\n";
  for (const std::string& note : report.notes) text += "* " + note + "\n";
  for (const Section& section : report.sections)
    text += fmt::format("\n## {} ({})\n{}", section.title, section.id, blocksText(section.blocks));
  return text;
}

std::string wholeTextOf(const Report& report) {
  std::string text = textOf(report);
  for (const Figure& figure : report.figures) text += figureText(figure);
  for (const auto& [name, content] : report.tables) text += tableText(name, content);
  return text;
}

const std::string& csvOf(const Report& report, const std::string& name) {
  for (const auto& [own, table] : report.tables)
    if (own == name) return table;
  throw std::out_of_range(name);
}

std::string junitOf(const Report& report) {
  return junitXml(report.head.kind, report.checks.value());
}

std::string shown(const OverviewCell& cell) {
  return fmt::format("{} {}", cellWord(cell.verdict), cell.shown);
}

const OverviewRow& rowNamed(const Overview& overview, const std::string& name) {
  const auto found = std::ranges::find(overview.rows, name, &OverviewRow::name);
  if (found == overview.rows.end()) throw std::runtime_error("no row " + name);
  return *found;
}

}  // namespace crossgrain::reports
