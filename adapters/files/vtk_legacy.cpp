/// VTK's older format, "# vtk DataFile Version 3.0": in text, what YADE's export.VTKExporter
/// writes, or with its numbers in binary, the highest byte first, each section behind its line:
/// https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html
#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "adapters/files/text_file.hpp"
#include "adapters/files/vtk_data.hpp"

namespace crossgrain::files {
namespace {

/// Words of a file, line ends counting as blanks.
class Words {
 public:
  explicit Words(const std::filesystem::path& file) : text_(file) {}

  /// The next line, of which nothing was taken yet; false after the last.
  bool line() {
    words_.clear();
    at_ = 0;
    if (!text_.next()) return false;
    words_ = files::words(text_.line());
    return true;
  }
  const std::vector<std::string_view>& all() const { return words_; }
  std::string_view keyword() const { return words_.front(); }
  std::string_view word(std::size_t k) const {
    if (k >= words_.size()) text_.fail(fmt::format("something is missing after {}", keyword()));
    return words_[k];
  }
  double number(std::string_view what) {
    while (at_ == words_.size()) {
      text_.need(what);
      words_ = files::words(text_.line());
      at_ = 0;
    }
    return numberOf(text_, words_[at_++], what);
  }
  /// Requires that all numbers of the line are read: the next section begins on a new line.
  void endLine() {
    if (at_ != words_.size()) text_.fail("more numbers than announced");
  }
  /// Skips the rest of the line: numbers follow.
  void skipLine() { at_ = words_.size(); }
  TextFile& text() { return text_; }
  const TextFile& text() const { return text_; }

  bool binary = false;

 private:
  TextFile text_;
  std::vector<std::string_view> words_;
  std::size_t at_ = 0;
};

/// So many numbers of a type of VTK's, in binary, the highest byte first.
std::vector<double> binaryNumbers(TextFile& text, std::string_view name, std::size_t count) {
  const VtkType* const type = vtkTypeOf(&VtkType::before, name);
  if (!type) text.fail(fmt::format("{} is no type of number that is read in binary", name));
  if (count > text.size()) text.fail(fmt::format("{} numbers are announced", count));
  std::vector<std::byte> bytes(type->size * count);
  text.take(bytes);
  return type->read(bytes, std::endian::native == std::endian::little);
}

VtkArray readArray(Words& in, std::string name, std::size_t components, std::size_t rows,
                   const std::string& type) {
  VtkArray array{std::move(name), components, {}};
  if (in.binary) {
    if (rows > in.text().size()) in.text().fail(fmt::format("{} rows are announced", rows));
    array.values = binaryNumbers(in.text(), type, rows * components);
    return array;
  }
  const std::size_t count =
      in.text().rows(static_cast<std::int64_t>(rows), components) * components;
  array.values.reserve(count);
  for (std::size_t k = 0; k < count; ++k) array.values.push_back(in.number(array.name));
  in.endLine();
  return array;
}

std::size_t rowsOf(Words& in, std::size_t word) {
  return static_cast<std::size_t>(countOf(in.text(), in.word(word), in.keyword()));
}

/// SCALARS name type [components]; LOOKUP_TABLE; values. VECTORS, NORMALS, TENSORS name type;
/// values.
VtkArray readAttribute(Words& in, std::size_t rows) {
  const std::string name(in.word(1)), type(in.word(2));
  if (in.keyword() != "SCALARS") {
    const std::size_t components = in.keyword() == "TENSORS" ? 9 : 3;
    in.skipLine();
    return readArray(in, name, components, rows, type);
  }
  const std::size_t components = in.all().size() > 3 ? rowsOf(in, 3) : 1;
  if (components < 1 || components > 4) in.text().fail("SCALARS have 1 to 4 components");
  if (!in.line() || in.keyword() != "LOOKUP_TABLE")
    in.text().fail("LOOKUP_TABLE should follow SCALARS");
  in.skipLine();
  return readArray(in, name, components, rows, type);
}

/// FIELD name n; of each array "name components rows type", values.
void readFields(Words& in, std::vector<VtkArray>& arrays) {
  const std::size_t count = in.text().rows(static_cast<std::int64_t>(rowsOf(in, 2)), 1);
  for (std::size_t k = 0; k < count; ++k) {
    if (!in.line()) in.text().fail("an array of FIELD is missing");
    const std::string name(in.word(0));
    const std::size_t components = rowsOf(in, 1), rows = rowsOf(in, 2);
    const std::string type(in.word(3));
    if (components < 1 || components > 100)
      in.text().fail("an array of FIELD has 1 to 100 components");
    in.skipLine();
    arrays.push_back(readArray(in, name, components, rows, type));
  }
}

void readLines(Words& in, VtkData& data) {
  const std::string where = in.text().path().string();
  if (in.binary) {
    const std::size_t lines = rowsOf(in, 1);
    if (rowsOf(in, 2) != 3 * lines) in.text().fail("a line that has not two points is no contact");
    const std::vector<double> ends = binaryNumbers(in.text(), "int", 3 * lines);
    for (std::size_t k = 0; k < lines; ++k) addLine(data, where, ends[3 * k + 1], ends[3 * k + 2]);
    return;
  }
  const std::size_t count = in.text().rows(static_cast<std::int64_t>(rowsOf(in, 1)), 3);
  in.skipLine();
  data.lines.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    if (in.number("a line") != 2.0) in.text().fail("a line that has not two points is no contact");
    const double from = in.number("a line");
    addLine(data, where, from, in.number("a line"));
  }
  in.endLine();
}

/// Skips the numbers of a binary file's sections that have no particles or contacts: 32-bit
/// integers.
void skipCells(Words& in) {
  const std::string_view keyword = in.keyword();
  if (keyword == "CELL_TYPES") return in.text().skip(4 * std::min(rowsOf(in, 1), in.text().size()));
  for (const char* const cells : {"VERTICES", "CELLS", "POLYGONS", "TRIANGLE_STRIPS"})
    if (keyword == cells) return in.text().skip(4 * std::min(rowsOf(in, 2), in.text().size()));
}

/// The first line and how numbers are written. Of version 5 cells are written in another way.
void readHead(Words& in) {
  if (!in.line() || !in.text().line().starts_with("# vtk DataFile"))
    in.text().fail("should begin with # vtk DataFile");
  const bool isNew = in.all().size() > 4 && in.word(4).starts_with('5');
  for (bool comment = true; in.line(); comment = false) {
    in.binary = in.keyword() == "BINARY";
    if (in.binary && isNew)
      in.text().fail("binary files are read of versions before 5: write version 4.2, or .vtp");
    if (in.binary || in.keyword() == "ASCII") return;
    if (!comment) break;
  }
  in.text().fail("ASCII is missing");
}

}  // namespace

VtkData readVtkLegacy(const std::filesystem::path& file) {
  Words in(file);
  readHead(in);
  VtkData data;
  std::vector<VtkArray>* arrays = nullptr;
  std::size_t rows = 0;
  while (in.line()) {
    const std::string keyword(in.keyword());
    if (keyword == "DATASET") {
      if (in.word(1) != "POLYDATA" && in.word(1) != "UNSTRUCTURED_GRID")
        in.text().fail("DATASET should be POLYDATA or UNSTRUCTURED_GRID");
    } else if (keyword == "POINTS") {
      const std::size_t count = rowsOf(in, 1);
      const std::string type(in.word(2));
      in.skipLine();
      const VtkArray places = readArray(in, "POINTS", 3, count, type);
      for (std::size_t k = 0; k < places.rows(); ++k) data.points.push_back(places.vector(k));
    } else if (keyword == "LINES") {
      readLines(in, data);
    } else if (keyword == "POINT_DATA" || keyword == "CELL_DATA") {
      arrays = keyword == "POINT_DATA" ? &data.pointArrays : &data.lineArrays;
      rows = rowsOf(in, 1);
      const std::size_t expected = keyword == "POINT_DATA" ? data.points.size() : data.lines.size();
      if (rows != expected && expected > 0)
        in.text().fail(fmt::format("{} of {}, there are {}", keyword, rows, expected));
    } else if (arrays && (keyword == "SCALARS" || keyword == "VECTORS" || keyword == "NORMALS" ||
                          keyword == "TENSORS")) {
      arrays->push_back(readAttribute(in, rows));
    } else if (keyword == "FIELD") {
      std::vector<VtkArray> ofFile;
      readFields(in, arrays ? *arrays : ofFile);
    } else if (in.binary) {
      skipCells(in);
    }
    // Of text, other sections (VERTICES, CELLS, CELL_TYPES, METADATA) are lines that say nothing.
  }
  if (data.points.empty()) in.text().fail("POINTS are missing");
  if (data.lines.empty()) data.lineArrays.clear();
  return data;
}

bool legacyHasLines(const std::filesystem::path& file) {
  Words in(file);
  readHead(in);
  while (in.line()) {
    if (in.keyword() == "LINES") return true;
    if (in.keyword() == "POINT_DATA" || in.keyword() == "CELL_DATA") return false;
    if (!in.binary) continue;
    if (in.keyword() == "POINTS") {
      const std::string type(in.word(2));
      readArray(in, "POINTS", 3, rowsOf(in, 1), type);
    } else {
      skipCells(in);
    }
  }
  return false;
}

}  // namespace crossgrain::files
