// Our fields and MercuryCG's, of the same files. MercuryCG's method is written out here from its
// definitions (Goldhirsch 2010, Granular Matter 12:239; Weinhart et al. 2012, Granular Matter
// 14:289; MercuryDPM, Kernel/CG: Fields/StandardFields.cc, Coordinates/O.cc, Y.cc, XY.cc,
// Functions/Polynomial.hcc), from what `export mercurydpm` wrote and nothing else:
//
//   Density        Σ m φ        Momentum  Σ m v φ        MomentumFlux  Σ m v⊗v φ
//   ContactStress  Σ F⊗(x_P − x_I) ∫₀¹ φ(x_I + s(x_P − x_I)) ds, x_P − x_I = n (R_P + R_I − δ)
//
// MercuryCG of July 2024, built from its source, gave the same on these files to 3e-16.
//
// φ is 1/V over the whole domain, 1/2c per area in slabs (Heaviside, |y − y_i| < c) and 1/πc² per
// length in the plane. KineticStress is MomentumFlux − Momentum⊗Momentum/Density.
#include <gsl/gsl_integration.h>
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <numbers>
#include <random>
#include <sstream>

#include "adapters/files/write_snapshots.hpp"
#include "averaging/grid.hpp"
#include "tests/averaging/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain {
namespace {

using test::fieldIn;
using test::Instant;

using std::numbers::pi;
/// Of a field's largest value: what the sums of a hundred numbers leave, with room to spare.
constexpr double agreement = 1e-9;

const Vec2 low(-0.1, 0.0), high(1.1, 0.9);
constexpr double height = 0.05, areaDensity = 40.0;  // [m], of disks: ρh [kg/m²]

/// Disks that fill the box loosely, a row of wall disks below and a plane wall on the left; every
/// pair that overlaps pushes, and some pull. No mechanics: only sums.
/// @param largest  radius of every third disk [m]  @param overlap  of touching pairs, instead of
///        what their places say [m]  @param wallDisks  whether there is that row
Instant packing(double largest, std::optional<double> overlap = {}, bool wallDisks = true) {
  std::mt19937_64 generator(38);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Instant instant;
  for (int row = 0; row < 8; ++row)
    for (int column = 0; column < 10; ++column) {
      const double a = (row + column) % 3 == 0 ? largest : 0.05;
      const Vec2 at(0.05 + 0.1 * column + 0.01 * unit(generator),
                    0.11 + 0.095 * row + 0.01 * unit(generator));
      const Vec2 v(0.3 * at.y() + 0.1 * unit(generator), 0.1 * unit(generator));
      // Larger disks are of another material, so that means by mass are not those by volume.
      const double density = a > 0.05 ? 1.5 * areaDensity : areaDensity;
      instant.addDisk(at, a, density * pi * a * a, v, unit(generator));
    }
  std::vector<Vec2> floor;
  for (int k = 0; wallDisks && k < 10; ++k) floor.emplace_back(0.05 + 0.1 * k, 0.045);
  instant.addWall("floor", floor, 0.02);
  instant.addWall("side", {}, 0.0);
  instant.scene.bodies.back().planes = {{{0.0, 0.0}, Vec2::UnitX()}};
  const std::vector<double> radii = instant.scene.radii();
  const auto place = [&](std::size_t id) {
    return id < 80 ? instant.snapshot.position[id] : instant.snapshot.wallPosition[id - 80];
  };
  const auto touch = [&](std::size_t i, std::size_t j, const Vec2& normal, double delta) {
    if (delta <= 0.0) return;
    instant.addContact(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), normal,
                       5.0 + 6.0 * unit(generator), unit(generator));
    instant.snapshot.contacts->overlap.back() = overlap.value_or(delta);
  };
  for (std::size_t i = 0; i < 80; ++i) {
    for (std::size_t j = i + 1; j < radii.size(); ++j) {
      const Vec2 branch = place(i) - place(j);
      touch(i, j, branch.normalized(), radii[i] + radii[j] - branch.norm());
    }
    touch(i, radii.size(), Vec2::UnitX(), radii[i] - place(i).x());
  }
  return instant;
}

struct Particle {
  Vec2 x, v;
  double radius, mass;
  bool isFixed;
};

struct Interaction {
  std::size_t p;
  std::ptrdiff_t i;  ///< < 0: a wall
  Vec2 normal, force;
  double overlap;
};

/// One time of .data and .fstat as DPMBase::readNextDataFile() and readNextFStatFile() read it,
/// with what DPMBase::read() has taken from .restart.
struct Files {
  std::vector<Particle> particles;
  std::vector<Interaction> interactions;
  double volume = 0.0;  ///< of the domain
  double lx = 0.0;
};

Files readBack(const Instant& instant) {
  const TemporaryFolder folder;
  const auto writer =
      files::openWriter("mercurydpm", folder.path() / "run", instant.scene, {low, high, height});
  writer->write(instant.snapshot);
  writer->close();
  Files read;
  std::ifstream data(folder.path() / "run.data"), fstat(folder.path() / "run.fstat"),
      restart(folder.path() / "run.restart");
  std::vector<double> density;
  std::vector<bool> isFixed;
  for (std::string word; restart >> word;)
    if (word == "density")
      restart >> density.emplace_back();
    else if (word == "invMass") {
      double inverse = 0.0;
      restart >> inverse;
      isFixed.push_back(inverse == 0.0);
    }
  std::size_t count = 0;
  double time, box[6], skipped;
  data >> count >> time;
  for (double& side : box) data >> side;
  read.lx = box[3] - box[0];
  read.volume = read.lx * (box[4] - box[1]) * (box[5] - box[2]);
  for (std::size_t k = 0; k < count; ++k) {
    Particle& p = read.particles.emplace_back();
    data >> p.x.x() >> p.x.y() >> skipped >> p.v.x() >> p.v.y() >> skipped >> p.radius;
    for (int rest = 7; rest < 13; ++rest) data >> skipped;
    std::size_t species = 0;
    data >> species;
    p.mass = density.at(species) * pi * p.radius * p.radius;  // BaseParticle::computeMass()
    p.isFixed = isFixed.at(k);
  }
  std::string line;
  for (int head = 0; head < 3; ++head) std::getline(fstat, line);
  while (std::getline(fstat, line)) {
    std::istringstream row(line);
    Interaction c;
    double fn, ft, tx, ty;
    row >> time >> c.p >> c.i >> skipped >> skipped >> skipped >> c.overlap >> skipped >> fn >>
        ft >> c.normal.x() >> c.normal.y() >> skipped >> tx >> ty;
    if (c.i >= 0 && static_cast<std::size_t>(c.i) < c.p) continue;  // the second of two lines
    c.force = fn * c.normal + ft * Vec2(tx, ty);
    if (c.i < 0) {  // BaseInteraction::setFStatData() of walls
      c.force = -c.force;
      c.normal = -c.normal;
    }
    read.interactions.push_back(c);
  }
  EXPECT_EQ(read.particles.size(), instant.scene.disks.size() + instant.scene.wallDiskCount());
  EXPECT_EQ(read.interactions.size(), instant.snapshot.contacts->size());
  return read;
}

/// The sums of MercuryCG's StandardFields over particles that are not fixed, each with its φ.
struct Sums {
  double density = 0.0;
  Vec2 momentum = Vec2::Zero();
  Eigen::Matrix2d flux = Eigen::Matrix2d::Zero();

  Eigen::Matrix2d kineticStress() const { return flux - momentum * momentum.transpose() / density; }
};
Sums sumsOf(const Files& files, const std::function<double(const Particle&)>& phi) {
  Sums sums;
  for (const Particle& p : files.particles) {
    if (p.isFixed) continue;
    const double weight = p.mass * phi(p);
    sums.density += weight;
    sums.momentum += weight * p.v;
    sums.flux += weight * p.v * p.v.transpose();
  }
  return sums;
}

/// ContactStress over the whole domain, from centre to centre, and of a fixed partner or a wall up
/// to the contact point only (CONTACT_TO_P), where the force becomes an InteractionForce.
Eigen::Matrix2d contactStress(const Files& files) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const Interaction& c : files.interactions) {
    const Particle& p = files.particles[c.p];
    const Particle* i = c.i < 0 ? nullptr : &files.particles[static_cast<std::size_t>(c.i)];
    const double length =
        !i || i->isFixed ? p.radius - 0.5 * c.overlap : p.radius + i->radius - c.overlap;
    sum += c.force * (length * c.normal).transpose();
  }
  return sum / files.volume;
}

/// Stress that ours has more, for its branches include the whole radius of each disk, and of a wall
/// disk, too.
Eigen::Matrix2d restOfBranches(const Files& files) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const Interaction& c : files.interactions) {
    const Particle* i = c.i < 0 ? nullptr : &files.particles[static_cast<std::size_t>(c.i)];
    const double length = !i           ? 0.5 * c.overlap
                          : i->isFixed ? i->radius + 0.5 * c.overlap
                                       : c.overlap;
    sum += c.force * (length * c.normal).transpose();
  }
  return sum / files.volume;
}

void expectSums(const Sums& theirs, const Coordinates& bins, const std::vector<Moments>& moments,
                std::size_t slot) {
  const auto ours = [&](const char* field) { return fieldIn(slot, field, bins, moments); };
  const double flux = theirs.flux.cwiseAbs().maxCoeff();
  EXPECT_NEAR(ours("density"), theirs.density, agreement * theirs.density);
  EXPECT_NEAR(ours("dynamic_stress_xx"), theirs.flux(0, 0), agreement * flux);
  EXPECT_NEAR(ours("dynamic_stress_xy"), theirs.flux(0, 1), agreement * flux);
  EXPECT_NEAR(ours("dynamic_stress_yy"), theirs.flux(1, 1), agreement * flux);
  const Vec2 momentum = ours("density") * Vec2(ours("velocity_x"), ours("velocity_y"));
  EXPECT_LT((momentum - theirs.momentum).norm(), agreement * theirs.momentum.norm());
}

void expectKineticStress(const Sums& theirs, const Coordinates& bins,
                         const std::vector<Moments>& moments, std::size_t slot) {
  const Eigen::Matrix2d stress = theirs.kineticStress();
  const double most = stress.cwiseAbs().maxCoeff();
  const auto ours = [&](const char* field) { return fieldIn(slot, field, bins, moments); };
  EXPECT_NEAR(ours("fluctuation_stress_xx"), stress(0, 0), agreement * most);
  EXPECT_NEAR(ours("fluctuation_stress_xy"), stress(0, 1), agreement * most);
  EXPECT_NEAR(ours("fluctuation_stress_yy"), stress(1, 1), agreement * most);
}

Eigen::Matrix2d stressOf(const Coordinates& bins, const std::vector<Moments>& moments,
                         std::size_t slot) {
  Eigen::Matrix2d stress;
  stress << fieldIn(slot, "stress_xx", bins, moments), fieldIn(slot, "stress_xy", bins, moments),
      fieldIn(slot, "stress_yx", bins, moments), fieldIn(slot, "stress_yy", bins, moments);
  return stress;
}

constexpr std::size_t onlyCell = 1;  // of a Grid of one cell

TEST(MercuryCg, WholeDomain_EveryWeight_SameFields) {
  const Instant instant = packing(0.06);
  const Files files = readBack(instant);
  ASSERT_GT(files.interactions.size(), 100u);
  const Grid box(low, high, 1, 1, height);
  const Sums theirs = sumsOf(files, [&](const Particle&) { return 1.0 / files.volume; });
  for (const Weight& weight :
       {Weight(WeightMethod::slicing), Weight(WeightMethod::centre),
        Weight(WeightMethod::lineHeaviside, 0.02), Weight(WeightMethod::lineGaussian, 0.004)}) {
    SCOPED_TRACE(toString(weight.method));
    const auto moments = momentsOf(box, instant, weight);
    expectSums(theirs, box, moments, onlyCell);
    expectKineticStress(theirs, box, moments, onlyCell);
  }
}

/// Ours has the whole radius as the branch of each disk, as the thesis does, and the part of the
/// wall disks; MercuryCG what is left of a radius in a contact, and of fixed partners nothing.
TEST(MercuryCg, ContactStressOfWholeDomain_IsTheirsAndTheRestOfTheBranches) {
  const Grid box(low, high, 1, 1, height);
  for (const bool wallDisks : {true, false})
    for (const std::optional<double> overlap : {std::optional<double>(), std::optional(0.0)}) {
      SCOPED_TRACE(testing::Message()
                   << "wall disks: " << wallDisks << ", overlaps: " << !overlap.has_value());
      const Instant instant = packing(0.06, overlap, wallDisks);
      const Files files = readBack(instant);
      const Eigen::Matrix2d theirs = contactStress(files), rest = restOfBranches(files);
      const double most = theirs.cwiseAbs().maxCoeff();
      for (const Weight& weight :
           {Weight(WeightMethod::slicing), Weight(WeightMethod::lineHeaviside, 0.02)}) {
        const Eigen::Matrix2d ours = stressOf(box, momentsOf(box, instant, weight), onlyCell);
        EXPECT_LT((ours - theirs - rest).cwiseAbs().maxCoeff(), agreement * most);
        if (overlap && !wallDisks) {
          EXPECT_LT((ours - theirs).cwiseAbs().maxCoeff(), agreement * most);
        } else {
          EXPECT_GT((ours - theirs).cwiseAbs().maxCoeff(), 1e-3 * most);
        }
      }
    }
}

/// `centre` in slabs is MercuryCG's Heaviside function of y with its width half a slab, at the
/// slabs' middles.
TEST(MercuryCg, Slabs_CentreIsHeavisideOfY) {
  const Instant instant = packing(0.06);
  const Files files = readBack(instant);
  constexpr int count = 6;
  const Grid slabs(low, high, 1, count, height);
  const auto moments = momentsOf(slabs, instant, WeightMethod::centre);
  const double half = 0.5 * (high.y() - low.y()) / count;
  for (int k = 0; k < count; ++k) {
    SCOPED_TRACE(k);
    const double middle = low.y() + (2 * k + 1) * half;
    const Sums theirs = sumsOf(files, [&](const Particle& p) {
      return std::abs(p.x.y() - middle) < half ? 1.0 / (2.0 * half) / (files.lx * height) : 0.0;
    });
    ASSERT_GT(theirs.density, 0.0);
    expectSums(theirs, slabs, moments, slabs.slot(0, k));
    expectKineticStress(theirs, slabs, moments, slabs.slot(0, k));
  }
}

/// Area of a disc in a rectangle: what is between its two arcs, added up along x.
double commonArea(const Vec2& x, double c, const Vec2& from, const Vec2& to) {
  struct Strip {
    Vec2 x, from, to;
    double c;
  } strip{x, from, to, c};
  gsl_function between;
  between.params = &strip;
  between.function = [](double at, void* given) {
    const Strip& s = *static_cast<Strip*>(given);
    const double arc = std::sqrt(std::max(s.c * s.c - (at - s.x.x()) * (at - s.x.x()), 0.0));
    return std::max(std::min(s.to.y(), s.x.y() + arc) - std::max(s.from.y(), s.x.y() - arc), 0.0);
  };
  // The integrand has kinks where an arc meets a side.
  std::vector<double> at = {std::max(from.x(), x.x() - c), std::min(to.x(), x.x() + c)};
  if (at[0] >= at[1]) return 0.0;
  for (const double side : {from.y(), to.y()})
    if (const double square = c * c - (side - x.y()) * (side - x.y()); square > 0.0)
      for (const double sign : {-1.0, 1.0})
        if (const double kink = x.x() + sign * std::sqrt(square); kink > at[0] && kink < at[1])
          at.push_back(kink);
  std::ranges::sort(at);
  const std::unique_ptr<gsl_integration_workspace, void (*)(gsl_integration_workspace*)> room(
      gsl_integration_workspace_alloc(200), gsl_integration_workspace_free);
  double area = 0.0;
  for (std::size_t k = 0; k + 1 < at.size(); ++k) {
    double part = 0.0, error = 0.0;
    gsl_integration_qags(&between, at[k], at[k + 1], 1e-14, 1e-12, 200, room.get(), &part, &error);
    area += part;
  }
  return area;
}

/// `line_heaviside` of width c is MercuryCG's Heaviside function in the plane with its width c, at
/// every point of a bin and their mean; and so is `slicing` of disks of one radius c.
TEST(MercuryCg, PlaneBins_LineHeavisideAndSlicingAreMeansOfHeaviside) {
  constexpr double c = 0.05;
  const Instant instant = packing(c);
  const Files files = readBack(instant);
  const Grid bins({0.1, 0.2}, {0.9, 0.8}, 4, 3, height);
  const Vec2 cell(0.2, 0.2);
  for (const Weight& weight :
       {Weight(WeightMethod::lineHeaviside, c), Weight(WeightMethod::slicing)}) {
    const auto moments = momentsOf(bins, instant, weight);
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i) {
        SCOPED_TRACE(testing::Message() << toString(weight.method) << " " << i << " " << j);
        const Vec2 from = Vec2(0.1, 0.2) + cell.cwiseProduct(Vec2(i, j));
        const Sums theirs = sumsOf(files, [&](const Particle& p) {
          return commonArea(p.x, c, from, from + cell) / (pi * c * c) / (cell.prod() * height);
        });
        expectSums(theirs, bins, moments, bins.slot(i, j));
      }
  }
}

}  // namespace
}  // namespace crossgrain
