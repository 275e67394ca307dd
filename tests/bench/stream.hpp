#pragma once

namespace crossgrain::bench {

/// What memory gives to the loop a[i] = b[i] + s c[i] (triad; McCalpin 1995) on arrays of 128 MiB,
/// far beyond the caches, counted as there: 24 bytes an element, without the read that a write
/// brings about. The best of some passes [byte/s]. Measured once per number of threads.
double streamBandwidth(int threads);

}  // namespace crossgrain::bench
