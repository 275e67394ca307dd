#include "adapters/suitability.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "law/law_options.hpp"

namespace crossgrain {
namespace {

Support supportOf(const Capabilities& can, Effect effect) {
  const auto found = can.effects.find(effect);
  return found == can.effects.end() ? Support::never : found->second;
}

template <int D>
void removeEffect(SceneOf<D>& scene, Effect effect) {
  switch (effect) {
    case Effect::normalDamping:
      changeLaws(scene, [](ContactLaw& law) {
        law.gn = 0.0;
        law.en = 1.0;
      });
      break;
    case Effect::rotation:
      scene.rotation = false;
      std::ranges::fill(scene.disks.spin, noSpin<D>());
      break;
    case Effect::friction:
      changeLaws(scene, [](ContactLaw& law) {
        law.mu = 0.0;
        law.tangential = TangentialLaw::none;
      });
      break;
    case Effect::tangentialSpring:
      changeLaws(scene, [](ContactLaw& law) { law.kt = 0.0; });
      break;
    case Effect::tangentialDamping:
      changeLaws(scene, [](ContactLaw& law) { law.gt = 0.0; });
      break;
    case Effect::bottomFriction:
      scene.bottom.reset();
      break;
    case Effect::bottomSpinFriction:
      if (scene.bottom) scene.bottom->spin = false;
      break;
    case Effect::gravity:
      scene.gravity = VecOf<D>::Zero();
      break;
    case Effect::movingWalls:
      for (auto& body : scene.bodies) body.motion = {};
      break;
    case Effect::rollingResistance:
      changeLaws(scene, [](ContactLaw& law) { law.rolling = RollingLaw::none; });
      break;
    case Effect::cohesion:
      changeLaws(scene, [](ContactLaw& law) { law.cohesion = CohesionLaw::none; });
      break;
    case Effect::pairMaterials:
      scene.materials.reset();
      break;
  }
}

bool has(const Capabilities& can, const ContactLaw& law, const std::string& option) {
  const auto found = can.lawOptions.find(option);
  return found == can.lawOptions.end() ||
         std::ranges::count(found->second, lawOptionValue(law, option)) > 0;
}

/// Springs and dashpots are parts of a soft law: an engine with another law in its place converts
/// them to that law's constants.
bool isPartOfSoftLaw(Effect effect) {
  return effect == Effect::tangentialSpring || effect == Effect::tangentialDamping;
}

bool isConventionName(const std::string& name) {
  return std::ranges::find(lawOptions(), name, &LawOption::name) != lawOptions().end() &&
         isConvention(name);
}

/// Advice to allow these differences.
std::string adviceOn(const std::vector<std::string>& names) {
  std::vector<std::string> quoted;
  for (const std::string& name : names) quoted.push_back('"' + name + '"');
  return fmt::format("list {} under [run] may_differ to run it all the same{}",
                     fmt::join(quoted, ", "),
                     std::ranges::count_if(names, isConventionName) < 2
                         ? ""
                         : fmt::format(" (\"{}\" lists all conventions)", allConventionsName));
}

}  // namespace

UnlistedDifferences::UnlistedDifferences(std::string why, std::vector<std::string> unlisted)
    : UnsupportedScene(why + "; " + adviceOn(unlisted)),
      reasons(std::move(why)),
      names(std::move(unlisted)) {}

std::vector<std::string> briefly(const std::vector<std::string>& names) {
  std::set<std::string> conventions, all;
  for (const std::string& name : names) (isConventionName(name) ? conventions : all).insert(name);
  if (conventions.size() > 1) conventions = {allConventionsName};
  all.merge(conventions);
  return {all.begin(), all.end()};
}

bool hasNormalLaw(const Capabilities& can, const ContactLaw& law) {
  return has(can, law, "normal");
}

template <int D>
std::vector<Mismatch> mismatches(const Capabilities& can, const SceneOf<D>& scene) {
  std::vector<Mismatch> found;
  const Effects called = effectsOf(scene);
  const bool sameLaw = hasNormalLaw(can, scene.law);
  for (const Effect effect : allEffects) {
    if (!sameLaw && isPartOfSoftLaw(effect)) continue;
    const Support support = supportOf(can, effect);
    if (called.contains(effect) && support == Support::never)
      found.push_back({toString(effect), fmt::format("has no {}", toString(effect)), true});
    if (!called.contains(effect) && support == Support::always)
      found.push_back({toString(effect), fmt::format("cannot do without {}", toString(effect))});
  }
  for (const auto& [name, values] : can.lawOptions) {
    if (!mattersTo(scene.law, name) || has(can, scene.law, name)) continue;
    // An engine with another law in its place still has, or lacks, each kind of the other parts.
    const bool part =
        (name == "rolling" && supportOf(can, Effect::rollingResistance) != Support::never) ||
        (name == "cohesion" && supportOf(can, Effect::cohesion) != Support::never);
    if (!sameLaw && name != "normal" && !part) continue;
    found.push_back({name, fmt::format("has {} = {}, not {}", name, fmt::join(values, " | "),
                                       lawOptionValue(scene.law, name))});
  }
  const bool restores =
      scene.law.et0 != 0.0 ||
      (scene.materials && std::ranges::any_of(scene.materials->laws, [](const ContactLaw& law) {
         return law.et0 != 0.0;
       }));
  if (sameLaw && scene.law.normal == NormalLaw::rigid && restores && !can.tangentialRestitution)
    found.push_back({tangentialRestitutionName, "has no tangential restitution (e_t0 = 0)"});
  return found;
}

template std::vector<Mismatch> mismatches<2>(const Capabilities&, const Scene&);

template <int D>
Effects simulatedEffects(const Capabilities& can, const SceneOf<D>& scene) {
  Effects effects = effectsOf(scene);
  std::erase_if(effects, [&](Effect effect) { return supportOf(can, effect) == Support::never; });
  return effects;
}
template Effects simulatedEffects<2>(const Capabilities&, const Scene&);
template Effects simulatedEffects<3>(const Capabilities&, const SpaceScene&);

ContactLaw lawAsRun(const Capabilities& can, ContactLaw law) {
  for (const auto& [option, values] : can.lawOptions) {
    // An engine that lacks the law itself converts it, or refuses.
    if (!isConvention(option)) continue;
    if (!values.empty() && !has(can, law, option)) setLawOption(law, option, values.front());
  }
  if (!can.tangentialRestitution && law.normal == NormalLaw::rigid) law.et0 = 0.0;
  return law;
}

namespace {

/// Names all unlisted differences at once, so that a user need not try again for each.
void refuseUnlisted(const std::vector<Mismatch>& all, const std::vector<std::string>& mayDiffer) {
  std::vector<std::string> reasons, names;
  for (const Mismatch& mismatch : all) {
    if (std::ranges::find(mayDiffer, mismatch.name) != mayDiffer.end()) continue;
    reasons.push_back(mismatch.reason);
    names.push_back(mismatch.name);
  }
  if (!names.empty()) throw UnlistedDifferences(fmt::format("{}", fmt::join(reasons, "; ")), names);
}

}  // namespace

template <int D>
AdaptedOf<D> adaptScene(const Capabilities& can, const SceneOf<D>& scene,
                        const std::vector<std::string>& mayDiffer) {
  if (std::ranges::find(can.dimensions, D) == can.dimensions.end())
    throw UnsupportedScene(
        fmt::format("has dimension = {}, not {}", fmt::join(can.dimensions, " | "), D));
  if (scene.box && !can.periodic) throw UnsupportedScene("has no periodic directions");
  AdaptedOf<D> adapted{scene, {}};
  const std::vector<Mismatch> all = mismatches(can, scene);
  refuseUnlisted(all, mayDiffer);
  for (const Mismatch& mismatch : all) {
    adapted.deviations.push_back({mismatch.name, 0.0, "", mismatch.reason});
    if (mismatch.effectMissing)
      for (const Effect effect : allEffects)
        if (toString(effect) == mismatch.name) removeEffect(adapted.scene, effect);
  }
  changeLaws(adapted.scene, [&](ContactLaw& law) { law = lawAsRun(can, law); });
  const std::vector<std::string> beyond =
      beyondLimits(can.limits, adapted.scene, !hasNormalLaw(can, scene.law));
  if (!beyond.empty()) throw UnsupportedScene(fmt::format("{}", fmt::join(beyond, "; ")));
  // Double is a scene's precision where the user chose none: an engine of floats that runs it
  // reports its rounding itself.
  const bool has = std::ranges::find(can.precisions, scene.precision) != can.precisions.end();
  if (!has && !can.precisions.empty()) {
    adapted.scene.precision = can.precisions.front();
    if (scene.precision == Precision::float32)
      adapted.deviations.push_back(
          {"precision", 0.0, "",
           fmt::format("runs in {}, not {}", toString(can.precisions.front()),
                       toString(scene.precision))});
  }
  if constexpr (D == 2)  // no engine takes a scene in space in single precision
    if (adapted.scene.precision == Precision::float32)
      if (const std::string why = beyondSinglePrecision(adapted.scene); !why.empty())
        throw UnsupportedScene(why);
  return adapted;
}
template Adapted adaptScene<2>(const Capabilities&, const Scene&, const std::vector<std::string>&);
template AdaptedOf<3> adaptScene<3>(const Capabilities&, const SpaceScene&,
                                    const std::vector<std::string>&);

}  // namespace crossgrain
