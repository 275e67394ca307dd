#include <fmt/format.h>

#include <algorithm>

#include "reports/collide/report.hpp"
#include "reports/collide/table.hpp"
#include "reports/common/csv_row.hpp"
#include "reports/common/numbers.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::reports {

namespace {

/// What stands in columns of its own beyond the restitutions.
std::vector<const CollisionQuantity*> furtherQuantities() {
  std::vector<const CollisionQuantity*> further;
  for (const CollisionQuantity& quantity : collisionQuantities())
    if (quantity.csvPlace > 0) further.push_back(&quantity);
  std::ranges::sort(further, {}, &CollisionQuantity::csvPlace);
  return further;
}

std::string furtherColumns() {
  std::string columns;
  for (const CollisionQuantity* quantity : furtherQuantities()) {
    std::string unit(quantity->unit);
    std::ranges::replace(unit, '/', '_');
    if (!unit.empty()) unit = "_" + unit;
    columns += fmt::format(",{0}{1},{0}_reference{1}", quantity->name, unit);
  }
  return columns;
}

std::string furtherCells(const CollisionTable& points, const CollisionTable& reference,
                         std::size_t k) {
  std::string cells;
  for (const CollisionQuantity* quantity : furtherQuantities())
    for (const CollisionTable* table : {&points, &reference})
      cells += "," + cell(table->at(quantity->id, k));
  return cells;
}

/// The first cells of all rows of a curve, and the last ones.
struct RowHead {
  const std::string &engine, &name, &variant;
  std::optional<double> dt;
  std::string verdicts;
};

/// Of the whole curve: how it came out; against the scene's law, the one that its engine declares,
/// and its own scheme.
std::string verdictCells(const CollisionCurve& curve) {
  const bool ran = curve.points.size() > 0;
  std::string cells = row(
      std::string(nameOf(outcomeOf(curve))), std::string(ran ? nameOf(curve.score.verdict) : ""),
      std::string(ran ? nameOf(declaredScore(curve).verdict) : ""), ownDeviation(curve));
  cells.pop_back();
  return cells;
}

std::string rowOf(const RowHead& head, const CollisionTable& points,
                  const CollisionTable& reference, std::size_t k, const std::string& status,
                  const std::string& reason) {
  std::string line =
      row(head.engine, head.name, head.variant, numberAt(points.psi, k), numberAt(points.vn, k),
          points.at(QuantityId::en, k), points.at(QuantityId::psiF, k),
          reference.at(QuantityId::en, k), reference.at(QuantityId::psiF, k), head.dt, status);
  line.pop_back();
  return line + furtherCells(points, reference, k) + "," + cell(reason) + "," + head.verdicts +
         "\n";
}

}  // namespace

std::string collisionsCsv(const CollideResults& results) {
  std::string table =
      "engine,case,variant,psi_i,v_n,e_n,psi_f,e_n_reference,psi_f_reference,dt_s,status" +
      furtherColumns() + ",reason,outcome,verdict_scene,verdict_declared,own_scheme\n";
  for (const CollisionVariant& variant : results.variants) {
    const std::string name = caseOf(results, variant);
    for (const CollisionCurve& curve : variant.curves) {
      const RowHead head{curve.engine, name, variant.variant, finite(curve.dt),
                         verdictCells(curve)};
      const CollisionPoints& points = curve.points;
      for (std::size_t k = 0; k < points.size(); ++k)
        table += rowOf(head, points, variant.reference, k,
                       std::string(k < points.status.size() ? nameOf(points.status[k]) : ""),
                       k < points.reason.size() ? points.reason[k] : "");
      if (points.size() == 0)
        table += rowOf(head, {}, {}, 0, std::string(nameOf(curve.status)), curve.reason);
    }
  }
  return table;
}

}  // namespace crossgrain::reports
