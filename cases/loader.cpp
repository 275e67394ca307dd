#include "cases/loader.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "cases/assembly_scene.hpp"
#include "cases/case_files.hpp"
#include "cases/collision_scene.hpp"
#include "cases/couette.hpp"
#include "cases/flow.hpp"
#include "cases/loader_document.hpp"
#include "cases/loader_sections.hpp"
#include "cases/materials.hpp"
#include "cases/scene_numbers.hpp"
#include "cases/time_step.hpp"
#include "oracle/impact.hpp"
#include "support/input_file.hpp"

namespace crossgrain::inline cases {
namespace {

/// The keys of [case].
struct Header {
  std::string name;
  enum class Kind { couette, collision, assembly } kind = Kind::couette;
  int dimension = 2;
};
const Names caseKinds = {"couette", "collision", "assembly"};  // in the order of Header::Kind

const Section<Header>& headerKeys() {
  static const Section<Header> section(
      {.name = "case"},
      {key("name", &Header::name, any, "letters, digits and `. _ - +`").listed("the file's name"),
       need("kind", &Header::kind, caseKinds, ""),
       special<Header>({"dimension", "", "2", "2, 3",
                        "3: spheres in space (docs/dimensions.md), not of couette"},
                       [](Reader& in, const std::string& key, Header& header) {
                         in.read(key, header.dimension, between(2, 3));
                       }),
       special<Header>({"extends", "", "–", "",
                        "a case file, relative to this one, or an installed one, `cases/…`"},
                       // readCaseDocuments() takes it
                       [](Reader&, const std::string&, Header&) {})});
  return section;
}

void readHeader(Reader& in, Case& c) {
  Header header{.name = c.name};
  headerKeys().read(in, header);
  c.name = header.name;
  c.dimension = header.dimension;
  if (header.kind == Header::Kind::collision)
    c.source = Collision();
  else if (header.kind == Header::Kind::assembly && c.dimension == 3)
    c.source = AssemblyOf<3>();
  else if (header.kind == Header::Kind::assembly)
    c.source = Assembly();
  in.check(c.dimension == 2 || !cellOf(c), "dimension",
           "a couette cell is of the plane: collisions and assemblies are in space, too");
  if (usableName(c.name)) return;
  if (in.has("name")) in.fail("name", usableNameRule);
  in.failMissing("name", "the name of the file cannot stand in for it");
}

/// The names of tables, of which a kind of case has some.
bool isTable(const SectionInfo& section) {
  return section.name.find('.') == std::string::npos && section.name != "variants";
}

/// Sections that only other kinds of cases have.
void refuseSections(const Reader& root, const Case& c) {
  const std::string own = kindOf(c);
  for (const SectionInfo& section : caseSections())
    if (isTable(section) && root.has(section.name) && !section.kinds.empty())
      root.check(section.kinds.find(own) != std::string::npos, section.name,
                 "has no part in {} {} case", isAssembly(c) ? "an" : "a", own);
}

/// Without [run] dt the law has to tell how long a contact lasts.
void requireStep(Reader& run, const Case& c) {
  if (c.run.dt) return;
  if (c.law.normal == NormalLaw::rigid) run.failMissing("dt", "a rigid law has no contact time");
  if (!c.law.stiffens()) return;
  const double speed = startingSpeed(c);
  double time = NAN;
  try {
    if (speed > 0.0) time = fastestImpactTime(c);
  } catch (const std::invalid_argument&) {
    // A law that gives way at that speed: no impact ends.
  }
  if (!std::isfinite(time))
    run.failMissing("dt", "the contact time of this law depends on the speed of an impact");
  run.failMissing("dt", fmt::format("the contact time of this law depends on the speed of an "
                                    "impact: {:.3g} s at {:.3g} m/s, the fastest at the start; "
                                    "a fiftieth of it is {:.2g} s",
                                    time, speed, time / 50.0));
}

/// A linear contact must oscillate: e_n and t_c are defined by that.
void checkDamping(const Reader& law, const Case& c) {
  if (c.law.normal != NormalLaw::linear) return;
  const double mass = lightestReducedMass(c);
  const auto check = [&](const ContactLaw& own, const char* key, const std::string& what) {
    const double critical = 2.0 * std::sqrt(own.kn * mass);
    const double used = withConstantDampers(own, mass).gn;
    law.check(used < critical, key, "{}overdamps the lightest pair: must be < {:.4g}", what,
              own.gn * critical / used);
  };
  check(c.law, "gn", "");
  if (!c.materials) return;
  const auto& names = c.materials->names;
  for (std::size_t a = 0; a < names.size(); ++a)
    for (std::size_t b = a; b < names.size(); ++b)
      check(c.materials->law(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)), "pairs",
            fmt::format("gn of {} with {} ", names[a], names[b]));
}

/// No disk may slip through a wall, nor through the ring where a packing begins.
void checkHoles(const Reader& cell, const Couette& source) {
  const double a = source.particles.smallRadius, dilation = source.filling.dilation;
  const auto check = [&](const char* wall, double radius, double dilated, std::string when) {
    const double hole = wallHole(source.cell, radius, dilated);
    cell.check(hole < 2.0 * a, "wall_spacing",
               "a disk of radius {} m slips through holes of {:.4g} m between the {} disks of the "
               "{}{}",
               a, hole, wallDiskCount(source.cell, radius), wall, when);
  };
  check("wheel", source.cell.innerRadius, 1.0, "");
  check("ring", source.cell.outerRadius, 1.0, "");
  if (!source.particles.file)  // else nothing is prepared
    check("ring", source.cell.outerRadius, dilation,
          fmt::format(" before it shrinks from preparation.dilation = {:g} R_o", dilation));
}

void checkFit(const Reader& cell, const Reader& particles, const Case& c) {
  const Particles& p = couetteIn(c).particles;
  const Cell& walls = couetteIn(c).cell;
  const double gap = walls.outerRadius - walls.innerRadius - 2.0 * walls.wallRadius;
  cell.check(gap >= 2.0 * p.largeRadius, "outer_radius",
             "a disk of radius {} m does not fit between the walls, {:.4g} m apart", p.largeRadius,
             gap);
  const double count =
      2.0 * std::numbers::pi * (walls.innerRadius + walls.outerRadius) / walls.wallSpacing;
  cell.check(count <= mostDisks, "wall_spacing",
             "makes {:.3g} wall disks: a case may have at most {}", count, mostDisks);
  checkHoles(cell, couetteIn(c));
  const char* const said = particles.has("small")             ? "small"
                           : particles.has("volume_fraction") ? "volume_fraction"
                                                              : "large";
  particles.check(volumeFraction(c) < 1.0, said, "the disks have {:.4g} times the area of the cell",
                  volumeFraction(c));
}

/// Runs that no machine ends are mistyped numbers.
/// @param steps  may be no number, where a step is too small to be one
void checkSteps(const Reader& in, std::string_view key, const char* what, double steps) {
  constexpr double mostSteps = 1e12;
  in.check(steps <= mostSteps, key, "{} would take {:.3g} steps: at most {:g}", what, steps,
           mostSteps);
}

void checkLength(const Reader& cell, const Case& c) {
  checkSteps(cell, "omega", "preparation, settling and averaging",
             preparationSteps(c) + flowDuration(c) / timeStep(c));
}

void checkPreparation(const Reader& preparation, const Case& c) {
  const std::optional<double> dt = couetteIn(c).filling.dt;
  if (!dt) return;
  const std::string why = unstableStepFault(c, *dt, "dt");
  preparation.check(why.empty(), "dt", "{}", why);
}

void readCouette(Reader& root, Reader& law, Reader& run, Case& c) {
  Reader cell = root.section("cell");
  Reader particles = root.section("particles");
  Reader preparation = root.section("preparation");
  Reader averaging = root.section("averaging");
  Reader looks = root.section("looks");
  Reader cost = root.section("cost");
  Couette& source = couetteIn(c);
  readCell(cell, source.cell);
  readParticles(particles, source.cell, source.particles);
  readBottom(root, c.bottom);
  readPreparation(preparation, c);
  readAveraging(averaging, c);
  setFlowOfCell(c);
  readInterims(looks, c.looks);
  settleMaterials(c);
  requireStep(run, c);
  readCost(cost, c.cost);
  checkDamping(law, c);
  checkFit(cell, particles, c);
  checkPreparation(preparation, c);
  if (c.run.dt || !source.particles.file) checkLength(cell, c);
}

void readAssemblyCase(Reader& root, Reader& law, Reader& run, Starts starts, Case& c) {
  Reader assembly = root.section("assembly");
  Reader preparation = root.section("preparation");
  Reader average = root.section("average");
  Reader looks = root.section("looks");
  Reader cost = root.section("cost");
  root.check(c.dimension == 2 || !root.has("bottom"), "bottom",
             "is of the plane alone, and case.dimension = 3");
  readBottom(root, c.bottom);
  withAssembly(c, [&](auto& target) { readAssembly(assembly, target); });
  settleMaterials(c);
  readPackings(preparation, c);
  readInterims(looks, c.looks);
  std::vector<Reader> endpoints;
  if (root.has("average")) {
    endpoints = root.sections("endpoints");
    readAverage(average, c);
    readEndpoints(endpoints, average, preparation, starts, c);
  }
  for (const char* const section : {"endpoints", "preparation", "looks", "cost"})
    root.check(c.region || !root.has(section), section, "is of no use without [average]");
  requireStep(run, c);
  const bool contactTimes = assembly.has("contact_times");
  assembly.check(!contactTimes || c.law.normal == NormalLaw::linear, "contact_times",
                 "this law has no contact time: give duration or steps");
  // An overdamped contact has no t_c, but it is a scene.
  if (!c.run.dt || contactTimes) checkDamping(law, c);
  for (const char* const key : {"duration", "contact_times", "steps"})
    if (assembly.has(key)) checkSteps(assembly, key, "it", assemblyDuration(c) / timeStep(c));
  if (c.region) checkAveragedTime(average, endpoints, c);
  readCost(cost, c.cost);
  inDimensionOf(c, [&]<int D>() { checkStartFiles<D>(c); });
}

/// As checkStart() does of a flow.
void checkCollisionNumbers(const Case& c) {
  try {
    const std::vector<CollisionStart> starts = collisionStarts(c);
    const double dt = timeStep(c);
    const std::string why = c.dimension == 3 ? beyondNumbers(spaceCollisionScene(c, starts, dt))
                                             : beyondNumbers(collisionScene(c, starts, dt));
    if (!why.empty()) throw BadInput(c.file.string() + why);
  } catch (const std::invalid_argument&) {
    return;  // a law that such an impact overcomes: the command says so
  }
}

void readCollisionCase(Reader& root, Reader& law, Reader& run, Case& c) {
  Reader collision = root.section("collision");
  readCollision(collision, collisionIn(c), c.dimension);
  settleMaterials(c);
  run.check(!run.has("steps_per_contact"), "steps_per_contact",
            "a collision takes collision.steps_per_contact");
  if (c.law.soft()) {
    run.check(!c.run.dt, "dt", "a collision of a soft law takes collision.steps_per_contact");
  } else {
    collision.check(!collision.has("steps_per_contact"), "steps_per_contact",
                    "a rigid law has no contact time, give run.dt");
    if (!c.run.dt) run.failMissing("dt", "a rigid law has no contact time");
  }
  if (collisionIn(c).isConvex()) checkConvexStarts(collision, c);
  checkDamping(law, c);
  checkCollisionNumbers(c);
  if (!c.law.soft()) return;
  const char* const key = collision.has("steps_per_contact") ? "steps_per_contact"
                          : collision.has("vn")              ? "vn"
                                                             : "speed";
  try {
    const ImpactTimes lasting = impactTimes(c);
    for (const double dt : collisionTimeSteps(c))
      checkSteps(collision, key, "the longest impact", lasting.longest / dt);
  } catch (const std::invalid_argument&) {
    return;  // a law that such an impact overcomes: the command says so
  }
}

/// Paths in a document that is kept or printed must not hang on where it came from.
void makeAbsolute(toml::table& root, const Case& c) {
  const auto absolute = [](const std::filesystem::path& file) {
    return std::filesystem::absolute(file).string();
  };
  if (packingFile(c))
    *root.at_path("particles.file").node()->as_string() = absolute(*packingFile(c));
  if (!isAssembly(c)) return;
  const auto& files = withAssembly(
      c, [](const auto& assembly) -> const auto& { return assembly.starts.files; });
  if (files.empty()) return;
  toml::node* const node = root.at_path("assembly.start.file").node();
  if (toml::array* const list = node->as_array())
    for (std::size_t k = 0; k < list->size(); ++k) *list->get(k)->as_string() = absolute(files[k]);
  else
    *node->as_string() = absolute(files.front());
}

Case readCase(const std::filesystem::path& file, CaseDocument& document,
              Starts starts = Starts::made) {
  Case c;
  c.file = file;
  c.variant = document.variant;
  c.name = file.stem().string();

  Reader root(&document.root, "", file.string());
  Reader header = root.section("case");
  Reader law = root.section("law");
  Reader run = root.section("run");
  Reader engines = root.section("engines");
  Reader stability = root.section("stability");
  for (const SectionInfo& section : caseSections())
    if (isTable(section)) root.take(section.name);
  root.finish();

  readHeader(header, c);
  refuseSections(root, c);
  std::vector<Reader> pairs = law.sections("pairs");
  c.law.dimension = c.dimension;
  readLaw(law, c.law, isCollision(c));
  readPairLaws(law, pairs, c);
  readRun(run, c.run);
  readEngines(engines, c.engines);
  if (root.has("stability")) readStability(stability, c.dimension, c.stability.emplace());
  if (cellOf(c))
    readCouette(root, law, run, c);
  else if (isCollision(c))
    readCollisionCase(root, law, run, c);
  else
    readAssemblyCase(root, law, run, starts, c);

  if (!law.has("pairs")) refuseMaterials(c);  // an empty list is one that was taken away

  document.root["case"].as_table()->insert("name", c.name);
  makeAbsolute(document.root, c);
  c.resolvedToml = printDocument(document.root);
  return c;
}

/// A step in seconds fits the contacts of the file that says it: where a later layer changes law or
/// disks, it may not. @param said  the file with [run] dt
void warnOfStep(Case& c, const std::filesystem::path& said) {
  const auto here = pairContactTime(c);
  if (!here) return;
  try {
    CaseDocument document = readBaseDocument(said);
    const Case there = readCase(said, document);
    const auto time = pairContactTime(there);
    constexpr double same = 0.01;
    if (!time || there.run.dt != c.run.dt || std::abs(*here / *time - 1.0) < same) return;
    c.warnings.push_back(
        fmt::format("run.dt = {:g} s is that of {}, where a contact lasts {:.3g} s, {:.3g} steps; "
                    "here it lasts "
                    "{:.3g} s, {:.3g} steps: give dt anew, or steps_per_contact",
                    *c.run.dt, said.string(), *time, *time / *c.run.dt, *here, *here / *c.run.dt));
  } catch (const BadInput&) {
    return;  // not a case by itself: it had no contacts to fit
  }
}

/// Whether a case has that fault, too.
bool hasFault(const std::filesystem::path& file, CaseDocument& document, Starts starts,
              const BadInput& error) {
  try {
    readCase(file, document, starts);
  } catch (const BadInput& its) {
    return std::string_view(its.what()) == error.what();
  }
  return false;
}

/// Whether a pattern leaves a variant out, and nothing is compared with it.
bool isLeftOut(const std::filesystem::path& file, const CaseDocument& document,
               const std::string& only) {
  Case named;
  named.name = document.root.at_path("case.name").value_or(file.stem().string());
  named.variant = document.variant;
  return !document.root.contains("stability") && !fits(named, only);
}

std::vector<Case> loadAll(const std::filesystem::path& file,
                          const std::vector<std::string>& overrides, const std::string& fragment,
                          Starts starts, const std::optional<std::string>& only) {
  std::vector<Case> cases;
  std::vector<CaseDocument> documents = readCaseDocuments(file, overrides, fragment);
  for (auto at = documents.begin(); at != documents.end(); ++at) {
    CaseDocument& document = *at;
    const toml::node* const step = document.root.at_path("run.dt").node();
    const auto said = step ? fileOf(step->source()) : std::nullopt;
    try {
      Case c = readCase(file, document, starts);
      c.overrides = overrides;
      if (said && c.run.dt) warnOfStep(c, *said);
      cases.push_back(std::move(c));
    } catch (const BadInput& error) {
      if (only && isLeftOut(file, document, *only)) continue;
      const auto sharesIt = [&](CaseDocument& later) {
        return hasFault(file, later, starts, error);
      };
      if (cases.empty() && std::all_of(at + 1, documents.end(), sharesIt)) throw;
      throw BadInput(fmt::format("{} (variant {})", error.what(), document.variant));
    }
  }
  return cases;
}

}  // namespace

std::string kindOf(const Case& setup) {
  return caseKinds[std::min<std::size_t>(setup.source.index(), 2)];
}

std::vector<SectionInfo> headerSections() {
  return {headerKeys().info(),
          {.name = "variants",
           .note = "Each is run: the case with these changes, sections and keys as below, and",
           .isList = true,
           .keys = {{"name", "", "required", "", "unique, as `case.name`"}}}};
}

std::vector<Case> loadCase(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides, const std::string& fragment,
                           Starts starts, const std::optional<std::string>& only) {
  try {
    return loadAll(file, overrides, fragment, starts, only);
  } catch (const BadInput& error) {
    // A fault of the command line is not the file's, wherever it shows.
    if (overrides.empty() || std::string_view(error.what()).starts_with("--set ")) throw;
    try {
      loadAll(file, {}, fragment, starts, only);
    } catch (const BadInput&) {
      throw error;
    }
    throw BadInput(fmt::format("--set {}: {}", fmt::join(overrides, " --set "), error.what()));
  }
}

Case caseWith(const Case& setup, const std::string& fragment) {
  CaseDocument document = documentOf(setup.resolvedToml, setup.variant, fragment);
  Case changed = readCase(setup.file, document);
  changed.overrides = setup.overrides;
  return changed;
}

std::string resolvedFile(const std::vector<Case>& cases) {
  if (cases.size() == 1 && cases.front().variant.empty()) return cases.front().resolvedToml;
  std::string text = fmt::format("[case]\nname = \"{}\"\n", cases.front().name);
  for (const Case& c : cases) text += '\n' + printVariant(toml::parse(c.resolvedToml), c.variant);
  return text;
}

}  // namespace crossgrain::inline cases
