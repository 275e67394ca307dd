#include "studies/conformance/conformance_scenes.hpp"

#include <cmath>
#include <numbers>

#include "oracle/impact.hpp"

namespace crossgrain::conformance {

ContactLaw fullLaw() {
  ContactLaw law = thesisLaw();
  law.en = 0.8;
  law.et0 = 0.3;
  return law;
}

ContactLaw frictionless(ContactLaw law) {
  law.tangential = TangentialLaw::none;
  law.mu = 0.0;
  return law;
}

Scene emptyScene(const ContactLaw& law, double steps) {
  Scene scene;
  scene.name = "conformance";
  scene.law = law;
  ContactLaw soft = law;
  if (!law.soft()) soft.normal = NormalLaw::linear;
  scene.dt = impactTime(soft, {0.5 * smallMass, 0.5 * smallRadius, Encounter::speed}) / steps;
  return scene;
}

WallBody wallOf(const std::string& name, const Vec2& centre, const std::vector<Vec2>& disks,
                const Motion& motion) {
  WallBody body;
  body.name = name;
  body.centre = centre;
  body.diskPosition = disks;
  body.diskRadius.assign(disks.size(), smallRadius);
  body.motion = motion;
  return body;
}

Encounter crookedEncounter() {
  Encounter pair;
  pair.radii[1] = largeRadius;
  pair.masses[1] = largeMass;
  pair.obliqueness = 0.5;
  pair.spins[0] = 6.0;
  pair.spins[1] = -2.5;
  pair.drift = {0.013, -0.021};
  return pair;
}

Scene encounterScene(const Encounter& pair, const ContactLaw& law, double steps) {
  Scene scene = emptyScene(law, steps);
  const double reach = pair.radii[0] + pair.radii[1];
  const Vec2 apart = reach * Vec2(std::cos(pair.obliqueness), std::sin(pair.obliqueness)) +
                     Vec2(Encounter::gap, 0.0);
  for (const int k : {0, 1}) {
    const double share =
        (k == 0 ? 1.0 : -1.0) * pair.masses[1 - k] / (pair.masses[0] + pair.masses[1]);
    addDisk(scene, pair.radii[k], pair.masses[k], share * apart,
            pair.drift - share * Vec2(Encounter::speed, 0.0), pair.spins[k]);
  }
  return scene;
}

Scene landingScene(const ContactLaw& law, double steps) {
  Scene scene = emptyScene(law, steps);
  scene.bodies = {planeWall({0.0, -1e-3}, {0.0, 1.0})};
  const double height = smallRadius - 1e-3 + Encounter::gap;
  addDisk(scene, smallRadius, smallMass, {0.0, height}, {0.05, -0.05}, 6.0);
  return scene;
}

Scene busyScene(const ContactLaw& law) {
  Scene scene = emptyScene(law, coarseSteps);
  scene.gravity = {0.0, -50.0};  // settles within a short run
  constexpr int count = 12;
  constexpr double wheelRadius = 0.02, column = 9.1e-3, row = 9.2e-3;
  std::vector<Vec2> rim, posts;
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / count;
    rim.push_back(wheelRadius * Vec2(std::cos(angle), std::sin(angle)));
  }
  for (const double side : {-2.3, 2.3})
    for (int k = 0; k < 5; ++k) posts.emplace_back(side * column, 0.019 + 7.4e-3 * k);
  scene.bodies = {wallOf("wheel", Vec2::Zero(), rim, rotating(3.0)),
                  wallOf("posts", {0.0, 0.03}, posts)};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) {
      const bool large = (r + c) % 3 == 0;
      addDisk(scene, large ? largeRadius : smallRadius, large ? largeMass : smallMass,
              {column * (c - 1.5), 0.0285 + row * r}, {0.02 * r, -0.1 * (r + 1)}, 5.0 - c);
    }
  return scene;
}

Scene plateScene(const ContactLaw& law) {
  Scene scene = busyScene(law);
  scene.bottom = thesisBottom<BottomPlate>();
  return scene;
}

Scene withMaterials(Scene scene) {
  scene.materials = Materials{{"one"},
                              std::vector<std::int32_t>(scene.disks.size()),
                              std::vector<std::int32_t>(scene.bodies.size()),
                              {scene.law}};
  return scene;
}

Scene shifted(Scene scene, const Vec2& by) {
  for (Vec2& position : scene.disks.position) position += by;
  for (WallBody& body : scene.bodies) {
    body.centre += by;
    for (Vec2& position : body.diskPosition) position += by;
    for (Plane& plane : body.planes) plane.point += by;
  }
  return scene;
}

}  // namespace crossgrain::conformance
