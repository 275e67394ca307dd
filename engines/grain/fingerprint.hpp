#pragma once

#include <cstdint>

#include "engines/grain/setup.hpp"

namespace grain {

struct SpheresSetup;

/// Of everything in the setup that a trajectory depends on, but for the walls' motion, which is a
/// function: FNV-1a, 64 bits, over the numbers' bytes. Skin, threads and the choice of kernels
/// change no bit of a run and do not count.
std::uint64_t fingerprint(const Setup& setup);
std::uint64_t fingerprint(const SpheresSetup& setup);

}  // namespace grain
