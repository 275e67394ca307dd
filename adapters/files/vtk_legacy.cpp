/// VTK's older format, "# vtk DataFile Version 3.0", in text: what YADE's export.VTKExporter
/// writes.
#include <fmt/format.h>

#include <algorithm>

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
  /// What follows begins on a line of its own.
  void endLine() {
    if (at_ != words_.size()) text_.fail("more numbers than announced");
  }
  /// What follows is numbers.
  void skipLine() { at_ = words_.size(); }
  TextFile& text() { return text_; }

 private:
  TextFile text_;
  std::vector<std::string_view> words_;
  std::size_t at_ = 0;
};

VtkArray readArray(Words& in, std::string name, std::size_t components, std::size_t rows) {
  VtkArray array{std::move(name), components, {}};
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
  const std::string name(in.word(1));
  if (in.keyword() != "SCALARS") {
    const std::size_t components = in.keyword() == "TENSORS" ? 9 : 3;
    in.skipLine();
    return readArray(in, name, components, rows);
  }
  const std::size_t components = in.all().size() > 3 ? rowsOf(in, 3) : 1;
  if (components < 1 || components > 4) in.text().fail("SCALARS have 1 to 4 components");
  if (!in.line() || in.keyword() != "LOOKUP_TABLE")
    in.text().fail("LOOKUP_TABLE should follow SCALARS");
  in.skipLine();
  return readArray(in, name, components, rows);
}

/// FIELD name n; of each array "name components rows type", values.
void readFields(Words& in, std::vector<VtkArray>& arrays) {
  const std::size_t count = in.text().rows(static_cast<std::int64_t>(rowsOf(in, 2)), 1);
  for (std::size_t k = 0; k < count; ++k) {
    if (!in.line()) in.text().fail("an array of FIELD is missing");
    const std::string name(in.word(0));
    const std::size_t components = rowsOf(in, 1), rows = rowsOf(in, 2);
    if (components < 1 || components > 100)
      in.text().fail("an array of FIELD has 1 to 100 components");
    in.skipLine();
    arrays.push_back(readArray(in, name, components, rows));
  }
}

void readLines(Words& in, VtkData& data) {
  const std::size_t count = in.text().rows(static_cast<std::int64_t>(rowsOf(in, 1)), 3);
  in.skipLine();
  data.lines.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    if (in.number("a line") != 2.0) in.text().fail("a line that has not two points is no contact");
    const double from = in.number("a line");
    addLine(data, in.text().path().string(), from, in.number("a line"));
  }
  in.endLine();
}

}  // namespace

VtkData readVtkLegacy(const std::filesystem::path& file) {
  Words in(file);
  if (!in.line() || !in.text().line().starts_with("# vtk DataFile"))
    in.text().fail("should begin with # vtk DataFile");
  bool comment = true, ascii = false;
  VtkData data;
  std::vector<VtkArray>* arrays = nullptr;
  std::size_t rows = 0;
  while (in.line()) {
    const std::string_view keyword = in.keyword();
    if (keyword == "BINARY")
      in.text().fail("BINARY: older VTK files are read in text (ASCII) only");
    if (keyword == "ASCII") {
      ascii = true;
    } else if (!ascii) {
      if (!std::exchange(comment, false)) in.text().fail("ASCII is missing");
    } else if (keyword == "DATASET") {
      if (in.word(1) != "POLYDATA" && in.word(1) != "UNSTRUCTURED_GRID")
        in.text().fail("DATASET should be POLYDATA or UNSTRUCTURED_GRID");
    } else if (keyword == "POINTS") {
      const std::size_t count = rowsOf(in, 1);
      in.skipLine();
      const VtkArray places = readArray(in, "POINTS", 3, count);
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
    }
    // Other sections (VERTICES, CELLS, CELL_TYPES, METADATA) say nothing of particles or contacts.
  }
  if (data.points.empty()) in.text().fail("POINTS are missing");
  if (data.lines.empty()) data.lineArrays.clear();
  return data;
}

}  // namespace crossgrain::files
