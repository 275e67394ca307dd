#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "reports/common/labels.hpp"
#include "reports/common/page.hpp"
#include "results/overview.hpp"

/// A page as data, for as long as reports have no common model: sections of blocks, all texts
/// plain, and what the template report_cost.html is filled from.
namespace crossgrain::reports::costpage {

struct Cell {
  std::string text;
  std::vector<std::string> notes;  ///< in smaller letters below
  std::optional<CellState> state;  ///< its mark and colour; absent: none
  Cell(std::string text_ = {}, std::vector<std::string> notes_ = {},
       std::optional<CellState> state_ = {}, bool = true)
      : text(std::move(text_)), notes(std::move(notes_)), state(state_) {
    std::erase(notes, std::string());
  }
  Cell(const char* text_) : text(text_) {}
};

struct Column {
  enum class Kind { words, number, remark, engines };
  std::string name;
  Kind kind = Kind::words;
  Column(std::string name_, Kind kind_ = Kind::words) : name(std::move(name_)), kind(kind_) {}
  Column(const char* name_, Kind kind_ = Kind::words) : name(name_), kind(kind_) {}
};

struct TableRow {
  std::vector<Cell> cells;
  std::string group = {};  ///< a heading above the row; empty: none
};

struct Table {
  std::vector<Column> columns;
  std::vector<TableRow> rows;
  std::string note = {};
};

struct Paragraph {
  std::string text;
};
struct Item {
  std::string lead, text;
};
struct List {
  std::vector<Item> items;
};
struct Drawings {
  std::string prefix;
};
struct Code {
  std::string text;
};
struct Heading {
  std::string text;
};
using Block = std::variant<Paragraph, List, Table, Drawings, Code, Heading>;
using Blocks = std::vector<Block>;

struct Section {
  std::string id, title;
  Blocks blocks;
};

using Json = nlohmann::json;

inline Json viewOf(const Table& table) {
  constexpr std::array marks = {"✓", "≠", "≈", "✗", "○", "•", "…", "·"};
  constexpr std::array styles = {"agree", "", "", "disagree", "undecided", "", "", ""};
  Json columns = Json::array(), rows = Json::array();
  for (const Column& column : table.columns)
    columns.push_back(
        {{"name", symbolsHtml(column.name)}, {"number", column.kind == Column::Kind::number}});
  for (const TableRow& row : table.rows) {
    Json cells = Json::array();
    for (std::size_t k = 0; k < row.cells.size(); ++k) {
      const Cell& cell = row.cells[k];
      Json notes = Json::array();
      for (const std::string& note : cell.notes) notes.push_back(symbolsHtml(note));
      const auto state = static_cast<std::size_t>(cell.state.value_or(CellState::figure));
      cells.push_back({{"text", symbolsHtml(cell.text)},
                       {"mark", cell.state ? marks[state] : ""},
                       {"style", cell.state ? styles[state] : ""},
                       {"number", table.columns[k].kind == Column::Kind::number},
                       {"notes", notes}});
    }
    rows.push_back({{"group", symbolsHtml(row.group)},
                    {"hasGroup", !row.group.empty()},
                    {"span", table.columns.size()},
                    {"cells", cells}});
  }
  return {{"columns", columns}, {"rows", rows}, {"note", symbolsHtml(table.note)}};
}

inline Json viewOf(const Block& block, const Illustrations& shown) {
  if (const auto* table = std::get_if<Table>(&block)) return {{"table", viewOf(*table)}};
  if (const auto* text = std::get_if<Paragraph>(&block))
    return {{"paragraph", symbolsHtml(text->text)}};
  if (const auto* code = std::get_if<Code>(&block)) return {{"code", code->text}};
  if (const auto* heading = std::get_if<Heading>(&block))
    return {{"heading", symbolsHtml(heading->text)}};
  if (const auto* drawings = std::get_if<Drawings>(&block))
    return {{"figures", figureViews(shown, drawings->prefix)}};
  Json items = Json::array();
  for (const Item& item : std::get<List>(block).items)
    items.push_back({{"lead", item.lead}, {"text", symbolsHtml(item.text)}});
  return {{"list", {{"items", items}}}};
}

inline Json viewOf(const std::vector<Section>& sections, const Illustrations& shown) {
  Json view = Json::array();
  for (const Section& section : sections) {
    Json blocks = Json::array();
    for (const Block& block : section.blocks) blocks.push_back(viewOf(block, shown));
    view.push_back({{"id", section.id}, {"title", section.title}, {"blocks", blocks}});
  }
  return view;
}

}  // namespace crossgrain::reports::costpage
