#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/flow_numbers.hpp"
#include "results/schema.hpp"

/// Causes of a difference between a reference and a peer, measured by runs of the in-house engine
/// under mixtures of both.
namespace crossgrain::inline results {

/// One thing in which a peer's way of running a scene differs from the reference's: an option, with
/// the constants that mean nothing without it, a constant, or an effect.
struct CauseName {
  std::string name;      ///< as in case files: "spring_update"; "mu"; "rotation"; "time step"
  std::string from, to;  ///< the reference's and the peer's: "after", "before"
  /// false: seen in what the peer does, which it declares otherwise
  bool declared = true;

  bool operator==(const CauseName&) const = default;
  void fields(auto& io) { FIELDS(io, name, from, to, declared); }
};

/// Which mixtures ran.
enum class Mixtures {
  all,  ///< 2^k: a part is its Shapley value, parts add up to what the laws make of it
  /// Each alone in the reference and each taken back from the peer: a part is the mean of both, and
  /// what they lack of the whole is an interaction.
  bothEnds
};
constexpr auto namesOf(Mixtures) {
  return std::array<std::string_view, 2>{"all", "both_ends"};
}

/// Two differences of which one does more, or less, where the other is.
struct Interaction {
  std::string one, other;
  double share = 0.0;  ///< largest over all numbers, in the largest difference of the laws [-]

  void fields(auto& io) { FIELDS(io, one, other, share); }
};

/// How far a set of differences, the largest first, brings the reference to the peer.
struct CauseStep {
  std::string name;   ///< that is taken besides those before it
  double left = 1.0;  ///< of the distance between both laws, over all numbers [-]

  void fields(auto& io) { FIELDS(io, name, left); }
};

/// Findings that hold for all numbers of a pair.
struct Causes {
  std::vector<CauseName> differences;
  /// In what the peer does something else than it declares, from that to what it does.
  std::vector<CauseName> undeclared;
  Mixtures mixtures = Mixtures::all;
  std::vector<Interaction> interactions;  ///< the largest first
  std::vector<CauseStep> path;            ///< where not all mixtures ran
  std::string remainder;  ///< name of what no difference of laws makes: "implementation", "solver"
  std::string reason;     ///< why nothing is attributed; empty: it is
  int runs = 0;           ///< of the in-house engine
  double cpuSeconds = 0.0;  ///< that they took

  void fields(auto& io) {
    FIELDS(io, differences, mixtures, interactions, reason, runs);
    io.when(!undeclared.empty(), "undeclared", undeclared);
    io.when(!path.empty(), "path", path);
    io("remainder_is", remainder);
    io("cpu_s", cpuSeconds);
  }
};

/// Difference of one quantity, peer less reference, at each point of a sweep, and its parts: whole
/// = Σ parts + interaction + remainder. [unit of the quantity's errors]
struct QuantityCauses {
  Numbers whole;
  std::vector<Numbers> parts;  ///< by difference
  Numbers interaction, remainder;
  std::optional<double> limit;  ///< the case's margin of it; absent: it has none

  void fields(auto& io) { FIELDS(io, whole, parts, interaction, remainder, limit); }
};

/// A mean over packings with the interval of the verdict.
struct CausePart {
  std::optional<double> mean, low, high;  ///< [unit of the endpoint]

  /// Whether its interval holds no zero.
  bool isSeen() const { return low && high && (*low > 0.0 || *high < 0.0); }

  void fields(auto& io) { FIELDS(io, mean, low, high); }
};

/// Difference of one endpoint between two engines, or of a field in one bin, b less a, and its
/// parts.
struct EndpointCauses {
  std::string endpoint, unit;
  int packings = 0;  ///< that the parts rest on
  CausePart whole;
  std::vector<CausePart> parts;  ///< by difference
  CausePart interaction, remainder;
  std::optional<std::size_t> bin = {};

  void fields(auto& io) {
    io("endpoint", endpoint, aName);
    io("unit", unit, aUnit);
    io.present("bin", bin);
    FIELDS(io, packings, whole, parts, interaction, remainder);
  }
};

/// Causes between two engines that were compared on a flow.
struct PairCauses : Causes {
  std::string a, b;  ///< the reference first
  std::vector<EndpointCauses> endpoints;
  std::vector<EndpointCauses> profile;  ///< of the field that was asked for, bin by bin
  std::optional<double> missing;  ///< seconds that what was left out would take; absent: nothing

  void fields(auto& io) {
    io("a", a, aName);
    io("b", b, aName);
    Causes::fields(io);
    io("endpoints", endpoints);
    io.when(!profile.empty(), "profile", profile);
    io.present("missing_s", missing);
  }
};

}  // namespace crossgrain::inline results
