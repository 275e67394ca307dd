#include "adapters/files/frame_contacts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "adapters/audit_geometry.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::files {
namespace {

/// Of a unit vector or of a force, that may stand out of the plane: files of six digits leave 10⁻⁵.
constexpr double outOfPlane = 1e-4;
/// Two lines of one contact, each number of six digits, are mirror images to 2·10⁻⁵ of the force.
constexpr double mirrored = 2e-5;
/// Between centres, in units of the sum of radii: no bond reaches as far.
constexpr double farthestPair = 1.5;

/// A contact by our ids, i < j.
template <int D>
struct LineOf {
  std::size_t i = 0, j = 0;
  bool turned = false;  ///< the file's first is j
  VecOf<D> normal = VecOf<D>::Zero(), force = VecOf<D>::Zero();
  double overlap = 0.0;
  SpinOf<D> torque = noSpin<D>();
};

template <int D>
class ContactReader {
 public:
  using Line = LineOf<D>;

  ContactReader(const FileFrame& frame, const FileUnits& units, const ParticleIds& ids,
                const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis)
      : frame_(frame),
        in_(*frame.contacts),
        units_(units),
        ids_(ids),
        basis_(basis),
        places_(contactPlaces(snapshot, basis)) {}

  std::vector<Line> read() {
    std::vector<Line> lines;
    lines.reserve(in_.size());
    for (std::size_t c = 0; c < in_.size(); ++c)
      if (auto line = readLine(c)) lines.push_back(*line);
    std::ranges::sort(lines, {},
                      [](const Line& line) { return std::tuple(line.i, line.j, line.turned); });
    return merged(lines);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw BadInput(fmt::format("{}: {}", frame_.where, what));
  }
  std::string nameOf(std::size_t c) const {
    return in_.second[c] < 0 ? fmt::format("contact {}–wall {}", in_.first[c], -in_.second[c] - 1)
                             : fmt::format("contact {}–{}", in_.first[c], in_.second[c]);
  }
  std::size_t ourOf(std::int64_t id, std::size_t c) const {
    const auto our = ids_.ourOf(id);
    if (!our) fail(fmt::format("{}: there is no particle {}", nameOf(c), id));
    return *our;
  }

  std::optional<Line> readLine(std::size_t c) const {
    const std::size_t disks = ids_.disks();
    const std::size_t a = ourOf(in_.first[c], c);
    Line line;
    line.i = a;
    if (in_.second[c] < 0) {
      if (a >= disks) return std::nullopt;  // two walls
      line.j = planeOf(c, a);
    } else {
      const std::size_t b = ourOf(in_.second[c], c);
      if (a == b) fail(fmt::format("{}: a particle touches itself", nameOf(c)));
      if (std::min(a, b) >= disks) return std::nullopt;
      std::tie(line.i, line.j) = std::minmax(a, b);
      line.turned = a > b;
    }
    const PairPlaceOf<D> place = pairPlace(places_, basis_, line.i, line.j);
    const double side = line.turned ? -1.0 : 1.0;
    line.normal = place.normal;
    if (!in_.normal.empty()) line.normal = side * normalOf(c);
    if (line.normal.dot(place.normal) < -0.5)
      fail(
          fmt::format("{}: its normal points from the first to the second; wanted is the other way",
                      nameOf(c)));
    line.force = scalarForce(c) * line.normal;
    if (!in_.force.empty()) line.force = side * forceOf(c);
    line.overlap = in_.overlap.empty() ? place.overlap : units_.length * in_.overlap[c];
    if (!in_.torque.empty())
      line.torque = side * units_.force() * units_.length * units_.about<D>(in_.torque[c]);
    const bool nothing = line.force.isZero(0.0) && line.torque == noSpin<D>();
    if (nothing && line.overlap <= 0.0) return std::nullopt;  // a pair that was only looked at
    checkDistance(c, line, place);
    return line;
  }

  /// Over a periodic edge, the other is somebody's image.
  void checkDistance(std::size_t c, const Line& line, const PairPlaceOf<D>& place) const {
    if (line.j >= basis_.radius.size()) return;
    const double reach = basis_.radius[line.i] + basis_.radius[line.j];
    if (place.distance > farthestPair * reach)
      fail(fmt::format(
          "{}: their centres are {:.3g} m apart, {:.3g} times the sum of their radii (a contact "
          "over a periodic edge? {})",
          nameOf(c), place.distance, place.distance / reach,
          basis_.scene->box ? "the case's box is periodic along other directions, or longer"
                            : "the case has no periodic box"));
  }

  VecOf<D> normalOf(std::size_t c) const {
    const Vec3& n = in_.normal[c];
    if (!(std::abs(n.norm() - 1.0) <= outOfPlane))
      fail(fmt::format("{}: its normal has length {:.6g}, not 1", nameOf(c), n.norm()));
    if (D == 2 && !(std::abs(n[units_.third()]) <= outOfPlane))
      fail(fmt::format("{}: its normal ({:.4g}, {:.4g}, {:.4g}) is not in the plane", nameOf(c),
                       n.x(), n.y(), n.z()));
    return units_.along<D>(n).normalized();
  }

  VecOf<D> forceOf(std::size_t c) const {
    const Vec3& f = in_.force[c];
    if (D == 2 && !(std::abs(f[units_.third()]) <= outOfPlane * f.norm()))
      fail(fmt::format("{}: its force ({:.4g}, {:.4g}, {:.4g}) is not in the plane", nameOf(c),
                       f.x(), f.y(), f.z()));
    return units_.force() * units_.along<D>(f);
  }

  double scalarForce(std::size_t c) const {
    return in_.normalForce.empty() ? 0.0 : units_.force() * in_.normalForce[c];
  }

  /// The plane or cylinder of the case that a wall of the file is, for the disk that touches it: of
  /// those with the contact's normal the one whose distance from the centre is nearest to the
  /// radius less the contact's overlap. Without a normal no disk is deeper in it than half a
  /// radius.
  std::size_t planeOf(std::size_t c, std::size_t disk) const {
    std::optional<std::size_t> best;
    const double radius = basis_.radius[disk];
    const double overlap = in_.overlap.empty() ? 0.0 : units_.length * in_.overlap[c];
    double nearest = in_.normal.empty() ? 0.5 * radius : INFINITY;
    for (std::size_t p = 0; p < places_.planes.size(); ++p) {
      const PlaneOf<D> plane = places_.planes[p].under(places_.position[disk]);
      if (!in_.normal.empty() && plane.normal.dot(units_.along<D>(in_.normal[c])) < 0.99) continue;
      const double distance = (places_.position[disk] - plane.point).dot(plane.normal);
      const double off = std::abs(distance - radius + overlap);
      if (off > nearest || distance > 1.5 * radius) continue;
      nearest = off;
      best = p;
    }
    if (!best)
      fail(fmt::format("{}: no plane of the case touches {} at ({:.6g}) m{}", nameOf(c),
                       nameOfId(*basis_.scene, disk), fmt::join(places_.position[disk], ", "),
                       in_.normal.empty()
                           ? ""
                           : fmt::format(" with a normal of ({:.3g})",
                                         fmt::join(units_.along<D>(in_.normal[c]), ", "))));
    return basis_.radius.size() + *best;
  }

  std::string nameOf(const Line& line) const {
    return fmt::format("contact {}–{}", ids_.theirOf(line.i),
                       line.j < ids_.size() ? fmt::format("{}", ids_.theirOf(line.j))
                                            : nameOfId(*basis_.scene, line.j));
  }

  /// Each once: of two lines of a contact, one from either side, the first is kept.
  std::vector<Line> merged(const std::vector<Line>& lines) const {
    std::vector<Line> result;
    result.reserve(lines.size());
    const auto samePair = [](const Line& a, const Line& b) { return a.i == b.i && a.j == b.j; };
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const Line& line = lines[k];
      if (k == 0 || !samePair(lines[k - 1], line)) {
        result.push_back(line);
        continue;
      }
      if (lines[k - 1].turned == line.turned)
        fail(fmt::format("{} is listed twice from the same side", nameOf(line)));
      const VecOf<D>& before = result.back().force;
      if (!((before - line.force).norm() <= mirrored * before.norm()))
        fail(fmt::format(
            "{} is listed twice with different forces: ({:.6g}) N on the one, ({:.6g}) N on the "
            "other",
            nameOf(line), fmt::join(before, ", "), fmt::join(VecOf<D>(-line.force), ", ")));
    }
    return result;
  }

  const FileFrame& frame_;
  const FileContacts& in_;
  const FileUnits& units_;
  const ParticleIds& ids_;
  const AuditBasisOf<D>& basis_;
  ContactPlacesOf<D> places_;
};

/// Whether there are tangential forces in the scene: where its law has none they are 0.
template <int D>
bool rubs(const SceneOf<D>& scene) {
  return scene.materials ? std::ranges::any_of(scene.materials->laws, &ContactLaw::friction)
                         : scene.law.friction();
}

/// Why contacts give no averages; null: they do. Sizes of tangential forces without a direction say
/// nothing unless they are 0.
/// @param rubs  tangential forces are to be there
const char* lackOf(const std::optional<FileContacts>& contacts, bool rubs) {
  if (!contacts) return "no contacts in the files";
  if (contacts->size() == 0 || !contacts->force.empty()) return nullptr;
  if (contacts->normalForce.empty()) return "contacts have no forces in the files";
  double largest = 0.0;
  for (const double f : contacts->normalForce) largest = std::max(largest, std::abs(f));
  if (std::ranges::any_of(contacts->tangentialForce,
                          [&](double f) { return std::abs(f) > 1e-9 * largest; }))
    return "tangential forces have a size and no direction in the files, and contacts are left out";
  if (contacts->tangentialForce.empty() && rubs)
    return "no tangential forces in the files, and contacts are left out";
  return nullptr;
}

}  // namespace

ParticleIds::ParticleIds(const std::vector<std::int64_t>& idOfRow,
                         const std::vector<std::size_t>& walls)
    : rows_(idOfRow),
      ours_(idOfRow.size()),
      theirs_(idOfRow.size()),
      disks_(idOfRow.size() - walls.size()) {
  std::vector<bool> isWall(idOfRow.size(), false);
  for (std::size_t w = 0; w < walls.size(); ++w) {
    isWall[walls[w]] = true;
    ours_[walls[w]] = disks_ + w;
  }
  std::vector<std::size_t> byId(idOfRow.size());
  std::iota(byId.begin(), byId.end(), std::size_t{0});
  std::ranges::stable_sort(byId, {}, [&](std::size_t row) { return idOfRow[row]; });
  std::size_t next = 0;
  for (const std::size_t row : byId) {
    if (!isWall[row]) ours_[row] = next++;
    theirs_[ours_[row]] = idOfRow[row];
  }
}

std::optional<std::size_t> ParticleIds::ourOf(std::int64_t id) const {
  const auto row = rows_[id];
  return row ? std::optional(ours_[*row]) : std::nullopt;
}

template <int D>
std::optional<ContactsOf<D>> frameContacts(const FileFrame& frame, const FileUnits& units,
                                           const ParticleIds& ids, const SnapshotOf<D>& snapshot,
                                           const AuditBasisOf<D>& basis,
                                           std::set<std::string>& remarks) {
  if (const char* const lack = lackOf(frame.contacts, rubs(*basis.scene))) {
    remarks.insert(fmt::format(
        "{}: stress, fabric, coordination and forces on walls are not available", lack));
    return std::nullopt;
  }
  const FileContacts& in = *frame.contacts;
  if (in.size() > 0 && in.normal.empty())
    remarks.insert("no normals in the files: they follow from the positions");
  if (in.size() > 0 && in.overlap.empty())
    remarks.insert("no overlaps in the files: they follow from the positions");
  using Line = LineOf<D>;
  const std::vector<Line> lines = ContactReader<D>(frame, units, ids, snapshot, basis).read();
  ContactsOf<D> contacts;
  for (auto* list : {&contacts.overlap, &contacts.normalForce}) list->reserve(lines.size());
  contacts.tangentialForce.reserve(lines.size());
  for (auto* list : {&contacts.i, &contacts.j}) list->reserve(lines.size());
  contacts.normal.reserve(lines.size());
  const bool rolls =
      std::ranges::any_of(lines, [](const Line& line) { return line.torque != noSpin<D>(); });
  for (const Line& line : lines) {
    contacts.i.push_back(static_cast<std::int32_t>(line.i));
    contacts.j.push_back(static_cast<std::int32_t>(line.j));
    contacts.normal.push_back(line.normal);
    contacts.overlap.push_back(line.overlap);
    contacts.normalForce.push_back(line.force.dot(line.normal));
    if constexpr (D == 2)
      contacts.tangentialForce.push_back(line.force.dot(perpendicular(line.normal)));
    else
      contacts.tangentialForce.push_back(line.force - line.force.dot(line.normal) * line.normal);
    if (rolls || (basis.scene->law.rolls() && !in.torque.empty()))
      contacts.rollingTorque.push_back(line.torque);
  }
  return contacts;
}
template std::optional<Contacts> frameContacts(const FileFrame&, const FileUnits&,
                                               const ParticleIds&, const Snapshot&,
                                               const AuditBasis&, std::set<std::string>&);
template std::optional<ContactsOf<3>> frameContacts(const FileFrame&, const FileUnits&,
                                                    const ParticleIds&, const SpaceSnapshot&,
                                                    const AuditBasisOf<3>&, std::set<std::string>&);

}  // namespace crossgrain::files
