#include "cases/loader_sections.hpp"

#include <cmath>
#include <numbers>

#include "adapters/effects.hpp"
#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "averaging/weights.hpp"
#include "cases/couette.hpp"
#include "cases/endpoints.hpp"
#include "law/law_options.hpp"
#include "stability/measures.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cases {
namespace {

constexpr int mostSnapshots = 10'000'000;  // averaged in one run

const Section<BottomPlate>& bottomKeys() {
  static const Section<BottomPlate> section(
      {.name = "bottom",
       .kinds = "couette, assembly",
       .commands = "compare plan lockstep identify baseline record effects cost stability collide",
       .note = "Leave it out for no plate."},
      {need("mu", &BottomPlate::mu, atLeast(0.0), "µ_b"),
       need("kb", &BottomPlate::kb, atLeast(0.0, "N/m"), "spring of a disk on the plate"),
       need("gb", &BottomPlate::gb, atLeast(0.0, "kg/s"), "dashpot"),
       need("tau_m", &BottomPlate::tauM, atLeast(0.0), "τ_M of Eq. 4.28"),
       key("gravity", &BottomPlate::gravity, positive("m/s^2"), "presses disks on the plate"),
       key("spin", &BottomPlate::spin, any, "whether the plate also brakes spin")});
  return section;
}

const Section<Cell>& cellKeys() {
  static const Section<Cell> section(
      {.name = "cell", .kinds = "couette"},
      {need("inner_radius", &Cell::innerRadius, positive("m"),
            "R_i, the wheel; wall disks' centres lie on it"),
       need("outer_radius", &Cell::outerRadius, positive("m"), "R_o, the fixed ring; likewise"),
       need("wall_radius", &Cell::wallRadius, positive("m"), ""),
       need("wall_spacing", &Cell::wallSpacing, positive("m"),
            "wanted; 2πR/wall_spacing disks, rounded, are spread evenly"),
       need("height", &Cell::height, positive("m"), "h of the disks"),
       need("omega", &Cell::omega,
            Range{.unit = "rad/s",
                  .reason = ": all is timed in rotations of the wheel; < 0 is clockwise",
                  .notZero = true},
            "Ω of the wheel, counter-clockwise; v_φ, spin, σ_rφ and torque have its sign"),
       key("wheel_material", &Cell::wheelMaterial, any, "of `[[law.pairs]]`"),
       key("ring_material", &Cell::ringMaterial, any, "likewise")});
  return section;
}

/// The keys of [particles]: numbers and masses may be given by others.
struct ParticlesInput : Particles {
  double density = 0.0, volumeFraction = 0.0, largeNumberShare = 0.0, largeMassShare = 0.0;
};

const Section<ParticlesInput>& particlesKeys() {
  using P = ParticlesInput;
  static const Section<P> section(
      {.name = "particles", .kinds = "couette"},
      {key("small", &P::small, between(0, mostDisks), "number of disks"),
       key("large", &P::large, between(0, mostDisks), "number of disks"),
       need("small_radius", &P::smallRadius, positive("m"), ""),
       need("large_radius", &P::largeRadius, positive("m"), "≥ `small_radius`"),
       key("volume_fraction", &P::volumeFraction, inside(0.0, 1.0), "ν̄, instead of the numbers")
           .listed("–"),
       key("large_number_share", &P::largeNumberShare, between(0.0, 1.0), "0: none")
           .listed("with `volume_fraction`"),
       key("large_mass_share", &P::largeMassShare, between(0.0, 1.0), "likewise, by mass")
           .listed("or this"),
       key("small_mass", &P::smallMass, positive("kg"), "").listed("required"),
       key("large_mass", &P::largeMass, positive("kg"), "").listed("required"),
       key("density", &P::density, positive("kg/m^3"), "instead of the masses: m = ρ π a² h")
           .listed("–"),
       key("inertia_factor", &P::inertiaFactor, aboveZeroTo(1.0),
           "q in J = q m a²: 0.5 disk, 0.4 sphere"),
       key("rotation", &P::rotation, any, "false: no disk spins, friction acts"),
       key("max_overlap", &P::maxOverlap, between(0.0, 1.0),
           "largest of a start, in `small_radius`"),
       key("file", &P::file, ExistingFile{".h5"},
           "your own packing, relative to this file; its numbers of disks apply"),
       key("small_material", &P::smallMaterial, any, "of `[[law.pairs]]`"),
       key("large_material", &P::largeMaterial, any,
           "likewise; disks of a file are of the nearer radius")});
  return section;
}

void setMasses(const Reader& in, const Cell& cell, ParticlesInput& p) {
  if (!in.has("density")) {
    for (const char* const mass : {"small_mass", "large_mass"})
      if (!in.has(mass)) in.failMissing(mass);
    return;
  }
  for (const char* const mass : {"small_mass", "large_mass"}) in.notBeside("density", mass);
  p.smallMass = massOf(in, p.density, p.smallRadius, cell.height);
  p.largeMass = massOf(in, p.density, p.largeRadius, cell.height);
}

/// Numbers of disks from a volume fraction and the part of the disks that are large.
void setNumbers(Reader& in, const Cell& cell, ParticlesInput& p) {
  const std::string share = in.onlyOne({"large_number_share", "large_mass_share"});
  if (!in.has("volume_fraction")) {
    if (!share.empty())
      in.failMissing("volume_fraction", "the share of large disks is for a case that gives it");
    return;
  }
  for (const char* const number : {"small", "large"})
    in.notBeside("volume_fraction", number, ", a number of disks");
  if (share.empty())
    in.failMissing("large_number_share", "or large_mass_share: 0 if there are no large disks");
  double largeFraction = p.largeNumberShare;
  if (share == "large_mass_share") {
    const double large = p.largeMassShare / p.largeMass;
    largeFraction = large / (large + (1.0 - p.largeMassShare) / p.smallMass);
  }
  const double most = diskNumber(cell, p, p.volumeFraction, largeFraction);
  in.check(most <= mostDisks, "volume_fraction",
           "that would be {:.3g} disks: a case may have at most {}", most, mostDisks);
  setNumbers(cell, p, p.volumeFraction, largeFraction);
}

/// The keys of [preparation], and of [averaging].
struct PreparationInput : Preparation, Filling {};
struct AveragingInput : Averaging, CellTimes {};

const Section<PreparationInput>& preparationKeys() {
  using P = PreparationInput;
  static const Section<P> section(
      {.name = "preparation",
       .kinds = "couette, assembly",
       .commands = "compare plan lockstep identify baseline record effects cost stability",
       .note = "An assembly with `[average]` uses `packings` and `seed` only."},
      {key("engine", &P::engine, any, "prepares packings, within `may_differ` and its settings")
           .listed("the in-house one"),
       key("packings", &P::packings, between(1, 10'000),
           "number at the first interim analysis; fewer than 4 give no general verdict")
           .usedBy("compare plan lockstep baseline effects cost"),
       key("seed", &P::seed, between(0, mostSeed), "packing k draws from stream k of it"),
       key("dilation", &P::dilation, above(1.0), "R_prepare/R_o"),
       key("velocity", &P::velocity, atLeast(0.0, "m/s"), "rms of components at the start"),
       key("shrink_time", &P::shrinkTime, positive("s"), "from R_prepare to R_o"),
       key("rotations", &P::rotations, atLeast(0.0), "after that"),
       key("dt", &P::dt, positive("s"), "independent of `run.dt`").listed("that of the runs")});
  return section;
}

const Section<AveragingInput>& averagingKeys() {
  using A = AveragingInput;
  constexpr const char* averaged = "compare plan effects cost average baseline";
  constexpr const char* run =
      "compare plan lockstep identify baseline effects cost stability average";
  static const Section<A> section(
      {.name = "averaging", .kinds = "couette"},
      {key("rings", &A::rings, between(1, 10'000), "of equal width, R_i to R_o").usedBy(averaged),
       key("method", &A::methods, Names(weightNames.begin(), weightNames.end()),
           "one or a list; reports show the first")
           .usedBy(averaged),
       key("line_width", &A::lineWidth, positive("d"), "w of the line methods")
           .usedBy("compare plan effects cost average baseline"),
       key("settle_rotations", &A::settleRotations, atLeast(0.0), "before averaging").usedBy(run),
       key("rotations", &A::rotations, positive(), "averaged").usedBy(run),
       key("snapshots_per_rotation", &A::snapshotsPerRotation, between(1, 1'000'000), "")
           .usedBy("compare plan effects cost baseline"),
       key("confidence", &A::confidence, inside(0.0, 1.0), "").usedBy(averaged)});
  return section;
}

const Section<InterimSettings>& looksKeys() {
  static const Section<InterimSettings> section(
      {.name = "looks",
       .kinds = "couette, assembly",
       .commands = "compare plan",
       .note = "`compare` adds packings until every endpoint is decided: an interim analysis after "
               "1, 2, … times `preparation.packings`."},
      {key("count", &InterimSettings::count, between(1, 100),
           "most interim analyses; 1 for packing files, or fewer than 4 at the first"),
       key("budget", &InterimSettings::budget, positive("s"),
           "none begins that would end later; `--budget` takes precedence")});
  return section;
}

/// Everything an engine may do otherwise than the scene says.
Names deviationNames() {
  Names names;
  for (const LawOption& option : lawOptions()) names.emplace_back(option.name);
  names.emplace_back("rounding");
  names.emplace_back(tangentialRestitutionName);
  for (const Effect effect : allEffects) names.push_back(toString(effect));
  names.emplace_back(allConventionsName);
  return names;
}

/// Puts their names in place of the word for all conventions.
void nameConventions(Names& mayDiffer) {
  if (std::erase(mayDiffer, allConventionsName) == 0) return;
  for (const LawOption& option : lawOptions())
    if (isConvention(option.name) && std::ranges::find(mayDiffer, option.name) == mayDiffer.end())
      mayDiffer.emplace_back(option.name);
}

const Section<RunOptions>& runKeys() {
  constexpr const char* users =
      "compare plan lockstep identify baseline record effects cost stability collide";
  // Answers are waited for in whole milliseconds, and no clock holds more than some years.
  const Range timeouts = between(1e-3, 1e9, "s");
  static const Section<RunOptions> section(
      {.name = "run", .commands = users},
      {key("dt", &RunOptions::dt, positive("s"),
           "of engines without `[engines.NAME] dt`; required for a rigid law"),
       key("steps_per_contact", &RunOptions::stepsPerContact, atLeast(2.0),
           "without `dt`: t_c of the lightest pair / dt; not of collisions"),
       key("handover", &RunOptions::handover, Names{"cold", "warm"},
           "`cold` drops tangential and bottom springs; `warm`: not yet"),
       special<RunOptions>({"may_differ", "", "[]", valuesOf(deviationNames()),
                            "what engines may replace or lack; noted beside figures. "
                            "`conventions`: all options that are no law of their own"},
                           [](Reader& in, const std::string& key, RunOptions& run) {
                             in.read(key, run.mayDiffer, deviationNames());
                             nameConventions(run.mayDiffer);
                           }),
       key("precision", &RunOptions::precision, Names(precisionNames.begin(), precisionNames.end()),
           "of engines that have it"),
       key("timeout", &RunOptions::timeout, timeouts,
           "longest wait for an engine's answer, doubled while it computes"),
       key("mirrors", &RunOptions::mirrors, any,
           "run the in-house engine under each peer's conventions, too")
           .usedBy("compare plan collide"),
       key("energy_ledger", &RunOptions::energyLedger, any,
           "columns `energy_…` of `series.csv` and the field `dissipation`, of engines that report "
           "terms")
           .usedBy("compare plan record stability effects cost"),
       key("keep_snapshots", &RunOptions::keepSnapshots, between(0, 1'000'000), "per run, in HDF5")
           .usedBy("compare plan effects cost"),
       key("keep_snapshots_of", &RunOptions::keepSnapshotsOf, between(1, 1'000'000),
           "packings, from the first")
           .usedBy("compare plan effects cost")});
  return section;
}

const Section<Stability>& stabilityKeys() {
  Names measures;
  for (const StabilityMeasure& measure : stabilityMeasures()) measures.emplace_back(measure.name);
  static const Section<Stability> section(
      {.name = "stability", .commands = "stability", .note = "Makes a hard case of any case."},
      {need("tests", &Stability::tests, Sentence{"must say in a sentence what it tests"},
            "a sentence"),
       need("measure", &Stability::measure, measures, ""),
       need("limit", &Stability::limit, atLeast(0.0), "stable up to this")
           .listed("required", "the measure's"),
       need("degraded", &Stability::degraded, atLeast(0.0), "degraded up to this; unstable beyond")
           .listed("required", "the measure's"),
       need("why", &Stability::why, Sentence{"must give the reason"}, "of the limits"),
       key("samples", &Stability::samples, between(1, 100'000), "snapshots, evenly spread"),
       key("settle", &Stability::settle, Range{.low = 0.0, .high = 1.0, .highOpen = true},
           "part of the run before rest is required"),
       key("stands", &Stability::stands, any,
           "all stands: once a body moves by half a diameter before `settle`, rest is required "
           "from the start"),
       key("quick", &Stability::quick, any, "of `--quick`"),
       key("long", &Stability::longRun, any, "of `--long` only")});
  return section;
}

std::vector<Judged> judgedEndpoints() {
  std::vector<Judged> judged;
  for (const Endpoint& endpoint : endpointTable())
    judged.push_back({std::string(endpoint.name), std::string(endpoint.unit), endpoint.byRatio});
  return judged;
}

}  // namespace

std::vector<SectionInfo> cellSections() {
  return {
      bottomKeys().info(),
      cellKeys().info(),
      particlesKeys().info(),
      preparationKeys().info(),
      averagingKeys().info(),
      marginSection(
          {.name = "averaging.endpoints",
           .kinds = "couette",
           .commands = "compare plan baseline",
           .note = "Largest difference of two engines that agree: decides verdicts of `compare`. "
                   "Without one an endpoint is not judged. `pressure` is compared by its ratio and "
                   "takes `relative`, all others by their difference."},
          "ENDPOINT", "an endpoint (`crossgrain list endpoints`)", "of the reference's mean", true),
      looksKeys().info(),
      marginSection({.name = "averaging.margins",
                     .kinds = "couette",
                     .commands = "compare plan effects",
                     .note = "Per ring, for colours and `effects`."},
                    "FIELD", "a field of `profiles.csv` (`crossgrain list fields`)",
                    "of the reference's mean", true)};
}

std::vector<SectionInfo> runSections() {
  return {runKeys().info(),
          {.name = "engines.NAME",
           .commands = runKeys().info().commands + " average",
           .keys = {{"SETTING", "the setting's", "the engine's", "",
                     "boolean, number or string; `crossgrain engines` lists them"}}},
          stabilityKeys().info()};
}

double massOf(const Reader& in, double density, double radius, double height) {
  const double mass = density * std::numbers::pi * radius * radius * height;
  in.check(std::isnormal(mass), "density", "makes disks of radius {} m weigh {} kg", radius, mass);
  return mass;
}

void readBottom(Reader& root, std::optional<BottomPlate>& plate) {
  Reader in = root.section("bottom");
  if (!root.has("bottom")) return;
  bottomKeys().read(in, plate.emplace());
  if (plate->mu == 0.0) plate.reset();
}

void readCell(Reader& in, Cell& c) {
  cellKeys().read(in, c);
  in.check(c.outerRadius > c.innerRadius, "outer_radius", "must be > inner_radius = {} m",
           c.innerRadius);
  in.check(c.wallSpacing <= c.innerRadius, "wall_spacing", "must be <= inner_radius = {} m",
           c.innerRadius);
}

void readParticles(Reader& in, const Cell& c, Particles& target) {
  ParticlesInput p;
  particlesKeys().read(in, p);
  setMasses(in, c, p);
  setNumbers(in, c, p);
  in.check(p.largeRadius >= p.smallRadius, "large_radius", "must be >= small_radius = {} m",
           p.smallRadius);
  if (p.file) {
    p.small = p.large = 0;  // how many there are is for the file to say
  } else if (p.small + p.large == 0) {
    if (in.has("small")) in.fail("small", "no small and no large disks: a cell without disks");
    if (in.has("volume_fraction")) in.fail("volume_fraction", "is less than one disk has");
    in.failMissing("small", "or large, or volume_fraction, or file: a cell without disks");
  }
  in.check(p.small <= mostDisks - p.large, "small", "with large = {} that is more than {} disks",
           p.large, mostDisks);
  target = p;
}

void readPreparation(Reader& in, Case& c) {
  PreparationInput input;
  preparationKeys().read(in, input);
  c.preparation = input;
  couetteIn(c).filling = input;
  const std::string& engine = input.engine;
  if (!in.has("engine") || findEngine(engine)) return;
  Names known;
  for (const EngineEntry& entry : engineRegistry()) known.push_back(entry.name);
  in.fail("engine", "there is no such engine{}", suggestion(engine, known));
}

void readPackings(Reader& in, Case& c) {
  withAssembly(c, [&](auto& assembly) {
    PreparationInput input;
    input.seed = assembly.seed;
    preparationKeys().read(in, input, {"packings", "seed"});
    c.preparation = input;
    assembly.seed = input.seed;
  });
}

void readAveraging(Reader& in, Case& c) {
  const Reader margins = in.section("margins"), endpoints = in.section("endpoints");
  AveragingInput how;
  averagingKeys().read(in, how);
  how.margins = readMargins(margins, judgedFields(fieldsIn(2, true)), &c);
  how.endpoints = readMargins(endpoints, judgedEndpoints(), &c);
  in.check(!how.methods.empty(), "method", "must not be empty");
  in.check(how.snapshotsPerRotation * how.rotations <= mostSnapshots, "rotations",
           "with {} snapshots_per_rotation: more than {} snapshots", how.snapshotsPerRotation,
           mostSnapshots);
  c.averaging = how;
  couetteIn(c).times = how;
}

void readInterims(Reader& in, InterimSettings& target) {
  looksKeys().read(in, target);
}

void readRun(Reader& in, RunOptions& options) {
  runKeys().read(in, options);
  in.check(options.handover != "warm", "handover", "not yet supported; \"cold\" is");
  in.check(!options.dt || !in.has("steps_per_contact"), "steps_per_contact",
           "the step is given by run.dt, leave out one of them");
}

Settings readSettings(Reader engine) {
  Settings settings;
  for (const std::string& key : engine.keys()) {
    const toml::node& node = *engine.take(key);
    if (const auto flag = node.value_exact<bool>())
      settings[key] = *flag;
    else if (const auto text = node.value_exact<std::string>())
      settings[key] = *text;
    else
      engine.read(key, std::get<double>(settings[key] = 0.0), anyNumber());
  }
  return settings;
}

void readEngines(Reader& in, std::map<std::string, Settings>& engines) {
  for (const std::string& name : in.keys()) engines[name] = readSettings(in.section(name));
}

void readStability(Reader& in, int dimension, Stability& hard) {
  stabilityKeys().read(in, hard);
  const StabilityMeasure& measure = stabilityMeasure(hard.measure);
  in.check(dimension == 2 || !measure.curve || measure.curveInSpace, "measure",
           "is of the plane alone, and case.dimension = 3");
  in.check(hard.degraded >= hard.limit, "degraded", "must be >= limit = {}", hard.limit);
}

}  // namespace crossgrain::inline cases
