#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "studies/core/engine_access.hpp"
#include "studies/lockstep/lockstep.hpp"
#include "support/scratch_folder.hpp"
#include "tests/studies/quick_cell.hpp"

namespace crossgrain::test {

/// tests/faults/engine, which shares no line with the in-house engine, changed by these words and
/// compared with its mirror. @param declares  whether it declares what it does otherwise
inline LockstepRow rowOfProgram(const QuickFlow& flow, std::vector<std::string> words,
                                bool declares) {
  words.insert(words.begin(), {CROSSGRAIN_PLANTED, declares ? "declares=1" : "declares=0"});
  EngineEntry entry;
  entry.name = "program";
  entry.command = [=] { return words; };
  const ScratchFolder scratch;
  const auto engine = startAudited(entry, scratch.path, flow.setup.run.timeout);
  return holdAgainstMirror(*engine, entry, flow.setup, flow.states, flow.dt, [](double) {});
}

/// A convention of that program, and the term that lockstep names where it is not declared.
struct OtherConvention {
  const char *word, *term;
};

/// Each is named where it is not declared.
inline void expectNamed(const QuickFlow& flow, const std::vector<OtherConvention>& conventions) {
  for (const OtherConvention& other : conventions) {
    SCOPED_TRACE(other.word);
    const LockstepRow undeclared = rowOfProgram(flow, {other.word}, false);
    EXPECT_NE(undeclared.verdict, Equivalence::sameToRounding);
    ASSERT_TRUE(undeclared.term);
    EXPECT_EQ(undeclared.term->name, other.term);
  }
}

/// Declared it is the mirror to rounding, and alone or with all others; else it is named.
inline void expectDeclaredOrNamed(const QuickFlow& flow,
                                  const std::vector<OtherConvention>& conventions) {
  expectNamed(flow, conventions);
  std::vector<std::string> all;
  for (const OtherConvention& other : conventions) {
    SCOPED_TRACE(other.word);
    all.emplace_back(other.word);
    const LockstepRow declared = rowOfProgram(flow, {other.word}, true);
    EXPECT_EQ(declared.verdict, Equivalence::sameToRounding) << declared.reason;
    EXPECT_EQ(declared.starts, flow.states.size());
  }
  const LockstepRow together = rowOfProgram(flow, all, true);
  EXPECT_EQ(together.verdict, Equivalence::sameToRounding) << together.reason;
}

}  // namespace crossgrain::test
