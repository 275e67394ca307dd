#include "support/random.hpp"

#include <algorithm>
#include <new>
#include <random>

namespace crossgrain::inline support {

namespace {

using Twister = std::mt19937_64;

/// The generator that GSL's distributions draw from. GSL's own generators take 32 bits of seed at
/// most.
const gsl_rng_type twister = {
    "mt19937_64",
    Twister::max(),
    Twister::min(),
    sizeof(Twister),
    [](void* state, unsigned long seed) { new (state) Twister(seed); },
    [](void* state) -> unsigned long { return (*static_cast<Twister*>(state))(); },
    [](void* state) {
      return static_cast<double>((*static_cast<Twister*>(state))() >> 11) * 0x1p-53;
    }};

}  // namespace

Random randomStream(std::uint64_t seed, std::uint64_t index) {
  if (index == 0) return seededRandom(seed);
  const auto low = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
  std::seed_seq words{low(seed), low(seed >> 32), low(index), low(index >> 32)};
  Random random(gsl_rng_alloc(&twister), &gsl_rng_free);
  new (random->state) Twister(words);
  return random;
}

}  // namespace crossgrain::inline support
