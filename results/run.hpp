#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/engine.hpp"
#include "averaging/distributions.hpp"
#include "averaging/profiles.hpp"
#include "results/flow_numbers.hpp"
#include "results/flow_state.hpp"
#include "results/json_fields.hpp"
#include "results/scene_picture.hpp"

namespace crossgrain::inline results {

enum class RunStatus { finished, failed, missing };
constexpr auto namesOf(RunStatus) {
  return std::array<std::string_view, 3>{"finished", "failed", "missing"};
}

/// One engine on one packing: what it used, what it cost and what its averages are. A run that did
/// not finish has none.
struct FlowRun {
  std::string engine;
  std::string without;  ///< the effect that was switched off; empty: none
  int packing = 0;      ///< index
  RunStatus status = RunStatus::finished;
  std::string reason;
  std::optional<EffectiveParameters> effective;  ///< absent where crossgrain ran nothing
  std::optional<Stats> stats;                    ///< likewise
  std::vector<HeadNumber> head;
  std::optional<RegimeRow> regime;
  std::vector<SeriesDrift> steadiness;
  std::vector<Profile> profiles;
  std::vector<FitRow> fits;
  std::vector<CheckRow> checks;
  /// Absent where a report does not show them; then it shows no distributions and picture either.
  std::optional<RunSeries> series;
  std::vector<Distribution> distributions;
  std::optional<ScenePicture> picture;  ///< of the first packing

  bool finished() const { return status == RunStatus::finished; }

  void fields(auto& io) {
    io("engine", engine, aName);
    io.when(!without.empty(), "without", without, aName);
    io("packing", packing);
    io("status", status);
    io("reason", reason);
    io.present("realised", effective);
    io.present("stats", stats);
    io.when(finished(), "head", head);
    io.present("regime", regime);
    io.when(finished(), "steadiness", steadiness);
    io.when(finished(), "profiles", profiles);
    io.when(finished(), "fits", fits);
    io.when(finished(), "checks", checks);
    io.present("series", series);
    io.when(series.has_value(), "distributions", distributions);
    io.when(effective && series, "picture", picture);
  }
};

Json toJson(const FlowRun& run);
/// @throws FieldError
FlowRun runFromJson(const Json& json);

/// Means over the packings of one engine's finished runs, with sd/√P as errors.
struct CouetteEnsemble {
  std::string engine;
  std::string without;  ///< as of a run
  std::size_t packings = 0;
  std::vector<Profile> profiles;
  std::vector<Distribution> distributions;
  std::vector<FitRow> fits;
  std::vector<HeadNumber> head;

  void fields(auto& io) {
    io("engine", engine, aName);
    io.when(!without.empty(), "without", without, aName);
    io("packings", packings);
    io("profiles", profiles);
    io("distributions", distributions);
    io("fits", fits);
    io("head", head);
  }
};

/// Null where there is none.
const Profile* profileOf(const std::vector<Profile>& profiles, std::string_view field);
const Profile* profileOf(const std::vector<Profile>& profiles, std::string_view method,
                         std::string_view field);

}  // namespace crossgrain::inline results
