/// VTK's XML files, as vtkXMLDataParser reads them:
/// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <optional>
#include <pugixml.hpp>

#include "adapters/files/readers.hpp"
#include "adapters/files/vtk_data.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/input_file.hpp"

namespace crossgrain::files {
namespace fs = std::filesystem;
namespace {

using Bytes = std::vector<unsigned char>;

/// Of base64, −1 for other characters.
constexpr std::array<signed char, 256> sixBits = [] {
  std::array<signed char, 256> table{};
  for (auto& value : table) value = -1;
  constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (signed char k = 0; k < 64; ++k) table[static_cast<unsigned char>(letters[k])] = k;
  return table;
}();

/// A case has a million particles at most, and walls of as many.
constexpr std::size_t mostPoints = 4'000'000;

constexpr std::size_t charactersOf(std::size_t bytes) {
  return (bytes + 2) / 3 * 4;
}

/// A whole file, of which binary content is read without the parser.
class XmlFile {
 public:
  explicit XmlFile(const fs::path& file);

  VtkData data() const;  ///< of all pieces, one after the other
  /// Of an index, the files that hold its pieces; of any other file none.
  std::vector<fs::path> pieces() const;

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw BadInput(fmt::format("{}: {}", file_.string(), what));
  }
  /// An array's numbers as they stand in the file.
  struct Source {
    std::string_view name, text;
    bool base64 = false;
  };

  VtkData piece(const pugi::xml_node& piece, bool isPolyData) const;
  void add(VtkData& all, VtkData next) const;
  void append(std::vector<VtkArray>& arrays, std::vector<VtkArray> more) const;
  VtkArray array(const pugi::xml_node& node, std::size_t rows) const;
  std::vector<VtkArray> arrays(const pugi::xml_node& section, std::size_t rows) const;
  Bytes bytes(Source source, std::uint64_t expected) const;
  Bytes packedBytes(const Source& source, std::uint64_t expected) const;
  Bytes take(const Source& source, std::size_t from, std::size_t count) const;
  std::uint64_t header(const Bytes& bytes, std::size_t k) const;
  std::vector<double> numbersIn(std::string_view name, std::string_view text) const;
  std::size_t countOf(const pugi::xml_node& node, const char* name) const;

  fs::path file_;
  std::string content_;
  std::string_view appended_;
  bool appendedBase64_ = false, packed_ = false, swapped_ = false;
  std::size_t headerSize_ = 4;
  pugi::xml_document document_;
};

XmlFile::XmlFile(const fs::path& file) : file_(file) {
  if (const std::string why = fileFault(file); !why.empty()) fail(why);
  constexpr std::size_t most = std::size_t{1} << 34;
  content_ = readFile(file, most).value_or("");
  // Raw bytes are no XML: they are cut out before it is parsed.
  std::string xml;
  if (const std::size_t tag = content_.find("<AppendedData"); tag != std::string::npos) {
    const std::size_t start = content_.find('>', tag);
    const std::size_t stop = content_.rfind("</AppendedData>");
    const std::size_t mark = content_.find('_', start);
    if (start == std::string::npos || stop == std::string::npos || mark == std::string::npos ||
        mark > stop)
      fail("the end of <AppendedData> is missing: the file was cut off");
    appended_ = std::string_view(content_).substr(mark + 1, stop - mark - 1);
    xml.assign(content_, 0, start + 1).append(content_, stop);
  } else {
    xml = content_;
  }
  const pugi::xml_parse_result result = document_.load_buffer(xml.data(), xml.size());
  if (!result) fail(fmt::format("no XML at byte {}: {}", result.offset, result.description()));
  const pugi::xml_node root = document_.child("VTKFile");
  if (!root) fail("there is no <VTKFile>");
  const std::string_view packing = root.attribute("compressor").value();
  if (!packing.empty() && packing != "vtkZLibDataCompressor")
    fail(fmt::format("it is packed by {}: vtkZLibDataCompressor is read", packing));
  packed_ = !packing.empty();
  const std::string_view order = root.attribute("byte_order").value();
  swapped_ = (order == "BigEndian") != (std::endian::native == std::endian::big) && !order.empty();
  headerSize_ = std::string_view(root.attribute("header_type").value()) == "UInt64" ? 8 : 4;
  const std::string_view encoding = root.child("AppendedData").attribute("encoding").value();
  if (!appended_.empty() && encoding != "base64" && encoding != "raw")
    fail(fmt::format("AppendedData: encoding \"{}\" should be raw or base64", encoding));
  appendedBase64_ = encoding == "base64";
}

std::size_t XmlFile::countOf(const pugi::xml_node& node, const char* name) const {
  const std::string_view text = node.attribute(name).value();
  std::size_t value = 0;
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return 0;
  const auto [end, error] = std::from_chars(text.data() + first, text.data() + text.size(), value);
  if (error != std::errc()) fail(fmt::format("{}=\"{}\" should be a number", name, text));
  return value;
}

/// Bytes from a place on, which in base64 is the first character of what was encoded in one go.
Bytes XmlFile::take(const Source& source, std::size_t from, std::size_t count) const {
  const std::string_view& text = source.text;
  const std::size_t length = source.base64 ? charactersOf(count) : count;
  if (from > text.size() || count > text.size() || length > text.size() - from)
    fail(fmt::format("{}: its data end too early: the file was cut off, or the size in it is wrong",
                     source.name));
  Bytes bytes;
  bytes.reserve(count + 2);
  if (!source.base64) {
    bytes.assign(text.begin() + static_cast<long>(from),
                 text.begin() + static_cast<long>(from + count));
    return bytes;
  }
  for (std::size_t k = from; k < from + length; k += 4) {
    std::uint32_t group = 0;
    for (std::size_t l = k; l < k + 4; ++l) {
      const signed char six = sixBits[static_cast<unsigned char>(text[l])];
      if (six < 0 && text[l] != '=') fail(fmt::format("{}: its data are no base64", source.name));
      group = group << 6 | static_cast<std::uint32_t>(six < 0 ? 0 : six);
    }
    for (const int shift : {16, 8, 0}) bytes.push_back(static_cast<unsigned char>(group >> shift));
  }
  bytes.resize(count);
  return bytes;
}

std::uint64_t XmlFile::header(const Bytes& bytes, std::size_t k) const {
  std::uint64_t value = 0;
  for (std::size_t l = 0; l < headerSize_; ++l) {
    const bool lowFirst = (std::endian::native == std::endian::little) != swapped_;
    const std::size_t at = lowFirst ? headerSize_ - 1 - l : l;
    value = value << 8 | bytes[k * headerSize_ + at];
  }
  return value;
}

/// A number of bytes, then these.
Bytes XmlFile::bytes(Source source, std::uint64_t expected) const {
  if (packed_) return packedBytes(source, expected);
  const std::uint64_t count = header(take(source, 0, headerSize_), 0);
  const std::size_t headerLength = source.base64 ? charactersOf(headerSize_) : headerSize_;
  if (count > source.text.size())
    fail(fmt::format("{}: {} bytes of it are not there: the file was cut off", source.name, count));
  // The head is encoded by itself, padded, or together with what follows.
  if (!source.base64 || source.text[headerLength - 1] == '=')
    return take(source, headerLength, static_cast<std::size_t>(count));
  Bytes all = take(source, 0, headerSize_ + static_cast<std::size_t>(count));
  all.erase(all.begin(), all.begin() + static_cast<long>(headerSize_));
  return all;
}

/// Number of blocks, their size, size of the last (0: as the others), packed size of each; blocks.
/// @param expected  bytes that they should hold
Bytes XmlFile::packedBytes(const Source& source, std::uint64_t expected) const {
  const std::uint64_t blocks = header(take(source, 0, headerSize_), 0);
  if (blocks > source.text.size() / headerSize_)
    fail(fmt::format("{}: {} packed blocks are not there", source.name, blocks));
  const std::size_t headerBytes = (3 + static_cast<std::size_t>(blocks)) * headerSize_;
  const Bytes head = take(source, 0, blocks == 0 ? headerSize_ : headerBytes);
  if (blocks == 0) return {};
  const std::uint64_t size = header(head, 1), last = header(head, 2);
  // Before room is taken: zlib packs what is alike into a thousandth. Some other number of rows is
  // the caller's to name.
  const std::uint64_t most = 2 * expected + (std::uint64_t{1} << 20);
  // The size is the nominal one, of which an only block may be a part.
  const std::uint64_t lastSize = last != 0 ? last : size;
  if (last > size || lastSize > most || (blocks > 1 && size > most) ||
      (blocks - 1) * size + lastSize > most)
    fail(fmt::format("{}: {} packed blocks of {} bytes are more than the {} bytes of its rows",
                     source.name, blocks, size, expected));
  std::uint64_t packedSize = 0;
  for (std::size_t k = 0; k < blocks; ++k) {
    const std::uint64_t one = header(head, 3 + k);
    if (one > source.text.size())
      fail(fmt::format("{}: a packed block is larger than the file", source.name));
    packedSize += one;
  }
  const std::size_t headerLength = source.base64 ? charactersOf(headerBytes) : headerBytes;
  const Bytes packed = take(source, headerLength, static_cast<std::size_t>(packedSize));
  Bytes out;
  constexpr std::uint64_t mostPacked = 1032;  // zlib packs so many bytes into one
  for (std::size_t k = 0, at = 0; k < blocks; ++k) {
    const auto length = static_cast<std::size_t>(header(head, 3 + k));
    const std::uint64_t own = k + 1 == blocks && last != 0 ? last : size;
    if (own > mostPacked * length + 64)
      fail(fmt::format("{}: a block of {} bytes cannot hold {}", source.name, length, own));
    const std::size_t before = out.size();
    out.resize(before + static_cast<std::size_t>(own));
    uLongf got = static_cast<uLongf>(own);
    if (uncompress(out.data() + before, &got, packed.data() + at, length) != Z_OK || got != own)
      fail(fmt::format("{}: a packed block is damaged", source.name));
    at += length;
  }
  return out;
}

std::vector<double> XmlFile::numbersIn(std::string_view name, std::string_view text) const {
  std::vector<double> values;
  constexpr const char* blanks = " \t\r\n";
  for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;
       at = text.find_first_not_of(blanks, at)) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
    if (error != std::errc())
      fail(fmt::format("{}: \"{}\" should be a number", name, text.substr(at, 20)));
    values.push_back(value);
    at = static_cast<std::size_t>(end - text.data());
  }
  return values;
}

/// @param rows  that it should have
VtkArray XmlFile::array(const pugi::xml_node& node, std::size_t rows) const {
  VtkArray found;
  found.name = node.attribute("Name").value();
  if (node.attribute("NumberOfComponents")) found.components = countOf(node, "NumberOfComponents");
  if (found.components < 1 || found.components > 100)
    fail(fmt::format("{}: {} components", found.name, found.components));
  const std::string_view format = node.attribute("format").value(),
                         type = node.attribute("type").value();
  Source source{found.name, node.child_value(), true};
  if (format == "ascii") {
    found.values = numbersIn(found.name, source.text);
  } else {
    if (format == "appended") {
      const std::size_t offset = countOf(node, "offset");
      if (offset > appended_.size())
        fail(fmt::format("{}: its data are not in the file", found.name));
      source.text = appended_.substr(offset);
      source.base64 = appendedBase64_;
    } else if (format == "binary") {
      const std::size_t first = source.text.find_first_not_of(" \t\r\n");
      source.text.remove_prefix(std::min(first, source.text.size()));
    } else {
      fail(
          fmt::format("{}: format \"{}\" should be ascii, binary or appended", found.name, format));
    }
    const VtkType* const known = vtkTypeOf(&VtkType::name, type);
    if (!known) fail(fmt::format("{}: type \"{}\" is no number that is read", found.name, type));
    const Bytes raw = bytes(source, known->size * rows * found.components);
    found.values = known->read(std::as_bytes(std::span(raw)), swapped_);
  }
  if (found.values.size() % found.components != 0 || found.rows() != rows)
    fail(fmt::format(
        "{} has {} rows, there should be {}{}", found.name, found.rows(), rows,
        found.name == "forceN"
            ? " (contacts over a periodic edge? YADE's VTKRecorder writes them wrongly: "
              "use export.VTKExporter)"
            : ""));
  return found;
}

std::vector<VtkArray> XmlFile::arrays(const pugi::xml_node& section, std::size_t rows) const {
  std::vector<VtkArray> found;
  for (const pugi::xml_node& node : section.children("DataArray"))
    if (std::string_view(node.attribute("type").value()) != "String")
      found.push_back(array(node, rows));
  return found;
}

VtkData XmlFile::piece(const pugi::xml_node& piece, bool isPolyData) const {
  VtkData data;
  const std::size_t points = countOf(piece, "NumberOfPoints"),
                    lines = countOf(piece, "NumberOfLines");
  const pugi::xml_node place = piece.child("Points").child("DataArray");
  if (!place) fail("<Points> are missing");
  if (points > mostPoints)
    fail(fmt::format("{} points: there should be {} at most", points, mostPoints));
  const VtkArray places = array(place, points);
  if (places.components != 3) fail("Points should have 3 components");
  data.points.reserve(points);
  for (std::size_t k = 0; k < points; ++k) data.points.push_back(places.vector(k));
  data.pointArrays = arrays(piece.child("PointData"), points);
  if (!isPolyData) return data;
  if (lines > 0) {
    const pugi::xml_node section = piece.child("Lines");
    const VtkArray ends =
        array(section.find_child_by_attribute("DataArray", "Name", "connectivity"), 2 * lines);
    for (std::size_t k = 0; k < lines; ++k)
      addLine(data, file_.string(), ends.values[2 * k], ends.values[2 * k + 1]);
  }
  // Cells of other kinds have rows, too: particles as vertices.
  const pugi::xml_node cells = piece.child("CellData");
  if (lines > 0 || cells.find_child_by_attribute("DataArray", "Name", "forceN"))
    data.lineArrays = arrays(cells, lines);
  return data;
}

/// A piece after those before. One without points says nothing of arrays.
void XmlFile::add(VtkData& all, VtkData next) const {
  if (all.points.empty()) {
    if (!next.points.empty() || all.pointArrays.empty()) all = std::move(next);
    return;
  }
  if (next.points.empty() && next.lines.empty()) return;
  const std::size_t before = all.points.size();
  for (const auto& [from, to] : next.lines) all.lines.emplace_back(before + from, before + to);
  all.points.insert(all.points.end(), next.points.begin(), next.points.end());
  append(all.pointArrays, std::move(next.pointArrays));
  if (all.lineArrays.empty())
    all.lineArrays = std::move(next.lineArrays);
  else if (!next.lines.empty())
    append(all.lineArrays, std::move(next.lineArrays));
}

/// Those of the next piece, which has the same.
void XmlFile::append(std::vector<VtkArray>& arrays, std::vector<VtkArray> more) const {
  if (more.size() != arrays.size())
    fail(fmt::format("a <Piece> has {} arrays, the one before {}", more.size(), arrays.size()));
  for (std::size_t k = 0; k < more.size(); ++k) {
    if (more[k].name != arrays[k].name || more[k].components != arrays[k].components)
      fail(fmt::format("a <Piece> has {} where the one before has {}", more[k].name,
                       arrays[k].name));
    arrays[k].values.insert(arrays[k].values.end(), more[k].values.begin(), more[k].values.end());
  }
}

std::vector<fs::path> XmlFile::pieces() const {
  const pugi::xml_node root = document_.child("VTKFile");
  const std::string_view type = root.attribute("type").value();
  std::vector<fs::path> files;
  if (type != "PUnstructuredGrid" && type != "PPolyData") return files;
  for (const pugi::xml_node& node : root.child(root.attribute("type").value()).children("Piece"))
    files.push_back(file_.parent_path() / node.attribute("Source").value());
  if (files.empty()) fail("it is an index without a <Piece>");
  return files;
}

/// Points that another piece has, too, are no particles of their own.
void dropGhosts(VtkData& data) {
  const auto ghosts = std::ranges::find(data.pointArrays, "vtkGhostType", &VtkArray::name);
  if (ghosts == data.pointArrays.end() || !data.lines.empty()) return;
  const std::vector<double> isGhost = ghosts->values;
  const auto keep = [&](auto& values, std::size_t width) {
    std::size_t kept = 0;
    for (std::size_t row = 0; row < isGhost.size(); ++row)
      for (std::size_t k = 0; isGhost[row] == 0.0 && k < width; ++k)
        values[kept++] = values[row * width + k];
    values.resize(kept);
  };
  for (VtkArray& array : data.pointArrays) keep(array.values, array.components);
  keep(data.points, 1);
}

VtkData XmlFile::data() const {
  const pugi::xml_node root = document_.child("VTKFile");
  const std::string_view type = root.attribute("type").value();
  if (const auto files = pieces(); !files.empty()) {
    VtkData all;
    for (const fs::path& file : files) {
      const XmlFile one(file);
      if (!one.pieces().empty()) one.fail("an index should name files of points, not an index");
      VtkData next = one.data();
      dropGhosts(next);
      add(all, std::move(next));
    }
    return all;
  }
  if (type != "UnstructuredGrid" && type != "PolyData")
    fail(fmt::format("VTKFile type \"{}\" should be UnstructuredGrid or PolyData", type));
  VtkData all;
  bool any = false;
  for (const pugi::xml_node& node : root.child(root.attribute("type").value()).children("Piece")) {
    add(all, piece(node, type == "PolyData"));
    any = true;
  }
  if (!any) fail("there is no <Piece>");
  return all;
}

}  // namespace

std::vector<fs::path> piecesOfVtk(const fs::path& file) {
  return XmlFile(file).pieces();
}

VtkData readVtkXml(const fs::path& file) {
  return XmlFile(file).data();
}

namespace {

template <typename T>
constexpr VtkType vtkType(std::string_view name, std::string_view before) {
  return {name, before, sizeof(T), [](std::span<const std::byte> bytes, bool swapped) {
            std::vector<double> values(bytes.size() / sizeof(T));
            for (std::size_t k = 0; k < values.size(); ++k) {
              std::array<std::byte, sizeof(T)> raw;
              std::ranges::copy(bytes.subspan(k * sizeof(T), sizeof(T)), raw.begin());
              if (swapped) std::ranges::reverse(raw);
              values[k] = static_cast<double>(std::bit_cast<T>(raw));
            }
            return values;
          }};
}

}  // namespace

const VtkType* vtkTypeOf(std::string_view VtkType::*named, std::string_view name) {
  static constexpr VtkType types[] = {vtkType<double>("Float64", "double"),
                                      vtkType<float>("Float32", "float"),
                                      vtkType<std::int64_t>("Int64", "long"),
                                      vtkType<std::int64_t>("Int64", "vtktypeint64"),
                                      vtkType<std::uint64_t>("UInt64", "unsigned_long"),
                                      vtkType<std::int32_t>("Int32", "int"),
                                      vtkType<std::int32_t>("Int32", "vtkIdType"),
                                      vtkType<std::uint32_t>("UInt32", "unsigned_int"),
                                      vtkType<std::int16_t>("Int16", "short"),
                                      vtkType<std::uint16_t>("UInt16", "unsigned_short"),
                                      vtkType<std::int8_t>("Int8", "char"),
                                      vtkType<std::uint8_t>("UInt8", "unsigned_char")};
  const auto* const known = std::ranges::find(types, name, named);
  return known == std::end(types) ? nullptr : known;
}

void addLine(VtkData& data, const std::string& where, double from, double to) {
  const auto isPoint = [&](double k) {
    return k >= 0.0 && k < static_cast<double>(data.points.size()) &&
           k == static_cast<double>(static_cast<std::size_t>(k));
  };
  if (!isPoint(from) || !isPoint(to))
    throw BadInput(fmt::format("{}: line {}: ends at a point that is not there", where,
                               data.lines.size() + 1));
  data.lines.emplace_back(static_cast<std::size_t>(from), static_cast<std::size_t>(to));
}

}  // namespace crossgrain::files
