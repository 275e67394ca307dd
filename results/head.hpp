#pragma once

#include <string>

#include "results/schema.hpp"

/// Head of every kind of results.
namespace crossgrain::inline results {

struct Machine {
  std::string cpu, os;
  unsigned cores = 0;

  void fields(auto& io) { FIELDS(io, cpu, os, cores); }
};

/// The case that was run, as it was resolved.
struct CaseHead {
  std::string name, variant, file;
  std::string toml;  ///< the merged document, printed

  void fields(auto& io) { FIELDS(io, name, variant, file, toml); }
};

struct ResultsHead {
  std::string schema, kind, version;
  std::string build;  ///< the source that the program was built from; empty: not known
  std::string command;
  std::string started;  ///< ISO 8601, UTC
  Machine machine;
  CaseHead setup;

  /// Its members stand beside those of the results themselves, not in an object of their own.
  void fields(auto& io) {
    FIELDS(io, schema, kind, version, command, started, machine);
    io.when(!build.empty(), "build", build);
    io("case", setup);
  }
};

/// Names in files of an engine's status.
inline constexpr support::EnumNames<Status, 3> engineStatusNames{
    {{Status::finished, "ran"}, {Status::refused, "refused"}, {Status::failed, "failed"}}};

/// An engine that took part. Their order is that of the report: the reference first.
struct EngineRow {
  std::string name, summary;
  std::string version;  ///< empty: it did not answer
  std::string mirrors;  ///< the peer whose conventions it has; empty for one named by the user
  Status status = Status::finished;
  std::string reason;

  void fields(auto& io) {
    io("name", name, aName);
    FIELDS(io, summary, version, reason);
    io("mirrors", mirrors, aName);
    io("status", status, engineStatusNames);
  }
};

}  // namespace crossgrain::inline results
