#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/causes.hpp"
#include "results/endpoints.hpp"
#include "results/flow_frame.hpp"
#include "results/flow_numbers.hpp"
#include "results/head.hpp"
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

  /// Whether it was run again and again from one start: there is no scatter between packings.
  bool hasOneStart() const {
    return packings.size() > 1 && std::ranges::all_of(packings, [&](const PackingRow& packing) {
             return packing.hash == packings.front().hash;
           });
  }

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

/// One field under one weight about one place, against the width of a bin.
struct RevCurve {
  std::string method, field, unit;
  double r = 0.0;             ///< of rings; of slabs and boxes along their axis, or height [m]
  std::vector<double> width;  ///< [d]
  Numbers mean, standardError;

  void fields(auto& io) {
    io("method", method, aName);
    io("field", field, aField);
    io("unit", unit, aUnit);
    FIELDS(io, r, width, mean);
    io("stderr", standardError);
  }
};

/// Where, next to a width, a method comes closest to slicing.
struct RevMeeting {
  std::string method, field;
  double near = 0.0, width = 0.0;  ///< [d]
  double difference = 0.0;         ///< root mean square over the places, in units of slicing's

  void fields(auto& io) {
    io("method", method, aName);
    io("field", field, aField);
    FIELDS(io, near, width, difference);
  }
};

/// How far a method is from slicing in bins of that width [d]: √⟨(m − slicing)²⟩/√⟨slicing²⟩ over
/// the places that have room for such a bin; absent without one.
std::optional<double> differenceFromSlicing(const std::vector<RevCurve>& curves,
                                            std::string_view field, std::string_view method,
                                            double width);

/// How large a representative element must be.
struct RevResults : FlowFrame {
  std::string engine;  ///< whose snapshots
  std::vector<RevCurve> curves;
  std::vector<RevMeeting> meetings;

  void fields(auto& io) {
    FlowFrame::fields(io);
    io("engine", engine, aName);
    FIELDS(io, curves, meetings);
  }
};

}  // namespace crossgrain::inline results
