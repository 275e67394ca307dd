#include "studies/lockstep/separation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace crossgrain::inline studies {
namespace {

using Pair = std::pair<std::int32_t, std::int32_t>;

template <int D>
std::map<Pair, std::size_t> byPair(const std::optional<ContactsOf<D>>& contacts) {
  std::map<Pair, std::size_t> found;
  if (contacts)
    for (std::size_t k = 0; k < contacts->size(); ++k) found[{contacts->i[k], contacts->j[k]}] = k;
  return found;
}

template <int D>
bool slides(const ContactsOf<D>& contacts, std::size_t k) {
  return k < contacts.sliding.size() && contacts.sliding[k] != 0;
}

/// Forces of a contact of the two, 0 where one of them does not have it [N].
template <int D>
struct PairForces {
  double normal[2] = {0.0, 0.0};
  SpinOf<D> tangential[2] = {noSpin<D>(), noSpin<D>()};
  double tangentialDifference() const {
    if constexpr (D == 2)
      return std::abs(tangential[0] - tangential[1]);
    else
      return (tangential[0] - tangential[1]).norm();
  }
  double difference() const { return std::hypot(normal[0] - normal[1], tangentialDifference()); }
};

template <int D>
std::map<Pair, PairForces<D>> forcesOfBoth(const LockstepFrameOf<D>& engine,
                                           const LockstepFrameOf<D>& mirror) {
  std::map<Pair, PairForces<D>> forces;
  const LockstepFrameOf<D>* const frames[2] = {&engine, &mirror};
  for (int side = 0; side < 2; ++side)
    if (const auto& contacts = frames[side]->contacts)
      for (std::size_t k = 0; k < contacts->size(); ++k) {
        PairForces<D>& both = forces[{contacts->i[k], contacts->j[k]}];
        both.normal[side] = contacts->normalForce[k];
        both.tangential[side] = contacts->tangentialForce[k];
      }
  return forces;
}

/// A contact of that disk in the mirror or the engine: the one whose forces differ most.
template <int D>
std::optional<Pair> contactOf(std::size_t disk, const LockstepFrameOf<D>& engine,
                              const LockstepFrameOf<D>& mirror) {
  std::optional<Pair> worst;
  double most = -1.0;
  for (const auto& [pair, forces] : forcesOfBoth(engine, mirror)) {
    const auto id = static_cast<std::int32_t>(disk);
    if (pair.first != id && pair.second != id) continue;
    if (forces.difference() <= most) continue;
    most = forces.difference();
    worst = pair;
  }
  return worst;
}

/// How many contacts the busier of the two disks has.
template <int D>
std::size_t touching(const Pair& of, const LockstepFrameOf<D>& frame, std::size_t wallFrom,
                     std::size_t most) {
  for (const std::int32_t id : {of.first, of.second}) {
    if (static_cast<std::size_t>(id) >= wallFrom) continue;
    std::size_t count = 0;
    for (const auto& [pair, where] : byPair(frame.contacts))
      count += pair.first == id || pair.second == id;
    most = std::max(most, count);
  }
  return most;
}

/// "new, sliding, wall"
template <int D>
std::string kindInWords(const Pair& pair, const LockstepFrameOf<D>* before,
                        const LockstepFrameOf<D>& now, std::size_t wallFrom) {
  std::vector<std::string> words;
  const auto nowThere = byPair(now.contacts);
  const auto found = nowThere.find(pair);
  if (before) {
    const bool was = byPair(before->contacts).contains(pair);
    if (!was && found != nowThere.end()) words.emplace_back("new");
    if (was && found == nowThere.end()) words.emplace_back("opening");
  }
  if (found != nowThere.end())
    words.emplace_back(slides(*now.contacts, found->second) ? "sliding" : "sticking");
  if (static_cast<std::size_t>(std::max(pair.first, pair.second)) >= wallFrom)
    words.emplace_back("wall");
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

template <int D>
std::vector<double> distances(const LockstepFrameOf<D>& one, const LockstepFrameOf<D>& other,
                              double diameter) {
  std::vector<double> apart;
  for (std::size_t i = 0; i < std::min(one.position.size(), other.position.size()); ++i)
    apart.push_back((one.position[i] - other.position[i]).norm() / diameter);
  return apart;
}

template <int D>
Farthest farthest(const LockstepFrameOf<D>& one, const LockstepFrameOf<D>& other, double diameter) {
  const std::vector<double> apart = distances(one, other, diameter);
  if (apart.empty()) return {};
  const auto worst = std::ranges::max_element(apart);
  return {static_cast<std::size_t>(worst - apart.begin()), *worst};
}

template <int D>
std::vector<double> separationVector(const LockstepFrameOf<D>& one, const LockstepFrameOf<D>& other,
                                     double diameter) {
  std::vector<double> separation;
  for (std::size_t i = 0; i < std::min(one.position.size(), other.position.size()); ++i) {
    const VecOf<D> apart = (one.position[i] - other.position[i]) / diameter;
    separation.insert(separation.end(), apart.begin(), apart.end());
  }
  const bool spins = one.spin.size() == other.spin.size() && one.velocityTime == other.velocityTime;
  for (std::size_t i = 0; i < one.spin.size(); ++i) {
    const SpinOf<D> turn =
        spins ? SpinOf<D>(0.5 * (one.spin[i] - other.spin[i]) * one.time) : noSpin<D>();
    if constexpr (D == 2)
      separation.push_back(turn);
    else
      separation.insert(separation.end(), turn.begin(), turn.end());
  }
  return separation;
}

template <int D>
ContactKinds kindsVisited(const std::vector<LockstepFrameOf<D>>& mirror, std::size_t wallFrom) {
  std::set<Pair> sticking, sliding, made, opened, wall;
  for (std::size_t k = 0; k < mirror.size(); ++k) {
    const auto now = byPair(mirror[k].contacts);
    for (const auto& [pair, where] : now) {
      (slides(*mirror[k].contacts, where) ? sliding : sticking).insert(pair);
      if (static_cast<std::size_t>(std::max(pair.first, pair.second)) >= wallFrom)
        wall.insert(pair);
    }
    if (k == 0) continue;
    const auto before = byPair(mirror[k - 1].contacts);
    for (const auto& [pair, where] : now)
      if (!before.contains(pair)) made.insert(pair);
    for (const auto& [pair, where] : before)
      if (!now.contains(pair)) opened.insert(pair);
  }
  return {sticking.size(), sliding.size(), made.size(), opened.size(), wall.size()};
}

template <int D>
std::optional<LockstepForces> forcesOfFirstStep(const LockstepWindowOf<D>& window) {
  if (window.engine.empty() || !window.engine.front().contacts || !window.mirror.front().contacts)
    return std::nullopt;
  const auto theirs = byPair(window.engine.front().contacts);
  const auto ours = byPair(window.mirror.front().contacts);
  LockstepForces found;
  found.contacts = ours.size();
  for (const auto& [pair, where] : ours) found.missing += !theirs.contains(pair);
  for (const auto& [pair, where] : theirs) found.extra += !ours.contains(pair);
  double unit = 0.0;
  const auto forces = forcesOfBoth(window.engine.front(), window.mirror.front());
  for (const auto& [pair, both] : forces) unit = std::max(unit, std::abs(both.normal[1]));
  if (unit > 0.0)
    for (const auto& [pair, both] : forces) {
      found.normal = std::max(found.normal, std::abs(both.normal[0] - both.normal[1]) / unit);
      found.tangential = std::max(found.tangential, both.tangentialDifference() / unit);
    }
  return found;
}

LockstepForces together(const LockstepForces& one, const LockstepForces& other) {
  return {one.contacts + other.contacts, one.missing + other.missing, one.extra + other.extra,
          std::max(one.normal, other.normal), std::max(one.tangential, other.tangential)};
}

template <int D>
std::optional<FirstExceedance> firstExceedance(const LockstepWindowOf<D>& window, double diameter,
                                               const std::vector<double>& limits,
                                               std::size_t wallFrom) {
  for (std::size_t k = 0; k < window.engine.size(); ++k) {
    const LockstepFrameOf<D>&engine = window.engine[k], &mirror = window.mirror[k];
    const Farthest worst = farthest(engine, mirror, diameter);
    if (worst.distance <= limits[k]) continue;
    FirstExceedance first;
    first.after = k == 0 ? 0.0 : window.mirror[k - 1].time;
    first.until = mirror.time;
    first.disk = worst.disk;
    const LockstepFrameOf<D>* const before = k == 0 ? nullptr : &window.mirror[k - 1];
    auto contact = contactOf(worst.disk, engine, mirror);
    if (!contact && before) contact = contactOf(worst.disk, window.engine[k - 1], *before);
    if (contact) {
      const auto id = static_cast<std::int32_t>(worst.disk);
      first.partner =
          static_cast<std::size_t>(contact->first == id ? contact->second : contact->first);
      first.contact = kindInWords(*contact, before, mirror, wallFrom);
      // Impulses of a step show in the positions of the next, when the disks may have parted.
      for (const auto* frames : {&window.engine, &window.mirror})
        for (std::size_t back = 0; back <= std::min<std::size_t>(k, 1); ++back)
          first.touching = touching(*contact, (*frames)[k - back], wallFrom, first.touching);
    }
    return first;
  }
  return std::nullopt;
}

template std::vector<double> distances(const LockstepFrameOf<2>&, const LockstepFrameOf<2>&,
                                       double);
template Farthest farthest(const LockstepFrameOf<2>&, const LockstepFrameOf<2>&, double);
template std::vector<double> separationVector(const LockstepFrameOf<2>&, const LockstepFrameOf<2>&,
                                              double);
template ContactKinds kindsVisited(const std::vector<LockstepFrameOf<2>>&, std::size_t);
template std::optional<LockstepForces> forcesOfFirstStep(const LockstepWindowOf<2>&);
template std::optional<FirstExceedance> firstExceedance(const LockstepWindowOf<2>&, double,
                                                        const std::vector<double>&, std::size_t);
template std::vector<double> distances(const LockstepFrameOf<3>&, const LockstepFrameOf<3>&,
                                       double);
template Farthest farthest(const LockstepFrameOf<3>&, const LockstepFrameOf<3>&, double);
template std::vector<double> separationVector(const LockstepFrameOf<3>&, const LockstepFrameOf<3>&,
                                              double);
template ContactKinds kindsVisited(const std::vector<LockstepFrameOf<3>>&, std::size_t);
template std::optional<LockstepForces> forcesOfFirstStep(const LockstepWindowOf<3>&);
template std::optional<FirstExceedance> firstExceedance(const LockstepWindowOf<3>&, double,
                                                        const std::vector<double>&, std::size_t);

}  // namespace crossgrain::inline studies
