#include "runs/conformance/check_list.hpp"

namespace crossgrain::conformance {

std::vector<Check> checksOf(bool isMirror) {
  std::vector<Check> all;
  for (const auto& part : {capabilities::checks(), lifecycle::checks(), free_motion::checks(),
                           collision::checks(), laws::checks(), symmetry::checks(), walls::checks(),
                           contacts::checks(), reach::checks(), refusal::checks()})
    all.insert(all.end(), part.begin(), part.end());
  if (isMirror) {
    const auto more = mirror::checks();
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace crossgrain::conformance
