#include "studies/core/mirrors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <utility>

#include "adapters/registry.hpp"
#include "law/law_options.hpp"
#include "studies/core/engine_access.hpp"
#include "support/interrupt.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline studies {

namespace {

std::optional<Capabilities> ask(const EngineEntry& entry, double timeout) {
  if (entry.make) return entry.make()->capabilities();
  // Kept until this process ends: a worker whose folder has gone is of no use to the next run.
  static const ScratchFolder folder;
  try {
    return startEngine(entry, folder.path / entry.name, timeout)->capabilities();
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception&) {
    return std::nullopt;  // a mirror says so where it matters
  }
}

}  // namespace

std::optional<Capabilities> capabilitiesOf(const EngineEntry& entry, double timeout) {
  static std::mutex mutex;
  static std::map<std::string, std::optional<Capabilities>> known;
  const std::lock_guard lock(mutex);
  const auto [found, isNew] = known.try_emplace(entry.name);
  if (isNew) found->second = ask(entry, timeout);
  return found->second;
}

template <int D>
AdaptedOf<D> sceneOfPeer(const EngineEntry& mirror, const Case& setup, const SceneOf<D>& scene) {
  const EngineEntry* peer = findEngine(mirror.mirrors);
  const auto can = peer ? capabilitiesOf(*peer, setup.run.timeout) : std::nullopt;
  if (!can)
    return {
        scene,
        {{"peer", 0.0, "",
          fmt::format("{} cannot be asked here: what it lacks is not left out", mirror.mirrors)}}};
  const bool sameLaw = hasNormalLaw(*can, scene.law);
  AdaptedOf<D> adapted;
  try {
    adapted = adaptScene(*can, scene, setup.run.mayDiffer);
  } catch (const UnsupportedScene& refusal) {
    throw UnsupportedScene(fmt::format("its peer {} {}", peer->name, refusal.what()));
  }
  adapted.scene.precision = scene.precision;
  if (!sameLaw)
    changeLaws(adapted.scene, [&](ContactLaw& law) { law.conventions = scene.law.conventions; });
  std::erase_if(adapted.deviations, [&](const Deviation& deviation) {
    return deviation.name == "precision" || (!sameLaw && deviation.name == "normal");
  });
  for (Deviation& deviation : adapted.deviations)
    deviation.note = fmt::format("as its peer {}: {}", peer->name, deviation.note);
  if (sameLaw) {
    if (const auto step = stepOfItsOwn(setup, peer->name, *can)) adapted.scene.dt = *step;
  }
  return adapted;
}
template Adapted sceneOfPeer<2>(const EngineEntry&, const Case&, const Scene&);
template AdaptedOf<3> sceneOfPeer<3>(const EngineEntry&, const Case&, const SpaceScene&);

namespace {

/// Engines whose mirrors are not made yet, in the order of their names on the command line.
std::vector<std::string> withoutMirror;

/// As conventionsFromWords() reads them.
std::vector<std::string> describeConventions(const LawConventionSets& conventions) {
  std::vector<std::string> words;
  for (const auto& [option, values] : conventions)
    words.push_back(fmt::format("{}={}", option, fmt::join(values, ",")));
  return words;
}

/// The in-house engine with the conventions of another. Which law a scene has is the scene's
/// matter.
std::optional<EngineEntry> mirrorOf(const std::string& name, const Capabilities& can) {
  EngineEntry mirror;
  if (const auto laws = can.lawOptions.find("normal"); laws != can.lawOptions.end())
    for (const std::string& law : laws->second)
      if (law != "rigid") mirror.mirrorsNormal.push_back(law);
  if (mirror.mirrorsNormal.empty()) return std::nullopt;
  const LawConventionSets conventions = conventionsOf(can.lawOptions);
  mirror.name = "grain-as-" + name;
  mirror.summary = "the in-house engine with the conventions that " + name + " declares";
  mirror.make = [conventions] { return makeGrainMirror(conventions); };
  // Its worker's registry does not know it.
  std::vector<std::string> call = {ownProgram(), "__serve", engineRegistry().front().name};
  std::ranges::move(describeConventions(conventions), std::back_inserter(call));
  mirror.command = [call] { return call; };
  mirror.mirrors = name;
  return mirror;
}

}  // namespace

LawConventionSets conventionsFromWords(const std::vector<std::string>& words) {
  LawConventionSets conventions;
  for (const std::string& word : words) {
    const std::size_t sign = word.find('=');
    std::istringstream values(sign == std::string::npos ? "" : word.substr(sign + 1));
    for (std::string value; std::getline(values, value, ',');)
      conventions[word.substr(0, sign)].push_back(value);
  }
  return conventions;
}

std::string addExternalEngine(EngineEntry entry) {
  const std::string name = entry.name;
  addEngine(std::move(entry));
  withoutMirror.push_back(name);
  return name;
}

void addMirrorOfShelved(const std::string& name) {
  const std::size_t known = engineRegistry().size();
  for (std::size_t k = builtInEngines(); k < known; ++k) {
    const EngineEntry& entry = engineRegistry()[k];
    const bool hasOne = std::ranges::find(engineRegistry(), entry.name, &EngineEntry::mirrors) !=
                        engineRegistry().end();
    if ((entry.name == name || name == "all") && entry.mirrors.empty() && !hasOne &&
        entry.missing().empty() &&
        std::ranges::find(withoutMirror, entry.name) == withoutMirror.end())
      withoutMirror.push_back(entry.name);
  }
}

void addMirrors(double timeout) {
  for (const std::string& name : std::exchange(withoutMirror, {}))
    if (const auto can = capabilitiesOf(*findEngine(name), timeout))
      if (auto mirror = mirrorOf(name, *can)) addEngine(std::move(*mirror));
}

}  // namespace crossgrain::inline studies
