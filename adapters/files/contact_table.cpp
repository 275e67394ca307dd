#include "adapters/files/contact_table.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "support/bad_input.hpp"

namespace crossgrain::files {
namespace {

/// Six digits of a unit vector's components.
constexpr double unitTolerance = 1e-4;
/// Half of the last of six digits, of a number 1.
constexpr double sixDigits = 5e-6;

[[noreturn]] void fail(const std::string& where, const FileContacts& contacts, std::size_t k,
                       const std::string& what) {
  throw BadInput(fmt::format("{}: contact {} ({} and {}): {}", where, k + 1, contacts.first[k],
                             contacts.second[k], what));
}

/// Rows of the particles of each contact; a wall has none.
struct Partners {
  std::vector<std::uint32_t> first, second;
};
constexpr std::uint32_t noRow = UINT32_MAX;

/// " (run.dump, step 4: ids from 1 to 48)": where ids of contacts are others than those of the
/// particles, as they are without a column of ids.
std::string rangeOfIds(const FileFrame& frame) {
  if (frame.particles.id.empty()) return {};
  const auto [lowest, highest] = std::ranges::minmax(frame.particles.id);
  return fmt::format(" ({}: ids from {} to {})", frame.where, lowest, highest);
}

Partners partnersOf(const FileContacts& contacts, const FileFrame& frame,
                    const std::string& where) {
  const RowOfId rows(frame);
  Partners partners;
  partners.first.reserve(contacts.size());
  partners.second.reserve(contacts.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const auto first = rows[contacts.first[k]];
    const auto second =
        contacts.second[k] < 0 ? std::optional<std::size_t>(noRow) : rows[contacts.second[k]];
    if (!first || !second)
      fail(where, contacts, k,
           fmt::format("there is no particle {} at that time{}",
                       first ? contacts.second[k] : contacts.first[k], rangeOfIds(frame)));
    if (first == second) fail(where, contacts, k, "a particle touches itself");
    partners.first.push_back(static_cast<std::uint32_t>(*first));
    partners.second.push_back(static_cast<std::uint32_t>(*second));
  }
  return partners;
}

/// Unit vectors, from the file, the branches or the centres, whichever comes first.
void findNormals(ContactTable& table, const FileFrame& frame, const Partners& partners,
                 const std::string& where) {
  FileContacts& contacts = table.contacts;
  const bool given = !contacts.normal.empty();
  contacts.normal.resize(contacts.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    Vec3& normal = contacts.normal[k];
    if (!given) {
      if (!table.branch.empty()) {
        normal = table.branch[k];
      } else if (partners.second[k] == noRow) {
        fail(where, contacts, k, "the direction of a contact with a wall is missing (nx, ny, nz)");
      } else {
        const auto& position = frame.particles.position;
        normal =
            nearestImage(position[partners.first[k]] - position[partners.second[k]], frame.box);
      }
    }
    const double length = normal.norm();
    if (given && std::abs(length - 1.0) > unitTolerance)
      fail(where, contacts, k,
           fmt::format("its normal has the length {:.6g}, it should be a unit vector", length));
    if (!(length > 0.0)) fail(where, contacts, k, "both centres are the same point");
    if (!std::isfinite(length)) fail(where, contacts, k, "its centres are too far apart");
    normal /= length;
  }
}

/// Subtracts from each torque that of the force, which acts at the middle of the overlap:
/// −(R − δ/2) n × F. Forces and positions have six digits, so the rest is uncertain by a few units
/// of the last digit times R F (1 + |x| / R); a smaller rest is set to 0.
void takeOffLevers(ContactTable& table, const FileFrame& frame, const Partners& partners) {
  FileContacts& contacts = table.contacts;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const std::size_t i = partners.first[k];
    const double radius = frame.particles.radius[i];
    const double overlap = contacts.overlap.empty() ? 0.0 : contacts.overlap[k];
    const Vec3 lever = -(radius - 0.5 * overlap) * contacts.normal[k].cross(contacts.force[k]);
    Vec3 rolling = table.torque[k] - lever;
    const double uncertain =
        4.0 * sixDigits * contacts.force[k].norm() * (radius + frame.particles.position[i].norm());
    if (rolling.norm() <= uncertain) rolling.setZero();
    contacts.torque.push_back(rolling);
  }
}

void findTorques(ContactTable& table, const FileFrame& frame, const Partners& partners) {
  FileContacts& contacts = table.contacts;
  const auto& radius = frame.particles.radius;
  if (radius.empty()) return;
  for (std::size_t k = 0; k < table.rollingForce.size(); ++k) {
    const double own = radius[partners.first[k]];
    const bool isWall = partners.second[k] == noRow;
    const double other = isWall ? 0.0 : radius[partners.second[k]];
    const double reduced = isWall ? own : own * other / (own + other);
    contacts.torque.push_back(reduced * contacts.normal[k].cross(table.rollingForce[k]));
  }
  if (!table.torque.empty() && !contacts.force.empty()) takeOffLevers(table, frame, partners);
}

/// Forces as those have them that know no direction of their tangential part.
void splitForces(FileContacts& contacts) {
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const double along = contacts.force[k].dot(contacts.normal[k]);
    contacts.normalForce.push_back(along);
    contacts.tangentialForce.push_back((contacts.force[k] - along * contacts.normal[k]).norm());
  }
  contacts.force.clear();
}

template <typename T>
void join(std::vector<T>& to, std::vector<T>& more, std::size_t before, std::size_t after) {
  if ((to.empty() && before > 0) || (more.empty() && after > 0)) {
    to.clear();
    return;
  }
  to.insert(to.end(), more.begin(), more.end());
}

void findPoints(FileContacts& contacts, const FileFrame& frame) {
  const FileParticles& particles = frame.particles;
  if (!contacts.point.empty() || particles.radius.empty() || contacts.normal.empty()) return;
  if (std::ranges::any_of(contacts.second, [](std::int64_t id) { return id < 0; })) return;
  const Partners partners = partnersOf(contacts, frame, frame.where);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const std::size_t i = partners.first[k], j = partners.second[k];
    const double distance =
        nearestImage(particles.position[i] - particles.position[j], frame.box).norm();
    const double overlap = particles.radius[i] + particles.radius[j] - distance;
    contacts.point.push_back(particles.position[i] -
                             (particles.radius[i] - 0.5 * overlap) * contacts.normal[k]);
  }
}

}  // namespace

void reserve(ContactTable& table, const Columns& columns, std::size_t rows) {
  FileContacts& contacts = table.contacts;
  contacts.first.reserve(rows);
  contacts.second.reserve(rows);
  if (columns.has(Meaning::nx)) contacts.normal.reserve(rows);
  if (columns.has(Meaning::fx)) contacts.force.reserve(rows);
  if (columns.has(Meaning::normalForce)) contacts.normalForce.reserve(rows);
  if (columns.has(Meaning::px)) contacts.point.reserve(rows);
  if (columns.has(Meaning::tx)) table.tangential.reserve(rows);
}

void checkContactColumns(const Columns& columns, const TextFile& text) {
  columns.checkDistinct(text);
  if (!columns.has(Meaning::first) || !columns.has(Meaning::second))
    text.fail("contacts need columns that name both particles: first, second");
  if (!columns.has(Meaning::fx) && !columns.has(Meaning::normalForce))
    text.fail("contacts need a force: fx, fy, fz or normal_force");
  for (const auto& [x, y, name] :
       {std::tuple(Meaning::nx, Meaning::ny, "nx, ny"),
        std::tuple(Meaning::fx, Meaning::fy, "fx, fy"),
        std::tuple(Meaning::tx, Meaning::ty, "tx, ty"),
        std::tuple(Meaning::px, Meaning::py, "px, py"),
        std::tuple(Meaning::branchX, Meaning::branchY, "branch_x, branch_y")})
    if (columns.has(x) != columns.has(y)) text.fail(fmt::format("one of {} is missing", name));
  if (columns.has(Meaning::tx) && !columns.has(Meaning::normalForce))
    text.fail("tx, ty, tz are the tangential force: normal_force should be there, too");
}

void addContact(ContactTable& table, const Columns& columns, const TextFile& text) {
  FileContacts& contacts = table.contacts;
  if (contacts.first.empty())
    for (const Meaning vector :
         {Meaning::nx, Meaning::branchX, Meaning::fx, Meaning::tx, Meaning::px, Meaning::rollingX,
          Meaning::torqueX, Meaning::pseudoX})
      columns.addMissing(vector, contacts.missing);
  const std::int64_t first = wholeNumber(text, columns[Meaning::first], "first");
  const std::int64_t second = wholeNumber(text, columns[Meaning::second], "second");
  if (first < 0 && second < 0)
    text.fail("a contact of two walls: one of both should be a particle");
  // Seen from the other one, all directions and forces are reversed.
  const bool turned = first < 0;
  const double sign = turned ? -1.0 : 1.0;
  contacts.first.push_back(turned ? second : first);
  contacts.second.push_back(turned ? first : second);
  const auto add = [&](std::vector<Vec3>& to, Meaning x, double factor) {
    if (columns.hasVector(x)) to.push_back(factor * columns.vector(x));
  };
  add(contacts.normal, Meaning::nx, sign);
  add(table.branch, Meaning::branchX, sign);
  add(contacts.force, Meaning::fx, sign);
  add(contacts.point, Meaning::px, 1.0);
  if (columns.hasVector(Meaning::rollingX))
    contacts.torque.push_back(sign * columns.vector(Meaning::rollingX));
  if (columns.has(Meaning::overlap)) contacts.overlap.push_back(columns[Meaning::overlap]);
  if (!columns.has(Meaning::fx)) {
    contacts.normalForce.push_back(columns[Meaning::normalForce]);
    add(table.tangential, Meaning::tx, sign);
    if (!columns.has(Meaning::tx) && columns.has(Meaning::tangentialForce))
      contacts.tangentialForce.push_back(columns[Meaning::tangentialForce]);
  }
  if (turned && (columns.hasVector(Meaning::torqueX) || columns.hasVector(Meaning::pseudoX)))
    text.fail("torque on a wall: the particle should be the first");
  add(table.torque, Meaning::torqueX, 1.0);
  add(table.rollingForce, Meaning::pseudoX, 1.0);
}

std::string describeTwice(const FileParticles& particles, std::int64_t id) {
  const std::string what = fmt::format("particle {} is there twice", id);
  const auto& ids = particles.id;
  if (particles.firstLine == 0 || particles.lastLine + 1 != particles.firstLine + ids.size())
    return what;  // comments or empty lines are between them
  const auto one = std::ranges::find(ids, id);
  const auto lineOf = [&](auto row) {
    return particles.firstLine + static_cast<std::size_t>(row - ids.begin());
  };
  return fmt::format("{} (lines {} and {})", what, lineOf(one),
                     lineOf(std::find(one + 1, ids.end(), id)));
}

RowOfId::RowOfId(const std::vector<std::int64_t>& ids) {
  if (ids.empty()) return;
  const auto [lowest, highest] = std::ranges::minmax(ids);
  lowest_ = lowest;
  constexpr std::uint64_t holes = 4;  // with more of them a sorted list takes less memory
  if (static_cast<std::uint64_t>(highest) - static_cast<std::uint64_t>(lowest) <
      holes * ids.size() + 64) {
    dense_.assign(static_cast<std::size_t>(highest - lowest) + 1, noRow);
    for (std::size_t k = 0; k < ids.size(); ++k) {
      std::uint32_t& row = dense_[static_cast<std::size_t>(ids[k] - lowest)];
      if (row == noRow)
        row = static_cast<std::uint32_t>(k);
      else if (!twice_)
        twice_ = ids[k];
    }
    return;
  }
  for (std::size_t k = 0; k < ids.size(); ++k)
    sparse_.emplace_back(ids[k], static_cast<std::uint32_t>(k));
  std::ranges::sort(sparse_);
  const auto twice = std::ranges::adjacent_find(sparse_, {}, [](const auto& e) { return e.first; });
  if (twice != sparse_.end()) twice_ = twice->first;
}

RowOfId::RowOfId(const FileFrame& frame) : RowOfId(frame.particles.id) {
  if (twice_)
    throw BadInput(fmt::format("{}: {}", frame.where, describeTwice(frame.particles, *twice_)));
}

std::optional<std::size_t> RowOfId::operator[](std::int64_t id) const {
  if (!dense_.empty()) {
    if (id < lowest_ || id - lowest_ >= static_cast<std::int64_t>(dense_.size())) return {};
    const std::uint32_t row = dense_[static_cast<std::size_t>(id - lowest_)];
    return row == noRow ? std::nullopt : std::optional<std::size_t>(row);
  }
  const auto found =
      std::ranges::lower_bound(sparse_, id, {}, [](const auto& e) { return e.first; });
  if (found == sparse_.end() || found->first != id) return {};
  return found->second;
}

Vec3 nearestImage(Vec3 difference, const std::optional<FileBox>& box) {
  if (!box) return difference;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = box->high[axis] - box->low[axis];
    if (box->periodic[axis] && length > 0.0)
      difference[axis] -= length * std::round(difference[axis] / length);
  }
  return difference;
}

void takePeriods(FileBox& box, const FileBox& ofCase) {
  constexpr double samePeriod = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    const double period = ofCase.high[axis] - ofCase.low[axis];
    if (ofCase.periodic[axis] &&
        std::abs(box.high[axis] - box.low[axis] - period) <= samePeriod * period)
      box.periodic[axis] = true;
  }
}

FileContacts completed(ContactTable table, const FileFrame& frame, const std::string& where) {
  FileContacts& contacts = table.contacts;
  const Partners partners = partnersOf(contacts, frame, where);
  findNormals(table, frame, partners, where);
  if (!table.tangential.empty()) {
    for (std::size_t k = 0; k < contacts.size(); ++k)
      contacts.force.push_back(contacts.normalForce[k] * contacts.normal[k] + table.tangential[k]);
    contacts.normalForce.clear();
  }
  findTorques(table, frame, partners);
  return std::move(contacts);
}

void append(FileContacts& contacts, FileContacts more, const FileFrame& particles) {
  if (!more.point.empty()) findPoints(contacts, particles);
  if (contacts.force.empty() && !contacts.normalForce.empty() && !more.force.empty())
    splitForces(more);
  const std::size_t before = contacts.size(), after = more.size();
  contacts.missing.insert(contacts.missing.end(), more.missing.begin(), more.missing.end());
  join(contacts.first, more.first, before, after);
  join(contacts.second, more.second, before, after);
  join(contacts.normal, more.normal, before, after);
  join(contacts.force, more.force, before, after);
  join(contacts.normalForce, more.normalForce, before, after);
  join(contacts.tangentialForce, more.tangentialForce, before, after);
  join(contacts.point, more.point, before, after);
  join(contacts.overlap, more.overlap, before, after);
  join(contacts.torque, more.torque, before, after);
}

}  // namespace crossgrain::files
