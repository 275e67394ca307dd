/// CSV files of particles and of contacts, a line of column names before the rows. Columns are
/// parted by commas, or by semicolons or tabs where their names are. Comments begin with #. Rows of
/// one time follow one another; a file without t is one time.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "adapters/files/readers.hpp"
#include "adapters/files/series.hpp"
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

/// Rows up to the next time.
class Csv : public TextParts {
 public:
  Csv(Files files, std::shared_ptr<const ColumnOptions> columns, Content content,
      std::optional<FileBox> box = {})
      : TextParts(std::move(files)),
        options_(std::move(columns)),
        content_(content),
        box_(std::move(box)) {}

 protected:
  void begin(TextFile& text) override {
    const Header header = headerOf(text);
    columns_ = columnsOf(text, header, *options_);
    separator_ = header.separator == '\t' ? ' ' : header.separator;  // as readRow() calls tabs
    if (content_ == Content::contacts)
      checkContactColumns(columns_, text);
    else if (!columns_.has(Meaning::x) || !columns_.has(Meaning::y))
      text.fail("the columns x and y are missing");
    fromName_ = numberInName(text.path());
    if (!alone() && !fromName_) fromName_ = 0;
    if (!text.nextUncommented('#')) text.fail("there are no rows below the column names");
    text.back();
  }

  Part read(TextFile& text) override {
    Part part;
    FileFrame& frame = part.frame;
    frame.box = box_;
    const bool timed = columns_.has(Meaning::time), stepped = columns_.has(Meaning::step);
    if (content_ == Content::contacts) part.table.emplace();
    bool first = true;
    while (text.nextUncommented('#')) {
      columns_.read(text, separator_);
      const bool isNext =
          !first && ((timed && columns_[Meaning::time] != *frame.time) ||
                     (stepped && columns_[Meaning::step] != static_cast<double>(*frame.step)));
      if (isNext) {
        text.back();
        break;
      }
      if (first && timed) frame.time = columns_[Meaning::time];
      if (first && stepped) frame.step = wholeNumber(text, columns_[Meaning::step], "step");
      first = false;
      if (part.table)
        addContact(*part.table, columns_, text);
      else
        addParticle(frame.particles, columns_, text);
    }
    if (!timed && !stepped) frame.step = fromName_;
    frame.alone = !timed && !stepped && alone();
    frame.where = text.path().string();
    if (timed)
      frame.where += fmt::format(", t = {}", *frame.time);
    else if (!frame.alone)
      frame.where += fmt::format(", step {}", *frame.step);
    return part;
  }

 private:
  std::shared_ptr<const ColumnOptions> options_;
  Content content_;
  std::optional<FileBox> box_;
  Columns columns_;
  char separator_ = ',';
  std::optional<std::int64_t> fromName_;
};

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
    contacts.push_back(std::make_unique<Csv>(std::move(list), columns, Content::contacts));
  return joinParts(std::make_unique<Csv>(filesOf(files, Content::particles, contentOfCsv), columns,
                                         Content::particles, options.box),
                   std::move(contacts), columns);
}

}  // namespace crossgrain::files
