#pragma once

#include <nlohmann/json.hpp>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"
#include "cases/case.hpp"

namespace crossgrain::inline runs {

/// Numbers of the whole cell over time: "series" of a run in results.json.
class CouetteSeries {
 public:
  /// Both outlive it. The scene has the Couette cell's two bodies.
  CouetteSeries(const Case& setup, const Scene& scene) : setup_(setup), scene_(scene) {}

  void add(const Snapshot& now);

  const nlohmann::json& rows() const { return rows_; }

 private:
  const Case& setup_;
  const Scene& scene_;
  nlohmann::json rows_;
};

}  // namespace crossgrain::inline runs
