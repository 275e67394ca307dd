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
};

/// How one pair of a sweep ended.
enum class PairStatus {
  parted,
  notParted,
  noLimit  ///< parted, but there is no reference to judge by: `reason` says why
};
constexpr auto namesOf(PairStatus) {
  return std::array<std::string_view, 3>{"parted", "not parted", "no limit"};
}

/// What an engine made of a sweep.
struct CollisionPoints : CollisionTable {
  std::vector<PairStatus> status;
  std::vector<std::string> reason;  ///< why there is no reference; else empty
};

}  // namespace crossgrain::inline results
