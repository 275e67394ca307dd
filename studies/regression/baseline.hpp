#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "cases/case.hpp"
#include "results/flow_numbers.hpp"
#include "results/head.hpp"
#include "studies/lockstep/account.hpp"
#include "studies/lockstep/starts.hpp"
#include "studies/lockstep/window.hpp"

namespace crossgrain::inline studies {

inline constexpr const char* baselineFormat = "baseline-3";

/// Record of an engine from one start.
template <int D>
struct BaselineWindowOf {
  std::vector<LockstepFrameOf<D>> frames;  ///< at lockstepSteps() of its own step
  /// Responses to changes of the reference constant, at the frames nearest to lockstepTimes:
  /// measured in the engine itself, so that no mirror is needed, and when it was kept, so that
  /// nothing that a later version does bends the measure.
  Responses responses;
};
using BaselineWindow = BaselineWindowOf<2>;

/// Outcomes of an engine in a sweep of collisions, to the bit.
struct KeptCollisions {
  std::string name, variant;    ///< of the case
  std::string refusal;          ///< why it was not run; empty if it was
  double dt = 0.0;              ///< of the scene [s]
  std::vector<double> psi, vn;  ///< of each collision: Ψ_i, speed of approach [m/s]
  /// Quantities by name, as scoredValue() has them; NaN of a pair that did not part.
  std::map<std::string, std::vector<double>> values;
};

/// Endpoints of whole runs by name, an entry for each start.
using KeptEndpoints = std::map<std::string, Numbers>;

/// Record of one engine, and as what it presented itself.
struct BaselineEngine {
  std::string name, version;
  Capabilities can;
  std::optional<EffectiveParameters>
      effective;                        ///< of the first start; absent of cases of collisions
  std::vector<BaselineWindow> windows;  ///< by start, of a flow in the plane
  std::vector<BaselineWindowOf<3>> spaceWindows;  ///< of one in space
  std::vector<KeptCollisions> collisions;
  KeptEndpoints endpoints;  ///< by start; empty: not asked for
};

/// Its windows of that dimension.
template <int D, typename AnyEngine>
auto& windowsIn(AnyEngine& engine) {
  if constexpr (D == 2)
    return engine.windows;
  else
    return engine.spaceWindows;
}

/// Record of some engines on one case, with all that is needed to do the same again: nothing
/// outside of it is read.
struct Baseline {
  std::string version;            ///< of the crossgrain that kept it
  CaseHead setup;                 ///< its text is the merged case, with all variants
  int dimension = 2;              ///< of starts and windows
  std::vector<FlowState> starts;  ///< springs relaxed; none of cases of collisions
  std::vector<BaselineEngine> engines;
};

/// A file of records (recording.hpp; runs/README.md lists them). The same baseline gives the same
/// bytes. @throws OutputError
void writeBaseline(const Baseline& baseline, const std::filesystem::path& file);

/// @throws BadInput naming the file: not a baseline, one of another format, damaged
Baseline readBaseline(const std::filesystem::path& file);

/// The cases that a baseline was made of, with changes, as after `--set`.
/// @param file  of the baseline, for messages
/// @throws BadInput
std::vector<Case> casesOf(const Baseline& baseline, const std::filesystem::path& file,
                          const std::vector<std::string>& overrides);

}  // namespace crossgrain::inline studies
