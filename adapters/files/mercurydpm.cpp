/// MercuryDPM's .data and .fstat, as DPMBase::outputXBallsData and BaseInteraction::writeToFStat
/// write them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "adapters/files/readers.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::files {
namespace fs = std::filesystem;
namespace {

using enum Meaning;

/// x y z, vx vy vz, R, three angles, ω, info (the species).
const std::vector<Meaning> rowInSpace = {x,    y,    z,    vx,    vy,    vz,    radius,
                                         none, none, none, spinX, spinY, spinZ, kind};
/// x y, vx vy, R, angle, −ω_z, info.
const std::vector<Meaning> rowInPlane = {x, y, vx, vy, radius, none, spinZ, kind};
/// t, i, j, point, δ, δ_t, F_n, F_t, n, t.
const std::vector<Meaning> rowOfContact = {none, first,       second,          px, py, pz, overlap,
                                           none, normalForce, tangentialForce, nx, ny, nz, tx,
                                           ty,   tz};

/// N t xmin ymin [zmin] xmax ymax [zmax]; rows.
Part readData(TextFile& text) {
  text.next();
  const auto head = words(text.line());
  if (head.size() != 8 && head.size() != 6)
    text.fail(
        fmt::format("a time begins with N t xmin ymin zmin xmax ymax zmax (in 2D: without z); "
                    "here are {} words",
                    head.size()));
  const bool inSpace = head.size() == 8;
  const int dimensions = inSpace ? 3 : 2;
  Columns columns(inSpace ? rowInSpace : rowInPlane);
  const std::size_t rows = text.rows(countOf(text, head[0], "N"), columns.count());
  Part part;
  FileFrame& frame = part.frame;
  frame.time = numberOf(text, head[1], "t");
  frame.where = fmt::format("{}, time {}", text.path().string(), *frame.time);
  frame.box.emplace();
  for (int k = 0; k < dimensions; ++k) {
    frame.box->low[k] = numberOf(text, head[2 + k], "the box");
    frame.box->high[k] = numberOf(text, head[2 + dimensions + k], "the box");
  }
  reserve(frame.particles, columns, rows);
  for (std::size_t k = 0; k < rows; ++k) {
    text.need("a particle");
    columns.read(text, ' ');
    if (!inSpace) columns[spinZ] = -columns[spinZ];
    // Info may be anything that a user asked for.
    if (columns[kind] != std::floor(columns[kind]) || std::abs(columns[kind]) > 0x1p31)
      columns[kind] = 0.0;
    addParticle(frame.particles, columns, text);
  }
  return part;
}

/// "# t version", "# box", "# Rmin Rmax 0 0 0 0"; rows.
Part readFStat(TextFile& text) {
  Columns columns(rowOfContact);
  Part part;
  text.next();
  for (int k = 0; k < 3; ++k) {
    if (k > 0) text.need("the head of a time, three lines with # before them,");
    const auto head = words(text.line());
    if (head.front() != "#" || head.size() < 3)
      text.fail("a time begins with three lines: # t 1, # box, # Rmin Rmax 0 0 0 0");
    if (k == 0) part.frame.time = numberOf(text, head[1], "t");
  }
  part.frame.where = fmt::format("{}, time {}", text.path().string(), *part.frame.time);
  FileContacts& contacts = part.table.emplace().contacts;
  while (text.next()) {
    if (text.line()[text.line().find_first_not_of(" \t")] == '#') {
      text.back();
      break;
    }
    columns.read(text, ' ');
    const std::int64_t i = wholeNumber(text, columns[first], "i");
    const std::int64_t j = wholeNumber(text, columns[second], "j");
    if (i < 0) text.fail("i should be a row of .data, from 0");
    contacts.first.push_back(i);
    contacts.second.push_back(j);
    // "the flip in normal/tangential direction for walls should not be done; this is an old bug"
    // (BaseInteraction.cc): of walls both point the other way.
    const double sign = j < 0 ? -1.0 : 1.0;
    const Vec3 normal = sign * columns.vector(nx), tangent = sign * columns.vector(tx);
    contacts.normal.push_back(normal);
    contacts.force.push_back(columns[normalForce] * normal + columns[tangentialForce] * tangent);
    contacts.point.push_back(columns.vector(px));
    contacts.overlap.push_back(columns[overlap]);
  }
  return part;
}

/// Of a contact with a ghost, the particle that is there in the box's nearest image: its centre is
/// R − δ/2 behind the point.
std::optional<std::int64_t> particleBehind(const FileContacts& contacts, std::size_t k,
                                           const FileFrame& frame) {
  constexpr double samePlace = 1e-4;  // of a radius: points have six digits
  const FileParticles& all = frame.particles;
  for (std::size_t j = 0; j < all.size(); ++j) {
    const double arm = all.radius[j] - 0.5 * contacts.overlap[k];
    const Vec3 centre = contacts.point[k] - arm * contacts.normal[k];
    if (nearestImage(all.position[j] - centre, frame.box).norm() <= samePlace * all.radius[j])
      return all.id[j];
  }
  return std::nullopt;
}

/// Over a periodic edge the partner is a ghost, a row that .data does not have. The same contact is
/// listed from the other side, too, with the same overlap and force and the reverse normal; that
/// line's particle is the one meant. Of a fixed particle's ghost there is no such line: it is the
/// one at its place, where the case's box is known.
/// @param box  the case's, since that of .data is the one that is drawn
void resolveGhosts(ContactTable& table, FileFrame& frame, const std::optional<FileBox>& box) {
  FileContacts& contacts = table.contacts;
  const auto rows = static_cast<std::int64_t>(frame.particles.size());
  std::vector<std::size_t> ghosts;
  for (std::size_t k = 0; k < contacts.size(); ++k)
    if (contacts.second[k] >= rows) ghosts.push_back(k);
  std::ranges::sort(ghosts, {}, [&](std::size_t k) { return contacts.overlap[k]; });
  if (box) frame.box = box;
  constexpr double tenDigits = 1e-9;
  const auto mirrors = [&](std::size_t a, std::size_t b) {
    const double size = contacts.force[a].norm();
    return (contacts.force[a] + contacts.force[b]).norm() <= tenDigits * size &&
           (contacts.normal[a] + contacts.normal[b]).norm() <= tenDigits;
  };
  std::vector<std::int64_t> partner(ghosts.size(), -1);
  constexpr std::size_t window = 64;  // contacts of one overlap, in a lattice
  for (std::size_t a = 0; a < ghosts.size(); ++a) {
    for (std::size_t b = a + 1; b < std::min(ghosts.size(), a + window) && partner[a] < 0; ++b) {
      if (partner[b] >= 0 || !mirrors(ghosts[a], ghosts[b])) continue;
      partner[a] = contacts.first[ghosts[b]];
      partner[b] = contacts.first[ghosts[a]];
      const Vec3 shift = contacts.point[ghosts[a]] - contacts.point[ghosts[b]];
      for (int axis = 0; !box && frame.box && axis < 3; ++axis) {
        const double length = frame.box->high[axis] - frame.box->low[axis];
        if (std::abs(shift[axis]) > 0.5 * length && length > 0.0) frame.box->periodic[axis] = true;
      }
    }
    if (const auto behind =
            partner[a] < 0 && box ? particleBehind(contacts, ghosts[a], frame) : std::nullopt)
      partner[a] = *behind;
    if (partner[a] < 0)
      throw BadInput(fmt::format(
          "{}: particle {} touches {}, but there are {} particles, from 0: if that is the ghost of "
          "one, its own contact over the periodic edge should be listed, too",
          frame.where, contacts.first[ghosts[a]], contacts.second[ghosts[a]], rows));
  }
  for (std::size_t a = 0; a < ghosts.size(); ++a) contacts.second[ghosts[a]] = partner[a];
}

}  // namespace

Content contentOfMercuryDpm(const fs::path& file) {
  TextFile text(file);
  if (!text.next()) return Content::particles;  // the reader says that it is empty
  const auto head = words(text.line());
  if (head.front() == "#") return Content::contacts;
  if (head.front().find_first_not_of("0123456789") != std::string_view::npos)
    text.fail("should be a .data, which begins with N t xmin …, or an .fstat, with # t 1");
  return Content::particles;
}

std::unique_ptr<FrameReader> openMercuryDpm(const Files& files, const FileOptions& options) {
  if (!options.columns.empty()) throw BadInput("columns: those of .data and .fstat are fixed");
  std::vector<std::unique_ptr<PartReader>> contacts;
  if (Files fstat = filesOf(files, Content::contacts, contentOfMercuryDpm); !fstat.empty())
    contacts.push_back(std::make_unique<TextParts>(std::move(fstat), readFStat));
  return joinParts(std::make_unique<TextParts>(
                       filesOf(files, Content::particles, contentOfMercuryDpm), readData),
                   std::move(contacts), nullptr,
                   [box = options.box](ContactTable& table, FileFrame& frame) {
                     resolveGhosts(table, frame, box);
                   });
}

}  // namespace crossgrain::files
