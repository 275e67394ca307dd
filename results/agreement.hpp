#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/json_fields.hpp"

/// Engines compared with each other.
namespace crossgrain::inline results {

/// Why two engines are compared.
enum class PairKind {
  peer,                  ///< both were named
  mirrorModel,           ///< the reference and a mirror of a peer
  mirrorImplementation,  ///< a mirror and its peer
  effect,                ///< an engine and itself without an effect
  closedForm             ///< an expected value of the case (EndpointRow::reference) and an engine
};
constexpr auto namesOf(PairKind) {
  return std::array<std::string_view, 5>{"peer", "mirror_model", "mirror_implementation", "effect",
                                         "closed_form"};
}
/// `a` of such a pair.
inline constexpr const char* closedFormName = "closed-form";
/// `a` of an engine and the median of the others, packing by packing, where no engine is the
/// reference.
inline constexpr const char* medianName = "median";

/// On which scale a ring was tested: of values, or of their ratios.
enum class TestScale { linear, logarithmic };
constexpr auto namesOf(TestScale) {
  return std::array<std::string_view, 2>{"linear", "logarithmic"};
}

/// One ring of one field, in the field's unit: a ratio as the difference that it makes.
struct AgreementRing {
  std::size_t ring = 0;                             ///< from 0
  std::optional<double> difference, standardError;  ///< b − a
  std::optional<double> low, high;                  ///< interval of the difference
  std::optional<double> margin;                     ///< absent: relative, and there is nothing
  std::optional<double> detects;         ///< the smallest true difference found in 9 of 10 repeats
  std::optional<double> withinFraction;  ///< of the variance, due to finite runs
  TestScale scale = TestScale::linear;
  std::optional<int> packings;  ///< that both have
  Verdict verdict = Verdict::undecided;

  void fields(auto& io) {
    FIELDS(io, ring, difference, low, high, margin, detects, scale, packings);
    io("stderr", standardError);
    io("within_share", withinFraction);
    io("verdict", verdict, agreementNames);
  }
};

/// The verdict on one field of two engines.
struct AgreementRow {
  std::string a, b;  ///< the reference first
  PairKind kind = PairKind::peer;
  std::string field;
  std::optional<double>
      margin;  ///< of the reference where marginRelative, else in the field's unit
  bool marginRelative = false;
  std::string marginWhy;
  Verdict verdict = Verdict::undecided;
  std::optional<double> detects;  ///< in the ring that shows it best
  std::vector<AgreementRing> rings;

  void fields(auto& io) {
    io("a", a, aName);
    io("b", b, aName);
    FIELDS(io, kind, margin, marginRelative, marginWhy, detects, rings);
    io("field", field, aField);
    io("verdict", verdict, agreementNames);
  }
};

/// Where a command that judges has judged nothing: that is never a success by itself.
struct NothingJudged {
  std::string reason;      ///< ends the line "nothing was judged: …"
  bool byRequest = false;  ///< one engine: there was nothing to compare it with

  void fields(auto& io) { FIELDS(io, reason, byRequest); }
};

}  // namespace crossgrain::inline results
