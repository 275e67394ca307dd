#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "adapters/registry.hpp"

namespace crossgrain::test {

/// An engine that does as the in-house one does up to a step and misbehaves from there on, for
/// lists of engines in tests: a worker program like a user's own, named after its mischief.
///
/// "pump"      its disks get faster, by 1 % of their velocity a step
/// "nan"       a disk's position is not a number
/// "hang"      does not come back
/// "exit"      ends with status 3
/// "crash"     aborts
/// "garbage"   answers what is no JSON
/// "short"     shows one disk too few
/// "slippery"  loses 98 % of the friction, and its springs
/// "worn"      loses 30 % of the friction, and nothing else
///
/// Others misbehave from the start, each in one thing that is declared:
///
/// "no-checkpoints"    has none
/// "forgetful"         its checkpoints do not hold the springs of contacts; "checkpoints" do
/// "hertz-radius"      its law of Hertz lacks √R₁₂ (of the first pair, in SI units)
/// "impulse-planes"    impulses restore 0.8 e_n where there are planes
/// "impulse-sizes"     the same where disks are of several sizes
inline EngineEntry misbehavingEntry(const std::string& mischief, std::uint64_t step) {
  EngineEntry entry;
  entry.name = mischief;
  entry.summary = "misbehaves on purpose";
  entry.command = [=] {
    return std::vector<std::string>{CROSSGRAIN_MISBEHAVING, mischief, std::to_string(step)};
  };
  return entry;
}

/// Those that end a run; the others go on as if nothing were.
inline const std::vector<std::string>& fatalMischiefs() {
  static const std::vector<std::string> all = {"nan", "hang", "exit", "crash", "garbage", "short"};
  return all;
}

}  // namespace crossgrain::test
