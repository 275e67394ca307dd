#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/head.hpp"

/// results.json of kind "conformance": whether one engine behaves as it declares.
namespace crossgrain::inline results {

/// How a check came out.
struct CheckOutcome {
  Status status;
  Verdict verdict;
  bool operator==(const CheckOutcome&) const = default;
};
inline constexpr CheckOutcome checkPassed{Status::finished, Verdict::pass};
inline constexpr CheckOutcome checkFailed{Status::finished, Verdict::fail};
/// The engine does not declare what the check needs, or the check does not apply to it.
inline constexpr CheckOutcome checkSkipped{Status::notRun, Verdict::notApplicable};
/// The time given was over: not known.
inline constexpr CheckOutcome checkUntried{Status::notRun, Verdict::notMeasured};
/// It died, hung, or gave an invalid answer.
inline constexpr CheckOutcome checkBrokeDown{Status::failed, Verdict::fail};
inline constexpr support::EnumNames<CheckOutcome, 5> checkNames{{{checkPassed, "passed"},
                                                                 {checkFailed, "failed"},
                                                                 {checkSkipped, "skipped"},
                                                                 {checkUntried, "not_tried"},
                                                                 {checkBrokeDown, "broke_down"}}};

/// One check of one engine.
struct ConformanceRow {
  std::string part;  ///< "suite", "lockstep", "collisions"
  std::string name;  ///< "HeadOnCollision"; of collisions the case and variant
  std::string what;  ///< property of an engine that passes
  CheckOutcome outcome = checkPassed;
  std::string detail;      ///< the first fault with its number, or why it was skipped; may be empty
  std::size_t faults = 0;  ///< that were found in all
  std::string cause = {};  ///< of the faults, sign and size; empty: none that was tried fits
  double seconds = 0.0;    ///< wall time [s]
  /// Subject, "free motion"; with others of that it passes or fails. Empty of other parts.
  std::string about = {};

  void fields(auto& io) {
    FIELDS(io, part, what, detail, faults, cause, about);
    io("check", name);
    io("outcome", outcome, checkNames);
    io("wall_s", seconds);
  }
};

/// Share of the declared capabilities that has to be examined, or nothing is said of an engine by
/// checks that passed: each fifth that was not could hold a fault.
inline constexpr double leastExamined = 0.8;

struct ConformanceResults {
  ResultsHead head;
  std::optional<double> elapsed;  ///< [s]
  EngineRow engine;
  std::vector<ConformanceRow> rows;  ///< in the order in which they were run
  std::string cause;  ///< those of the rows, each once; empty: nothing that was tried explains them
  std::optional<std::size_t> declared;   ///< capabilities; absent: only some checks were asked for
  std::vector<std::string> notExamined;  ///< of them, by no check
  std::vector<std::string> atDefaults;   ///< settings that were run at their defaults alone

  /// Of what is declared; absent: only some checks were asked for, or nothing is declared.
  std::optional<double> partExamined() const;

  std::size_t count(CheckOutcome outcome) const;

  void fields(auto& io) {
    head.fields(io);
    io.present("elapsed_s", elapsed);
    FIELDS(io, engine, cause, notExamined, atDefaults);
    io("checks", rows);
    io.present("declared", declared);
  }
};

}  // namespace crossgrain::inline results
