/// Files of YADE's export.textExt(): "#format …", a comment line or none, spheres. No contacts, no
/// time: the last number of the file's name counts as the step.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "adapters/files/readers.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::files {
namespace fs = std::filesystem;
namespace {

using Meanings = std::vector<Meaning>;

/// Columns that the user's comment names: "# x y z r id vx vy vz".
Meanings attributeColumns(const TextFile& text, const std::string& comment, std::size_t width,
                          const ColumnOptions& options) {
  Meanings meanings{Meaning::x, Meaning::y, Meaning::z, Meaning::radius};
  const auto names = words(comment);
  if (names.size() < 5 || names[0] != "#" || names[4] != "r" || names.size() - 1 != width)
    text.fail(
        fmt::format("{} columns, which the comment line before them should name: # x y z r id "
                    "vx vy vz …",
                    width));
  for (std::size_t k = 5; k < names.size(); ++k)
    meanings.push_back(options.of(names[k]).value_or(meaningOf(names[k])));
  return meanings;
}

Columns columnsOf(const TextFile& text, std::string_view format, const std::string& comment,
                  const ColumnOptions& options) {
  using enum Meaning;
  if (format == "x_y_z_r") return Columns({x, y, z, radius});
  if (format == "x_y_z_r_matId") return Columns({x, y, z, radius, kind});
  if (format == "id_x_y_z_r_matId") return Columns({id, x, y, z, radius, kind});
  if (format == "x_y_z_r_attrs") {
    Columns columns(attributeColumns(text, comment, words(text.line()).size(), options));
    columns.checkDistinct(text);
    return columns;
  }
  text.fail(
      fmt::format("#format {}: x_y_z_r, x_y_z_r_matId, id_x_y_z_r_matId and x_y_z_r_attrs are "
                  "read",
                  format));
}

Part readSpheres(const fs::path& file, const ColumnOptions& options) {
  TextFile text(file);
  Part part;
  part.frame.where = file.string();
  const auto head = text.next() ? words(text.line()) : std::vector<std::string_view>();
  if (head.size() != 2 || head[0] != "#format")
    text.fail("the first line should be #format x_y_z_r…");
  const std::string format(head[1]);
  std::string comment;
  std::optional<Columns> columns;
  while (text.next()) {
    if (text.line().front() == '#') {
      if (columns) text.fail("a comment among the spheres");
      comment = text.line();
      continue;
    }
    if (!columns) columns = columnsOf(text, format, comment, options);
    columns->read(text, ' ');
    addParticle(part.frame.particles, *columns, text);
  }
  if (!columns) text.fail("there are no spheres in it");
  return part;
}

}  // namespace

std::unique_ptr<FrameReader> openYadeText(const Files& files, const FileOptions& options) {
  const auto columns = std::make_shared<const ColumnOptions>(options.columns);
  return joinParts(
      std::make_unique<WholeFiles>(
          files, [columns](const fs::path& file) { return readSpheres(file, *columns); }),
      {}, columns);
}

}  // namespace crossgrain::files
