/// CSV files of particles and of contacts, a line of column names before the rows. Columns are
/// parted by commas, or by semicolons or tabs where their names are. Comments begin with #. Rows of
/// one time follow one another; a file without t is one time.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "adapters/files/readers.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::files {
namespace fs = std::filesystem;
namespace {

/// Columns of start files that say nothing of a time.
bool isOfStartFiles(std::string_view name) {
  return name == "inertia" || name == "fixed" || name == "material";
}

/// The names of columns and their separator.
struct Header {
  std::vector<std::string> names;
  char separator = ',';
};

/// Goes on to the line of names. @throws BadInput
Header headerOf(TextFile& text) {
  if (!text.nextUncommented('#')) text.fail("there is no line of column names");
  Header header;
  const auto separator = separatorOf(text.line());
  const bool single =
      words(text.line()).size() == 1 && text.line().find(',') == std::string_view::npos;
  if (!separator && !single)
    text.fail("commas, or semicolons, or tabs should part the names of columns");
  header.separator = separator.value_or(',');
  for (const std::string_view name : separatedWords(text.line(), header.separator))
    header.names.emplace_back(name);
  return header;
}

Columns columnsOf(const TextFile& text, const Header& header, const ColumnOptions& options) {
  std::vector<Meaning> meanings;
  for (const std::string& name : header.names) {
    const std::optional<Meaning> said = options.of(name);
    meanings.push_back(said.value_or(meaningOf(name)));
    if (!said && meanings.back() == Meaning::none && !isOfStartFiles(name))
      text.fail(
          fmt::format("{} is none of the names of columns{}; columns = {}=MEANING says what it is, "
                      "{}=- leaves it out",
                      name, suggestedMeaning(name), name, name));
  }
  Columns columns(std::move(meanings));
  columns.checkDistinct(text);
  return columns;
}

/// A file's columns, and the step that its name says.
struct Table {
  Columns columns;
  char separator = ',';
  std::optional<std::int64_t> fromName;
};

/// @param alone  there is no other file
Table tableOf(TextFile& text, const ColumnOptions& options, Content content, bool alone) {
  const Header header = headerOf(text);
  Table table{columnsOf(text, header, options),
              header.separator == '\t' ? ' ' : header.separator,  // as readRow() calls tabs
              numberInName(text.path())};
  if (content == Content::contacts)
    checkContactColumns(table.columns, text);
  else if (!table.columns.has(Meaning::x) || !table.columns.has(Meaning::y))
    text.fail("the columns x and y are missing");
  if (!alone && !table.fromName) table.fromName = 0;
  if (!text.nextUncommented('#')) text.fail("there are no rows below the column names");
  text.back();
  return table;
}

/// Rows up to the next time.
Part readRows(TextFile& text, Table& table, Content content, bool alone) {
  Columns& columns = table.columns;
  Part part;
  FileFrame& frame = part.frame;
  const bool timed = columns.has(Meaning::time), stepped = columns.has(Meaning::step);
  if (content == Content::contacts) part.table.emplace();
  bool first = true;
  while (text.nextUncommented('#')) {
    columns.read(text, table.separator);
    const bool isNext =
        !first && ((timed && columns[Meaning::time] != *frame.time) ||
                   (stepped && columns[Meaning::step] != static_cast<double>(*frame.step)));
    if (isNext) {
      text.back();
      break;
    }
    if (first && timed) frame.time = columns[Meaning::time];
    if (first && stepped) frame.step = wholeNumber(text, columns[Meaning::step], "step");
    first = false;
    if (part.table)
      addContact(*part.table, columns, text);
    else
      addParticle(frame.particles, columns, text);
  }
  if (!timed && !stepped) frame.step = table.fromName;
  frame.alone = !timed && !stepped && alone;
  frame.where = text.path().string();
  if (timed)
    frame.where += fmt::format(", t = {}", *frame.time);
  else if (!frame.alone)
    frame.where += fmt::format(", step {}", *frame.step);
  return part;
}

std::unique_ptr<PartReader> tables(Files files, std::shared_ptr<const ColumnOptions> options,
                                   Content content, std::optional<FileBox> box = {}) {
  const bool alone = files.size() == 1;
  const auto table = std::make_shared<Table>();
  return std::make_unique<TextParts>(
      std::move(files),
      [=](TextFile& text) {
        Part part = readRows(text, *table, content, alone);
        part.frame.box = box;
        return part;
      },
      [=](TextFile& text) { *table = tableOf(text, *options, content, alone); });
}

}  // namespace

Content contentOfCsv(const fs::path& file) {
  TextFile text(file);
  const auto names = headerOf(text).names;
  const auto has = [&](Meaning meaning) {
    return std::ranges::find(names, meaning, meaningOf) != names.end();
  };
  if (has(Meaning::first) || has(Meaning::second)) return Content::contacts;
  if (has(Meaning::x) || has(Meaning::radius)) return Content::particles;
  // Names of one's own: what the file's says.
  const std::string name = lowered(file.filename().string());
  for (const char* word : {"contact", "pair", "intr", "interaction"})
    if (name.find(word) != std::string::npos) return Content::contacts;
  return Content::particles;
}

double firstTimeOfCsv(const fs::path& file) {
  TextFile text(file);
  const auto [names, separator] = headerOf(text);
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (meaningOf(names[k]) != Meaning::time && meaningOf(names[k]) != Meaning::step) continue;
    const auto row = text.nextUncommented('#') ? separatedWords(text.line(), separator)
                                               : std::vector<std::string_view>();
    if (row.size() != names.size()) text.fail("there is no row below the column names");
    return numberOf(text, row[k], names[k]);
  }
  return static_cast<double>(numberInName(file).value_or(0));
}

std::unique_ptr<FrameReader> openCsv(const Files& files, const FileOptions& options) {
  const auto columns = std::make_shared<const ColumnOptions>(options.columns);
  std::vector<std::unique_ptr<PartReader>> contacts;
  for (Files& list : bySeries(filesOf(files, Content::contacts, contentOfCsv)))
    contacts.push_back(tables(std::move(list), columns, Content::contacts));
  return joinParts(tables(filesOf(files, Content::particles, contentOfCsv), columns,
                          Content::particles, options.box),
                   std::move(contacts), columns);
}

}  // namespace crossgrain::files
