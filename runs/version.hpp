#pragma once

namespace crossgrain {

inline constexpr const char* programVersion = CROSSGRAIN_VERSION;

}  // namespace crossgrain
