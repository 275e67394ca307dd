#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace grain {

/// Steps between two renumberings of the bodies by place. A fixed number, as it decides in which
/// order forces are summed up.
inline constexpr std::uint64_t renumberingInterval = 8192;

/// The first elements of the array by their order: array[k] becomes what was array[order[k]].
/// @param scratch  room, kept from call to call
template <class Array>
void reorder(Array& array, std::span<const std::int32_t> order, std::vector<std::byte>& scratch) {
  using Element = typename Array::value_type;
  static_assert(std::is_trivially_copyable_v<Element>);
  if (order.empty()) return;
  scratch.resize(order.size() * sizeof(Element));
  std::memcpy(scratch.data(), array.data(), scratch.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    std::memcpy(&array[k], &scratch[static_cast<std::size_t>(order[k]) * sizeof(Element)],
                sizeof(Element));
}

}  // namespace grain
