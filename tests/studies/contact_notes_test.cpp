#include "studies/flow/notes.hpp"

#include <gtest/gtest.h>

namespace crossgrain {
namespace {

FlowRun run(const char* engine, const Numbers& coordination, const Numbers& listed) {
  FlowRun run;
  run.engine = engine;
  run.series = RunSeries{{"coordination", coordination}, {"pairs_listed", listed}};
  return run;
}

FlowStudy studyOf(const std::vector<const char*>& engines) {
  FlowStudy study;
  for (const char* name : engines) study.engines.emplace_back().name = name;
  return study;
}

TEST(ContactNotes, SayWhatTheRuleChanges) {
  FlowStudy study = studyOf({"soft", "rigid", "blind"});
  study.runs = {run("soft", {2.0, 4.0}, {2.0, 4.0}), run("rigid", {1.0, {}}, {2.5, {}}),
                run("rigid", {2.0}, {3.5}), run("blind", {std::nullopt}, {std::nullopt})};
  const auto notes = contactNotes(study);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0],
            "Contacts are pairs that transmit a force. With every pair that an engine lists, the "
            "coordination C (and with it the trace of the fabric, νC) would be: rigid 3 instead of "
            "1.5; no other for soft.");
}

TEST(ContactNotes, AreSilentWithoutContacts) {
  FlowStudy study = studyOf({"blind"});
  study.runs = {run("blind", {std::nullopt}, {std::nullopt})};
  EXPECT_TRUE(contactNotes(study).empty());
}

}  // namespace
}  // namespace crossgrain
