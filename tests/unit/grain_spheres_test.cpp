// Spheres in space: the plane's own engine where all is in a plane, turned scenes, springs that
// turn, and what every scheme keeps.
#include "engines/grain/spheres.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <sstream>
#include <string>

#include "engines/grain/kernels.hpp"
#include "engines/grain/simulation.hpp"
#include "tests/support/refusal.hpp"
#include "tests/unit/grain_scenes.hpp"

namespace {

using namespace grain;
using Vector = grain::Vec3<double>;

constexpr double radius = 0.005, mass = 1.309e-3;
constexpr double inertia = 0.4 * mass * radius * radius;

ContactLaw springLaw() {
  return crossgrain::test::sphereLaw();
}

double contactTime() {
  return M_PI * std::sqrt(0.5 * mass / 1e5);
}

void add(SpheresSetup& setup, const Vector& x, const Vector& v, const Vector& spin) {
  setup.position.push_back(x);
  setup.velocity.push_back(v);
  setup.spin.push_back(spin);
  setup.radius.push_back(radius);
  setup.mass.push_back(mass);
  setup.inertia.push_back(inertia);
}

/// Three spheres and a floor, all meeting at once.
SpheresSetup meeting(const ContactLaw& law, bool planar) {
  SpheresSetup setup{.law = law, .dt = contactTime() / 40.0};
  const double out = planar ? 0.0 : 1.0;
  add(setup, {0.0, radius + 1e-5, 0.0}, {0.3, -0.7, 0.2 * out}, {40.0 * out, -30.0 * out, 90.0});
  add(setup, {2.0 * radius + 2e-5, radius + 3e-5, out * 1e-4}, {-0.8, -0.4, -0.3 * out},
      {-200.0 * out, 70.0 * out, -50.0});
  add(setup, {radius, radius + 1.733 * radius, -out * 2e-4}, {0.1, -1.1, 0.0},
      {10.0 * out, 300.0 * out, 20.0});
  SpaceWall floor;
  floor.planes.push_back({{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}});
  floor.motion = [out](double t) {
    return SpaceWall::State{{0.2 * t, 0.05 * t, 0.1 * out * t}, {0.2, 0.05, 0.1 * out}};
  };
  setup.walls.push_back(floor);
  SpaceWall lid;  // one sphere that swings on an arm
  lid.position.push_back({-1.0 * radius, 3.0 * radius, 0.0});
  lid.radius.push_back(0.7 * radius);
  lid.motion = [](double t) {
    return SpaceWall::State{
        {0.1 * t, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.0, 0.0, 30.0 * t}, {0.0, 0.0, 30.0}};
  };
  setup.walls.push_back(lid);
  return setup;
}

/// Of two materials, in turn; every constant differs, and two of the second do not rub.
void mix(SpheresSetup& setup) {
  const auto changed = [&](double by, double friction) {
    ContactLaw law = setup.law;
    for (double* constant : {&law.kn, &law.gn, &law.kt, &law.gt, &law.w, &law.kr, &law.gr})
      *constant *= by;
    law.mu *= friction;
    return law;
  };
  const ContactLaw both = changed(0.6, 0.5);
  setup.materials = Materials{{0, 1, 0}, {1, 0}, 2, {setup.law, both, both, changed(0.3, 0.0)}};
}

Setup inThePlane(const SpheresSetup& spheres) {
  Setup setup;
  for (std::size_t i = 0; i < spheres.radius.size(); ++i) {
    setup.disks.x.push_back(spheres.position[i].x);
    setup.disks.y.push_back(spheres.position[i].y);
    setup.disks.vx.push_back(spheres.velocity[i].x);
    setup.disks.vy.push_back(spheres.velocity[i].y);
    setup.disks.spin.push_back(spheres.spin[i].z);
  }
  setup.disks.radius = spheres.radius;
  setup.disks.mass = spheres.mass;
  setup.disks.inertia = spheres.inertia;
  Wall floor;
  floor.planes.push_back({});
  floor.motion = [](double t) {
    return WallState{.x = 0.2 * t, .y = 0.05 * t, .vx = 0.2, .vy = 0.05};
  };
  setup.walls.push_back(floor);
  Wall lid;
  lid.diskX = {-1.0 * radius};
  lid.diskY = {3.0 * radius};
  lid.diskRadius = {0.7 * radius};
  lid.motion = [](double t) {
    return WallState{.x = 0.1 * t, .angle = 30.0 * t, .vx = 0.1, .spin = 30.0};
  };
  setup.walls.push_back(lid);
  setup.law = spheres.law;
  setup.materials = spheres.materials;
  setup.dt = spheres.dt;
  setup.law.conventions.integrator = spheres.law.conventions.integrator;
  return setup;
}

TEST(Spheres, AllInAPlane_MoveAsThePlanesEngineMovesThem) {
  // Every convention that both have, each with the others as they are. 1e-12 of a radius and of
  // 1 m/s is rounding of 120 steps, three contacts at a time.
  std::vector<std::pair<std::string, SpheresSetup>> runs;
  const auto with = [&](const std::string& name, auto&& change) {
    SpheresSetup setup = meeting(springLaw(), true);
    change(setup);
    runs.emplace_back(name, std::move(setup));
  };
  with("as it is", [](auto&) {});
  with("frictionless", [](auto& s) { s.law.tangential = TangentialLaw::none; });
  with("spring alone", [](auto& s) { s.law.tangential = TangentialLaw::spring; });
  with("cut", [](auto& s) { s.law.conventions.tension = Tension::cut; });
  for (const CoulombBound bound : {CoulombBound::magnitude, CoulombBound::signedForce})
    with("bound", [&](auto& s) { s.law.conventions.coulombBound = bound; });
  with("outside", [](auto& s) { s.law.conventions.dashpot = Dashpot::outside; });
  with("spring only", [](auto& s) { s.law.conventions.springReset = SpringReset::springOnly; });
  for (const SpringUpdate stretch : {SpringUpdate::before, SpringUpdate::midpoint})
    with("stretch", [&](auto& s) { s.law.conventions.springUpdate = stretch; });
  for (const LeverArm lever : {LeverArm::contactPoint, LeverArm::overlapMiddle})
    for (const PlaneArm plane : {PlaneArm::surface, PlaneArm::middle, PlaneArm::radius})
      with("levers", [&](auto& s) {
        s.law.conventions.leverArm = lever;
        s.law.conventions.planeArm = plane;
      });
  with("velocity lever", [](auto& s) {
    s.law.conventions.leverArm = LeverArm::overlapMiddle;
    s.law.conventions.velocityArm = VelocityArm::radius;
  });
  for (const DampingVelocity damping : {DampingVelocity::lagged, DampingVelocity::implicit})
    with("damping", [&](auto& s) { s.law.conventions.dampingVelocity = damping; });
  for (const Integrator integrator : {Integrator::velocityVerlet, Integrator::semiImplicitEuler})
    with("integrator", [&](auto& s) { s.law.conventions.integrator = integrator; });
  for (const TangentialLaw tangential : {TangentialLaw::coulomb, TangentialLaw::viscous})
    with("tangential", [&](auto& s) { s.law.tangential = tangential; });
  const auto hertz = [](auto& s) {
    s.law.normal = NormalLaw::hertz;
    s.law.kn = 2e8;
    s.law.kt = 3e8;
    s.law.gn = s.law.gt = 0.2;
    s.law.damper = Damper::critical;
  };
  with("hertz", hertz);
  with("hertz, force", [&](auto& s) {
    hertz(s);
    s.law.conventions.history = History::force;
  });
  with("polynomial", [](auto& s) {
    s.law.normal = NormalLaw::polynomial;
    s.law.kn = 1e9;
    s.law.kn3 = 1e12;
    s.law.damper = Damper::viscoelastic;
    s.law.gn = s.law.gt = 1e-5;
  });
  for (const RollingLaw rolling : {RollingLaw::constantTorque, RollingLaw::viscous,
                                   RollingLaw::viscousByLoad, RollingLaw::spring})
    for (const RollingLength of : {RollingLength::effective, RollingLength::smallerRadius})
      with("rolling", [&](auto& s) {
        s.law.rolling = rolling;
        s.law.kr = 1e4;
        s.law.gr = 0.05;
        s.law.muR = 0.1;
        s.law.conventions.rollingLength = of;
        s.law.conventions.rollingDamper =
            of == RollingLength::effective ? RollingDamper::constant : RollingDamper::critical;
      });
  for (const CohesionLaw cohesion :
       {CohesionLaw::area, CohesionLaw::dmt, CohesionLaw::elastoPlastic})
    with("cohesion", [&](auto& s) {
      s.law.cohesion = cohesion;
      s.law.kc = cohesion == CohesionLaw::area ? 1e6 : 2e4;
      s.law.w = 20.0;
      s.law.kUnload = 2e5;
      s.law.plasticDepth = 0.05;
    });
  for (const UnloadingStiffness unloading :
       {UnloadingStiffness::current, UnloadingStiffness::lagged})
    with("unloading", [&](auto& s) {
      s.law.cohesion = CohesionLaw::elastoPlastic;
      s.law.kc = 2e4;
      s.law.kUnload = 2e5;
      s.law.plasticDepth = 0.05;
      s.law.conventions.unloadingStiffness = unloading;
    });
  with("jkr", [&](auto& s) {
    hertz(s);
    s.law.cohesion = CohesionLaw::jkr;
    s.law.w = 20.0;
  });
  with("materials", mix);
  with("materials, implicit", [](auto& s) {
    s.law.conventions.dampingVelocity = DampingVelocity::implicit;
    mix(s);
  });
  with("materials, jkr", [&](auto& s) {
    hertz(s);
    s.law.cohesion = CohesionLaw::jkr;
    s.law.w = 20.0;
    mix(s);
  });
  for (const SpringTurn turn : {SpringTurn::rescaled, SpringTurn::rotated})
    with("turn", [&](auto& s) { s.law.conventions.springTurn = turn; });
  for (auto& [name, setup] : runs) {
    Simulation plane(inThePlane(setup));
    Spheres space(setup);
    for (int piece = 0; piece < 12; ++piece) {
      plane.advance(10);
      space.advance(10);
      for (std::size_t i = 0; i < 3; ++i) {
        SCOPED_TRACE(name + ", sphere " + std::to_string(i));
        EXPECT_NEAR(space.position(i).x, plane.x(i), 1e-12 * radius);
        EXPECT_NEAR(space.position(i).y, plane.y(i), 1e-12 * radius);
        EXPECT_EQ(space.position(i).z, 0.0);
        EXPECT_NEAR(space.velocity(i).x, plane.velocityX(i), 1e-12);
        EXPECT_NEAR(space.velocity(i).y, plane.velocityY(i), 1e-12);
        EXPECT_NEAR(radius * space.spin(i).z, radius * plane.spin(i), 1e-12);
        EXPECT_EQ(space.spin(i).x, 0.0);
      }
    }
    for (const std::size_t wall : {0u, 1u}) {
      const WallLoad load = plane.wallLoad(wall);
      const auto [force, torque] = space.wallLoad(wall);
      EXPECT_NEAR(force.x, load.fx, 1e-9) << name;
      EXPECT_NEAR(force.y, load.fy, 1e-9) << name;
      EXPECT_NEAR(torque.z, load.torque, 1e-11) << name;
    }
    EXPECT_EQ(space.contacts().size(), plane.contacts().size()) << name;
    EXPECT_EQ(space.contactEvaluations(), plane.contactEvaluations()) << name;
  }
}

/// A rotation.
struct Turn {
  std::array<Vector, 3> rows;
  Vector operator()(const Vector& v) const {
    return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
  }
};

/// By an angle about an axis of length 1 (Rodrigues).
Turn turnBy(const Vector& axis, double angle) {
  Turn turn;
  const double c = std::cos(angle), s = std::sin(angle);
  const Vector units[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int k = 0; k < 3; ++k)  // row k of the matrix is the inverse turn of unit k
    turn.rows[k] =
        c * units[k] - s * cross(axis, units[k]) + ((1.0 - c) * dot(axis, units[k])) * axis;
  return turn;
}

SpheresSetup turned(SpheresSetup setup, const Turn& turn) {
  for (auto* list : {&setup.position, &setup.velocity, &setup.spin})
    for (Vector& v : *list) v = turn(v);
  for (SpaceWall& wall : setup.walls) {
    for (SpaceWall::Plane& plane : wall.planes) plane = {turn(plane.point), turn(plane.normal)};
    for (Vector& x : wall.position) x = turn(x);
    wall.motion = [motion = wall.motion, turn](double t) {
      const SpaceWall::State now = motion(t);
      return SpaceWall::State{turn(now.centre), turn(now.velocity), turn(now.angle),
                              turn(now.spin)};
    };
  }
  setup.gravity = turn(setup.gravity);
  return setup;
}

TEST(Spheres, TurnedScene_GivesTheTurnedMotion) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (const SpringTurn how :
       {SpringTurn::rotated, SpringTurn::firstOrder, SpringTurn::rescaled, SpringTurn::projected})
    for (const SpringTwist twist : {SpringTwist::meanSpin, SpringTwist::none}) {
      SpheresSetup setup = meeting(springLaw(), false);
      setup.law.conventions.springTurn = how;
      setup.law.conventions.springTwist = twist;
      setup.gravity = {0.0, -9.81, 0.0};
      Vector axis{normal(random), normal(random), normal(random)};
      axis = (1.0 / length(axis)) * axis;
      const Turn turn = turnBy(axis, 3.0 * normal(random));
      Spheres own(setup), other(turned(setup, turn));
      for (int piece = 0; piece < 12; ++piece) {
        own.advance(10);
        other.advance(10);
        // The turned start is rounded itself; contacts amplify that by about ten.
        for (std::size_t i = 0; i < own.size(); ++i) {
          EXPECT_LT(length(turn(own.position(i)) - other.position(i)), 1e-12 * radius);
          EXPECT_LT(length(turn(own.velocity(i)) - other.velocity(i)), 1e-11);
          EXPECT_LT(radius * length(turn(own.spin(i)) - other.spin(i)), 1e-11);
        }
        const auto here = own.contacts(), there = other.contacts();
        ASSERT_EQ(here.size(), there.size());
        for (std::size_t k = 0; k < here.size(); ++k)
          EXPECT_LT(length(turn(here[k].tangentialForce) - there[k].tangentialForce), 1e-8);
      }
      EXPECT_GT(own.contactEvaluations(), 60u);
    }
}

/// ξ of length 1 at angle φ from the direction in which n turns, after a turn by `angle` in so many
/// steps about a fixed axis.
Vector tumbled(SpringTurn how, double angle, int steps, double phi) {
  Vector n{1, 0, 0}, spring{0, std::cos(phi), std::sin(phi)};
  for (int k = 1; k <= steps; ++k) {
    const double a = angle * k / steps;
    const Vector next{std::cos(a), std::sin(a), 0};
    spring = turnedSpring(how, spring, n, next);
    n = next;
  }
  return spring;
}

TEST(Spheres, SpringOfATumblingPair_ChangesAsItsConventionSays) {
  const int steps = 400;
  const double turn = 2.0 * M_PI, each = turn / steps;
  for (const double phi : {0.0, 0.7, 1.5}) {
    const double c2 = std::cos(phi) * std::cos(phi);
    const Vector start{0, std::cos(phi), std::sin(phi)};
    // A whole turn about the axis: parallel transport brings ξ back.
    EXPECT_LT(length(tumbled(SpringTurn::rotated, turn, steps, phi) - start), 1e-13);
    EXPECT_NEAR(length(tumbled(SpringTurn::rescaled, turn, steps, phi)), 1.0, 1e-13);
    // In one step of `each`: docs/dimensions.md, section 4.
    const double s2 = std::sin(each) * std::sin(each);
    EXPECT_NEAR(length(tumbled(SpringTurn::firstOrder, each, 1, phi)), std::sqrt(1.0 + s2 * c2),
                1e-15);
    EXPECT_NEAR(length(tumbled(SpringTurn::projected, each, 1, phi)), std::sqrt(1.0 - s2 * c2),
                1e-15);
  }
  // Over a turn Θ in steps of ΔΘ: exp(∓½ΘΔΘ), to the next order ΘΔΘ³/8.
  const double projected = length(tumbled(SpringTurn::projected, turn, steps, 0.0));
  EXPECT_NEAR(projected, std::exp(-0.5 * turn * each), 2e-5);
  EXPECT_NEAR(projected, std::pow(std::cos(each), steps), 1e-13);
  EXPECT_NEAR(length(tumbled(SpringTurn::firstOrder, turn, steps, 0.0)),
              std::exp(0.5 * turn * each), 2e-5);
}

TEST(Spheres, SpringOfATwistedPair_TurnsByTheMeanSpin) {
  const Vector n{0, 0, 1}, spring{1, 0, 0};
  const Vector turned = twistedSpring(SpringTurn::rotated, spring, n, 0.3);
  EXPECT_NEAR(turned.x, std::cos(0.3), 1e-12);
  EXPECT_NEAR(turned.y, std::sin(0.3), 1e-12);
  const Vector first = twistedSpring(SpringTurn::firstOrder, spring, n, 0.3);
  EXPECT_EQ(first.x, 1.0);
  EXPECT_EQ(first.y, 0.3);
}

TEST(Spheres, SlippingForce_IsAlongTheSpringAndAtTheBound) {
  ContactLaw law = springLaw();
  law.tangential = TangentialLaw::spring;
  const auto general = generalLaw<double>(law, 1e-6, true);
  ContactMotion<double> contact{};
  contact.overlap = 1e-5;  // f_n = 1 N, bound 0.3 N
  Vector spring{0.0, 3e-5, 4e-5};
  double sliding = 0.0;
  const Vector force = tangentialForce(general, contact, {}, 1.0, spring, sliding);
  EXPECT_EQ(sliding, 1.0);
  EXPECT_NEAR(force.y, -0.3 * 0.6, 1e-15);
  EXPECT_NEAR(force.z, -0.3 * 0.8, 1e-15);
  EXPECT_NEAR(spring.y, 0.3 * 0.6 / law.kt, 1e-20);
}

/// A cloud of spheres that fly towards its middle.
SpheresSetup cloud() {
  SpheresSetup setup;
  setup.law = springLaw();
  setup.law.conventions.leverArm = LeverArm::overlapMiddle;
  setup.dt = contactTime() / 40.0;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const Vector at{2.2 * radius * x, 2.2 * radius * y, 2.2 * radius * z};
        add(setup, at + Vector{1e-4 * uniform(random), 1e-4 * uniform(random), 0.0}, -100.0 * at,
            {200.0 * uniform(random), 200.0 * uniform(random), 200.0 * uniform(random)});
      }
  return setup;
}

TEST(Spheres, FreeCloud_KeepsItsMomentaWhereTheArmsMeet) {
  Spheres spheres(cloud());
  const auto momenta = [&] {
    Vector linear{}, angular{};
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      linear += mass * spheres.velocity(i);
      angular += mass * cross(spheres.position(i), spheres.velocity(i)) + inertia * spheres.spin(i);
    }
    return std::pair(linear, angular);
  };
  const auto [linear, angular] = momenta();
  spheres.advance(400);
  const auto [later, turning] = momenta();
  EXPECT_LT(length(later - linear), 1e-13 * 27.0 * mass);
  // Positions and the velocities shown are of one time to second order, so x × mv is kept to the
  // rounding of each step.
  EXPECT_LT(length(turning - angular), 1e-12 * 27.0 * mass * radius);
}

TEST(Spheres, LawThatTheyDoNotHave_IsRefused) {
  const auto why = [](auto&& change) {
    SpheresSetup setup = meeting(springLaw(), true);
    change(setup);
    return crossgrain::test::refusalOf<std::invalid_argument>([&] { Spheres spheres(setup); });
  };
  EXPECT_EQ(why([](auto&) {}), "");
  EXPECT_EQ(why([](auto& s) { s.law.normal = NormalLaw::rigid; }), "spheres have no impulses");
  EXPECT_EQ(why([](auto& s) { s.dt = 0.0; }), "the time step must be > 0 s");
}

/// The cloud in a box that it fills, periodic along x and y, which flies through its borders.
SpheresSetup boxed(const Vector& offset) {
  SpheresSetup setup = cloud();
  const double side = 3.0 * 2.2 * radius;
  setup.box = SpaceBox{{-0.5 * side, -0.5 * side, 0.0}, {side, side, 0.0}, {true, true, false}};
  for (std::size_t i = 0; i < setup.position.size(); ++i) {
    setup.position[i] += offset;
    setup.velocity[i] = Vector{3.0, -5.0, 0.0} + 5.0 * setup.velocity[i];
  }
  return setup;
}

TEST(Spheres, ShiftOfAllInAPeriodicBox_ChangesNothingElse) {
  // By powers of two, so that nothing is rounded: the borders lie elsewhere, the bits are the same.
  const Vector by{0.00390625, 0.0078125, 0.0};
  SpheresSetup start = boxed({});
  for (Vector& x : start.position)  // sums with `by` are exact
    x = {std::round(x.x * 0x1p40) * 0x1p-40, std::round(x.y * 0x1p40) * 0x1p-40, x.z};
  SpheresSetup moved = start;
  for (Vector& x : moved.position) x += by;
  Spheres here(start), there(moved);
  std::size_t across = 0;
  for (int piece = 0; piece < 40; ++piece) {
    here.advance(25);
    there.advance(25);
    for (std::size_t i = 0; i < here.size(); ++i) {
      EXPECT_LT(length(here.position(i) + by - there.position(i)), 1e-11 * radius);
      EXPECT_LT(length(here.velocity(i) - there.velocity(i)), 1e-10);
    }
    const auto contacts = here.contacts();
    EXPECT_EQ(contacts.size(), there.contacts().size());
    for (const SpaceContact& contact : contacts)
      across += length(here.position(static_cast<std::size_t>(contact.i)) -
                       here.position(static_cast<std::size_t>(contact.j))) > 2.1 * radius;
  }
  EXPECT_GT(across, 20u);
  EXPECT_GT(here.rebuilds(), 1u);
}

std::vector<double> bitsOf(const Spheres& spheres) {
  std::vector<double> bits;
  for (std::size_t i = 0; i < spheres.size(); ++i)
    for (const Vector& v : {spheres.position(i), spheres.velocity(i), spheres.spin(i)})
      bits.insert(bits.end(), {v.x, v.y, v.z});
  return bits;
}

/// Beyond the first step, 8192, at which spheres are numbered anew.
constexpr std::uint64_t pastRenumbering = 8600;

/// Periodic along z as well, so that spheres still meet by then.
SpheresSetup closedBox() {
  SpheresSetup setup = boxed({});
  setup.box->low.z = setup.box->low.x;
  setup.box->length.z = setup.box->length.x;
  setup.box->periodic[2] = true;
  return setup;
}

TEST(Spheres, AnySkin_GivesTheSameBits) {
  std::vector<double> bits;
  for (const double skin : {0.0, 1e-4, 3.0 * radius}) {
    SpheresSetup setup = closedBox();
    setup.skin = skin;
    Spheres spheres(setup);
    spheres.advance(pastRenumbering);
    if (bits.empty()) bits = bitsOf(spheres);
    EXPECT_EQ(bitsOf(spheres), bits);
    EXPECT_GT(spheres.rebuilds(), skin == 1e-4 ? 100u : 1u);
    EXPECT_GT(spheres.contactEvaluations(), 1000u);
  }
}

TEST(Spheres, RestoredBeforeARenumbering_GoesOnToTheBit) {
  Spheres whole(closedBox()), second(closedBox());
  whole.advance(8100);
  std::stringstream file;
  whole.save(file);
  second.restore(file);
  const std::uint64_t before = whole.contactEvaluations();
  for (auto* spheres : {&whole, &second}) spheres->advance(pastRenumbering - 8100);
  EXPECT_EQ(bitsOf(whole), bitsOf(second));
  EXPECT_EQ(whole.contactEvaluations(), second.contactEvaluations());
  EXPECT_GT(whole.contactEvaluations(), before + 100u);
}

TEST(Spheres, PlaneThatNothingReaches_ChangesNoBit) {
  // With a plane all spheres are kicked and watched in every step, without one those in contact.
  SpheresSetup open = closedBox(), closed = open;
  SpaceWall floor;
  floor.planes.push_back({{0.0, 0.0, -1000.0 * radius}, {0.0, 0.0, 1.0}});
  floor.motion = [](double) { return SpaceWall::State{}; };
  closed.walls.push_back(floor);
  for (const Integrator integrator : {Integrator::positionVerlet, Integrator::velocityVerlet}) {
    open.law.conventions.integrator = closed.law.conventions.integrator = integrator;
    Spheres here(open), there(closed);
    for (auto* spheres : {&here, &there}) spheres->advance(2000);
    EXPECT_EQ(bitsOf(here), bitsOf(there));
    EXPECT_GT(here.contactEvaluations(), 1000u);
    EXPECT_EQ(here.contactEvaluations(), there.contactEvaluations());
  }
}

TEST(Spheres, OtherOrderOfSpheres_IsTheSameMotionAndTheSameContacts) {
  const SpheresSetup setup = cloud();
  SpheresSetup other = setup;
  const std::size_t count = setup.radius.size();
  const auto numberInOther = [&](std::size_t i) { return (10 * i + 3) % count; };  // 27 spheres
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = numberInOther(i);
    other.position[j] = setup.position[i];
    other.velocity[j] = setup.velocity[i];
    other.spin[j] = setup.spin[i];
  }
  Spheres here(setup), there(other);
  std::size_t found = 0;
  for (int piece = 0; piece < 10; ++piece) {
    for (auto* spheres : {&here, &there}) spheres->advance(40);
    // Sums of forces in another order: rounding, which contacts amplify by about ten.
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_LT(length(here.position(i) - there.position(numberInOther(i))), 1e-11 * radius);
    for (const SpaceContact& contact : here.contacts()) {
      auto i = static_cast<std::int32_t>(numberInOther(static_cast<std::size_t>(contact.i)));
      auto j = static_cast<std::int32_t>(numberInOther(static_cast<std::size_t>(contact.j)));
      const double sign = i < j ? 1.0 : -1.0;
      if (j < i) std::swap(i, j);
      for (const SpaceContact& same : there.contacts()) {
        if (same.i != i || same.j != j) continue;
        ++found;
        EXPECT_LT(length(contact.normal - sign * same.normal), 1e-10);
        EXPECT_LT(length(contact.tangentialForce - sign * same.tangentialForce), 1e-7);
      }
    }
    found -= here.contacts().size();
  }
  EXPECT_EQ(found, 0u);  // each in the other
  EXPECT_GT(here.contactEvaluations(), 500u);
}

TEST(Spheres, PairAcrossABorder_MeetsAsInTheMiddle) {
  const auto pair = [](double shift, bool apart) {
    SpheresSetup setup{.law = springLaw(), .dt = contactTime() / 40.0};
    const double side = 0.0625;  // exact sums
    setup.box = SpaceBox{{0.0, 0.0, 0.0}, {side, side, side}, {true, true, true}};
    add(setup, {shift, 0.03125, 0.03125}, {1.0, 0.2, 0.0}, {0.0, 30.0, 20.0});
    add(setup, {shift + 0.009765625 + (apart ? -side : 0.0), 0.03125, 0.03125}, {-1.0, 0.0, 0.3},
        {100.0, 0.0, 20.0});
    return setup;
  };
  Spheres middle(pair(0.03125, false)), border(pair(0.0625 - 0.0078125, true));
  middle.advance(60);
  border.advance(60);
  EXPECT_GT(middle.contactEvaluations(), 20u);
  for (std::size_t i = 0; i < 2; ++i) {
    // The same but for where it is: 0.0625 and its parts are exact, the rest rounds at 2⁻⁵⁷ m.
    EXPECT_LT(length(middle.velocity(i) - border.velocity(i)), 1e-11);
    EXPECT_LT(length(middle.spin(i) - border.spin(i)), 1e-8);
  }
}

TEST(Spheres, RestoredRun_GoesOnToTheBit) {
  SpheresSetup setup = meeting(springLaw(), false);
  setup.law.rolling = RollingLaw::spring;
  setup.law.kr = 1e4;
  setup.law.gr = 0.05;
  setup.law.muR = 0.1;
  for (const Integrator integrator : {Integrator::positionVerlet, Integrator::velocityVerlet}) {
    setup.law.conventions.integrator = integrator;
    Spheres whole(setup), second(setup), other(boxed({}));
    whole.advance(30);
    ASSERT_GE(whole.contacts().size(), 3u);
    std::stringstream file;
    whole.save(file);
    second.restore(file);
    for (int piece = 0; piece < 2; ++piece) {
      for (std::size_t i = 0; i < whole.size(); ++i) {
        EXPECT_EQ(length(whole.position(i) - second.position(i)), 0.0);
        EXPECT_EQ(length(whole.velocity(i) - second.velocity(i)), 0.0);
        EXPECT_EQ(length(whole.spin(i) - second.spin(i)), 0.0);
      }
      EXPECT_EQ(whole.contacts().size(), second.contacts().size());
      for (const std::size_t wall : {0u, 1u})
        EXPECT_EQ(length(whole.wallLoad(wall).second - second.wallLoad(wall).second), 0.0);
      whole.advance(20);
      second.advance(20);
    }
    EXPECT_EQ(whole.contactEvaluations(), second.contactEvaluations());
    file.seekg(0);
    EXPECT_THROW(other.restore(file), std::runtime_error);
    std::stringstream part(file.str().substr(0, file.str().size() / 2));
    EXPECT_THROW(second.restore(part), std::runtime_error);
  }
}

TEST(Spheres, RunThatBeginsUnderWay_GoesOnAsTheOneItIsOf) {
  std::vector<std::pair<std::string, SpheresSetup>> runs;
  const auto with = [&](const std::string& name, auto&& change) {
    SpheresSetup setup = meeting(springLaw(), false);
    setup.walls.resize(1);
    setup.law.conventions.dampingVelocity =
        DampingVelocity::lagged;  // predicted velocities need the forces of a step before
    change(setup);
    runs.emplace_back(name, std::move(setup));
  };
  with("as it is", [](auto&) {});
  with("before", [](auto& s) { s.law.conventions.springUpdate = SpringUpdate::before; });
  with("outside", [](auto& s) { s.law.conventions.dashpot = Dashpot::outside; });
  with("spring only", [](auto& s) { s.law.conventions.springReset = SpringReset::springOnly; });
  with("no twist", [](auto& s) { s.law.conventions.springTwist = SpringTwist::none; });
  with("rough", [](auto& s) { s.law.mu = 5.0; });
  with("materials", [](auto& s) {
    mix(s);
    s.materials->ofWall.pop_back();
  });
  for (const Integrator integrator : {Integrator::velocityVerlet, Integrator::semiImplicitEuler})
    with("integrator", [&](auto& s) { s.law.conventions.integrator = integrator; });
  with("rolling", [](auto& s) {
    s.law.mu = 5.0;
    s.law.rolling = RollingLaw::spring;
    s.law.kr = 1e4;
    s.law.gr = 0.05;
    s.law.muR = 5.0;
  });
  for (auto& [name, setup] : runs) {
    Spheres whole(setup);
    whole.advance(30);
    const auto contacts = whole.contacts();
    ASSERT_GE(contacts.size(), 3u) << name;
    SpheresSetup later = setup;
    for (std::size_t i = 0; i < whole.size(); ++i) {
      later.position[i] = whole.position(i);
      later.velocity[i] = whole.velocity(i);
      later.spin[i] = whole.spin(i);
    }
    for (SpaceWall& wall : later.walls) {
      const double since = whole.time();
      const Vector shift = wall.motion(since).centre - wall.motion(0.0).centre;
      for (SpaceWall::Plane& plane : wall.planes) plane.point += shift;
      wall.motion = [motion = wall.motion, since](double t) { return motion(since + t); };
    }
    Spheres begun(later);
    begun.beginUnderWay(contacts);
    EXPECT_EQ(begun.contactEvaluations(), Spheres(later).contactEvaluations());
    for (const int steps : {0, 1, 20}) {
      whole.advance(static_cast<std::uint64_t>(steps));
      begun.advance(static_cast<std::uint64_t>(steps));
      SCOPED_TRACE(name + ", " + std::to_string(steps));
      for (std::size_t i = 0; i < whole.size(); ++i) {
        EXPECT_LT(length(whole.position(i) - begun.position(i)), 1e-10 * radius);
        EXPECT_LT(length(whole.velocity(i) - begun.velocity(i)), 1e-9);
        EXPECT_LT(radius * length(whole.spin(i) - begun.spin(i)), 1e-9);
      }
    }
    EXPECT_THROW(begun.beginUnderWay(contacts), std::logic_error);
  }
}

TEST(Spheres, EveryInstructionSet_GivesTheSameBits) {
  std::vector<std::vector<double>> bits;
  for (const char* set : instructionSets()) {
    setenv("GRAIN_INSTRUCTIONS", set, 1);
    Spheres spheres(boxed({}));
    spheres.advance(400);
    bits.push_back(bitsOf(spheres));
  }
  unsetenv("GRAIN_INSTRUCTIONS");
  for (const auto& each : bits) EXPECT_EQ(each, bits.front());
}

TEST(Spheres, SphereInASphere_EndsTheRun) {
  SpheresSetup setup = meeting(springLaw(), true);
  setup.walls.clear();
  setup.velocity[0] = {500.0, 0.0, 0.0};
  Spheres spheres(setup);
  EXPECT_THROW(spheres.advance(100), std::runtime_error);
}

}  // namespace
