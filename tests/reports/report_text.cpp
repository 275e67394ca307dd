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
  std::string operator()(const Links& part) const {
    std::string text;
    for (const auto& [name, address] : part.links) text += fmt::format("<{}> ", address);
    return text + "\n";
  }
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

std::string textOf(const Report& report) {
  std::string text = overviewMarkdown(report.overview, titleOf(report.head)) + "\n";
  for (const std::string& note : report.notes) text += "* " + note + "\n";
  for (const Section& section : report.sections)
    text += fmt::format("\n## {} ({})\n{}", section.title, section.id, blocksText(section.blocks));
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

}  // namespace crossgrain::reports
