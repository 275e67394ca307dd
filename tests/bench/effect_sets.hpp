#pragma once

#include <vector>

#include "engines/grain/setup.hpp"

/// Effects of a setup's law, left out or added one by one.
namespace crossgrain::bench {

template <class Setup>
struct EffectSet {
  const char* name;
  void (*change)(Setup&);
};

/// The conventions of a case that names none.
template <class Setup>
void useDefaults(Setup& s) {
  s.law.conventions.leverArm = grain::LeverArm::overlapMiddle;
  s.law.conventions.springUpdate = grain::SpringUpdate::before;
  s.law.conventions.springReset = SpringReset::springOnly;
}

/// Those that disks and spheres have alike, before others. How much they cohere and resist rolling
/// is their own.
template <class Setup, void (*cohere)(Setup&), void (*resistRolling)(Setup&)>
std::vector<EffectSet<Setup>> withCommonEffects(std::vector<EffectSet<Setup>> others) {
  std::vector<EffectSet<Setup>> all = {
      {"defaults", useDefaults<Setup>},
      {"general", [](Setup& s) { s.generalKernels = true; }},
      {"no_friction", [](Setup& s) { s.law.tangential = grain::TangentialLaw::none; }},
      {"viscous", [](Setup& s) { s.law.tangential = grain::TangentialLaw::viscous; }},
      {"cut_tension", [](Setup& s) { s.law.conventions.tension = Tension::cut; }},
      {"no_rotation", [](Setup& s) { s.rotation = false; }},
      {"rolling", resistRolling},
      {"rolling_constant_torque",
       [](Setup& s) {
         resistRolling(s);
         s.law.rolling = grain::RollingLaw::constantTorque;
       }},
      {"rolling_critical",
       [](Setup& s) {
         resistRolling(s);
         s.law.conventions.rollingDamper = grain::RollingDamper::critical;
         s.law.gr = 0.1;
       }},
      {"cohesion", cohere},
      {"cohesion_net",
       [](Setup& s) {
         cohere(s);
         s.law.conventions.cohesionLoad = grain::CohesionLoad::net;
       }},
      {"cohesion_first_order",
       [](Setup& s) {
         cohere(s);
         s.law.conventions.cohesionArea = grain::CohesionArea::firstOrder;
       }},
  };
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

}  // namespace crossgrain::bench
