#include "studies/core/engine_access.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "adapters/audit.hpp"
#include "adapters/start_check.hpp"
#include "cases/case_keys.hpp"
#include "cases/time_step.hpp"
#include "law/law_options.hpp"
#include "studies/core/mirrors.hpp"
#include "support/bad_input.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline studies {

namespace {

/// Engine whose snapshots are audited before the caller gets them; all other calls are passed on.
class AuditedEngine final : public Engine {
 public:
  AuditedEngine(std::string name, std::unique_ptr<Engine> engine)
      : name_(std::move(name)), engine_(std::move(engine)) {}

  Capabilities capabilities() const override { return engine_->capabilities(); }
  EffectiveParameters load(const Scene& scene, const Settings& settings) override {
    return begin(plane_, scene, engine_->load(scene, settings));
  }
  EffectiveParameters loadInSpace(const SpaceScene& scene, const Settings& settings) override {
    return begin(space_, scene, engine_->loadInSpace(scene, settings));
  }
  double advance(double t) override {
    reached_ = engine_->advance(t);
    return *reached_;
  }
  /// @throws EngineFailure of one line: engine, scene, time and fault
  Snapshot snapshot(ContactReport contacts) override {
    return checked(plane_, engine_->snapshot(contacts));
  }
  SpaceSnapshot snapshotInSpace(ContactReport contacts) override {
    return checked(space_, engine_->snapshotInSpace(contacts));
  }
  Stats stats() const override { return engine_->stats(); }
  void checkpoint(const std::filesystem::path& file) override { engine_->checkpoint(file); }
  void restore(const std::filesystem::path& file) override {
    engine_->restore(file);
    reached_.reset();
  }

  Engine& inner() { return *engine_; }

 private:
  template <int D>
  struct Audited {
    SceneOf<D> scene;  ///< as the engine was given it
    AuditBasisOf<D> basis;
  };

  template <int D>
  EffectiveParameters begin(Audited<D>& audited, const SceneOf<D>& scene,
                            EffectiveParameters effective) {
    audited.scene = scene;
    audited.basis = auditBasis(audited.scene, engine_->capabilities(), effective);
    reached_ = 0.0;
    return effective;
  }
  template <int D>
  SnapshotOf<D> checked(const Audited<D>& audited, SnapshotOf<D> seen) {
    if (const std::string why = auditFault(seen, audited.basis, reached_); !why.empty()) {
      discardWorker(*engine_);
      throw EngineFailure(fmt::format("{}, {} at t = {:g} s: its snapshot cannot be: {}", name_,
                                      audited.scene.name, reached_.value_or(seen.positionTime),
                                      why));
    }
    return seen;
  }

  std::string name_;
  std::unique_ptr<Engine> engine_;
  Audited<2> plane_;
  Audited<3> space_;
  std::optional<double> reached_;  ///< last result of advance(); absent: not known [s]
};

std::string typeName(const SettingValue& value) {
  return std::visit(
      [](const auto& v) -> std::string {
        using T = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<T, bool>) return "true or false";
        if constexpr (std::is_same_v<T, double>) return "a number";
        return "a string";
      },
      value);
}

std::vector<std::string> knownEngines() {
  std::vector<std::string> names;
  for (const EngineEntry& entry : engineRegistry()) names.push_back(entry.name);
  return names;
}

}  // namespace

std::string ownProgram() {
  return std::filesystem::read_symlink("/proc/self/exe").string();
}

std::vector<EngineEntry> selectEngines(const std::vector<std::string>& names) {
  addMirrors();
  std::vector<EngineEntry> engines;
  for (const std::string& name : names) {
    if (name == "all") {
      for (const EngineEntry& entry : engineRegistry())
        if (entry.mirrors.empty() && (!entry.missing || entry.missing().empty()) &&
            std::ranges::find(engines, entry.name, &EngineEntry::name) == engines.end())
          engines.push_back(entry);
      continue;
    }
    const EngineEntry* entry = findEngine(name);
    if (!entry)
      throw BadInput(fmt::format("--engines: there is no engine '{}'{}", name,
                                 suggestion(name, knownEngines())));
    if (std::ranges::find(engines, name, &EngineEntry::name) != engines.end())
      throw BadInput(fmt::format("--engines: '{}' is named twice", name));
    engines.push_back(*entry);
  }
  return engines;
}

bool isNamed(const std::vector<std::string>& names, const EngineEntry& entry) {
  return std::ranges::find(names, entry.name) != names.end();
}

void checkEngineSections(const Case& setup) {
  // Files that do not take part have settings, too, and names like those of others: A, B, C.
  std::vector<std::string> programs;
  for (const EngineEntry& entry : engineRegistry())
    if (!entry.ofFiles()) programs.push_back(entry.name);
  for (const auto& [name, settings] : setup.engines) {
    const auto near = nearest(name, programs);
    if (findEngine(name) || !near) continue;
    // Of a short name little can be misspelt: "ondem" is no "ode".
    if (editDistance(name, *near) > std::max<std::size_t>(1, near->size() / 3)) continue;
    // A name that holds an engine's is what files of a run of it may be called, and no slip.
    const bool holdsIt =
        name.find('-') != std::string::npos && name.find(*near) != std::string::npos;
    if (!holdsIt)
      throw BadInput(fmt::format("{}: [engines.{}]: there is no such engine (did you mean {}?)",
                                 whereSaid(setup, "engines." + name), name, *near));
  }
}

std::vector<EngineEntry> mirrorsOf(const std::vector<EngineEntry>& engines) {
  std::vector<EngineEntry> mirrors;
  for (const EngineEntry& entry : engineRegistry()) {
    const bool peerRuns =
        std::ranges::find(engines, entry.mirrors, &EngineEntry::name) != engines.end();
    const bool runsAlready =
        std::ranges::find(engines, entry.name, &EngineEntry::name) != engines.end();
    if (peerRuns && !runsAlready) mirrors.push_back(entry);
  }
  return mirrors;
}

bool standsForItsPeer(const EngineEntry& mirror, const ContactLaw& law) {
  return std::ranges::find(mirror.mirrorsNormal, lawOptionValue(law, "normal")) !=
         mirror.mirrorsNormal.end();
}

std::vector<EngineEntry> enginesFor(const Case& setup, const std::vector<std::string>& names) {
  checkEngineSections(setup);
  std::vector<EngineEntry> engines = selectEngines(names);
  if (setup.run.mirrors)
    for (const EngineEntry& mirror : mirrorsOf(engines))
      if (standsForItsPeer(mirror, setup.law)) engines.push_back(mirror);
  return engines;
}

namespace {

/// @throws BadInput if it is not installed
WorkerPool::Kind workerOf(const EngineEntry& entry) {
  requireInstalled({entry});
  return {entry.name, entry.command
                          ? entry.command()
                          : std::vector<std::string>{ownProgram(), "__serve", entry.name}};
}

}  // namespace

void requireInstalled(const std::vector<EngineEntry>& engines) {
  for (const EngineEntry& entry : engines)
    if (entry.missing)
      if (const std::string why = entry.missing(); !why.empty())
        throw BadInput(fmt::format("engine {} is not available: {}", entry.name, why));
}

std::unique_ptr<Engine> startEngine(const EngineEntry& entry, const std::filesystem::path& scratch,
                                    double timeout) {
  return std::make_unique<PooledEngine>(workerPool(), workerOf(entry), scratch, timeout);
}

std::unique_ptr<Engine> startNew(const EngineEntry& entry, const std::filesystem::path& scratch,
                                 double timeout, ExchangeListener listener) {
  const WorkerPool::Kind kind = workerOf(entry);
  return std::make_unique<WorkerEngine>(kind.name, kind.call, scratch, timeout,
                                        std::move(listener));
}

std::unique_ptr<Engine> startAudited(const EngineEntry& entry, const std::filesystem::path& scratch,
                                     double timeout) {
  return audited(entry.name, startEngine(entry, scratch, timeout));
}

std::unique_ptr<Engine> audited(std::string name, std::unique_ptr<Engine> engine) {
  return std::make_unique<AuditedEngine>(std::move(name), std::move(engine));
}

void discardWorker(Engine& engine) {
  if (auto* const pooled = dynamic_cast<PooledEngine*>(&engine)) pooled->discardWorker();
  if (auto* const audited = dynamic_cast<AuditedEngine*>(&engine)) discardWorker(audited->inner());
}

namespace {

/// Settings of the case under [engines.NAME], and where it is silent the engine's own file.
Settings settingsSaid(const Case& setup, const std::string& engine) {
  Settings settings;
  if (const auto section = setup.engines.find(engine); section != setup.engines.end())
    settings = section->second;
  if (const EngineEntry* const entry = findEngine(engine))
    settings.insert(entry->settings.begin(), entry->settings.end());
  return settings;
}

/// The settings with the rule of the header spelt out: an engine with a default of its own is set
/// to take the scene's step where the case gives one.
Settings withStep(Settings settings, const Case& setup, const Capabilities& can) {
  const bool has = std::ranges::find(can.settings, "dt", &SettingSpec::name) != can.settings.end();
  if (setup.run.dt && has) settings.try_emplace("dt", 0.0);
  return settings;
}

const double* stepIn(const Settings& settings) {
  const auto found = settings.find("dt");
  return found == settings.end() ? nullptr : std::get_if<double>(&found->second);
}

bool isWithin(const SettingSpec& spec, double number) {
  return std::isfinite(number) && spec.least <= number && number <= spec.most &&
         (!spec.whole || number == std::floor(number));
}

std::string rangeOf(const SettingSpec& spec) {
  const std::string kind = spec.whole ? "a whole number " : "";
  if (std::isfinite(spec.most))
    return fmt::format("{}from {:g} to {:g}", kind, spec.least, spec.most);
  return fmt::format("{}>= {:g}", kind, spec.least);
}

}  // namespace

Settings settingsFor(const Case& setup, const std::string& engine, const Capabilities& can) {
  Settings settings = settingsSaid(setup, engine);
  const auto section = setup.engines.find(engine);
  for (const auto& [name, value] : settings) {
    const bool ofCase = section != setup.engines.end() && section->second.contains(name);
    const std::string where =
        ofCase ? fmt::format("{}: [engines.{}]",
                             whereSaid(setup, fmt::format("engines.{}.{}", engine, name)), engine)
               : fmt::format("{}: [settings] of its file:", engine);
    const auto spec = std::ranges::find(can.settings, name, &SettingSpec::name);
    if (spec == can.settings.end()) {
      std::vector<std::string> known;
      for (const SettingSpec& each : can.settings) known.push_back(each.name);
      throw BadInput(
          fmt::format("{} there is no setting '{}'{}", where, name, suggestion(name, known)));
    }
    if (value.index() != spec->defaultValue.index())
      throw BadInput(fmt::format("{} {} must be {}, not {}", where, name,
                                 typeName(spec->defaultValue), typeName(value)));
    if (const auto* number = std::get_if<double>(&value); number && !isWithin(*spec, *number))
      throw BadInput(fmt::format("{} {} = {:g} must be {}", where, name, *number, rangeOf(*spec)));
    if (const auto* text = std::get_if<std::string>(&value); text && !spec->choices.empty())
      if (std::ranges::find(spec->choices, *text) == spec->choices.end())
        throw BadInput(fmt::format("{} {} cannot be '{}' (it is one of: {})", where, name, *text,
                                   fmt::join(spec->choices, ", ")));
  }
  return withStep(std::move(settings), setup, can);
}

namespace {

/// Does `work`, and says engine and case where it is refused.
template <typename Work>
auto namingRefusals(const EngineEntry& entry, const Case& setup, Work&& work) {
  try {
    return work();
  } catch (const UnlistedDifferences& refusal) {
    throw UnlistedDifferences(
        fmt::format("{} cannot run {}: {}", entry.name, setup.file.string(), refusal.reasons),
        refusal.names);
  } catch (const UnsupportedScene& refusal) {
    throw UnsupportedScene(
        fmt::format("{} cannot run {}: {}", entry.name, setup.file.string(), refusal.what()));
  }
}

/// An engine's own time step, if it runs soft laws with it. @param scene  as it runs it
template <int D>
void checkOwnStep(const Capabilities& can, const EngineEntry& entry, const Case& setup,
                  const SceneOf<D>& scene, const Settings& settings) {
  const double* const step = stepIn(settings);
  if (!step) return;
  const auto normal = can.lawOptions.find("normal");
  if (normal != can.lawOptions.end() && normal->second == std::vector<std::string>{"rigid"}) return;
  Case own = setup;
  own.law = scene.law;
  own.materials = scene.materials;
  const std::string why = unstableStepFault(own, *step, fmt::format("[engines.{}] dt", entry.name));
  if (!why.empty())
    throw BadInput(
        fmt::format("{}: {}", whereSaid(setup, fmt::format("engines.{}.dt", entry.name)), why));
}

}  // namespace

void checkSuitable(const Capabilities& can, const EngineEntry& entry, const Case& setup,
                   const Scene& scene) {
  const Adapted adapted =
      namingRefusals(entry, setup, [&] { return sceneFor(can, entry, setup, scene); });
  checkOwnStep(can, entry, setup, adapted.scene, settingsFor(setup, entry.name, can));
}

namespace {

/// sceneFor(), with advice that works: see checkSuitable().
template <int D>
AdaptedOf<D> sceneWithAdvice(Engine& engine, const EngineEntry& entry, const Case& setup,
                             const SceneOf<D>& scene) {
  const Capabilities can = engine.capabilities();
  try {
    return sceneFor(can, entry, setup, scene);
  } catch (const UnlistedDifferences& advice) {
    Case listed = setup;
    auto& mayDiffer = listed.run.mayDiffer;
    mayDiffer.insert(mayDiffer.end(), advice.names.begin(), advice.names.end());
    std::string stillWhy;
    try {
      loadOn(engine, sceneFor(can, entry, listed, scene).scene,
             settingsFor(setup, entry.name, can));
    } catch (const UnsupportedScene& refusal) {
      stillWhy = refusal.what();
    } catch (const std::exception&) {
      // Other faults are for the run to find out.
    }
    if (stillWhy.empty()) throw;
    throw UnsupportedScene(
        fmt::format("{}; even if that may differ, it {}", advice.reasons, stillWhy));
  }
}

}  // namespace

template <int D>
void checkSuitable(Engine& engine, const EngineEntry& entry, const Case& setup,
                   const SceneOf<D>& scene) {
  const AdaptedOf<D> adapted =
      namingRefusals(entry, setup, [&] { return sceneWithAdvice(engine, entry, setup, scene); });
  const Capabilities can = engine.capabilities();
  checkOwnStep(can, entry, setup, adapted.scene, settingsFor(setup, entry.name, can));
}

template void checkSuitable<2>(Engine&, const EngineEntry&, const Case&, const Scene&);
template void checkSuitable<3>(Engine&, const EngineEntry&, const Case&, const SpaceScene&);

template <int D>
AdaptedOf<D> sceneFor(const Capabilities& can, const EngineEntry& entry, const Case& setup,
                      const SceneOf<D>& scene) {
  if (entry.mirrors.empty()) return adaptScene(can, scene, setup.run.mayDiffer);
  AdaptedOf<D> theirs = sceneOfPeer(entry, setup, scene);
  AdaptedOf<D> own = adaptScene(can, theirs.scene, setup.run.mayDiffer);
  std::ranges::move(own.deviations, std::back_inserter(theirs.deviations));
  return {std::move(own.scene), std::move(theirs.deviations)};
}
template Adapted sceneFor<2>(const Capabilities&, const EngineEntry&, const Case&, const Scene&);
template AdaptedOf<3> sceneFor<3>(const Capabilities&, const EngineEntry&, const Case&,
                                  const SpaceScene&);

namespace {

/// Shorter, no run would end; longer, no engine would move.
/// @param dt  of the scene [s]
/// @throws BadInput for an engine's own step that is far from it
void checkSizeOfStep(const EngineEntry& entry, const Case& setup, double dt,
                     const Settings& settings) {
  constexpr double most = 1e6;
  const double* const step = stepIn(settings);
  if (!step || *step == 0.0 || (*step >= dt / most && *step <= dt * most)) return;
  throw BadInput(fmt::format(
      "{}: [engines.{}] dt = {:g} s must be 0, or from {:.3g} to {:.3g} s (10^-6 to 10^6 times the "
      "case's step)",
      whereSaid(setup, fmt::format("engines.{}.dt", entry.name)), entry.name, *step, dt / most,
      dt * most));
}

template <int D>
EffectiveParameters loadAdapted(Engine& engine, const EngineEntry& entry, const Case& setup,
                                const SceneOf<D>& scene) {
  const Capabilities can = engine.capabilities();
  const AdaptedOf<D> adapted = sceneWithAdvice(engine, entry, setup, scene);
  const Settings settings = settingsFor(setup, entry.name, can);
  checkSizeOfStep(entry, setup, adapted.scene.dt, settings);
  EffectiveParameters effective = loadOn(engine, adapted.scene, settings);
  effective.engine = entry.name;
  effective.version = can.version;
  effective.deviations.insert(effective.deviations.begin(), adapted.deviations.begin(),
                              adapted.deviations.end());
  if (auto step = stepDeviation(effective.dt, scene.dt))
    effective.deviations.push_back(std::move(*step));
  return effective;
}

}  // namespace

template <int D>
EffectiveParameters loadScene(Engine& engine, const EngineEntry& entry, const Case& setup,
                              const SceneOf<D>& scene) {
  if (const std::string why = startFault(scene); !why.empty())
    throw BadInput(fmt::format("{}: {}", setup.file.string(), why));
  return namingRefusals(entry, setup, [&] { return loadAdapted(engine, entry, setup, scene); });
}
template EffectiveParameters loadScene<2>(Engine&, const EngineEntry&, const Case&, const Scene&);
template EffectiveParameters loadScene<3>(Engine&, const EngineEntry&, const Case&,
                                          const SpaceScene&);

void requireSameStep(const EffectiveParameters& first, const EffectiveParameters& now) {
  if (now.dt != first.dt || now.precision != first.precision)
    throw EngineFailure(
        fmt::format("from one start of the case its step is {} s ({}), from another {} s ({})",
                    first.dt, first.precision, now.dt, now.precision));
}

template <int D>
LoadedEngine loadEngine(const EngineEntry& entry, const Case& setup, const SceneOf<D>& scene,
                        const std::filesystem::path& scratch) {
  LoadedEngine loaded;
  loaded.engine = startAudited(entry, scratch, setup.run.timeout);
  loaded.can = loaded.engine->capabilities();
  loaded.effective = loadScene(*loaded.engine, entry, setup, scene);
  return loaded;
}
template LoadedEngine loadEngine<2>(const EngineEntry&, const Case&, const Scene&,
                                    const std::filesystem::path&);
template LoadedEngine loadEngine<3>(const EngineEntry&, const Case&, const SpaceScene&,
                                    const std::filesystem::path&);

std::optional<double> stepOfItsOwn(const Case& setup, const std::string& engine,
                                   const Capabilities& can) {
  Settings used;
  for (const SettingSpec& spec : can.settings) used[spec.name] = spec.defaultValue;
  Settings given = withStep(settingsSaid(setup, engine), setup, can);
  given.merge(used);
  const double* step = stepIn(given);
  return step && *step > 0.0 ? std::optional(*step) : std::nullopt;
}

std::optional<Deviation> stepDeviation(double engineStep, double sceneStep) {
  constexpr double roundings = 1e-12;
  if (!(std::abs(engineStep - sceneStep) > roundings * sceneStep)) return std::nullopt;
  return Deviation{
      "dt", engineStep, "s",
      fmt::format("takes steps of {:.4g} s, the case's are {:.4g} s", engineStep, sceneStep)};
}

template <int D>
Suitability suitabilityOf(Engine& engine, const EngineEntry& entry, const Case& setup,
                          const SceneOf<D>& scene) {
  const Capabilities can = engine.capabilities();
  settingsFor(setup, entry.name, can);
  const AdaptedOf<D> adapted = sceneFor(can, entry, setup, scene);
  std::vector<Deviation> deviations = adapted.deviations;
  Effects effects = simulatedEffects(can, adapted.scene);
  Suitability found;
  if (scene.disks.size() > 0 && startFault(scene).empty()) {
    const EffectiveParameters effective = loadAdapted(engine, entry, setup, scene);
    deviations = effective.deviations;
    effects = effective.effects;
    found.dt = effective.dt;
  }
  for (const Deviation& deviation : deviations)
    found.deviations.push_back(
        deviation.value == 0.0 || deviation.unit.empty() || deviation.unit == "-" ||
                deviation.note.find(fmt::format("{:.3g}", deviation.value)) != std::string::npos
            ? deviation.note
            : fmt::format("{}: {:.3g} {}", deviation.note, deviation.value, deviation.unit));
  for (const Effect effect : effectsOf(scene))
    if (!effects.contains(effect)) found.notSimulated.emplace_back(toString(effect));
  return found;
}
template Suitability suitabilityOf<2>(Engine&, const EngineEntry&, const Case&, const Scene&);
template Suitability suitabilityOf<3>(Engine&, const EngineEntry&, const Case&, const SpaceScene&);

}  // namespace crossgrain::inline studies
