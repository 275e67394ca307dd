#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <string>

#include "adapters/worker/json.hpp"
#include "results/head.hpp"
#include "results/schema.hpp"

/// Pieces that both samples use.
namespace crossgrain::sample {

using Json = nlohmann::json;

/// Uniform in −1 … 1, the same on every platform.
class Noise {
 public:
  explicit Noise(unsigned seed) : generator_(seed) {}
  double operator()() { return 2.0 * (static_cast<double>(generator_()) / 4294967295.0) - 1.0; }

 private:
  std::mt19937 generator_;
};

inline Json engine(const std::string& name, const std::string& summary,
                   const std::string& mirrors = "", const std::string& status = "ran",
                   const std::string& reason = "") {
  return {{"name", name},       {"summary", summary}, {"version", "1.0"},
          {"mirrors", mirrors}, {"status", status},   {"reason", reason}};
}

inline EngineRow engineRow(const std::string& name, const std::string& summary,
                           const std::string& mirrors = "", Status status = Status::finished,
                           const std::string& reason = "") {
  return {name, summary, "1.0", mirrors, status, reason};
}

inline Json effective(const std::string& name, double dt) {
  Json result = Json::parse(R"({"version": "1.0", "precision": "double", "deviations": [],
    "integrator": "velocity_verlet",
    "effects": ["normal_damping", "friction", "tangential_spring", "rotation", "moving_walls"],
    "pairs": [{"pair": "3.70 mm – 3.70 mm", "kn": 352.1, "gn": 0.19, "kt": 267.1, "gt": 0.15,
               "mu": 0.44, "en": null, "et0": null}]})");
  result["engine"] = name;
  result["dt"] = dt;
  if (name == "yade")
    result["deviations"] = Json::parse(R"([{"name": "tension", "value": 0.0, "unit": "",
      "note": "always cuts tension: e_n 0.341 instead of 0.222"}])");
  if (name.starts_with("box2d")) {
    result["precision"] = "float";
    result["effects"] = {"friction", "rotation", "moving_walls", "gravity"};
    result["deviations"] = Json::parse(
        R"([{"name": "rounding", "value": 2.4e-8, "unit": "m", "note": "positions as float32"}])");
  }
  return result;
}

inline Json head(const std::string& kind, const std::string& caseName) {
  Json result = Json::parse(R"({"schema": "crossgrain-results-1", "version": "0.1.0",
    "started": "2025-03-01T12:00:00Z", "elapsed_s": 754.2, "case": {"variant": ""},
    "machine": {"cpu": "A CPU", "cores": 2, "os": "Linux"},
    "effects": ["normal_damping", "friction", "tangential_spring", "rotation", "bottom_friction",
                "moving_walls"],
    "notes": ["Bottom friction is left out by two engines."]})");
  result["kind"] = kind;
  result["command"] = "crossgrain " + kind + " cases/a.toml --engines all --out \"my results\"";
  result["case"]["name"] = caseName;
  result["case"]["file"] = "cases/" + caseName + ".toml";
  result["case"]["toml"] =
      "[case]\nname = \"" + caseName + "\"  # a < b & c\n[cell]\nomega = 1.0\n";
  return result;
}

inline ResultsHead resultsHead(const std::string& kind, const std::string& caseName) {
  return readAs<ResultsHead>(head(kind, caseName));
}

}  // namespace crossgrain::sample
