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

/// Stream `index` of a seed: all streams of all seeds are independent of each other, and the same
/// on every machine. Stream 0 is seededRandom(seed); the others are 64-bit Mersenne twisters whose
/// whole state comes from both numbers by std::seed_seq (C++ standard, [rand.util.seedseq]).
Random randomStream(std::uint64_t seed, std::uint64_t index);

}  // namespace crossgrain::inline support
