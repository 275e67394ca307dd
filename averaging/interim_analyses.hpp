#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "averaging/agreement.hpp"

/// Verdicts on a family of endpoints while packings are added: looks at fixed numbers of packings,
/// each with its part of the chance of error, so that looking again is no new chance.
namespace crossgrain::inline averaging {

/// At how many packings is looked, and at which levels each look tests, α = 1 − confidence. The two
/// errors are apart, so each has the levels that serve it:
/// - a false *agree* is one endpoint's matter and most endpoints agree, the earlier the better: the
///   same level at each look (pocock.hpp);
/// - a false *disagree* is the family's, and one that is missed at the last look is missed for
/// good:
///   most of α is kept for the last, and the union bound over looks holds whatever happens before.
struct InterimPlan {
  std::vector<int> packings;  ///< rising
  std::vector<double> alpha;  ///< for *disagree*, one for each look; their sum is α
  double agreeAlpha;          ///< for *agree*, of every look
};

/// `count` looks at first, 2·first, …: for *disagree* the last spends half of α, the one before
/// half of the rest, and so on, the first two the same: 1/8, 1/8, 1/4, 1/2 of α for four.
/// @pre first, count >= 1
InterimPlan interimPlanAt(int first, int count, double alpha);

/// A verdict with the interval that it rests on, on the scale of the test.
struct InterimAnswer {
  Verdict verdict = Verdict::undecided;  ///< pass, borderline, undecided or fail
  std::size_t look = 0;                  ///< index of the look that gave it, or of the last one
  int packings = 0;                      ///< that both engines have, of those looked at
  int referencePackings = 0, otherPackings = 0;  ///< as of PairedComparison
  Basis basis = Basis::paired;
  int lost = 0;  ///< of those looked at, that one engine has no value on
  double difference = 0.0;
  std::optional<double> standardError;
  std::optional<double> low, high;  ///< (1 − 2α) interval, α that of *agree*
};

/// Answers after as many looks as `available` packings allow; each sample holds at least as many
/// entries as the last of them, in the order in which packings were added. At every look:
/// - agree: two one-sided t tests at agreeAlpha (Schuirmann 1987), endpoint by endpoint;
/// - disagree: |µ| ≤ margin rejected under Holm's (1979) procedure over the family at the look's
///   alpha.
/// Both are final. What is left after the last look is borderline if its interval holds ±margin and
/// lies between 0 and ±2 margins, else undecided; with fewer than 4 packings always undecided.
/// @returns absent where neither engine has anything; all absent before the first look
std::vector<std::optional<InterimAnswer>> answersAfterInterims(std::span<const PairedSample> family,
                                                               const InterimPlan& plan,
                                                               int available);

/// The chance that one of `tests` differences of that scatter, itself an estimate of dof degrees of
/// freedom, is as far out as this by itself: Student's t, both tails, at most 1.
double chanceOfOneAsFar(double difference, double scatter, int dof, std::size_t tests);

/// In units of the scatter: how far out is a difference that has this chance.
double farthestByChance(double chance, int dof, std::size_t tests);

/// How many looks that many packings allow.
std::size_t interimsTaken(const InterimPlan& plan, int available);

/// Packings that give a verdict with that chance if the mean difference is what it seems and one
/// paired difference scatters by `sd`: two one-sided tests at `alpha` toward the nearer side of the
/// margin. Absent beyond 10 000 of them.
std::optional<int> packingsFor(double difference, double sd, double margin, double alpha,
                               double chance = 0.9);

/// The same from a scatter that is itself an estimate: with the ends of its 80 % interval (χ² of
/// dof degrees of freedom).
struct PackingRange {
  int low = 0;
  std::optional<int> high;  ///< absent: beyond 10 000
};
std::optional<PackingRange> packingsFor(double difference, double sd, int dof, double margin,
                                        double alpha);

}  // namespace crossgrain::inline averaging
