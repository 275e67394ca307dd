#pragma once

#include <string>

/// What every kind of results begins with.
namespace crossgrain::inline results {

struct Machine {
  std::string cpu, os;
  unsigned cores = 0;
};

/// The case that was run, as it was resolved.
struct CaseHead {
  std::string name, variant, file;
  std::string toml;  ///< the merged document, printed
};

struct ResultsHead {
  std::string schema, kind, version;
  std::string build;  ///< the source that the program was built from; empty: nobody knows
  std::string command;
  std::string started;  ///< ISO 8601, UTC
  Machine machine;
  CaseHead setup;
};

}  // namespace crossgrain::inline results
