#include "tests/misbehaving/entries.hpp"

namespace crossgrain::test {

EngineEntry misbehavingEntry(const std::string& mischief, std::uint64_t step) {
  EngineEntry entry;
  entry.name = mischief;
  entry.summary = "misbehaves on purpose";
  entry.command = [=] {
    return std::vector<std::string>{CROSSGRAIN_MISBEHAVING, mischief, std::to_string(step)};
  };
  return entry;
}

const std::vector<std::string>& fatalMischiefs() {
  static const std::vector<std::string> all = {"nan", "hang", "exit", "crash", "garbage", "short"};
  return all;
}

}  // namespace crossgrain::test
