#include "cases/thesis_ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "adapters/registry.hpp"
#include "cases/loader.hpp"
#include "cases/loader_document.hpp"
#include "cases/loader_reader.hpp"
#include "support/input_file.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cases {

namespace {

constexpr const char* extension = ".toml";

/// Layers of one leg's case, later wins.
struct LadderLayers {
  std::vector<std::string> common, override;
};

LadderLeg readLeg(Reader in, const LadderLayers& layers) {
  static const std::vector<std::string> families(std::begin(ladderFamilies),
                                                 std::end(ladderFamilies));
  LadderLeg leg;
  if (!in.has("case")) in.failMissing("case");
  const std::filesystem::path file = *in.readFile("case", extension);
  leg.name = file.stem().string();
  in.read("name", leg.name);
  if (!usableName(leg.name)) in.fail("name", usableNameRule);
  in.requireText("purpose", leg.purpose, "must say what the leg is there for");
  in.require("families", leg.families, families);
  in.require("nu", leg.label, inside(0.0, 1.0));
  std::vector<std::string> changes = layers.common, own;
  in.read("set", own);
  in.finish();
  changes.insert(changes.end(), own.begin(), own.end());
  changes.insert(changes.end(), layers.override.begin(), layers.override.end());
  std::vector<Case> cases = loadCase(file, changes);
  if (cases.size() > 1) in.fail("case", "is a case with variants: a leg is one case");
  leg.setup = std::move(cases.front());
  if (leg.setup.kind != CaseKind::couette) in.fail("case", "is no Couette cell");
  if (leg.setup.particles.file) in.fail("case", "has a packing of its own: it cannot be prepared");
  return leg;
}

bool isOf(const LadderLeg& leg, const std::string& family) {
  return std::ranges::find(leg.families, family) != leg.families.end();
}

LadderRung readRung(Reader in, const std::vector<LadderLeg>& legs) {
  LadderRung rung;
  in.requireText("name", rung.name, "must say what the rung is for");
  in.read("packings", rung.packings, between(1, 10'000));
  std::vector<std::string> known, names, families;
  for (const LadderLeg& leg : legs) known.push_back(leg.name);
  in.read("legs", names, known);
  in.read("families", families,
          std::vector<std::string>(std::begin(ladderFamilies), std::end(ladderFamilies)));
  in.read("engines", rung.engines);
  in.read("carriers", rung.carriers);
  in.finish();
  if (names.empty() && families.empty())
    in.failMissing("legs", "their names, or families = […] for all of some families");
  for (const std::string& name : rung.engines) {
    if (findEngine(name)) continue;
    std::vector<std::string> engines;
    for (const EngineEntry& entry : engineRegistry()) engines.push_back(entry.name);
    in.fail("engines", fmt::format("there is no engine \"{}\"{}", name, suggestion(name, engines)));
  }
  for (std::size_t k = 0; k < legs.size(); ++k) {
    const bool named = std::ranges::find(names, legs[k].name) != names.end();
    const auto ofLeg = [&](const std::string& family) { return isOf(legs[k], family); };
    if (named || std::ranges::any_of(families, ofLeg)) rung.legs.push_back(k);
  }
  if (rung.legs.empty()) in.fail("families", "no leg belongs to them");
  return rung;
}

}  // namespace

ThesisLadder loadLadder(const std::filesystem::path& file,
                        const std::vector<std::string>& overrides) {
  const CaseDocument document = readBaseDocument(file);
  if (document.root.contains("case"))
    throw BadInput(fmt::format("{}: is a case; a ladder has rules, legs and rungs", file.string()));
  Reader root(&document.root, "", file.string());
  ThesisLadder ladder;
  ladder.file = file;
  ladder.name = file.stem().string();
  root.read("name", ladder.name);
  if (!root.has("rules")) root.failMissing("rules", "the file that claims are judged by");
  ladder.rules = *root.readFile("rules", extension);
  ladder.reasons = root.readFile("reasons", extension);
  if (const auto collisions = root.readFile("collisions", extension)) {
    ladder.collisions = loadCase(*collisions);
    if (ladder.collisions.front().kind != CaseKind::collision)
      root.fail("collisions", "is no case of collisions");
  }
  std::vector<double> finer;
  root.read("finer_rings", finer, between(3, 10'000));
  for (const double rings : finer) {
    if (rings != static_cast<int>(rings)) root.fail("finer_rings", "must be whole numbers");
    ladder.finerRings.push_back(static_cast<int>(rings));
  }
  root.read("settling_snapshots", ladder.settlingSnapshots, between(1, 100'000));
  LadderLayers layers;
  root.read("set", layers.common);
  layers.override = overrides;
  std::vector<Reader> legs = root.sections("legs"), rungs = root.sections("rungs");
  root.finish();
  if (legs.empty()) root.failMissing("legs", "what is run");
  if (rungs.empty()) root.failMissing("rungs", "in which order");
  std::set<std::string> names;
  for (Reader& in : legs) {
    ladder.legs.push_back(readLeg(in, layers));
    const std::string& name = ladder.legs.back().name;
    if (!names.insert(name).second)
      in.fail(in.has("name") ? "name" : "case", fmt::format("a leg \"{}\" is there twice", name));
  }
  for (Reader& in : rungs) ladder.rungs.push_back(readRung(in, ladder.legs));
  return ladder;
}

namespace {

bool takesPart(const LadderEngine& engine, const LadderRung& rung, int packing) {
  const bool named = std::ranges::find(rung.engines, engine.name) != rung.engines.end();
  if (rung.engines.empty()) return engine.part != LadderEngine::Part::carried || packing == 0;
  return named || (rung.carriers && engine.part == LadderEngine::Part::carrier);
}

}  // namespace

std::vector<LadderStep> stepsOf(const ThesisLadder& ladder,
                                const std::vector<LadderEngine>& engines) {
  std::vector<LadderStep> steps;
  std::set<std::tuple<std::size_t, std::size_t, int>> seen;
  for (const LadderRung& rung : ladder.rungs)
    for (int packing = 0; packing < rung.packings; ++packing)
      for (const std::size_t leg : rung.legs)
        for (std::size_t e = 0; e < engines.size(); ++e)
          if (takesPart(engines[e], rung, packing) && seen.insert({leg, e, packing}).second)
            steps.push_back({leg, e, packing});
  return steps;
}

}  // namespace crossgrain::inline cases
