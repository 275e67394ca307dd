#include "tests/reports/sample_common.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::sample {

namespace {

constexpr std::size_t effectRings = 3;

Json profile(const char* field, const char* unit, double scale, double shift) {
  Json result = {{"method", "slicing"}, {"field", field}, {"unit", unit}};
  for (std::size_t ring = 0; ring < effectRings; ++ring) {
    result["mean"].push_back(scale / static_cast<double>(ring + 1) + (ring == 1 ? shift : 0.0));
    result["stderr"].push_back(0.02 * scale);
    result["n_eff"].push_back(8.0);
  }
  return result;
}

/// A run; the velocity of ring 2 is changed by `shift`.
Json run(const std::string& without, int packing, double shift) {
  Json result = {{"engine", "grain"},
                 {"packing", packing},
                 {"status", "finished"},
                 {"reason", ""},
                 {"realised", effective("grain", 4e-5)},
                 {"stats", {{"steps", 1000}, {"wall_s", 0.05}, {"cpu_s", 0.05}}},
                 {"head", Json::array()},
                 {"fits", Json::array()}};
  result["profiles"] = {profile("azimuthal_velocity", "m/s", 0.02, shift),
                        profile("volume_fraction", "1", 0.8, 0.0)};
  if (!without.empty()) result["without"] = without;
  return result;
}

/// The velocity's ring 2 changes by `change`; no other ring of the fields by more than its error.
Json fields(double change, bool decided) {
  Json all = Json::array();
  const std::tuple<const char*, const char*, double, double> effectShapes[] = {
      {"azimuthal_velocity", "m/s", 0.02, change}, {"volume_fraction", "1", 0.8, 0.0}};
  for (const auto& [name, unit, scale, shift] : effectShapes) {
    Json field = {{"field", name}, {"unit", unit}, {"judged", true}, {"verdict", "undecided"}};
    for (std::size_t ring = 0; ring < effectRings; ++ring) {
      const bool changed = ring == 1 && shift != 0.0;
      Json row = {{"ring", ring},
                  {"reference", scale / static_cast<double>(ring + 1)},
                  {"change", changed ? shift : 0.0005 * scale},
                  {"stderr", 0.01 * scale},
                  {"p", changed ? 1e-5 : 1.0},
                  {"resolved", changed},
                  {"low", (changed ? shift : 0.0005 * scale) - 0.05 * scale},
                  {"high", (changed ? shift : 0.0005 * scale) + 0.05 * scale},
                  {"smallest", 0.05 * scale},
                  {"verdict", "undecided"}};
      if (!decided)
        for (const char* told : {"p", "resolved", "low", "high", "smallest"}) row[told] = nullptr;
      field["rings"].push_back(row);
    }
    all.push_back(field);
  }
  return all;
}

Json leg(const std::string& effect, double ratio, double contacts) {
  return {{"engine", "grain"},      {"effect", effect},
          {"status", "ran"},        {"reason", ""},
          {"step_s", 5e-6 * ratio}, {"contacts_per_step", contacts},
          {"time_ratio", ratio},    {"time_ratio_stderr", effect.empty() ? 0.0 : 0.01},
          {"precision", "double"}};
}

}  // namespace

EffectsResults effectsResults(int packings) {
  const bool decided = packings >= 4;
  Json results = head("effects", "small");
  results["notes"] = Json::array();
  results["averaging"] = Json::parse(R"({"method": "slicing", "settle_rotations": 0.25,
    "rotations": 1.0, "snapshots": 400, "confidence": 0.95})");
  results["cell"] = Json::parse(
      R"({"inner_radius": 0.03, "outer_radius": 0.0525, "omega": 1.0, "diameter": 0.0074})");
  results["rings"] =
      Json::parse(R"({"r": [0.034, 0.041, 0.049], "r_tilde": [0.5, 1.5, 2.5], "width": 0.0075})");
  results["timing"] = {{"rounds", 5}, {"seconds", 0.2}};
  results["engines"] = Json::array({engine("grain", "the in-house engine")});
  results["switches"] = {{{"effect", "friction"}, {"what", "No <tangential> force."}},
                         {{"effect", "bottom_friction"}, {"what", "No plate."}},
                         {{"effect", "tension_cut"}, {"what", "No tension."}}};
  results["ensemble"] = Json::array();
  const std::pair<const char*, double> legs[] = {
      {"", 0.0}, {"friction", -0.004}, {"bottom_friction", 0.0}};
  for (const auto& [without, shift] : legs) {
    for (int k = 0; k < packings; ++k) results["runs"].push_back(run(without, k, shift));
    Json ensemble = run(without, 0, shift);
    results["ensemble"].push_back(std::move(ensemble));
  }
  for (int k = 0; k < packings; ++k)
    results["packings"].push_back({{"index", k},
                                   {"seed", k + 1},
                                   {"hash", fmt::format("9f86d08 {}", k)},
                                   {"from_cache", false}});
  Json friction = leg("friction", 0.5, 45.0), bottom = leg("bottom_friction", 0.995, 424.0);
  for (Json* each : {&friction, &bottom}) {
    (*each)["packings"] = packings;
    (*each)["stderr_kind"] = packings > 1 ? "packings" : "within_run";
  }
  friction["fields"] = fields(-0.004, decided);
  bottom["fields"] = fields(0.0, decided);
  const Json refused = {
      {"engine", "grain"}, {"effect", "tension_cut"}, {"status", "refused"}, {"reason", awkward}};
  results["legs"] = {leg("", 1.0, 424.0), friction, bottom, refused};
  return fromJson<EffectsResults>(results);
}

}  // namespace crossgrain::sample
