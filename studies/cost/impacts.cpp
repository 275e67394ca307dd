#include "studies/cost/impacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "adapters/registry.hpp"
#include "cases/collision_scene.hpp"
#include "cases/flow.hpp"
#include "studies/core/engine_access.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {
namespace {

/// A contact that began.
struct Impact {
  CollidingPair bodies;
  ContactLaw law;
  double speed = 0.0;  ///< [m/s]
};

/// A partner of a contact by its id: a disk, a wall disk, a plane or a cylinder.
template <int D>
struct Partner {
  double radius = 0.0, mass = std::numeric_limits<double>::infinity();
  const WallBodyOf<D>* body = nullptr;  ///< of a wall
};

template <int D>
std::vector<Partner<D>> partnersIn(const SceneOf<D>& scene) {
  std::vector<Partner<D>> partners;
  for (std::size_t k = 0; k < scene.disks.size(); ++k)
    partners.push_back({scene.disks.radius[k], scene.disks.mass[k], nullptr});
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const WallBodyOf<D>& body : scene.bodies)
    for (const double radius : body.diskRadius) partners.push_back({radius, infinite, &body});
  for (const WallBodyOf<D>& body : scene.bodies)
    partners.insert(partners.end(), body.planes.size(), {0.0, infinite, &body});
  for (const WallBodyOf<D>& body : scene.bodies)
    partners.insert(partners.end(), body.cylinders.size(), {0.0, infinite, &body});
  return partners;
}

/// Follows one state and adds the contacts that begin.
template <int D>
void follow(const SceneOf<D>& scene, std::vector<Impact>& impacts, SceneImpacts& found) {
  // A tenth of a contact in the usual steps: the speed has hardly changed by then.
  constexpr int samples = 800, stepsOfSample = 5;
  const auto engine = engineRegistry().front().make();
  loadOn(*engine, scene, {});
  const std::vector<Partner<D>> partners = partnersIn(scene);
  std::set<std::pair<std::int32_t, std::int32_t>> touching;
  SnapshotOf<D> before;
  double squares = 0.0;
  for (int sample = 0; sample <= samples; ++sample) {
    throwIfInterrupted();
    engine->advance(sample * stepsOfSample * scene.dt);
    SnapshotOf<D> now = snapshotOf<D>(*engine, ContactReport::instant);
    const ContactsOf<D>& contacts = now.contacts.value();
    std::set<std::pair<std::int32_t, std::int32_t>> touchingNow;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const std::pair ids(contacts.i[k], contacts.j[k]);
      touchingNow.insert(ids);
      if (sample == 0 || touching.contains(ids)) continue;
      const auto i = static_cast<std::size_t>(ids.first), j = static_cast<std::size_t>(ids.second);
      const Partner<D>&one = partners[i], &two = partners[j];
      VecOf<D> other = VecOf<D>::Zero();
      if (!two.body)
        other = before.velocity[j];
      else
        other =
            memberVelocity<D>(stateAt<D>(two.body->motion, two.body->centre, before.velocityTime),
                              VecOf<D>(before.position[i] - one.radius * contacts.normal[k]));
      const double speed = -(before.velocity[i] - other).dot(contacts.normal[k]);
      if (!(speed > 0.0)) continue;
      CollidingPair bodies{{one.radius, two.radius}, {one.mass, two.mass}, {}, two.radius == 0.0};
      impacts.push_back({bodies, scene.lawOf(i, j), speed});
    }
    touching = std::move(touchingNow);
    for (const VecOf<D>& velocity : now.velocity)
      squares += velocity.squaredNorm() / static_cast<double>(now.velocity.size());
    before = std::move(now);
  }
  found.rmsSpeed += squares / (samples + 1);
  found.seconds += samples * stepsOfSample * scene.dt;
}

/// How unlike two pairs are, by their sizes; materials count more than any size.
double unlikeness(const Impact& impact, const NamedPair& pair) {
  const auto sizes = [&](int i, int j) {
    const auto apart = [&](int side, int of) {
      const double one = impact.bodies.radius[side], other = pair.bodies.radius[of];
      return one > 0.0 && other > 0.0 ? std::abs(std::log(one / other)) : 0.0;
    };
    return apart(0, i) + apart(1, j);
  };
  constexpr double otherMaterial = 1e3;
  const bool mayTurn = std::isfinite(pair.bodies.mass[1]);
  return (mayTurn ? std::min(sizes(0, 1), sizes(1, 0)) : sizes(0, 1)) +
         (impact.law == pair.law ? 0.0 : otherMaterial);
}

/// Of the kinds of pair with as many walls, the most alike.
const NamedPair* kindOf(const Impact& impact, const std::vector<NamedPair>& pairs) {
  const NamedPair* best = nullptr;
  for (const NamedPair& pair : pairs)
    if (pair.bodies.plane == impact.bodies.plane &&
        std::isinf(pair.bodies.mass[1]) == std::isinf(impact.bodies.mass[1]) &&
        (!best || unlikeness(impact, pair) < unlikeness(impact, *best)))
      best = &pair;
  return best;
}

PairImpacts summaryOf(const std::string& pair, const std::vector<const Impact*>& impacts) {
  PairImpacts summary{.pair = pair, .contacts = impacts.size()};
  std::vector<double> speeds;
  for (const Impact* one : impacts) speeds.push_back(one->speed);
  std::ranges::sort(speeds);
  const auto quantile = [&](double share) {
    return speeds[static_cast<std::size_t>(share * static_cast<double>(speeds.size() - 1))];
  };
  summary.median = quantile(0.5);
  summary.fast = quantile(0.95);
  const Impact& lightest = **std::ranges::min_element(
      impacts, {}, [](const Impact* one) { return one->bodies.reducedMass(); });
  std::ranges::copy(lightest.bodies.radius, summary.radius);
  std::ranges::copy(lightest.bodies.mass, summary.mass);
  return summary;
}

}  // namespace

SceneImpacts impactsIn(const Case& setup, const std::vector<Packing>& states, double dt) {
  std::vector<Impact> impacts;
  SceneImpacts found;
  for (const Packing& state : states)
    inDimensionOf(setup,
                  [&]<int D>() { follow<D>(flowScene<D>(setup, state, dt), impacts, found); });
  found.rmsSpeed =
      std::sqrt(found.rmsSpeed / static_cast<double>(std::max<std::size_t>(states.size(), 1)));
  const std::vector<NamedPair> pairs = pairsOf(setup);
  std::map<std::string, std::vector<const Impact*>> byPair;
  for (const Impact& impact : impacts)
    if (const NamedPair* const pair = kindOf(impact, pairs)) byPair[pair->name].push_back(&impact);
  for (const NamedPair& pair : pairs)
    if (const auto of = byPair.find(pair.name); of != byPair.end())
      found.pairs.push_back(summaryOf(of->first, of->second));
  return found;
}

}  // namespace crossgrain::inline studies
