#include <algorithm>

#include "results/schema.hpp"
#include "tests/reports/sample_common.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::sample {

namespace {

constexpr double inner = 0.1032, outer = 0.2524, diameter = 0.0074;
constexpr std::size_t rings = 20;
const double width = (outer - inner) / static_cast<double>(rings);

double radius(std::size_t ring) {
  return inner + (static_cast<double>(ring) + 0.5) * width;
}
double rTilde(std::size_t ring) {
  return (radius(ring) - inner) / diameter;
}

struct FieldShape {
  const char *name, *unit;
  double (*value)(double r, double x);  ///< over r and r̃
  double noise;                         ///< of the value's own size, between packings
};

const FieldShape shapes[] = {
    {"volume_fraction", "1", [](double, double x) { return 0.83 - 0.15 * std::exp(-0.6 * x); },
     0.01},
    {"azimuthal_velocity", "m/s",
     [](double, double x) { return 0.062 * std::exp(-x / 1.9) - (x > 15 ? 1e-5 : 0.0); }, 0.12},
    {"spin", "rad/s",
     [](double, double x) {
       return 6.7 * std::exp(-1.1 * x) * std::cos(std::numbers::pi * x + 1.8);
     },
     0.1},
    {"stress_rr", "N/m²", [](double, double x) { return 42.0 - 0.2 * x; }, 0.2},
    {"stress_pp", "N/m²", [](double, double x) { return 40.0 - 0.1 * x; }, 0.2},
    {"stress_rp", "N/m²", [](double r, double) { return 11.8 * inner * inner / (r * r); }, 0.2},
    {"fabric_trace", "1", [](double, double x) { return 2.6 - 1.2 * std::exp(-0.4 * x); }, 0.05},
};

Json profile(const FieldShape& shape, double bias, double errorScale, Noise& noise) {
  Json result = {{"method", "slicing"},   {"field", shape.name},     {"unit", shape.unit},
                 {"mean", Json::array()}, {"stderr", Json::array()}, {"n_eff", Json::array()}};
  for (std::size_t ring = 0; ring < rings; ++ring) {
    const double value = shape.value(radius(ring), rTilde(ring));
    result["mean"].push_back(value * (1.0 + bias * std::min(1.0, 10.0 * shape.noise) +
                                      shape.noise * errorScale * noise()));
    result["stderr"].push_back(std::abs(value) * shape.noise * errorScale);
    result["n_eff"].push_back(57.5);
  }
  return result;
}

Json profiles(double bias, double errorScale, Noise& noise) {
  Json all = Json::array();
  for (const FieldShape& shape : shapes) all.push_back(profile(shape, bias, errorScale, noise));
  return all;
}

Json fits(double bias, bool failed) {
  Json rows = Json::parse(R"([{"name": "stress_rp_exponent", "label": "exponent p of σ_rφ ∝ r^p",
    "stderr": 0.043, "unit": "-", "expected": -2, "reason": ""},
    {"name": "velocity_decay_length", "label": "decay length B of v_φ = A exp(−r̃/B), in d",
     "unit": "-", "value": null, "stderr": null, "expected": null,
     "reason": "fewer than 3 rings with a velocity"}])");
  rows[0]["value"] = -2.0 + bias;
  if (!failed) rows[1].update({{"value", 1.9 + bias}, {"stderr", 0.11}, {"reason", ""}});
  return rows;
}

Json headNumbers(double bias, bool impulses) {
  Json numbers = Json::array();
  for (const auto& [name, value] : std::initializer_list<std::pair<const char*, Json>>{
           {"inertial_number", 0.0041 * (1 + bias)},
           {"kn_over_p", 1490.0},
           {"mean_overlap_over_d", impulses ? Json(nullptr) : Json(1.2e-5)},
           {"max_overlap_over_d", impulses ? Json(nullptr) : Json(2.4e-4)},
           {"sliding_fraction", 0.131},
           {"stress_ratio_wheel", 0.284 + bias / 10},
           {"dt_over_tc", impulses ? 0.23 : 0.0183},
           {"coordination", 3.12}})
    numbers.push_back({{"name", name}, {"value", value}, {"unit", "-"}});
  return numbers;
}

Json series(double bias, Noise& noise) {
  Json result = {{"t_s", Json::array()}};
  for (int k = 0; k <= 500; ++k) {
    const double t = 1.25 * 2.0 * std::numbers::pi * k / 500;
    result["t_s"].push_back(t);
    result["wheel_torque"].push_back(4.7e-3 * (1 + bias + 0.4 * noise() - 0.5 * std::exp(-t)));
    result["outer_pressure"].push_back(41.0 * (1 + bias + 0.1 * noise()));
    result["kinetic_energy"].push_back(2.2e-4 * (1 + 0.2 * noise()));
    result["coordination"].push_back(3.1 + 0.1 * noise() - 1.5 * std::exp(-2 * t));
    result["max_overlap"].push_back(k % 7 == 0 ? Json(nullptr) : Json(1.7e-6));
    result["sliding_fraction"].push_back(0.13 + 0.02 * noise());
  }
  return result;
}

Json checks(Noise& noise) {
  Json result = {{"name", "torque_balance"},
                 {"label", "σ_φr·2πr²h over the wheel's torque"},
                 {"value", Json::array()},
                 {"reference", Json::array()},
                 {"stderr", Json::array()}};
  for (std::size_t ring = 0; ring < rings; ++ring) {
    result["value"].push_back(4.7e-3 * (1 + 0.03 * noise()));
    result["reference"].push_back(4.7e-3);
    result["stderr"].push_back(1e-4);
  }
  const Json pressure = Json::parse(R"({"name": "wall_pressure", "value": [41.5],
    "label": "σ_rr at the ring <outside>", "reference": [40.25], "reference_stderr": 0.5,
    "stderr": [1.25]})");
  return Json::array({result, pressure});
}

/// A made-up cell: disks on rings of their own diameter, turned as a shear band would turn them.
Json picture(int disks, Noise& noise) {
  Json p = {{"time_s", 3.14}, {"rotation", 0.5}};
  for (const char* key : {"radius", "x", "y", "start_r", "start_phi", "wall_x", "wall_y",
                          "wall_radius", "speed", "contact_i", "contact_j", "contact_force"})
    p[key] = Json::array();
  int made = 0;
  for (double r = inner + 0.005; r < outer - 0.004 && made < disks; r += 0.0073) {
    const int around = static_cast<int>(2.0 * std::numbers::pi * r / 0.0079);
    const double turn = std::numbers::pi * 0.6 * std::exp(-(r - inner) / diameter / 1.9);
    for (int k = 0; k < around && made < disks; ++k, ++made) {
      const double start = 2.0 * std::numbers::pi * k / around;
      p["radius"].push_back(made % 7 == 0 ? 0.004495 : 0.0037);
      p["x"].push_back(r * std::cos(start + turn));
      p["y"].push_back(r * std::sin(start + turn));
      p["start_r"].push_back(r);
      p["start_phi"].push_back(start);
      p["speed"].push_back(inner * std::exp(-(r - inner) / diameter / 1.9));
      if (k == 0) continue;
      const double force = std::pow(std::abs(noise()), 4) * 0.02;
      p["contact_i"].push_back(made - 1);
      p["contact_j"].push_back(made);
      p["contact_force"].push_back(force);
    }
  }
  for (const auto& [wall, count] : {std::pair{inner, 259}, std::pair{outer, 634}})
    for (int k = 0; k < count; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / count;
      p["wall_x"].push_back(wall * std::cos(angle));
      p["wall_y"].push_back(wall * std::sin(angle));
      p["wall_radius"].push_back(0.00125);
    }
  return p;
}

/// Packing 2 stands still but where impulses shake it.
Json regime(bool blocked) {
  return {{"name", blocked ? "blocked" : "flowing"},
          {"reason", blocked ? "layers take up 0.002 of the wheel's rotation, less than 0.1"
                             : "layers take up 0.31 of the wheel's rotation"},
          {"wheel_contacts", blocked ? 15.5 : 18.2},
          {"wheel_slip", blocked ? 0.998 : 0.66},
          {"shear_share", blocked ? 0.002 : 0.31},
          {"inertial_number", blocked ? 1.4e-4 : 0.0041},
          {"blocked_share", blocked ? 1.0 : 0.04}};
}

Json steadiness(const char* quantity, const char* verdict, double change, double half) {
  return {{"quantity", quantity},
          {"verdict", verdict},
          {"change", change},
          {"half_width", half},
          {"excluded", std::abs(change) + half}};
}

Json run(const std::string& name, int packing, double bias, double dt, int disks) {
  Noise noise(static_cast<unsigned>(packing) * 31u + static_cast<unsigned>(name.size()));
  const bool impulses = name.starts_with("box2d");
  const double steps = 7.85 / dt;
  Json stats = {{"steps", std::lround(steps)},
                {"contact_evaluations", std::lround(steps) * 2800},
                {"wall_s", steps * (impulses ? 2.4e-3 : 1.1e-4)},
                {"cpu_s", steps * (impulses ? 2.3e-3 : 1.0e-4)},
                {"counters", Json::object()}};
  if (impulses) stats["counters"]["impacts"] = 51234.0;
  return {{"engine", name},
          {"packing", packing},
          {"status", "finished"},
          {"reason", ""},
          {"realised", effective(name, dt)},
          {"stats", stats},
          {"head", headNumbers(bias, impulses)},
          {"regime", regime(packing == 2 && !impulses)},
          {"steadiness",
           {steadiness("wheel_torque", "cannot tell", 0.1, 0.5),
            steadiness("outer_pressure", packing == 0 ? "drifts" : "cannot tell", -0.5, 0.4)}},
          {"profiles", profiles(bias, 0.6, noise)},
          {"fits", fits(bias, impulses)},
          {"checks", checks(noise)},
          {"series", series(bias, noise)},
          {"picture", packing == 0 ? picture(disks, noise) : Json(nullptr)}};
}

Json failedRun(const std::string& name, int packing, const std::string& reason) {
  return {{"engine", name},
          {"packing", packing},
          {"status", "failed"},
          {"reason", reason},
          {"realised", effective(name, 4e-5)},
          {"series", Json::object()}};
}

Json agreement(const std::string& a, const std::string& b, const std::string& kind, double bias,
               bool decided) {
  Json all = Json::array();
  Noise noise(7);
  for (const FieldShape& shape : shapes) {
    Json entry = {{"a", a},
                  {"b", b},
                  {"field", shape.name},
                  {"kind", kind},
                  {"margin", 0.25},
                  {"margin_relative", true},
                  {"margin_why", "a quarter is half of the spread between packings"},
                  {"rings", Json::array()}};
    std::string field = decided ? "agree" : "undecided";
    for (std::size_t ring = 0; ring < rings; ++ring) {
      const double value = std::abs(shape.value(radius(ring), rTilde(ring)));
      const double share = bias + 0.1 * noise();
      const std::string verdict = !decided                 ? "undecided"
                                  : std::abs(share) > 0.25 ? "disagree"
                                  : std::abs(share) > 0.2  ? "undecided"
                                                           : "agree";
      if (verdict == "disagree") field = "disagree";
      if (verdict == "undecided" && field == "agree") field = "undecided";
      Json row = {{"ring", ring},
                  {"difference", value * share},
                  {"stderr", value * 0.03},
                  {"low", value * (share - 0.07)},
                  {"high", value * (share + 0.07)},
                  {"margin", 0.25 * value},
                  {"detects", 0.4 * value},
                  {"within_share", 0.3},
                  {"packings", 4},
                  {"verdict", verdict}};
      if (!decided) row["detects"] = row["stderr"] = row["low"] = row["high"] = nullptr;
      entry["rings"].push_back(row);
    }
    entry["verdict"] = field;
    all.push_back(entry);
  }
  return all;
}

/// Two endpoints of a pair, `distance` margins apart.
Json endpoints(const std::string& a, const std::string& b, const std::string& kind, double distance,
               const char* one, const char* two, const std::string& surrogate) {
  Json rows = Json::array();
  const bool decided = std::string_view(one) != "undecided";
  for (const auto& [name, answer] : {std::pair("pressure", one), std::pair("spin_at_wheel", two)}) {
    const bool ratio = std::string_view(name) == "pressure";
    Json row = {{"a", a},
                {"b", b},
                {"kind", kind},
                {"endpoint", name},
                {"unit", ratio ? "N/m²" : "rad/s"},
                {"margin", 0.25},
                {"margin_relative", ratio},
                {"margin_why", "a quarter is half of the spread between packings"},
                {"answer", answer},
                {"reference", 100.0},
                {"difference", 25.0 * distance},
                {"distance", distance},
                {"look", 1},
                {"packings", 4},
                {"lost", 0}};
    if (decided) {
      row["reference_half"] = 12.0;
      row["value_half"] = 14.0;
      row["low"] = 25.0 * (distance - 0.3);
      row["high"] = 25.0 * (distance + 0.3);
      row["distance_low"] = distance - (std::string_view(answer) == "small_difference" ? 0.1 : 0.3);
      row["distance_high"] = distance + 0.3;
    } else {
      row["needs"] = 12;
      row["needs_at_most"] = 20;
    }
    if (!surrogate.empty()) {
      row["carrier_b"] = surrogate;
      row["bound"] = 2e-3;
      row["reach"] = 1.5e-3;
    }
    rows.push_back(row);
  }
  return rows;
}

void append(Json& to, const Json& more) {
  for (const Json& entry : more) to.push_back(entry);
}

}  // namespace

CompareResults compareResults(int packings, int disks) {
  Json results = head("compare", "nu-0.804");
  results["notes"].push_back(std::string("A note with ") + awkward);
  results["cell"] = Json::parse(R"({"inner_radius": 0.1032, "outer_radius": 0.2524, "height": 0.006,
    "wall_radius": 0.00125, "wall_spacing": 0.0025, "omega": 1.0, "small": 2511, "large": 410,
    "small_radius": 0.0037, "large_radius": 0.004495, "volume_fraction": 0.804,
    "diameter": 0.0074})");
  results["averaging"] = Json::parse(R"({"method": "slicing", "settle_rotations": 0.25,
    "rotations": 1.0, "from_rotation": 0.25, "to_rotation": 1.25, "prepared_rotations": 5.0,
    "snapshots": 400, "confidence": 0.95})");
  results["engines"] = {
      engine("grain", "the in-house engine"), engine("yade", "YADE's viscoelastic law"),
      engine("box2d-impulse", "Box2D's own solver"),
      engine("grain~yade", "grain with YADE's conventions", "yade"),
      engine("odd-one", awkward, "", "refused", "it lacks \"bottom_friction\" & <more>")};
  results["rings"] = {{"r", Json::array()}, {"r_tilde", Json::array()}, {"width", width}};
  for (std::size_t ring = 0; ring < rings; ++ring) {
    results["rings"]["r"].push_back(radius(ring));
    results["rings"]["r_tilde"].push_back(rTilde(ring));
  }
  const std::vector<std::tuple<std::string, double, double>> engines = {
      {"grain", 0.0, 4e-5},
      {"yade", -0.06, 4e-5},
      {"box2d-impulse", 0.2, 5e-4},
      {"grain~yade", -0.05, 4e-5}};
  for (int p = 0; p < packings; ++p) {
    results["packings"].push_back({{"index", p},
                                   {"seed", p + 1},
                                   {"hash", "9f86d081884c7d65" + std::to_string(p)},
                                   {"from_cache", p == 0}});
    for (const auto& [name, bias, dt] : engines)
      results["runs"].push_back(
          name == "yade" && p == 1
              ? failedRun(name, p, "worker died at t = 0.31 s (signal 11) <oops>")
              : run(name, p, bias, dt, disks));
  }
  results["ensemble"] = Json::array();
  for (const auto& [name, bias, dt] : engines) {
    Noise noise(99u + static_cast<unsigned>(name.size()));
    Json numbers = headNumbers(bias, name.starts_with("box2d"));
    for (Json& number : numbers)
      if (packings > 1 && number["value"].is_number())
        number["stderr"] = number["value"].get<double>() * 0.04;
    results["ensemble"].push_back({{"engine", name},
                                   {"profiles", profiles(bias, 0.3, noise)},
                                   {"fits", fits(bias, false)},
                                   {"head", numbers}});
  }
  for (const auto& [a, b] : {std::pair("grain", "yade"), std::pair("grain", "box2d-impulse")}) {
    const bool impulses = std::string(b) == "box2d-impulse";
    results["regimes"].push_back(
        {{"a", a},
         {"b", b},
         {"kind", "peer"},
         {"packings", packings},
         {"differ", impulses && packings > 2 ? Json::array({2}) : Json::array()}});
  }
  for (const auto& [name, bias, dt] : engines) {
    Json row = name == "grain" ? steadiness("outer_pressure", "drifts", -0.4, 0.08)
                               : steadiness("outer_pressure", "no drift seen", 0.05, 0.1);
    row["engine"] = name;
    row["packings"] = packings;
    row["drifting"] = Json::array({0});
    results["steadiness"].push_back(row);
  }
  const bool decided = packings >= 4;
  results["agreement"] = agreement("grain", "yade", "peer", -0.06, decided);
  append(results["agreement"], agreement("grain", "box2d-impulse", "peer", 0.2, decided));
  append(results["agreement"], agreement("yade", "box2d-impulse", "peer", 0.22, decided));
  append(results["agreement"], agreement("grain", "grain~yade", "mirror_model", -0.05, decided));
  append(results["agreement"],
         agreement("grain~yade", "yade", "mirror_implementation", -0.01, decided));
  results["endpoints"]["looks"] = Json::parse(
      R"({"planned": [{"packings": 4, "alpha": 0.025}, {"packings": 8, "alpha": 0.025}]})");
  results["endpoints"]["looks"]["taken"] = decided ? 1 : 0;
  results["endpoints"]["looks"]["ended"] = "the budget";
  Json& rows = results["endpoints"]["rows"] =
      endpoints("grain", "yade", "peer", 0.2, decided ? "no_difference_seen" : "undecided",
                decided ? "small_difference" : "undecided", "grain~yade");
  append(rows, endpoints("grain", "box2d-impulse", "peer", 1.1, decided ? "disagree" : "undecided",
                         decided ? "borderline" : "undecided", ""));
  if (decided) {
    results["endpoints"]["alarms"] = Json::parse(R"([{"a": "grain", "b": "box2d-impulse",
      "kind": "peer", "what": "30 % of the disks are gone from the cell"}])");
    results["endpoints"]["carried"] = Json::parse(R"([{"engine": "yade", "mirror": "grain~yade",
      "equivalent": 1e-5, "starts": 16, "carried": true, "late": {"packing": 1, "length_s": 0.1,
      "times_s": [0.0, 0.1, 0.2], "equivalents": [{"constant": "mu", "change": 2e-5}]}}])");
  }
  return fromJson<CompareResults>(results);
}

CompareResults averageResults() {
  CompareResults results = compareResults(1, 100);
  results.head.kind = "average";
  results.head.command = "crossgrain average cases/a.toml snapshots.csv";
  results.engines.resize(1);
  results.runs.resize(1);
  FlowRun& run = results.runs.front();
  run.effective.reset();
  run.stats.reset();
  run.picture.reset();
  results.agreement.clear();
  results.ensemble.clear();
  results.packings.clear();
  results.averaging = {};
  results.averaging.method = "slicing";
  results.averaging.snapshots = 12;
  return results;
}

RevResults revResults() {
  RevResults results;
  results.head.schema = schemaVersion;
  results.head.kind = kindRev;
  results.engine = "grain";
  results.averaging.snapshots = 3;
  results.averaging.lineWidth = 1.0;
  for (const char* method : {"slicing", "centre"})
    results.curves.push_back(
        {method, "volume_fraction", "1", 0.12, {0.5, 1.0, 2.2}, {0.7, 0.8, 0.8}, {0.1, 0.1, 0.1}});
  results.meetings = {{"centre", "volume_fraction", 1.0, 0.95, 0.01}};
  return results;
}

}  // namespace crossgrain::sample
