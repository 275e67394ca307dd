#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "adapters/engine.hpp"

namespace crossgrain::inline studies {

/// One thing in which a mirror could be otherwise: a constant a little larger, another convention,
/// an effect less.
template <int D>
struct MirrorChangeOf {
  std::string name;         ///< "kn", "tension = cut", "without gravity"
  bool isConstant = false;  ///< the response is linear in it: any amount can be given
  /// `by`: of a constant the relative change; no matter to others.
  std::function<void(SceneOf<D>&, double by)> apply;
};
using MirrorChange = MirrorChangeOf<2>;

template <int D>
struct AppliedChangeOf {
  MirrorChangeOf<D> change;
  double by = 0.0;  ///< of a constant
};
using AppliedChange = AppliedChangeOf<2>;

/// Constants of the plate under disks, by the names that changes and differences have for them.
inline constexpr std::pair<const char*, double BottomPlate::*> plateConstants[] = {
    {"plate mu", &BottomPlate::mu},
    {"plate kb", &BottomPlate::kb},
    {"plate gb", &BottomPlate::gb},
    {"plate tau_m", &BottomPlate::tauM}};

/// Whether a mirror may follow otherwise by another value of an option. More do than matter to the
/// law: an arm of v_t that is that of f_t can become another one, and the velocity that dashpots
/// see, of this instant or half a step before, is the one that stretches springs and turns
/// friction.
bool bearsOnMirror(const ContactLaw& law, std::string_view option);

/// Whether the constants of a law mean the same under another value of an option: with another kind
/// of damper, say, they would have another unit, and others would be missing. Where a law resists
/// rolling or coheres, "none" is no such value: that is a missing effect.
bool constantsServe(const ContactLaw& law, std::string_view option, std::string_view value);

/// All that could be otherwise in this scene.
/// @param can  of the in-house engine
template <int D>
std::vector<MirrorChangeOf<D>> changesOf(const SceneOf<D>& scene, const Capabilities& can);

/// Scene with those changes, in their order. @throws UnsupportedScene where it lacks an effect that
/// cannot be left out
template <int D>
SceneOf<D> withChanges(SceneOf<D> scene, const std::vector<AppliedChangeOf<D>>& changes) {
  for (const AppliedChangeOf<D>& one : changes) one.change.apply(scene, one.by);
  return scene;
}

}  // namespace crossgrain::inline studies
