#pragma once

#include <string>

namespace crossgrain::inline stability {

/// Test of a hard case: what it tests, by which measure, and how far that may go.
struct Stability {
  std::string tests;      ///< one sentence
  std::string measure;    ///< a name of stabilityMeasures(), whose unit the limits have
  double limit = 0.0;     ///< up to here: stable
  double degraded = 0.0;  ///< up to here: degraded; beyond: unstable
  std::string why;        ///< of the limits
  int samples = 200;      ///< of the run, evenly spread
  double settle = 0.0;    ///< fraction of the run before measures of rest begin, [0, 1)
  bool stands = false;    ///< whether nothing is to move before that either
  bool quick = false;     ///< part of a quick suite
  bool longRun = false;   ///< only on request
};

}  // namespace crossgrain::inline stability
