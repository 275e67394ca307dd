#pragma once

#include <gsl/gsl_rng.h>

#include <cstdint>
#include <memory>

namespace crossgrain::inline support {

using Random = std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)>;

/// The same numbers for the same seed on every machine (Mersenne twister).
inline Random seededRandom(std::uint64_t seed) {
  Random random(gsl_rng_alloc(gsl_rng_mt19937), &gsl_rng_free);
  gsl_rng_set(random.get(), seed);
  return random;
}

}  // namespace crossgrain::inline support
