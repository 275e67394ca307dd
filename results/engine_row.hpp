#pragma once

#include <string>

#include "results/json_fields.hpp"

namespace crossgrain::inline results {

/// What files call the status of an engine.
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
    io("summary", summary);
    io("version", version);
    io("mirrors", mirrors, aName);
    io("status", status, engineStatusNames);
    io("reason", reason);
  }
};

}  // namespace crossgrain::inline results
