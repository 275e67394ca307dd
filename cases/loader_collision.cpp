#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/loader_sections.hpp"
#include "oracle/collision_quantities.hpp"

namespace crossgrain::inline cases {
namespace {

constexpr int mostCollisions = 100'000;  // two disks each, all in one scene

/// A number, a list, or { from, to, count } for equal steps.
void readSweep(Reader& in, const std::string& key, std::vector<double>& values,
               const Range& allowed) {
  if (!in.isTable(key)) return in.read(key, values, allowed);
  double from = 0.0, to = 0.0;
  int count = 0;
  Reader range = in.section(key);
  range.require("from", from, allowed);
  range.require("to", to, allowed);
  range.require("count", count, between(2, 10'000));
  range.finish();
  range.check(to > from, "to", "must be > {} (from)", from);
  for (int k = 0; k < count; ++k) values.push_back(from + (to - from) * k / (count - 1));
}

const Section<Collision>& collisionKeys() {
  constexpr const char* users = "calibrate baseline collide record stability";
  const Range speeds = positive("m/s", ", else the disks never meet");
  static const Section<Collision> section(
      {.name = "collision",
       .kinds = "collision",
       .commands = "compare plan lockstep identify baseline record effects cost stability collide",
       .note = "Two disks that meet, or a disk and a wall, with Ψ_i = v_t/\\|v_n\\| of the contact "
               "point; one sweep over `psi` for each `vn` and each `steps_per_contact`."},
      {special<Collision>(
           {"psi", "–", "required", "", "a number, a list, or `{ from = 0, to = 4, count = 41 }`"},
           [](Reader& in, const std::string& key, Collision& c) {
             readSweep(in, key, c.psi, anyNumber());
           }),
       special<Collision>({"angle", "degrees", "–", "(-90, 90)",
                           "instead of `psi`: the angle between velocity and normal, Ψ_i = "
                           "tan(angle)"},
                          [](Reader& in, const std::string& key, Collision& c) {
                            if (!in.has(key)) return static_cast<void>(in.take(key));
                            in.check(!in.has("psi"), key, "and psi, its tangent: give one of them");
                            readSweep(in, key, c.psi, inside(-90.0, 90.0, "degrees"));
                            for (double& psi : c.psi)
                              psi = std::tan(psi * std::numbers::pi / 180.0);
                          }),
       key("vn", &Collision::vn, speeds, "speed of approach, a number or a list")
           .listed("required"),
       key("speed", &Collision::speed, speeds,
           "instead of `vn`: √(v_n² + v_t²), the same for every Ψ_i")
           .listed("–"),
       key("approach", &Collision::approach, Names{"spin", "first_spin", "oblique"},
           "what gives v_t: both disks' spins, the first one's, or the centres' velocities"),
       key("counter_spin", &Collision::counterSpin, anyNumber("rad/s"),
           "a list: added to the first spin, a_i/a_j of it taken from the second: v_t stays"),
       special<Collision>({"second", "", "\"disk\"", "disk, wall",
                           "`wall`: the second body is a plane wall of infinite mass"},
                          [](Reader& in, const std::string& key, Collision& c) {
                            std::string second = "disk";
                            in.read(key, second, Names{"disk", "wall"});
                            c.wall = second == "wall";
                          }),
       special<Collision>({"wall_velocity", "m/s", "[0, 0]", "",
                           "along its normal and along itself; the relative motion stays"},
                          [](Reader& in, const std::string& key, Collision& c) {
                            std::vector<double> velocity(2);
                            in.read(key, velocity, anyNumber());
                            in.check(velocity.size() == 2, key,
                                     "must be [along its normal, along it] in m/s");
                            c.wallVelocity = {velocity[0], velocity[1]};
                          }),
       need("radius", &Collision::radius, positive("m"),
            "one number for both disks, or `[a, b]`; with a wall the disk's")
           .usedBy(users),
       need("mass", &Collision::mass, positive("kg"), "likewise").usedBy(users),
       special<Collision>(
           {"material", "", "–", "",
            "one name of `[[law.pairs]]` for both, or `[a, b]`; a wall is the second"},
           [](Reader& in, const std::string& key, Collision& c) {
             const toml::node* const node = in.take(key);
             if (!node) return;
             const toml::array* const both = node->as_array();
             in.check(!both || both->size() == 2, key, "must be one name or two");
             for (const std::size_t side : {0u, 1u})
               convert({both ? *both->get(side) : *node, "collision.material"},
                       c.material.emplace_back());
           }),
       key("inertia_factor", &Collision::inertiaFactor, aboveZeroTo(1.0), "as in `[particles]`")
           .usedBy(users),
       keyOf<Collision>(
           "first_spin", [](auto& c) -> auto& { return c.spinOutOfPlane[0]; }, anyNumber("rad/s"),
           "in space, spin that the first body has besides: about the line of centres n, and about "
           "the tangent s"),
       keyOf<Collision>(
           "second_spin", [](auto& c) -> auto& { return c.spinOutOfPlane[1]; }, anyNumber("rad/s"),
           "the same of the second"),
       special<Collision>({"turn", "degrees", "[0, 0, 0]", "",
                           "in space, the scene is turned about this axis by its length: n, s and "
                           "n × s are along x, y and z before"},
                          [](Reader& in, const std::string& key, Collision& c) {
                            std::vector<double> degrees(3);
                            in.read(key, degrees, anyNumber());
                            in.check(degrees.size() == 3, key, "must be [x, y, z] in degrees");
                            c.turn = Vec3::Map(degrees.data()) * (std::numbers::pi / 180.0);
                          }),
       key("steps_per_contact", &Collision::stepsPerContact, atLeast(2.0),
           "a number or a list; a rigid law takes `run.dt` instead"),
       key("start_phase", &Collision::startPhase,
           Range{.low = 0.0,
                 .high = 1.0,
                 .highOpen = true,
                 .reason = ": from 0 on, else the disks overlap at the start"},
           "the disks touch this fraction of a step after a step")});
  return section;
}

void checkWall(Reader& in, const Collision& c) {
  if (!c.wall) {
    in.check(!in.has("wall_velocity"), "wall_velocity", "only a wall has one (second = \"wall\")");
    return;
  }
  for (const char* const key : {"radius", "mass"})
    in.check(!in.take(key)->is_array(), key, "a wall has none: give the disk's alone");
  in.check(c.counterSpin == std::vector<double>{0.0}, "counter_spin", "a wall does not turn");
}

}  // namespace

std::vector<SectionInfo> collisionSections() {
  return {collisionKeys().info(),
          marginSection(
              {.name = "collision.margins",
               .kinds = "collision",
               .commands = "collide",
               .note = "Without any margin nothing is judged, and `collide` exits with 1."},
              "QUANTITY", "how far from the oracle it may be", "of the oracle's curve", false)};
}

void readCollision(Reader& in, Collision& c, int dimension) {
  const Reader margins = in.section("margins");
  collisionKeys().read(in, c);
  if (!in.has("psi") && !in.has("angle")) in.failMissing("psi");
  if (in.has("speed"))
    in.check(!in.has("vn"), "speed", "and vn, its part along the normal: give one of them");
  else if (!in.has("vn"))
    in.failMissing("vn");
  checkWall(in, c);
  for (const char* const key : {"first_spin", "second_spin", "turn"})
    in.check(dimension == 3 || !in.has(key), key,
             "only collisions in space have it (case.dimension = 3)");
  in.check(!c.wall || !in.has("second_spin"), "second_spin", "a wall does not turn");
  const auto starts = static_cast<double>(c.psi.size()) *
                      static_cast<double>(std::max<std::size_t>(1, c.vn.size())) *
                      static_cast<double>(c.counterSpin.size());
  in.check(starts <= mostCollisions, in.has("psi") ? "psi" : "angle",
           "with all vn and counter_spin {:.0f} collisions: at most {}", starts, mostCollisions);
  std::vector<Judged> quantities;
  for (const CollisionQuantity& quantity : scoredQuantities())
    quantities.push_back({std::string(quantity.name), ""});
  c.margins = readMargins(margins, quantities);
}

}  // namespace crossgrain::inline cases
