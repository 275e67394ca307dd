#pragma once

#include <array>
#include <string>
#include <string_view>

namespace crossgrain::inline cases {

/// Of which error `crossgrain cost` measures the price; the three are never mixed.
enum class CostKind {
  collision,   ///< two disks against the oracle
  trajectory,  ///< a packing's path against a run at a much smaller step
  averages     ///< of the sheared cell against a reference on the same packings
};
constexpr auto namesOf(CostKind) {
  return std::array<std::string_view, 3>{"collision", "trajectory", "averages"};
}
inline constexpr std::array costKinds = {CostKind::collision, CostKind::trajectory,
                                         CostKind::averages};

inline std::string toString(CostKind kind) {
  return std::string(namesOf(kind)[static_cast<std::size_t>(kind)]);
}

}  // namespace crossgrain::inline cases
