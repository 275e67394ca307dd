#include "cases/thesis_sweep.hpp"

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

const std::vector<std::string>& familyNames() {
  static const std::vector<std::string> names(std::begin(sweepFamilies), std::end(sweepFamilies));
  return names;
}

bool contains(const std::vector<std::string>& list, const std::string& name) {
  return std::ranges::find(list, name) != list.end();
}

/// @param common, overrides  changes of all cases; the case's own lie between, later wins
SweepCase readCase(Reader in, const std::vector<std::string>& common,
                   const std::vector<std::string>& overrides) {
  SweepCase own;
  if (!in.has("case")) in.failMissing("case");
  const std::filesystem::path file = *in.readFile("case", extension);
  own.name = file.stem().string();
  in.read("name", own.name);
  if (!usableName(own.name)) in.fail("name", usableNameRule);
  in.requireText("purpose", own.purpose, "must say what the leg is there for");
  in.require("families", own.families, familyNames());
  in.require("nu", own.label, inside(0.0, 1.0));
  std::vector<std::string> changes = common, set;
  in.read("set", set);
  in.finish();
  changes.insert(changes.end(), set.begin(), set.end());
  changes.insert(changes.end(), overrides.begin(), overrides.end());
  std::vector<Case> cases = loadCase(file, changes);
  if (cases.size() > 1) in.fail("case", "is a case with variants: a leg is one case");
  own.setup = std::move(cases.front());
  if (!cellOf(own.setup)) in.fail("case", "is no Couette cell");
  if (packingFile(own.setup)) in.fail("case", "has a packing of its own: it cannot be prepared");
  return own;
}

SweepStage readStage(Reader in, const std::vector<SweepCase>& cases) {
  SweepStage stage;
  in.requireText("name", stage.name, "must say what the rung is for");
  in.read("packings", stage.packings, between(1, 10'000));
  std::vector<std::string> known, names, families;
  for (const SweepCase& each : cases) known.push_back(each.name);
  in.read("legs", names, known);
  in.read("families", families, familyNames());
  in.read("engines", stage.engines);
  in.read("carriers", stage.mirrors);
  in.finish();
  if (names.empty() && families.empty())
    in.failMissing("legs", "their names, or families = […] for all of some families");
  for (const std::string& name : stage.engines) {
    if (findEngine(name)) continue;
    std::vector<std::string> engines;
    for (const EngineEntry& entry : engineRegistry()) engines.push_back(entry.name);
    in.fail("engines", fmt::format("there is no engine \"{}\"{}", name, suggestion(name, engines)));
  }
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const auto isWanted = [&](const std::string& family) {
      return contains(cases[k].families, family);
    };
    if (contains(names, cases[k].name) || std::ranges::any_of(families, isWanted))
      stage.cases.push_back(k);
  }
  if (stage.cases.empty()) in.fail("families", "no leg belongs to them");
  return stage;
}

bool takesPart(const SweepEngine& engine, const SweepStage& stage, int packing) {
  if (stage.engines.empty()) return engine.part != SweepEngine::Part::throughMirror || packing == 0;
  return contains(stage.engines, engine.name) ||
         (stage.mirrors && engine.part == SweepEngine::Part::mirror);
}

}  // namespace

ThesisSweep loadSweep(const std::filesystem::path& file,
                      const std::vector<std::string>& overrides) {
  const CaseDocument document = readBaseDocument(file);
  if (document.root.contains("case"))
    throw BadInput(
        fmt::format("{}: is a case; a parameter sweep has rules, legs and rungs", file.string()));
  Reader root(&document.root, "", file.string());
  ThesisSweep sweep;
  sweep.file = file;
  sweep.name = file.stem().string();
  root.read("name", sweep.name);
  if (!root.has("rules")) root.failMissing("rules", "the file that claims are judged by");
  sweep.rules = *root.readFile("rules", extension);
  sweep.reasons = root.readFile("reasons", extension);
  if (const auto collisions = root.readFile("collisions", extension)) {
    sweep.collisions = loadCase(*collisions);
    if (!isCollision(sweep.collisions.front())) root.fail("collisions", "is no case of collisions");
  }
  std::vector<double> finer;
  root.read("finer_rings", finer, between(3, 10'000));
  for (const double rings : finer) {
    if (rings != static_cast<int>(rings)) root.fail("finer_rings", "must be whole numbers");
    sweep.finerRings.push_back(static_cast<int>(rings));
  }
  root.read("settling_snapshots", sweep.settlingSnapshots, between(1, 100'000));
  std::vector<std::string> common;
  root.read("set", common);
  std::vector<Reader> cases = root.sections("legs"), stages = root.sections("rungs");
  root.finish();
  if (cases.empty()) root.failMissing("legs", "what is run");
  if (stages.empty()) root.failMissing("rungs", "in which order");
  std::set<std::string> names;
  for (Reader& in : cases) {
    sweep.cases.push_back(readCase(in, common, overrides));
    const std::string& name = sweep.cases.back().name;
    if (!names.insert(name).second)
      in.fail(in.has("name") ? "name" : "case", fmt::format("a leg \"{}\" is there twice", name));
  }
  for (Reader& in : stages) sweep.stages.push_back(readStage(in, sweep.cases));
  return sweep;
}

std::vector<SweepRun> runsOf(const ThesisSweep& sweep, const std::vector<SweepEngine>& engines) {
  std::vector<SweepRun> runs;
  std::set<std::tuple<std::size_t, std::size_t, int>> seen;
  for (const SweepStage& stage : sweep.stages)
    for (int packing = 0; packing < stage.packings; ++packing)
      for (const std::size_t setup : stage.cases)
        for (std::size_t e = 0; e < engines.size(); ++e)
          if (takesPart(engines[e], stage, packing) && seen.insert({setup, e, packing}).second)
            runs.push_back({setup, e, packing});
  return runs;
}

}  // namespace crossgrain::inline cases
