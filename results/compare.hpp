#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "results/agreement.hpp"
#include "results/causes.hpp"
#include "results/endpoints.hpp"
#include "results/flow_frame.hpp"
#include "results/head.hpp"
#include "results/json_fields.hpp"
#include "results/lockstep_findings.hpp"
#include "results/run.hpp"
#include "results/schema.hpp"

namespace crossgrain::inline results {

/// Engines on the packings of a Couette case.
struct FlowStudy : FlowFrame {
  std::optional<double> elapsed;   ///< [s]
  std::vector<EngineRow> engines;  ///< the reference first
  std::vector<PackingRow> packings;
  std::vector<FlowRun> runs;

  void fields(auto& io) {
    FlowFrame::fields(io);
    io.present("elapsed_s", elapsed);
    FIELDS(io, engines, runs);
    io.when(head.kind != kindAverage, "packings", packings);
  }
};

/// Kind "compare"; and kind "average", of one engine, where nothing is compared: of several runs it
/// has their ensemble.
struct CompareResults : FlowStudy {
  std::optional<LockstepFindings> lockstep;  ///< absent: nobody was compared with a mirror
  std::vector<RegimesOfPair> regimes;
  std::vector<EngineDrift> steadiness;
  std::vector<CouetteEnsemble> ensemble;
  std::vector<AgreementRow> agreement;         ///< ring by ring: where a difference is
  EndpointFindings endpoints;                  ///< basis of the verdicts
  std::vector<PairCauses> causes;              ///< of differences that were seen
  std::optional<NothingJudged> nothingJudged;  ///< absent where something was judged

  void fields(auto& io) {
    const bool compared = head.kind != kindAverage;
    FlowStudy::fields(io);
    io.present("lockstep", lockstep);
    io.when(compared, "regimes", regimes);
    io("steadiness", steadiness);
    io.when(compared || runs.size() > 1, "ensemble", ensemble);
    io.when(compared, "agreement", agreement);
    io.when(compared, "endpoints", endpoints);
    io.when(!causes.empty(), "causes", causes);
    io.present("nothing_judged", nothingJudged);
  }
};

/// Reference of engines: the first of them, or medianName. @pre there is an engine
inline const std::string& referenceOf(const CompareResults& results) {
  return results.endpoints.reference.empty() ? results.engines.front().name
                                             : results.endpoints.reference;
}

/// Kind "lockstep".
struct LockstepResults : FlowStudy {
  LockstepFindings lockstep;

  void fields(auto& io) {
    FlowStudy::fields(io);
    io("lockstep", lockstep);
  }
};

}  // namespace crossgrain::inline results
