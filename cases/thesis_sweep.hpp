#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// A case that the thesis' claims are compared with, and what it is there for: [[legs]].
struct SweepCase {
  std::string name, purpose;
  std::vector<std::string> families;  ///< of sweepFamilies
  double label = 0.0;                 ///< ν̄ as Table 3.2 has it [-]
  Case setup;
};

/// Families of cases that differ in one thing each.
inline constexpr const char* sweepFamilies[] = {"packings", "rate",   "spacing",  "kn",  "mass",
                                                "radius",   "bottom", "friction", "time"};

/// Cases that are run together, before all of the next stage: [[rungs]].
struct SweepStage {
  std::string name;
  std::vector<std::size_t> cases;    ///< indices, in their order
  int packings = 1;                  ///< of each case
  std::vector<std::string> engines;  ///< that take part where they are asked for; empty: all asked
  bool mirrors = false;  ///< mirrors that stand for an engine asked for take part, too (`carriers`)
};

/// What `crossgrain thesis` runs, most important first. cases/couette/thesis/README.md has the
/// keys.
struct ThesisSweep {
  std::string name;
  std::filesystem::path file;
  std::filesystem::path rules;                   ///< file of the claims' rules
  std::optional<std::filesystem::path> reasons;  ///< found for what is refuted; or none
  std::vector<Case> collisions;  ///< the variants of one case, which come before all; or none
  std::vector<int> finerRings;   ///< averaged over beside the case's own
  int settlingSnapshots = 50;    ///< per rotation that is not averaged, for the history
  std::vector<SweepCase> cases;
  std::vector<SweepStage> stages;
};

/// Reads a sweep with all its cases.
/// @param overrides  of all its cases, as loadCase() takes them; they come last
/// @throws BadInput with one line: where, what is there, what would be right
ThesisSweep loadSweep(const std::filesystem::path& file,
                      const std::vector<std::string>& overrides = {});

/// An engine of the campaign. One that is evaluated through its mirror runs packing 0 itself, and
/// only where no engines are named; the mirror runs all packings there, and all stages that are for
/// mirrors.
struct SweepEngine {
  std::string name;
  enum class Part { own, throughMirror, mirror } part = Part::own;
};

/// One engine on one packing of one case.
struct SweepRun {
  std::size_t setup = 0, engine = 0;  ///< indices
  int packing = 0;
};

/// All that is to be run, in order and each once: stage by stage, in a stage packing by packing,
/// then case by case, then engine by engine.
std::vector<SweepRun> runsOf(const ThesisSweep& sweep, const std::vector<SweepEngine>& engines);

}  // namespace crossgrain::inline cases
