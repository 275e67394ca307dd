#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oracle/collision_quantities.hpp"

namespace crossgrain::inline results {

/// Something of every quantity that a collision may have.
template <typename T>
class PerQuantity {
 public:
  std::optional<T>& operator[](QuantityId id) { return of_[static_cast<std::size_t>(id)]; }
  const std::optional<T>& operator[](QuantityId id) const {
    return of_[static_cast<std::size_t>(id)];
  }
  void fields(auto& io) {
    for (const CollisionQuantity& quantity : collisionQuantities())
      io.present(quantity.name.data(), (*this)[quantity.id]);
  }

 private:
  std::array<std::optional<T>, quantityCount> of_;
};

/// Collisions, one per row, in the units of CollisionQuantity.
struct CollisionTable {
  std::vector<double> psi;                                  ///< Ψ_i
  std::vector<double> vn;                                   ///< speed of approach [m/s]
  PerQuantity<std::vector<std::optional<double>>> columns;  ///< absent: known of no row
  std::vector<bool> noLimit;  ///< of the oracle: no limit of small time steps; empty: nowhere

  std::size_t size() const { return psi.size(); }
  /// Absent where it is not known of that row.
  std::optional<double> at(QuantityId id, std::size_t row) const {
    const auto& column = columns[id];
    if (!column || row >= column->size()) return std::nullopt;
    const std::optional<double>& value = (*column)[row];
    return value && std::isfinite(*value) ? value : std::nullopt;
  }

  void fields(auto& io) {
    presentUnlessEmpty(io, "psi_i", psi);
    presentUnlessEmpty(io, "v_n", vn);
    columns.fields(io);
    presentUnlessEmpty(io, "limitless", noLimit);
  }

 protected:
  static void presentUnlessEmpty(auto& io, const char* key, auto& list) {
    auto there = list.empty() ? std::nullopt : std::optional(list);
    io.present(key, there);
    if (there) list = std::move(*there);
  }
};

/// What an engine made of a sweep.
struct CollisionPoints : CollisionTable {
  std::vector<std::string> reason;  ///< why there is no reference to judge by; else empty
  std::vector<bool> sticks;         ///< which pairs do not part by the oracle; empty: none

  bool parted(std::size_t row) const { return at(QuantityId::psiF, row).has_value(); }
  bool shouldPart(std::size_t row) const { return row >= sticks.size() || !sticks[row]; }
  /// As files have it: a pair that parted may have no limit to be compared with.
  std::string status(std::size_t row) const {
    if (!parted(row)) return "not parted";
    return row < reason.size() && !reason[row].empty() ? "no limit" : "parted";
  }

  void fields(auto& io) {
    CollisionTable::fields(io);
    std::vector<std::string> words;
    for (std::size_t row = 0; row < size(); ++row) words.push_back(status(row));
    presentUnlessEmpty(io, "status", words);
    presentUnlessEmpty(io, "reason", reason);
    presentUnlessEmpty(io, "sticks", sticks);
  }
};

}  // namespace crossgrain::inline results
