#pragma once

// Coefficients of each two bodies of an engine of rigid contacts, and their report.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <map>
#include <vector>

#include "crossgrain_rigid_law.hpp"

namespace crossgrain_worker {

class RigidPairs {
 public:
  RigidPairs() = default;
  /// @param mass    of the disks [kg]
  /// @param radius  of disks, then of wall disks; later ids are planes [m]
  /// @throws Unsupported where a pair has no restitution: asked in a step, a refusal would pass
  ///         through the engine's callbacks
  RigidPairs(RigidLaw law, std::vector<double> mass, std::vector<double> radius)
      : law_(std::move(law)), mass_(std::move(mass)), radius_(std::move(radius)) {
    requireRestitution();
  }

  double restitution(std::int32_t i, std::int32_t j) {
    const double inverse = inverseMass(i) + inverseMass(j);
    const auto [known, isNew] = restitution_.try_emplace(inverse);
    if (isNew) known->second = law_.restitution(inverse);
    return known->second;
  }

  /// µ_r L [m].
  double rolling(std::int32_t i, std::int32_t j) const {
    const auto [least, most] = std::minmax({radius(i), radius(j)});
    return law_.rolling() * law_.rollingLength(least, most);
  }

  /// Coefficients of pairs of the first few kinds of disks, to be reported after load.
  Json table(bool walls, bool rolls) const {
    std::map<double, double> kinds;  // mass → radius
    for (std::size_t i = 0; i < mass_.size() && kinds.size() < 4; ++i)
      kinds.emplace(mass_[i], radius_[i]);
    Json pairs = Json::array();
    const auto add = [&](double radius, const std::string& other, double inverse) {
      char name[80];
      std::snprintf(name, sizeof name, "%.3g mm with %s", 1e3 * radius, other.c_str());
      pairs.push_back({{"pair", name}, {"en", law_.restitution(inverse)}});
      if (law_.friction() > 0.0) pairs.back().update({{"mu", law_.friction()}, {"et0", 0.0}});
      if (rolls) pairs.back()["mu_r"] = law_.rolling();
    };
    for (auto one = kinds.begin(); one != kinds.end(); ++one) {
      for (auto two = one; two != kinds.end(); ++two) {
        char other[40];
        std::snprintf(other, sizeof other, "%.3g mm", 1e3 * two->second);
        add(one->second, other, 1.0 / one->first + 1.0 / two->first);
      }
      if (walls) add(one->second, "wall", 1.0 / one->first);
    }
    return pairs;
  }

  /// Deviations of rigid contacts from a soft law, to be reported after load.
  Json deviations() const {
    Json list = Json::array();
    if (!law_.soft() || mass_.empty()) return list;
    list.push_back({{"name", "normal"},
                    {"value", table(false, false).front().at("en")},
                    {"unit", "-"},
                    {"note", "rigid contacts with the soft law's e_n for each pair"}});
    if (law_.friction() > 0.0)
      list.push_back({{"name", "e_t0"},
                      {"value", 0.0},
                      {"unit", "-"},
                      {"note", "contacts that stick give back nothing of the tangential speed"}});
    return list;
  }

 private:
  double inverseMass(std::int32_t id) const {
    const auto k = static_cast<std::size_t>(id);
    return k < mass_.size() ? 1.0 / mass_[k] : 0.0;
  }

  double radius(std::int32_t id) const {
    const auto k = static_cast<std::size_t>(id);
    return k < radius_.size() ? radius_[k] : std::numeric_limits<double>::infinity();
  }

  /// The law is overdamped where γ_n² (1/m₁ + 1/m₂) ≥ 4 k_n, so the lightest pair decides for all.
  void requireRestitution() const {
    if (mass_.empty()) return;
    std::vector<double> lightest(mass_);
    const auto second = lightest.begin() + std::min<long>(1, static_cast<long>(mass_.size()) - 1);
    std::nth_element(lightest.begin(), second, lightest.end());
    const double least = *std::min_element(lightest.begin(), lightest.end());
    law_.restitution(1.0 / least + (mass_.size() > 1 ? 1.0 / *second : 0.0));
  }

  RigidLaw law_;
  std::vector<double> mass_, radius_;
  std::map<double, double> restitution_;  ///< by 1/m₁₂ [1/kg]
};

}  // namespace crossgrain_worker
