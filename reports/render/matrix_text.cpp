#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "reports/common/report.hpp"
#include "reports/common/text.hpp"
#include "support/terminal.hpp"

namespace crossgrain::reports {

namespace {

std::string textOf(const OverviewCell& cell) {
  const std::string mark(lookOf(cell.verdict).mark);
  return cell.shown.empty() ? mark : mark + " " + cell.shown;
}

constexpr std::size_t gap = 2;  ///< between columns

/// A column's name in lines of at most that width, but for longer words.
Names headLines(const std::string& name, std::size_t width) {
  Names lines;
  std::istringstream text(wrapped(name, width, 0));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// Widths of the columns, the rows' names first.
/// @param most  of a column's name, but for longer words
std::vector<std::size_t> widthsOf(const Overview& overview, std::size_t most) {
  std::vector<std::size_t> widths = {displayWidth(overview.rowsAre)};
  for (const OverviewColumn& column : overview.columns) {
    widths.push_back(0);
    for (const std::string& line : headLines(column.name, most))
      widths.back() = std::max(widths.back(), displayWidth(line));
  }
  for (const OverviewRow& row : overview.rows) {
    widths[0] = std::max(widths[0], displayWidth(row.name));
    for (std::size_t k = 0; k < row.cells.size(); ++k)
      widths[k + 1] = std::max(widths[k + 1], displayWidth(textOf(row.cells[k])));
  }
  return widths;
}

/// The columns that each block begins with, and their end.
std::vector<std::size_t> blocksOf(const std::vector<std::size_t>& widths, std::size_t room) {
  std::vector<std::size_t> begins = {0};
  std::size_t used = widths[0];
  for (std::size_t k = 0; k + 1 < widths.size(); ++k) {
    used += gap + widths[k + 1];
    if (used > room && k > begins.back()) {
      begins.push_back(k);
      used = widths[0] + gap + widths[k + 1];
    }
  }
  begins.push_back(widths.size() - 1);
  return begins;
}

/// How much of the matrix there are lines for.
struct Shown {
  std::size_t rows = 0, blocks = 0;
};

/// Each block has a head and a row at least; what is left out takes a line.
/// @param heads  lines of a head
/// @param taken  lines below the matrix
Shown shownOf(const Overview& overview, std::size_t blocks, std::size_t heads, std::size_t taken) {
  const std::size_t lines = mostOverviewLines - std::min(taken, mostOverviewLines - heads - 3);
  if (blocks * (heads + overview.rows.size()) <= lines) return {overview.rows.size(), blocks};
  const std::size_t each = std::max<std::size_t>((lines - 1) / blocks, heads + 1);
  const std::size_t rows = std::min(overview.rows.size(), each - heads);
  return {rows, std::min(blocks, (lines - 1) / (heads + rows))};
}

/// "… and 3 more rows and 1 more column: in the report"; empty: nothing is left out.
std::string leftOut(std::size_t rows, std::size_t columns) {
  Names parts;
  if (rows > 0) parts.push_back(fmt::format("{} more row{}", rows, rows == 1 ? "" : "s"));
  if (columns > 0)
    parts.push_back(fmt::format("{} more column{}", columns, columns == 1 ? "" : "s"));
  return parts.empty() ? std::string() : fmt::format("… and {}: in the report\n", listed(parts));
}

std::string inColour(const OverviewCell& cell, const std::string& text, const TextLook& look) {
  if (!look.coloured) return text;
  return fmt::format("\033[{}m{}\033[0m", lookOf(cell.verdict).terminal, text);
}

std::string withoutEnd(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

/// The one way for words into Markdown, which takes some characters for its own.
std::string forTable(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    // Renderers that know no backslash before these would make them HTML.
    if (c == '<' || c == '>' || c == '&') {
      safe += c == '<' ? "&lt;" : c == '>' ? "&gt;" : "&amp;";
      continue;
    }
    if (std::string_view("\\|*_`[]#$~@").find(c) != std::string_view::npos) safe += '\\';
    safe += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return safe;
}

std::string headOf(const std::string& corner, const Names& names) {
  std::string text = fmt::format("| {} |", forTable(corner));
  for (const std::string& name : names) text += fmt::format(" {} |", forTable(name));
  text += "\n|---|";
  for (std::size_t k = 0; k < names.size(); ++k) text += "---|";
  return text + "\n";
}

/// A question per column.
std::string lying(const Overview& overview) {
  Names names;
  for (const OverviewColumn& column : overview.columns) names.push_back(column.name);
  std::string text = headOf(overview.rowsAre, names);
  for (const OverviewRow& row : overview.rows) {
    text += fmt::format("| {} |", forTable(row.name));
    for (const OverviewCell& cell : row.cells) text += fmt::format(" {} |", forTable(textOf(cell)));
    text += "\n";
  }
  return text;
}

/// A question per row.
std::string standing(const Overview& overview) {
  Names names;
  for (const OverviewRow& row : overview.rows) names.push_back(row.name);
  std::string text = headOf("", names);
  for (std::size_t k = 0; k < overview.columns.size(); ++k) {
    const OverviewColumn& column = overview.columns[k];
    text += fmt::format("| {} |",
                        forTable(column.name + (column.asks.empty() ? "" : ": ") + column.asks));
    for (const OverviewRow& row : overview.rows)
      text += fmt::format(" {} |", forTable(textOf(row.cells[k])));
    text += "\n";
  }
  return text;
}

}  // namespace

std::string overviewText(const Overview& overview, const TextLook& look) {
  if (overview.rows.empty() || overview.columns.empty()) return {};
  std::vector<std::size_t> widths = widthsOf(overview, look.width);
  std::vector<std::size_t> begins = blocksOf(widths, look.width);
  if (begins.size() > 2) {  // heads of several lines leave room for more columns
    widths = widthsOf(overview, 0);
    begins = blocksOf(widths, look.width);
  }
  std::vector<Names> heads = {{overview.rowsAre}};
  std::size_t headHeight = 1;
  for (std::size_t k = 0; k < overview.columns.size(); ++k) {
    heads.push_back(headLines(overview.columns[k].name, widths[k + 1]));
    headHeight = std::max(headHeight, heads.back().size());
  }
  std::string text, conclusion;
  for (const std::string& sentence : overview.conclusion)
    conclusion += wrapped(sentence, look.width, 2) + "\n";
  const Shown shown = shownOf(overview, begins.size() - 1, headHeight,
                              static_cast<std::size_t>(std::ranges::count(conclusion, '\n')));
  for (std::size_t b = 0; b < shown.blocks; ++b) {
    for (std::size_t h = 0; h < headHeight; ++h) {
      const auto part = [&](std::size_t k) {
        return padded(h < heads[k].size() ? heads[k][h] : "", widths[k]);
      };
      std::string head = part(0);
      for (std::size_t k = begins[b]; k < begins[b + 1]; ++k)
        head += std::string(gap, ' ') + part(k + 1);
      text += withoutEnd(head);
    }
    for (std::size_t r = 0; r < shown.rows; ++r) {
      const OverviewRow& row = overview.rows[r];
      std::string line = padded(row.name, widths[0]);
      for (std::size_t k = begins[b]; k < begins[b + 1]; ++k) {
        const std::string cell = textOf(row.cells[k]);
        line += std::string(gap, ' ') + inColour(row.cells[k], cell, look) +
                padded(cell, widths[k + 1]).substr(cell.size());
      }
      text += withoutEnd(line);
    }
  }
  text +=
      leftOut(overview.rows.size() - shown.rows, overview.columns.size() - begins[shown.blocks]);
  return text + conclusion;
}

std::string tableMarkdown(const Table& table, const std::string& title) {
  Names names;
  for (const Column& column : table.columns) names.push_back(column.name);
  std::string text = fmt::format("# {}\n\n{}", forTable(title),
                                 headOf(names.front(), {names.begin() + 1, names.end()}));
  for (const TableRow& row : table.rows) {
    text += "|";
    for (const Cell& cell : row.cells) {
      const std::string mark(cell.marked ? lookOf(cell.verdict).mark : "");
      std::string words = mark + (mark.empty() ? "" : " ") + cell.text;
      for (const std::string& note : cell.notes) words += "; " + note;
      text += fmt::format(" {} |", forTable(words));
    }
    text += "\n";
  }
  return text + (table.note.empty() ? "" : fmt::format("\n{}\n", forTable(table.note)));
}

std::string overviewMarkdown(const Overview& overview, const std::string& title) {
  std::string text = fmt::format("# {}\n", forTable(title));
  if (!overview.rows.empty() && !overview.columns.empty())
    text += "\n" + (overview.columns.size() > mostColumns ? standing(overview) : lying(overview));
  for (const std::string& sentence : overview.conclusion)
    text += fmt::format("\n{}\n", forTable(sentence));
  return text;
}

}  // namespace crossgrain::reports
