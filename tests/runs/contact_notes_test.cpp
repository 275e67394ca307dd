#include "runs/couette/contact_notes.hpp"

#include <gtest/gtest.h>

namespace {

using nlohmann::json;

json run(const char* engine, const json& coordination, const json& listed) {
  return {{"engine", engine},
          {"status", "finished"},
          {"series", {{"coordination", coordination}, {"pairs_listed", listed}}}};
}

TEST(ContactNotes, SayWhatTheRuleChanges) {
  json results;
  for (const char* name : {"soft", "rigid", "blind"})
    results["engines"].push_back({{"name", name}});
  results["runs"] = {run("soft", {2.0, 4.0}, {2.0, 4.0}),
                     run("rigid", {1.0, nullptr}, {2.5, nullptr}), run("rigid", {2.0}, {3.5}),
                     run("blind", {nullptr}, {nullptr})};
  const json notes = crossgrain::contactNotes(results);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0],
            "Contacts are pairs that transmit a force. With every pair that an engine lists, the "
            "coordination C (and with it the trace of the fabric, νC) would be: rigid 3 instead of "
            "1.5; no other for soft.");
}

TEST(ContactNotes, AreSilentWithoutContacts) {
  json results;
  results["engines"].push_back({{"name", "blind"}});
  results["runs"] = {run("blind", {nullptr}, {nullptr})};
  EXPECT_TRUE(crossgrain::contactNotes(results).empty());
}

}  // namespace
