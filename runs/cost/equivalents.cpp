#include "runs/cost/equivalents.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "runs/lockstep/rules.hpp"
#include "runs/lockstep/separation.hpp"
#include "runs/lockstep/terms.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {

namespace {

/// By disk [d].
std::vector<double> apart(const std::vector<Vec2>& one, const std::vector<Vec2>& other,
                          double diameter) {
  LockstepFrame a, b;
  a.position = one;
  b.position = other;
  return distances(a, b, diameter);
}

/// By time [m].
std::vector<std::vector<Vec2>> placesAt(Engine& engine, const Scene& scene,
                                        const std::vector<double>& times) {
  std::vector<std::vector<Vec2>> places;
  engine.load(scene, {});
  for (const double time : times) {
    throwIfInterrupted();
    engine.advance(time);
    places.push_back(engine.snapshot(ContactReport::none).position);
  }
  return places;
}

}  // namespace

std::vector<double> windowTimes(const Case& setup) {
  const double contact = costContactTime(setup);
  std::vector<double> times;
  for (const double time : {1e-3, 10e-3, 50e-3})
    times.push_back(contact * std::max(1.0, std::round(time / contact)));
  const auto rest = std::ranges::unique(times);
  times.erase(rest.begin(), rest.end());
  return times;
}

std::vector<Track> followStarts(Engine& engine, const EngineEntry& entry, const Case& setup,
                                const std::vector<FlowState>& states,
                                const std::vector<double>& times) {
  std::vector<Track> tracks;
  for (const FlowState& state : states)
    tracks.push_back(followPacking(engine, entry, setup,
                                   couetteScene(setup, state.packing, timeStep(setup)), times));
  return tracks;
}

WindowResponses windowResponses(Engine& inHouse, const std::vector<Scene>& scenes,
                                const std::vector<double>& times, double diameter) {
  WindowResponses responses;
  for (const Scene& scene : scenes) {
    auto& ofStart = responses.emplace_back(times.size());
    const auto unchanged = placesAt(inHouse, scene, times);
    for (const double change : yardstickChanges) {
      Scene changed = scene;
      changeYardstick(changed.law, change);
      const auto moved = placesAt(inHouse, changed, times);
      for (std::size_t k = 0; k < times.size(); ++k)
        std::ranges::copy(apart(moved[k], unchanged[k], diameter), std::back_inserter(ofStart[k]));
    }
  }
  return responses;
}

std::optional<double> equivalentOf(const std::vector<Track>& tracks,
                                   const std::vector<Track>& reference,
                                   const WindowResponses& responses, double diameter) {
  std::optional<double> largest;
  for (std::size_t s = 0; s < tracks.size(); ++s)
    for (std::size_t k = 0; k < tracks[s].positions.size(); ++k)
      if (const auto equivalent = equivalentChange(
              apart(tracks[s].positions[k], reference[s].positions[k], diameter), responses[s][k]))
        largest = std::max(largest.value_or(0.0), *equivalent);
  return largest;
}

}  // namespace crossgrain::inline runs
