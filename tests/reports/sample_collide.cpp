#include <algorithm>
#include <array>
#include <cmath>

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

void add(CollisionTable& table, QuantityId quantity, double value) {
  auto& column = table.columns[quantity];
  if (!column) column.emplace();
  column->push_back(value);
}

CollisionCurve curve(const std::string& name, double steps, double stick, double constant,
                     double error) {
  CollisionCurve curve{.engine = name, .dt = 2.18e-3 / steps, .stepsPerContact = steps};
  curve.effective = readAs<EffectiveParameters>(effective(name, curve.dt));
  for (int k = 0; k < places; ++k) {
    const double psi = psiAt(k);
    curve.points.psi.push_back(psi);
    curve.points.vn.push_back(1e-4);
    add(curve.points, QuantityId::en, 0.3408 + error / 5);
    add(curve.points, QuantityId::psiF,
        after(psi, stick, constant) + error * (0.4 + std::abs(std::sin(3 * psi))));
  }
  QuantityScore& psi = curve.score.of[QuantityId::psiF].emplace();
  psi.max = error / 2;
  psi.rms = error / 4;
  psi.limit = 0.01;
  psi.held = psi.max <= *psi.limit;
  curve.score.verdict = *psi.held ? Verdict::pass : Verdict::fail;
  return curve;
}

CollisionVariant variant(const std::string& name, double stick, double constant) {
  CollisionVariant v;
  v.variant = name;
  v.law = {
      {"normal", "linear"}, {"tangential", "spring_dashpot"}, {"tension", "cut"}, {"mu", 0.44}};
  v.effects = {"normal_damping", "friction", "tangential_spring", "rotation"};
  v.closedEn = 0.3408;
  v.sticking.et0 = stick;
  v.slidingConstant = constant;
  for (int k = 0; k < places; ++k) {
    v.reference.psi.push_back(psiAt(k));
    add(v.reference, QuantityId::en, 0.3408);
    add(v.reference, QuantityId::psiF, after(psiAt(k), stick, constant));
  }
  for (int k = 0; k <= 200; ++k) {
    v.oracle.psi.push_back(0.02 * k);
    add(v.oracle, QuantityId::psiF, after(0.02 * k, stick, constant));
  }
  for (const double steps : {50.0, 200.0, 1000.0}) {
    v.curves.push_back(curve("grain", steps, stick, constant, 12.0 / (steps * steps)));
    v.curves.push_back(curve("yade", steps, stick, constant, 1.2 / steps));
  }
  v.curves.push_back(curve("box2d-impulse", 10.0, stick, constant, 0.03));
  return v;
}

ConvergenceOrder order(const std::string& engine, FittedOrder fit,
                       std::map<std::string, double> errorAt) {
  ConvergenceOrder order{engine, "", "spring, tension cut", std::move(errorAt), {}};
  order.of[QuantityId::psiF] = fit;
  return order;
}

}  // namespace

CollideResults collideResults() {
  CollideResults results{.head = resultsHead("collide", "figure-4-3"), .elapsed = 754.2};
  results.engines = {engineRow("grain", "the in-house engine"),
                     engineRow("yade", "YADE's viscoelastic law"),
                     engineRow("box2d-impulse", "Box2D's own solver"),
                     engineRow("odd-one", awkward, "", Status::failed, "worker hung <120 s>")};
  results.variants = {variant("spring, tension cut", 0.47, 1.770),
                      variant("spring and dashpot", 0.055, 1.770)};
  results.variants[1].sticking.et0.reset();
  CollisionCurve& failed = results.variants[1].curves.emplace_back();
  failed.engine = "odd-one";
  failed.dt = 1e-5;
  failed.status = Status::failed;
  failed.reason = "worker hung <120 s>";
  results.orders = {order("grain", {2.003, 0.012}, {{"4.36e-05", 0.0024}, {"2.18e-06", 6e-6}}),
                    order("yade", {1.01, {}}, {{"4.36e-05", 0.012}})};
  return results;
}

CollideResults manyCollideResults() {
  CollideResults results = collideResults();
  results.engines.pop_back();  // its name alone is a sentence
  const std::vector<EngineRow> engines = results.engines;
  const std::array again = {"-2", "-3"};
  for (const std::string more : again)
    for (EngineRow engine : engines) {
      engine.name += more;
      results.engines.push_back(engine);
    }
  for (CollisionVariant& variant : results.variants) {
    for (CollisionCurve& curve : variant.curves)
      for (const QuantityId id : {QuantityId::en, QuantityId::spinI, QuantityId::duration,
                                  QuantityId::maxOverlap, QuantityId::energyLost})
        curve.score.of[id] = curve.score.of[QuantityId::psiF];
    const std::vector<CollisionCurve> curves = variant.curves;
    for (const std::string more : again)
      for (CollisionCurve curve : curves) {
        curve.engine += more;
        variant.curves.push_back(curve);
      }
  }
  return results;
}

}  // namespace crossgrain::sample
