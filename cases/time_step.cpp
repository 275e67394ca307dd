#include "cases/time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "cases/collision_scene.hpp"
#include "cases/flow.hpp"
#include "cases/materials.hpp"
#include "oracle/impact.hpp"

namespace crossgrain::inline cases {

namespace {

/// The two largest of some inverse masses: those of a pair. A single disk meets walls only.
struct LargestTwo {
  double first = 0.0, second = 0.0;
  void add(double inverse) {
    second = std::max(second, std::min(first, inverse));
    first = std::max(first, inverse);
  }
  double reducedMass() const { return 1.0 / (first + second); }
};

class Lightest {
 public:
  void add(double mass, double radius, double inertia, bool rotation) {
    normal_.add(1.0 / mass);
    tangential_.add(1.0 / mass + (rotation ? radius * radius / inertia : 0.0));
  }
  LightestPair pair() const { return {normal_.reducedMass(), tangential_.reducedMass()}; }

 private:
  LargestTwo normal_, tangential_;
};

template <int D>
void add(Lightest& lightest, const DisksOf<D>& disks, bool rotation) {
  for (std::size_t i = 0; i < disks.size(); ++i)
    lightest.add(disks.mass[i], disks.radius[i], disks.inertia[i], rotation);
}

template <int D>
LightestPair lightestPair(const AssemblyOf<D>& assembly) {
  Lightest lightest;
  for (const DiskGroupOf<D>& group : assembly.disks) {
    const double share = 1.0 - group.radiusSpread;
    const double radius = group.radius * share;
    double mass = group.mass * share * share;
    if (D == 3) mass *= share;
    for (std::size_t k = 0; k < std::min<std::size_t>(group.count(), 2); ++k)
      lightest.add(mass, radius, assembly.inertiaFactor * mass * radius * radius,
                   assembly.rotation);
  }
  for (const DisksOf<D>& disks : assembly.starts.disks) add(lightest, disks, assembly.rotation);
  return lightest.pair();
}

}  // namespace

LightestPair lightestPair(const Disks& disks, bool rotation) {
  Lightest lightest;
  add(lightest, disks, rotation);
  return lightest.pair();
}

LightestPair lightestPair(const Case& c) {
  if (isCollision(c)) {
    const CollidingPair pair = collidingPair(c);
    return {pair.reducedMass(), 1.0 / pair.tangentialCompliance()};
  }
  if (isAssembly(c))
    return withAssembly(c, [](const auto& assembly) { return lightestPair(assembly); });
  // A single disk of a kind never meets its like, but a bound is all that is wanted.
  const Particles& p = couetteIn(c).particles;
  double mass = std::min(p.smallMass, p.largeMass);
  if (p.small > 0 && p.large == 0) mass = p.smallMass;
  if (p.large > 0 && p.small == 0) mass = p.largeMass;
  return {mass / 2.0, mass / 2.0 / (1.0 + 1.0 / p.inertiaFactor)};
}

double lightestReducedMass(const Case& c) {
  return lightestPair(c).normal;
}

double timeStep(const Case& c) {
  if (isCollision(c)) return collisionTimeSteps(c).front();
  if (c.run.dt) return *c.run.dt;
  return shortestContact(c) / c.run.stepsPerContact;
}

double shortestContact(const Case& c) {
  const double mass = lightestReducedMass(c);
  double shortest = INFINITY;
  for (const ContactLaw& law : lawsOf(c)) shortest = std::min(shortest, contactTime(law, mass));
  return shortest;
}

double preparationTime(const Case& c) {
  const Couette& cell = couetteIn(c);
  return cell.filling.shrinkTime +
         cell.filling.rotations * 2.0 * std::numbers::pi / std::abs(cell.cell.omega);
}

double preparationSteps(const Case& c) {
  return preparationTime(c) / couetteIn(c).filling.dt.value_or(timeStep(c));
}

ImpactTimes impactTimes(const Case& c) {
  if (!c.law.soft()) return {};
  const CollidingPair pair = collidingPair(c);
  if (!c.law.stiffens()) {
    const double each = contactTime(c.law, pair.reducedMass());
    return {each, each};
  }
  const auto time = [&](double speed) {
    return impactTime(c.law, {pair.reducedMass(), pair.reducedRadius(), speed});
  };
  std::vector<double> speeds;
  for (const CollisionStart& start : collisionStarts(c)) speeds.push_back(start.vn);
  const auto [slowest, fastest] = std::ranges::minmax(speeds);
  const auto [shortest, longest] = std::minmax({time(slowest), time(fastest)});
  return {shortest, longest};
}

std::vector<double> collisionTimeSteps(const Case& c) {
  if (c.run.dt) return {*c.run.dt};
  std::vector<double> steps;
  const double shortest = impactTimes(c).shortest;
  for (const double count : collisionIn(c).stepsPerContact) steps.push_back(shortest / count);
  return steps;
}

namespace {

/// Stiffness where an impact is deepest.
struct Deepest {
  double normal, tangential;  ///< f_el′ and k_t [N/m]
};

Deepest deepest(const ContactLaw& law, const Impact& impact) {
  if (law.normal == NormalLaw::linear) {
    const bool yields = law.cohesion == CohesionLaw::elastoPlastic;  // unloads up to so stiff
    return {yields ? law.kUnload : law.kn, law.kt};
  }
  const double overlap = deepestOverlap(law, impact);
  if (law.normal == NormalLaw::polynomial)
    return {(2.0 * law.kn + 3.0 * law.kn3 * overlap) * overlap, law.kt};
  const double width = std::sqrt(impact.reducedRadius * overlap);
  return {1.5 * law.kn * width, law.kt * width};
}

/// A term of the law as an oscillator.
struct Oscillator {
  double stiffness, damping, mass;  ///< [N/m, kg/s, kg]
  double sign = 1.0;                ///< c σ of PairStepLimit
};

/// Derived at PairStepLimit; infinite for a contact that does not resist [s].
double longestStep(const Oscillator& term, double s) {
  const double decay = s * term.damping / (2.0 * term.mass);
  const double square = std::max(term.stiffness, 0.0) / term.mass;
  const double alternating = decay * decay + term.sign * square;
  const bool implicit = s == 0.0 && term.damping > 0.0;
  const double spring = implicit && term.sign < 1.0 ? INFINITY : 2.0 / std::sqrt(square);
  return alternating < 0.0 ? spring : std::min(spring, 2.0 / (decay + std::sqrt(alternating)));
}

/// s of PairStepLimit. Semi-implicit Euler has no velocity to predict from.
double laggingOf(const LawConventions& how) {
  if (how.dampingVelocity == DampingVelocity::implicit) return 0.0;
  const bool predicted = how.dampingVelocity == DampingVelocity::predicted &&
                         how.integrator != Integrator::semiImplicitEuler;
  return predicted ? 2.0 : 1.0;
}

/// c σ of PairStepLimit, of the tangential spring.
double signOf(const LawConventions& how) {
  return std::max(laggingOf(how), 1.0) * (2.0 * stretchedShare(how.springUpdate) - 1.0);
}

/// No dashpot of rolling is implicit.
double rollingLagging(const LawConventions& how) {
  return std::max(laggingOf(how), 1.0);
}

/// Rolling of the lightest bodies at a distance of a: (1/Σ 1/J) θ̈ + γ L² θ̇ + k_r (…) θ = 0, all
/// over a². Of two equal disks that turn against each other without slip Σ = 2/J, L = a/2; of one
/// on a plane Σ = 1/J, or 1/(J + m a²) where friction holds it, L = a. That which bears less.
Oscillator rollingOscillator(const ContactLaw& law, const LightestPair& pair, double a) {
  const double mass = 0.5 / pair.normal;                                     // 1/m
  const double inertia = 0.5 * (1.0 / pair.tangential - 1.0 / pair.normal);  // a²/J
  if (!(inertia > 0.0)) return {0.0, 0.0, 1.0};
  const double held = mass * inertia / (mass + inertia);  // a²/(J + m a²)
  const auto termOf = [&](double sum, double heldSum, double reach) {
    const LawConventions& how = law.conventions;
    const double length = how.rollingLength == RollingLength::effective        ? reach
                          : how.rollingLength == RollingLength::twiceEffective ? 2.0 * reach
                                                                               : 1.0;
    const double times = how.rollingStiffness == RollingStiffness::constant ? 1.0 / (a * a)
                         : how.rollingStiffness == RollingStiffness::radii  ? 1.0
                                                                            : length * length;
    const bool critical =
        law.rolling == RollingLaw::spring && how.rollingDamper == RollingDamper::critical;
    const double stiffness = law.rolling == RollingLaw::spring ? law.kr * times : 0.0;
    const double damping =
        critical ? 2.0 * law.gr * std::sqrt(stiffness / heldSum) : law.gr * length * length;
    return Oscillator{stiffness, damping, 1.0 / sum, signOf(how)};
  };
  const Oscillator disks = termOf(2.0 * inertia, 2.0 * held, 0.5);
  const Oscillator plane = termOf(law.friction() ? held : inertia, held, 1.0);
  const double s = rollingLagging(law.conventions);
  return longestStep(disks, s) < longestStep(plane, s) ? disks : plane;
}

/// Of an assembly's start, the two fastest against each other [m/s].
template <int D>
double startingSpeed(const AssemblyOf<D>& assembly) {
  double disk = 0.0, wall = 0.0, second = 0.0;
  const auto look = [&](double speed) {
    second = std::max(second, std::min(disk, speed));
    disk = std::max(disk, speed);
  };
  for (const DiskGroupOf<D>& group : assembly.disks) look(group.velocity.norm());
  for (const DisksOf<D>& disks : assembly.starts.disks)
    for (const VecOf<D>& velocity : disks.velocity) look(velocity.norm());
  for (const WallGroupOf<D>& walls : assembly.walls)
    wall = std::max({wall, walls.motion.velocity.norm(),
                     walls.motion.amplitude.norm() * std::abs(walls.motion.frequency)});
  return disk + std::max(second, wall);
}

}  // namespace

double startingSpeed(const Case& setup) {
  if (const Couette* const cell = cellOf(setup)) return cell->cell.rimSpeed();
  return withAssembly(setup, [](const auto& assembly) { return startingSpeed(assembly); });
}

double fastestImpactTime(const Case& setup) {
  // A disk alone meets walls, with R₁₂ = a; of two it is a/2.
  const bool alone = isAssembly(setup) && withAssembly(setup, [](const auto& assembly) {
                       return assembly.diskCount() == 1;
                     });
  const Impact impact{lightestReducedMass(setup), flowDiameter(setup) / (alone ? 2.0 : 4.0),
                      startingSpeed(setup)};
  double shortest = INFINITY;
  for (const ContactLaw& law : lawsOf(setup))
    shortest = std::min(shortest, impactTime(law, impact));
  return shortest;
}

std::optional<double> pairContactTime(const Case& setup) {
  if (setup.law.normal != NormalLaw::linear || packingFile(setup)) return std::nullopt;
  try {
    return shortestContact(setup);
  } catch (const std::invalid_argument&) {
    return std::nullopt;  // overdamped
  }
}

namespace {

std::optional<PairStepLimit> pairStepLimit(const Case& setup, const ContactLaw& law,
                                           const LightestPair& pair) {
  const double speed = startingSpeed(setup);
  Deepest stiffness{};
  try {
    stiffness = deepest(law, {pair.normal, flowDiameter(setup) / 4.0, speed});
  } catch (const std::invalid_argument&) {  // a polynomial law that gives way so fast
    return std::nullopt;
  }
  const auto limitOf = [&](const char* name, const Oscillator& term) {
    return PairStepLimit{longestStep(term, laggingOf(law.conventions)), name, term.stiffness,
                         term.damping, term.mass};
  };
  PairStepLimit least = limitOf(
      "normal", {stiffness.normal, dampingOf(law.damper, law.gn, stiffness.normal, pair.normal),
                 pair.normal});
  const double kt = law.springs() ? stiffness.tangential : 0.0;
  const double gt =
      law.dashpots() ? dampingOf(law.damper, law.gt, stiffness.tangential, pair.normal) : 0.0;
  const PairStepLimit tangential =
      limitOf("tangential", {kt, gt, pair.tangential, signOf(law.conventions)});
  if (tangential.dt < least.dt) least = tangential;
  if (law.rolling == RollingLaw::viscous || law.rolling == RollingLaw::spring) {
    const Oscillator term = rollingOscillator(law, pair, flowDiameter(setup) / 2.0);
    const PairStepLimit rolling{longestStep(term, rollingLagging(law.conventions)), "rolling",
                                term.stiffness, term.damping, term.mass};
    if (rolling.dt < least.dt) least = rolling;
  }
  if (!std::isfinite(least.dt)) return std::nullopt;
  return least;
}

}  // namespace

std::optional<PairStepLimit> pairStepLimit(const Case& setup,
                                           std::optional<LightestPair> lightest) {
  if (isCollision(setup) || !setup.law.soft()) return std::nullopt;
  const LightestPair pair = lightest ? *lightest : lightestPair(setup);
  std::optional<PairStepLimit> least;
  for (const ContactLaw& law : lawsOf(setup)) {
    const auto limit = pairStepLimit(setup, law, pair);
    if (limit && (!least || limit->dt < least->dt)) least = limit;
  }
  return least;
}

std::string unstableStepFault(const Case& setup, double dt, const std::string& key,
                              std::optional<LightestPair> lightest) {
  const auto limit = pairStepLimit(setup, lightest);
  if (!limit || dt < limit->dt) return {};
  const char* const parts = limit->damping == 0.0     ? "spring"
                            : limit->stiffness == 0.0 ? "dashpot"
                                                      : "spring and dashpot";
  return fmt::format(
      "{} = {:g} s is beyond {:.3g} s, the longest step at which the {} {} of the lightest contact "
      "stays stable (k = {:.4g} N/m, γ = {:.4g} kg/s, mass = {:.4g} kg)",
      key, dt, limit->dt, limit->term, parts, limit->stiffness, limit->damping, limit->mass);
}

std::string riskyStepFault(const Case& setup, double dt) {
  const auto limit = pairStepLimit(setup);
  if (!limit || dt < limit->dt / std::sqrt(6.0)) return {};
  return fmt::format(
      "the time step of {:.3g} s is beyond what a disk with six contacts bears, 1/√6 of what one "
      "does = {:.3g} s",
      dt, limit->dt / std::sqrt(6.0));
}

}  // namespace crossgrain::inline cases
