#pragma once

#include <map>
#include <string>
#include <vector>

#include "cases/cost_kind.hpp"

namespace crossgrain::inline cases {

/// What `crossgrain cost` varies and measures in a Couette case, [cost] of a case file. Steps are
/// numbers of steps in the contact time t_c of two small disks.
struct Cost {
  std::vector<CostKind> kinds = {costKinds.begin(), costKinds.end()};
  std::vector<std::string> knobs;  ///< names of CostKnobs (cases/cost_knobs.hpp)
  double timed = 0.02;             ///< shortest time that counts as measured [s]
  int repeats = 3;                 ///< of which the shortest counts

  /// Two small disks that meet as in `approach = "spin"`, Ψ_i = 0 … psiMax.
  std::vector<double> collisionSteps = {400, 200, 100, 50, 20, 10, 5, 2, 1.2};
  double speed = 0.01;  ///< v_n [m/s]
  double psiMax = 4.0;
  int psiCount = 41;
  /// Steps per t_c of an engine's own limit of small steps, where its law has no oracle; held
  /// against itself at half of them.
  double collisionReference = 6400.0;

  /// A packing over a window that is short against its chaos.
  std::vector<double> trajectorySteps = {400, 200, 100, 50, 20, 10, 5, 2};
  double trajectoryReference = 1600.0;  ///< steps per t_c of the references
  double perturbation = 1e-10;          ///< of positions, to see it grow [d]
  double separation = 1e-3;             ///< the reference may have erred so far at the end [d]
  double windowMost = 40.0;             ///< longest window [t_c]
  double growthTime = 1.0;              ///< how long the perturbation is watched [s]

  /// The case's packings and averaging.
  std::vector<double> averageSteps = {100, 50, 20, 10, 5, 2};
  double averageReference = 200.0;
  /// Steps at which averages are only bounded, over short windows.
  std::vector<double> boundSteps = {1600, 800, 400, 200};
  double boundReference = 3200.0;  ///< of those windows

  /// What knobs are set to, by the name of the knob: of each either texts or numbers.
  std::map<std::string, std::vector<std::string>> texts;
  std::map<std::string, std::vector<double>> numbers;
  /// Engine → its setting → values, [cost.settings.NAME].
  std::map<std::string, std::map<std::string, std::vector<double>>> settings;

  Cost();  ///< all knobs, with the values they have by default
};

}  // namespace crossgrain::inline cases
