#include "reports/common/csv.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "reports/collide/table.hpp"
#include "reports/common/csv_row.hpp"

namespace crossgrain::reports {

namespace {

/// Quantities of a collision beyond the restitutions, as in results.json, and their units.
constexpr std::array<std::pair<const char*, const char*>, 16> furtherQuantities = {{
    {"beta", ""},
    {"centre_psi_f", ""},
    {"e_t", ""},
    {"rebound_angle", "_rad"},
    {"spin_i", "_rad_s"},
    {"spin_j", "_rad_s"},
    {"duration", "_s"},
    {"max_overlap", "_m"},
    {"energy_before", "_J"},
    {"energy_after", "_J"},
    {"lost_normal_damping", "_J"},
    {"lost_tangential_damping", "_J"},
    {"lost_sliding", "_J"},
    {"lost_stored", "_J"},
    {"lost_tangential", "_J"},
    {"lost_stiffening", "_J"},
}};

std::string furtherColumns() {
  std::string columns;
  for (const auto& [name, unit] : furtherQuantities)
    columns += fmt::format(",{0}{1},{0}_reference{1}", name, unit);
  return columns;
}

std::string furtherCells(const Json& points, const Json& reference, std::size_t k) {
  std::string cells;
  for (const auto& [name, unit] : furtherQuantities)
    for (const Json* table : {&points, &reference}) cells += "," + cell(at(*table, name, k));
  return cells;
}

}  // namespace

std::string collisionsCsv(const Json& results) {
  std::string table =
      "engine,case,variant,psi_i,v_n,e_n,psi_f,e_n_reference,psi_f_reference,dt_s,status" +
      furtherColumns() + ",reason\n";
  for (const Json& variant : list(results, "variants")) {
    const std::string name = caseOf(results, variant);
    const std::string label = text(variant, "variant");
    const Json& reference = member(variant, "reference");
    for (const Json& curve : list(variant, "curves")) {
      const Json& points = member(curve, "points");
      const auto add = [&](std::size_t k, const Json& expected, const std::string& status,
                           const std::string& reason) {
        std::string line =
            row(text(curve, "engine"), name, label, at(points, "psi_i", k), at(points, "v_n", k),
                at(points, "e_n", k), at(points, "psi_f", k), at(expected, "e_n", k),
                at(expected, "psi_f", k), number(curve, "dt"), status);
        line.pop_back();
        table += line + furtherCells(points, expected, k) + "," + cell(reason) + "\n";
      };
      const auto wordAt = [&](const char* column, std::size_t k) {
        const Json& word = element(list(points, column), k);
        return word.is_string() ? word.get<std::string>() : std::string();
      };
      for (std::size_t k = 0; k < rowCount(points); ++k)
        add(k, reference, wordAt("status", k), wordAt("reason", k));
      if (rowCount(points) == 0) add(0, Json(), text(curve, "status"), text(curve, "reason"));
    }
  }
  return table;
}

}  // namespace crossgrain::reports
