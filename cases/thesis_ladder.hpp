#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// A case that the thesis' claims are held against, and what it is there for.
struct LadderLeg {
  std::string name, purpose;
  std::vector<std::string> families;  ///< of ladderFamilies
  double label = 0.0;                 ///< ν̄ as Table 3.2 has it [-]
  Case setup;
};

/// Families of legs that differ in one thing each.
inline constexpr const char* ladderFamilies[] = {"packings", "rate",   "spacing",  "kn",  "mass",
                                                 "radius",   "bottom", "friction", "time"};

/// Legs that are run together, before all of the next rung.
struct LadderRung {
  std::string name;
  std::vector<std::size_t> legs;     ///< indices, in their order
  int packings = 1;                  ///< of each leg
  std::vector<std::string> engines;  ///< that take part where they are asked for; empty: all asked
  bool carriers = false;             ///< mirrors that carry an engine asked for take part, too
};

/// What `crossgrain thesis` runs, most important first. cases/couette/thesis/README.md has the
/// keys.
struct ThesisLadder {
  std::string name;
  std::filesystem::path file;
  std::filesystem::path rules;                   ///< file of the claims' rules
  std::optional<std::filesystem::path> reasons;  ///< found for what is refuted; or none
  std::vector<Case> collisions;  ///< the variants of one case, which come before all; or none
  std::vector<int> finerRings;   ///< averaged over beside the case's own
  int settlingSnapshots = 50;    ///< per rotation that is not averaged, for the history
  std::vector<LadderLeg> legs;
  std::vector<LadderRung> rungs;
};

/// Reads a ladder with all its cases.
/// @param overrides  of all its cases, as loadCase() takes them; they come last
/// @throws BadInput with one line: where, what is there, what would be right
ThesisLadder loadLadder(const std::filesystem::path& file,
                        const std::vector<std::string>& overrides = {});

/// An engine that climbs. One that is carried, by its mirror, runs packing 0 itself, and only where
/// no engines are named; the mirror runs all packings there, and all rungs that are for carriers.
struct LadderEngine {
  std::string name;
  enum class Part { own, carried, carrier } part = Part::own;
};

/// One engine on one packing of one leg.
struct LadderStep {
  std::size_t leg = 0, engine = 0;  ///< indices
  int packing = 0;
};

/// All that is to be run, in order and each once: rung by rung, in a rung packing by packing, then
/// leg by leg, then engine by engine.
std::vector<LadderStep> stepsOf(const ThesisLadder& ladder,
                                const std::vector<LadderEngine>& engines);

}  // namespace crossgrain::inline cases
