#include "studies/core/mirrors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "cases/case_keys.hpp"
#include "law/law_options.hpp"
#include "studies/core/engine_access.hpp"
#include "support/interrupt.hpp"
#include "support/scratch_folder.hpp"
#include "support/terminal.hpp"

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

namespace {

/// Conventions that the case leaves to their defaults.
std::vector<std::string> openConventions(const Case& setup) {
  const CaseKeys given = caseKeys(setup.resolvedToml);
  std::vector<std::string> open;
  for (const LawOption& option : lawOptions()) {
    const std::string name(option.name);
    if (isConvention(name) && !given.contains("law." + name) &&
        std::ranges::find(setup.run.mayDiffer, name) == setup.run.mayDiffer.end())
      open.push_back(name);
  }
  return open;
}

/// Values of an option that all engines have, in the first one's order; absent: no engine lists
/// it.
std::optional<std::vector<std::string>> valuesOfAll(const std::vector<Capabilities>& all,
                                                    const std::string& option) {
  std::optional<std::vector<std::string>> shared;
  for (const Capabilities& can : all) {
    const auto found = can.lawOptions.find(option);
    if (found == can.lawOptions.end()) continue;
    if (!shared)
      shared = found->second;
    else
      std::erase_if(*shared, [&](const std::string& value) {
        return std::ranges::find(found->second, value) == found->second.end();
      });
  }
  return shared;
}

using Lacks = std::set<std::pair<std::size_t, std::string>>;

/// Parts of a law that engines lack and the case does not let differ, by engine.
Lacks lacksOf(const std::vector<Capabilities>& all, const Case& setup, const ContactLaw& law) {
  Scene scene;
  scene.law = law;
  Lacks lacks;
  for (std::size_t k = 0; k < all.size(); ++k)
    for (const Mismatch& mismatch : mismatches(all[k], scene))
      if (std::ranges::find(setup.run.mayDiffer, mismatch.name) == setup.run.mayDiffer.end())
        lacks.emplace(k, mismatch.name);
  return lacks;
}

/// The law with the open conventions shared; absent: an engine then lacks what it does not lack of
/// the case's own law. What one convention is decides whether another matters, so that each value
/// is tried with all that follows from it.
std::optional<ContactLaw> sharedLaw(const Case& setup, const std::vector<Capabilities>& soft,
                                    ContactLaw law, std::vector<std::string> open) {
  for (std::size_t k = 0; k < open.size(); ++k) {
    const std::string option = open[k];
    if (!mattersTo(law, option)) continue;
    const auto values = valuesOfAll(soft, option);
    if (!values || std::ranges::find(*values, lawOptionValue(law, option)) != values->end())
      continue;
    open.erase(open.begin() + static_cast<std::ptrdiff_t>(k));
    for (const std::string& value : *values) {
      ContactLaw changed = law;
      setLawOption(changed, option, value);
      if (auto shared = sharedLaw(setup, soft, changed, open)) return shared;
    }
    return sharedLaw(setup, soft, law, std::move(open));
  }
  const Lacks before = lacksOf(soft, setup, setup.law), now = lacksOf(soft, setup, law);
  return std::ranges::includes(before, now) ? std::optional(law) : std::nullopt;
}

}  // namespace

std::vector<std::string> sharedConventions(const Case& setup,
                                           const std::vector<Capabilities>& all) {
  std::vector<Capabilities> soft;
  for (const Capabilities& can : all)
    if (hasNormalLaw(can, setup.law)) soft.push_back(can);
  const std::vector<std::string> open = openConventions(setup);
  const ContactLaw law = sharedLaw(setup, soft, setup.law, open).value_or(setup.law);
  std::vector<std::string> overrides;
  for (const std::string& option : open)
    if (const std::string value = lawOptionValue(law, option);
        value != lawOptionValue(setup.law, option))
      overrides.push_back(fmt::format("law.{}=\"{}\"", option, value));
  return overrides;
}

std::vector<std::string> sharedConventionsOf(const Case& setup,
                                             const std::vector<std::string>& engines) {
  addMirrors(setup.run.timeout);
  if (engines.size() < 2 || std::ranges::find(engines, "all") != engines.end() ||
      std::ranges::none_of(openConventions(setup),
                           [&](const std::string& option) { return mattersTo(setup.law, option); }))
    return {};
  std::vector<Capabilities> all;
  for (const EngineEntry& entry : selectEngines(engines)) {
    if (entry.ofFiles() || (entry.missing && !entry.missing().empty())) continue;
    // The fault of one that does not answer is said where it is to run.
    if (auto can = capabilitiesOf(entry, setup.run.timeout)) all.push_back(std::move(*can));
  }
  return sharedConventions(setup, all);
}

std::string describeShared(const std::vector<std::string>& shared) {
  return fmt::format(
      "conventions that all engines named share: {} (give them, or list them in "
      "run.may_differ, to have others)",
      fmt::join(shared, ", "));
}

bool shareConventions(const Case& setup, const std::vector<std::string>& engines,
                      std::vector<std::string>& overrides) {
  const std::vector<std::string> shared = sharedConventionsOf(setup, engines);
  if (shared.empty()) return false;
  printLines(stderr, fmt::format("note: {}: {}\n", setup.file.string(), describeShared(shared)));
  overrides.insert(overrides.end(), shared.begin(), shared.end());
  return true;
}

}  // namespace crossgrain::inline studies
