// Springs of spheres that are moved as prescribed: tangential ones, and of rolling resistance.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "adapters/declared_law.hpp"
#include "law/law_options.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/conformance/conformance_scenes.hpp"
#include "studies/conformance/moved_pairs.hpp"

namespace crossgrain::conformance {
namespace {

/// F_t or M on the first of the pair, normal to n, and the step that it is of.
struct SeenForce {
  Vec3 force;
  int step;
};

/// @param list  of contacts, which has it
std::vector<SeenForce> seenOf(CheckContext& c, const MovedPair& pair,
                              std::vector<Vec3> ContactsOf<3>::*list, const char* name) {
  const double dt = c.effective.dt;
  std::vector<SeenForce> seen;
  for (const int step : {2, 30, 60, movedSteps}) {
    const SpaceSnapshot now = shown<3>(c, step * dt);
    c.require(now.contacts && now.contacts->size() == 1,
              text("shows ", now.contacts ? now.contacts->size() : 0, " contacts of ", pair.name,
                   " after ", step, " steps, not 1"));
    c.require(!((*now.contacts).*list).empty(), text("shows no ", name, " of its contacts"));
    const Vec3 force = ((*now.contacts).*list)[0], n = now.contacts->normal[0];
    const double along = force.dot(n);
    c.near(along, 0.0,
           {1e-4 * force.norm(), 0.0, "what is turned to first order leaves the plane by ½ ΔΘ³"},
           text(name, "·n of ", pair.name, " after ", step, " steps"));
    seen.push_back({force - along * n, static_cast<int>(std::llround(now.contactTime / dt))});
  }
  return seen;
}

/// The largest difference of the seen forces from the wanted ones, relative to the largest force.
double distance(const std::vector<SeenForce>& seen, const std::vector<Vec3>& wanted) {
  double most = 0.0, size = 0.0;
  for (const auto& [force, step] : seen) {
    const Vec3& other = wanted[static_cast<std::size_t>(step)];
    most = std::max(most, (force - other).norm());
    size = std::max(size, other.norm());
  }
  return most / size;
}

// Rounding of a hundred steps; conventions of a turn differ by 1e-3.
Tolerance movedRounding(const CheckContext& c) {
  return c.byPrecision(1e-9, 1e-4, "the same sums in another order, motion as prescribed");
}

/// Loads each pair and sees what its spring does. @param declared  becomes the law as declared
std::vector<std::vector<SeenForce>> seenOfPairs(CheckContext& c, std::span<const MovedPair> pairs,
                                                const ContactLaw& law, ContactLaw& declared,
                                                std::vector<Vec3> ContactsOf<3>::*list,
                                                const char* name) {
  std::vector<std::vector<SeenForce>> seen;
  for (const MovedPair& pair : pairs) {
    const SpaceScene scene = loaded(c, movedScene(pair, law));
    declared = declaredLaw(c.can, scene, c.effective, 0.5 * scene.disks.mass[0]).value();
    seen.push_back(seenOf(c, pair, list, name));
  }
  return seen;
}

/// Of rolling springs the equations say how θ follows n; that θ × n follows it likewise is as good.
void rollingSpringsOfMovedPairs(CheckContext& c) {
  if (!c.can.instantContacts) c.skip("shows no contacts of one instant");
  ContactLaw law = rollingLawOf(c.can, 3);
  if (law.normal != NormalLaw::linear || law.rolling != RollingLaw::spring)
    c.skip("has no linear law with a rolling spring");
  const MovedPair pairs[] = {passingPair(), rollingPair()};
  ContactLaw declared;
  std::vector<std::vector<SeenForce>> seen;
  std::vector<std::string> lengths = valuesOf(c.can, law, "rolling_length");
  while (seen.empty()) try {  // not every one of them need go with the linear law
      setLawOption(law, "rolling_length", lengths.back());
      lengths.pop_back();
      seen = seenOfPairs(c, pairs, law, declared, &ContactsOf<3>::rollingTorque, "rolling torque");
    } catch (const Skipped&) {
      if (lengths.empty()) throw;
    }
  const double dt = c.effective.dt;
  const auto off = [&](std::size_t k, const SpringMotion& motion) {
    return distance(seen[k], rollingTorques(pairs[k], motion, dt, movedSteps));
  };
  const auto farthest = [&](const SpringMotion& motion) {
    return std::max(off(0, motion), off(1, motion));
  };
  const Tolerance rounding = movedRounding(c);
  SpringMotion own{declared}, displaced{declared};
  displaced.asDisplacement = true;
  const bool asDisplacement = farthest(displaced) < farthest(own);
  const SpringMotion& closer = asDisplacement ? displaced : own;
  for (const std::size_t k : {0u, 1u})
    c.near(off(k, closer), 0.0, rounding,
           text("rolling torque of ", pairs[k].name, ", off by a part of it"));
  if (c.faults.empty()) {
    if (asDisplacement)
      c.notes.push_back(
          fmt::format("its rolling spring is θ × n, and follows n as that: to second order of a "
                      "step's turn another than θ (here {:.2g} of M)",
                      farthest(own)));
    return;
  }
  for (const SpringMotion& motion : springMotions(declared))
    if (farthest(motion) <= rounding.absolute) {
      // Where it is the declared one something else is wrong.
      const std::string difference = motion.differenceFrom(declared);
      return c.suspect(difference.empty() ? difference : "rolling: " + difference);
    }
}

/// Under one way in which springs follow their pair.
void expectMovedSprings(CheckContext& c, const ContactLaw& law) {
  const MovedPair pairs[] = {passingPair(), twistingPair()};
  ContactLaw declared;
  const auto seen = seenOfPairs(c, pairs, law, declared, &ContactsOf<3>::tangentialForce, "F_t");
  const auto farthest = [&](const SpringMotion& motion) {
    double most = 0.0;
    for (std::size_t k = 0; k < seen.size(); ++k)
      most = std::max(
          most, distance(seen[k], springForces(pairs[k], motion, c.effective.dt, movedSteps)));
    return most;
  };
  const Tolerance rounding = movedRounding(c);
  const std::size_t before = c.faults.size();
  for (std::size_t k = 0; k < seen.size(); ++k)
    c.near(distance(seen[k], springForces(pairs[k], {declared}, c.effective.dt, movedSteps)), 0.0,
           rounding, text("F_t of ", pairs[k].name, ", off by a part of it"));
  for (const char* const option : {"spring_turn", "spring_twist"})
    c.examine(text(option, " = ", lawOptionValue(declared, option)));
  c.examine(spheresInSpace);
  if (c.faults.size() == before) {
    for (std::string& note : frameDependence(declared))
      if (std::ranges::find(c.notes, note) == c.notes.end()) c.notes.push_back(std::move(note));
    return;
  }
  for (const SpringMotion& motion : springMotions(declared))
    if (farthest(motion) <= rounding.absolute) return c.suspect(motion.differenceFrom(declared));
}

void springsOfMovedPairs(CheckContext& c) {
  if (!c.can.instantContacts) c.skip("shows no contacts of one instant");
  ContactLaw law = followed(c.can, movedLaw());
  if (law.normal != NormalLaw::linear || law.tangential != TangentialLaw::spring)
    c.skip("has no linear law with a tangential spring");
  expectMovedSprings(c, law);
  for (const char* const option : {"spring_turn", "spring_twist"})
    for (const std::string& value : valuesOf(c.can, law, option)) {
      if (value == lawOptionValue(law, option)) continue;
      ContactLaw other = law;
      setLawOption(other, option, value);
      expectMovedSprings(c, other);
    }
}

}  // namespace

Checks springChecks() {
  return {
      {"SpringsOfMovedPairs",
       "tangential springs of spheres that pass, turn and twist are those of the declared law, "
       "step "
       "by step",
       springsOfMovedPairs, 3},
      {"RollingSpringsOfMovedPairs",
       "springs of rolling resistance of spheres that pass, turn and twist are those of the "
       "declared law, step by step",
       rollingSpringsOfMovedPairs, 3},
  };
}

}  // namespace crossgrain::conformance
