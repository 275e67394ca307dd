#include <algorithm>

#include "tests/reports/sample_common.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::sample {

namespace {

/// Walton's (1992) law: sticking below, sliding above.
double after(double psi, double stick, double constant) {
  return std::max(-stick * psi, psi - constant);
}

Json curve(const std::string& name, double steps, double stick, double constant, double error) {
  const double dt = 2.18e-3 / steps;
  Json points = Json::array();
  for (int k = 1; k <= 16; ++k) {
    const double psi = 0.25 * k, expected = after(psi, stick, constant);
    points.push_back({{"psi_i", psi},
                      {"v_n", 1e-4},
                      {"e_n", 0.3408 + error / 5},
                      {"psi_f", expected + error * (0.4 + std::abs(std::sin(3 * psi)))},
                      {"e_n_reference", 0.3408},
                      {"psi_f_reference", expected},
                      {"status", "ok"}});
  }
  return {{"engine", name},
          {"dt", dt},
          {"steps_per_contact", steps},
          {"status", "finished"},
          {"reason", ""},
          {"realised", realised(name, dt)},
          {"points", points},
          {"score",
           {{"max_error", error / 2},
            {"rms_error", error / 4},
            {"e_n_error", error / 5},
            {"verdict", error < 0.02 ? "held" : "fell short"},
            {"limit", 0.01}}}};
}

Json variant(const std::string& name, double stick, double constant) {
  Json v = {
      {"variant", name},
      {"law",
       {{"normal", "linear"}, {"tangential", "spring_dashpot"}, {"tension", "cut"}, {"mu", 0.44}}},
      {"e_n_closed", 0.3408},
      {"sticking", {{"e_t0", stick}}},
      {"sliding_constant", constant},
      {"oracle", Json::array()},
      {"curves", Json::array()}};
  for (int k = 0; k <= 200; ++k)
    v["oracle"].push_back({{"psi_i", 0.02 * k},
                           {"v_n", 1e-4},
                           {"e_n", 0.3408},
                           {"psi_f", after(0.02 * k, stick, constant)}});
  for (const double steps : {50.0, 200.0, 1000.0}) {
    v["curves"].push_back(curve("grain", steps, stick, constant, 12.0 / (steps * steps)));
    v["curves"].push_back(curve("yade", steps, stick, constant, 1.2 / steps));
  }
  v["curves"].push_back(curve("box2d-impulse", 10.0, stick, constant, 0.03));
  return v;
}

}  // namespace

Json collideResults() {
  Json results = head("collide", "figure-4-3");
  results["engines"] = {engine("grain", "the in-house engine"),
                        engine("yade", "YADE's viscoelastic law"),
                        engine("box2d-impulse", "Box2D's own solver"),
                        engine(awkward, "the user's own", "", "failed", "worker hung <120 s>")};
  results["variants"] = {variant("spring, tension cut", 0.47, 1.770),
                         variant("spring and dashpot", 0.055, 1.770)};
  results["variants"][1]["sticking"]["e_t0"] = nullptr;
  results["variants"][1]["curves"].push_back({{"engine", awkward},
                                              {"dt", 1e-5},
                                              {"steps_per_contact", nullptr},
                                              {"status", "failed"},
                                              {"reason", "worker hung <120 s>"},
                                              {"realised", nullptr},
                                              {"points", Json::array()},
                                              {"score",
                                               {{"max_error", nullptr},
                                                {"rms_error", nullptr},
                                                {"e_n_error", nullptr},
                                                {"verdict", "not judged"},
                                                {"limit", 0.01}}}});
  results["orders"] = {{{"engine", "grain"},
                        {"variant", "spring, tension cut"},
                        {"order", 2.003},
                        {"stderr", 0.012},
                        {"error_at", {{"4.36e-05", 0.0024}, {"2.18e-06", 6e-6}}}},
                       {{"engine", "yade"},
                        {"variant", "spring, tension cut"},
                        {"order", 1.01},
                        {"stderr", nullptr},
                        {"error_at", {{"4.36e-05", 0.012}}}}};
  return results;
}

}  // namespace crossgrain::sample
