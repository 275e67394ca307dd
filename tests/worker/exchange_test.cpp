#include "adapters/worker/exchange.hpp"

#include <gtest/gtest.h>

#include "adapters/worker/arrays.hpp"
#include "adapters/worker/exchange_difference.hpp"
#include "support/bad_input.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain {
namespace {

class Exchanges : public ::testing::Test {
 protected:
  ScratchFolder scratch_;
  std::filesystem::path file_ = scratch_.path / "run.rec";

  /// An answer to snapshot with two contacts, of 0 and 1 and of 2 and 3, listed in that order or
  /// not.
  Exchange snapshot(double force, bool swapped = false) const {
    Exchange exchange;
    exchange.request = {{"request", "snapshot"}, {"file", "/tmp/of-that-run"}};
    ArrayWriter arrays;
    const auto listed = [&](auto a, auto b) {
      return swapped ? std::vector{b, a} : std::vector{a, b};
    };
    arrays.add("contacts.i", listed(std::int32_t{0}, std::int32_t{2}));
    arrays.add("contacts.j", listed(std::int32_t{1}, std::int32_t{3}));
    arrays.add("contacts.normal", listed(Vec2{1.0, 0.0}, Vec2{0.6, 0.8}));
    arrays.add("contacts.normal_force", listed(force, 4.0));
    const std::filesystem::path file = scratch_.path / "arrays.bin";
    exchange.answer = {{"ok", true}, {"seconds", force}, {"arrays", arrays.write(file)}};
    exchange.received = keptContent(file);
    return exchange;
  }

  std::vector<AnswerDifference> differences(const Exchange& then, const Exchange& now,
                                            double tolerance = 0.0) const {
    return answerDifferences(then, now, tolerance, scratch_.path);
  }

  void record() const {
    ExchangeWriter writer(file_, {{"engine", "toy"}});
    writer.write(snapshot(1.0));
    Exchange failed;
    failed.request = {{"request", "advance"}, {"time", 0.1}};
    failed.failure = "toy: ended";
    writer.write(failed);
  }
};

TEST_F(Exchanges, ComeBackAsTheyWere) {
  record();
  ExchangeReader reader(file_);
  EXPECT_EQ(reader.head()["engine"], "toy");
  const auto first = reader.next(), second = reader.next();
  ASSERT_TRUE(first && second);
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(first->answer, snapshot(1.0).answer);
  EXPECT_EQ(first->received, snapshot(1.0).received);
  EXPECT_FALSE(first->request.contains("file"));
  EXPECT_TRUE(second->answer.is_null());
  EXPECT_EQ(second->failure, "toy: ended");
}

TEST_F(Exchanges, CutOffAnywhereAreBadInput) {
  record();
  int complete = 0;
  for (auto kept = std::filesystem::file_size(file_); kept-- > 0;) {
    std::filesystem::resize_file(file_, kept);
    try {
      ExchangeReader reader(file_);
      while (reader.next()) {
      }
      ++complete;
    } catch (const BadInput&) {
      // That is how it is to end.
    }
  }
  // Between exchanges, and where only the end of a line is missing, nothing shows that more was to
  // come.
  EXPECT_EQ(complete, 5);
}

TEST_F(Exchanges, DifferWhereTheirNumbersDo) {
  EXPECT_TRUE(differences(snapshot(1.0), snapshot(1.0)).empty());
  const auto found = differences(snapshot(1.0), snapshot(1.25));
  ASSERT_EQ(found.size(), 1u);  // seconds are not compared
  EXPECT_EQ(found[0].field, "contacts.normal_force");
  EXPECT_EQ(found[0].place, " of 0 with 1");
  EXPECT_EQ(found[0].off, 0.25);
  EXPECT_EQ(found[0].differ, 1u);
  EXPECT_EQ(found[0].of, 2u);
  // Against the largest of the array, 4.
  EXPECT_TRUE(differences(snapshot(1.0), snapshot(1.25), 0.0626).empty());
  EXPECT_FALSE(differences(snapshot(1.0), snapshot(1.25), 0.0624).empty());
}

TEST_F(Exchanges, DoNotDifferByTheOrderOfContacts) {
  EXPECT_TRUE(differences(snapshot(1.0), snapshot(1.0, true)).empty());
  EXPECT_EQ(differences(snapshot(1.0), snapshot(2.0, true)).at(0).place, " of 0 with 1");
}

TEST_F(Exchanges, WithAndWithoutAnAnswerDiffer) {
  Exchange none = snapshot(1.0);
  none.answer = nullptr;
  none.failure = "toy: ended";
  EXPECT_EQ(differences(none, snapshot(1.0)).at(0).then, "toy: ended");
  EXPECT_EQ(differences(snapshot(1.0), none).at(0).now, "toy: ended");
  EXPECT_TRUE(differences(none, none).empty());
}

TEST_F(Exchanges, WithArraysThatDoNotFitSaySo) {
  Exchange broken = snapshot(1.0);
  broken.received.resize(8);
  const auto found = differences(snapshot(1.0), broken);
  ASSERT_FALSE(found.empty());
  EXPECT_NE(found[0].now.find("is too short"), std::string::npos);
}

}  // namespace
}  // namespace crossgrain
