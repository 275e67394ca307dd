#include <algorithm>

#include "tests/reports/sample_common.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::sample {

namespace {

/// Walton's (1992) law: sticking below, sliding above.
double after(double psi, double stick, double constant) {
  return std::max(-stick * psi, psi - constant);
}

constexpr int places = 16;

double psiAt(int k) {
  return 0.25 * (k + 1);
}

Json score(double error, double limit) {
  return {{"max", error},       {"rms", error / 2}, {"unit", 1.0},
          {"unit_is", "range"}, {"limit", limit},   {"held", error <= limit}};
}

Json curve(const std::string& name, double steps, double stick, double constant, double error) {
  const double dt = 2.18e-3 / steps;
  Json points;
  for (int k = 0; k < places; ++k) {
    const double psi = psiAt(k);
    points["psi_i"].push_back(psi);
    points["v_n"].push_back(1e-4);
    points["e_n"].push_back(0.3408 + error / 5);
    points["psi_f"].push_back(after(psi, stick, constant) +
                              error * (0.4 + std::abs(std::sin(3 * psi))));
    points["status"].push_back("parted");
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
            {"limit", 0.01},
            {"psi_f", score(error / 2, 0.01)}}}};
}

Json variant(const std::string& name, double stick, double constant) {
  Json v = {
      {"variant", name},
      {"law",
       {{"normal", "linear"}, {"tangential", "spring_dashpot"}, {"tension", "cut"}, {"mu", 0.44}}},
      {"effects", {"normal_damping", "friction", "tangential_spring", "rotation"}},
      {"e_n_closed", 0.3408},
      {"sticking", {{"e_t0", stick}}},
      {"sliding_constant", constant},
      {"curves", Json::array()}};
  for (int k = 0; k < places; ++k) {
    v["reference"]["psi_i"].push_back(psiAt(k));
    v["reference"]["e_n"].push_back(0.3408);
    v["reference"]["psi_f"].push_back(after(psiAt(k), stick, constant));
  }
  for (int k = 0; k <= 200; ++k) {
    v["oracle"]["psi_i"].push_back(0.02 * k);
    v["oracle"]["psi_f"].push_back(after(0.02 * k, stick, constant));
  }
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
                                              {"points", Json::object()},
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
                        {"error_at", {{"4.36e-05", 0.0024}, {"2.18e-06", 6e-6}}},
                        {"quantities", {{"psi_f", {{"order", 2.003}, {"stderr", 0.012}}}}}},
                       {{"engine", "yade"},
                        {"variant", "spring, tension cut"},
                        {"order", 1.01},
                        {"stderr", nullptr},
                        {"error_at", {{"4.36e-05", 0.012}}},
                        {"quantities", {{"psi_f", {{"order", 1.01}, {"stderr", nullptr}}}}}}};
  return results;
}

}  // namespace crossgrain::sample
