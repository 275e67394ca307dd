#include "runs/cost/equivalents.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "runs/lockstep/rules.hpp"
#include "runs/lockstep/separation.hpp"
#include "runs/lockstep/terms.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {

namespace {

/// Of the disk that is farthest off [d].
double distanceOf(const std::vector<Vec2>& one, const std::vector<Vec2>& other, double diameter) {
  LockstepFrame a, b;
  a.position = one;
  b.position = other;
  return farthest(a, b, diameter).distance;
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
  for (const double time : std::span(lockstepTimes).first(lockstepTimes.size() - 1))
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
    auto& ofStart =
        responses.emplace_back(times.size(), std::vector<double>(yardstickChanges.size(), 0.0));
    const auto unchanged = placesAt(inHouse, scene, times);
    for (std::size_t c = 0; c < yardstickChanges.size(); ++c)
      for (const double sign : {1.0, -1.0}) {
        Scene changed = scene;
        changeYardstick(changed.law, sign * yardstickChanges[c]);
        const auto moved = placesAt(inHouse, changed, times);
        for (std::size_t k = 0; k < times.size(); ++k)
          ofStart[k][c] = std::max(ofStart[k][c], distanceOf(moved[k], unchanged[k], diameter));
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
              distanceOf(tracks[s].positions[k], reference[s].positions[k], diameter),
              responses[s][k]))
        largest = std::max(largest.value_or(0.0), *equivalent);
  return largest;
}

}  // namespace crossgrain::inline runs
