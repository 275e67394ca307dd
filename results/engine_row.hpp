#pragma once

#include <array>
#include <string>
#include <string_view>

#include "results/json_fields.hpp"

namespace crossgrain::inline results {

/// Whether an engine, or one of its runs, came to anything.
enum class EngineStatus {
  ran,
  refused,  ///< it cannot run the scene
  failed
};
constexpr auto namesOf(EngineStatus) {
  return std::array<std::string_view, 3>{"ran", "refused", "failed"};
}

/// An engine that took part. Their order is that of the report: the reference first.
struct EngineRow {
  std::string name, summary;
  std::string version;  ///< empty: it did not answer
  std::string mirrors;  ///< the peer whose conventions it has; empty for one named by the user
  EngineStatus status = EngineStatus::ran;
  std::string reason;

  void fields(auto& io) {
    io("name", name, aName);
    io("summary", summary);
    io("version", version);
    io("mirrors", mirrors, aName);
    io("status", status);
    io("reason", reason);
  }
};

}  // namespace crossgrain::inline results
