#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/engine.hpp"
#include "adapters/worker/json.hpp"
#include "averaging/distributions.hpp"
#include "averaging/profiles.hpp"
#include "results/flow_numbers.hpp"
#include "results/scene_picture.hpp"
#include "results/schema.hpp"

namespace crossgrain::inline results {

void fields(auto& io, Profile& profile) {
  io("method", profile.method, aName);
  io("field", profile.field, aField);
  io("unit", profile.unit, aUnit);
  FIELDS(io, profile.mean, profile.nEff, profile.dof);
  io("stderr", profile.standardError);
}

void fields(auto& io, Distribution& distribution) {
  io("quantity", distribution.quantity, aName);
  FIELDS(io, distribution.ring, distribution.axes, distribution.density, distribution.outside,
         distribution.samples);
  io("stderr", distribution.standardError);
}

/// Names in files of a run's status.
inline constexpr support::EnumNames<Status, 3> runStatusNames{
    {{Status::finished, "finished"}, {Status::failed, "failed"}, {Status::notRun, "missing"}}};

/// How well one run knows an endpoint by itself: it says nothing of other packings.
struct EndpointError {
  std::string endpoint;
  double standardError = 0.0;  ///< [unit of the endpoint]
  double dof = 0.0;            ///< of Student's t

  void fields(auto& io) {
    io("endpoint", endpoint, aName);
    io("stderr", standardError);
    io("dof", dof);
  }
};

/// One engine on one packing: its parameters, cost and averages. A run that did not finish has
/// none.
struct FlowRun {
  std::string engine;
  std::string without;  ///< the effect that was switched off; empty: none
  int packing = 0;      ///< index
  Status status = Status::finished;
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
  std::vector<ScenePicture>
      strip;  ///< likewise, of the reference: times from first to last, without contacts
  std::vector<EndpointError> endpointErrors;  ///< where runs of files are compared
  std::string files;                          ///< of a run of files: their names
  std::vector<std::string> remarks;           ///< likewise: what they lack and what that costs
  bool hasOtherLaw = false;                   ///< likewise: forces are not those of the case's law

  bool finished() const { return status == Status::finished; }
  /// Whether it is averaged from files, not run here.
  bool ofFiles() const { return finished() && !stats; }

  void fields(auto& io) {
    io("engine", engine, aName);
    io.when(!without.empty(), "without", without, aName);
    FIELDS(io, packing, reason);
    io("status", status, runStatusNames);
    io.present("realised", effective);
    PRESENT_FIELDS(io, stats, regime, series);
    io.when(finished(), "head", head);
    io.when(finished(), "steadiness", steadiness);
    io.when(finished(), "profiles", profiles);
    io.when(finished(), "fits", fits);
    io.when(finished(), "checks", checks);
    io.when(series.has_value(), "distributions", distributions);
    io.when(effective && series, "picture", picture);
    io.when(!strip.empty(), "strip", strip);
    io.when(!endpointErrors.empty(), "endpoint_errors", endpointErrors);
    io.when(!files.empty(), "files", files);
    io.when(!remarks.empty(), "remarks", remarks);
    io.when(hasOtherLaw, "other_law", hasOtherLaw);
  }
};

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
    FIELDS(io, packings, profiles, distributions, fits, head);
  }
};

/// Null where there is none.
const Profile* profileOf(const std::vector<Profile>& profiles, std::string_view field);
const Profile* profileOf(const std::vector<Profile>& profiles, std::string_view method,
                         std::string_view field);

}  // namespace crossgrain::inline results
