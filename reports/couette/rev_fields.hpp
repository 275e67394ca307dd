#pragma once

#include <array>

namespace crossgrain::reports {

/// The fields of a study of ring widths that are drawn; the CSV file has all.
inline constexpr std::array drawnRevFields = {"volume_fraction", "azimuthal_velocity", "spin",
                                              "fabric_trace",    "stress_rr",          "stress_pr"};

}  // namespace crossgrain::reports
