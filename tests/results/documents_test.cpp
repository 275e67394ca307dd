// Results of every kind as documents and back. The names of members are in tests/golden.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "averaging/fields.hpp"
#include "cases/endpoints.hpp"
#include "results/collision.hpp"
#include "results/run.hpp"
#include "results/schema.hpp"
#include "stability/measures.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/refusal.hpp"

namespace crossgrain::inline results {
namespace {

using Reread = std::function<Json(const Json&)>;  ///< a document → results → a document

struct Document {
  Json json;
  Reread reread;
};

template <typename Results>
Document documentOf(const Results& results, Results (*read)(const Json&)) {
  return {toJson(results), [read](const Json& json) { return toJson(read(json)); }};
}

std::map<std::string, Document> madeUp() {
  CompareResults compared = sample::compareResults(4, 30);
  compared.packings.front().seed = std::numeric_limits<std::uint64_t>::max();
  return {{"compare", documentOf(compared, fromJson<CompareResults>)},
          {"average", documentOf(sample::averageResults(), fromJson<CompareResults>)},
          {"rev", documentOf(sample::revResults(), fromJson<RevResults>)},
          {"collide", documentOf(sample::manyCollideResults(), fromJson<CollideResults>)},
          {"effects", documentOf(sample::effectsResults(4), fromJson<EffectsResults>)},
          {"stability", documentOf(sample::stabilityResults(), fromJson<StabilityResults>)},
          {"lockstep", documentOf(sample::lockstepResults(), fromJson<LockstepResults>)},
          {"cost", documentOf(sample::costResults(), fromJson<CostResults>)}};
}

const std::map<std::string, Document>& documents() {
  static const std::map<std::string, Document> all = madeUp();
  return all;
}

TEST(ResultsDocument, EveryKind_ReadAndWrittenAgain_IsTheSameText) {
  for (const auto& [kind, document] : documents()) {
    SCOPED_TRACE(kind);
    const std::string text = document.json.dump();
    EXPECT_GT(text.size(), 500u);
    EXPECT_EQ(document.reread(Json::parse(text)).dump(), text);
  }
}

TEST(ResultsDocument, MembersMissing_AreDefaults) {
  for (const auto& [kind, document] : documents()) {
    SCOPED_TRACE(kind);
    const Json little = {{"schema", "crossgrain-results-1"}, {"kind", kind}};
    const auto read = [&] { return document.reread(little); };
    if (kind == "compare")  // there is no reference engine
      EXPECT_THROW(read(), FieldError);
    else
      EXPECT_EQ(document.reread(read()), read());
  }
}

TEST(ResultsDocument, MemberOfAnotherType_ThrowsWithItsPath) {
  struct Wrong {
    const char *kind, *member;
    Json value;
    std::string message;
  };
  for (const Wrong& wrong :
       {Wrong{"compare", "/runs/0/profiles/0/mean", "no list",
              "runs.0.profiles.0.mean: is string, not a list"},
        Wrong{"cost", "/points/1/wall_s", "long", "points.1.wall_s: is string, not a number"},
        Wrong{"cost", "/points/1/knob", "effect:fric tion", "points.1.knob: "},
        Wrong{"lockstep", "/lockstep/rows/0/kinds/new", "many", "lockstep.rows.0.kinds.new: "},
        Wrong{"stability", "/runs/0/verdict", "fine", "runs.0.verdict: is \"fine\", not one of"}}) {
    Document document = documents().at(wrong.kind);
    document.json.at(Json::json_pointer(wrong.member)) = wrong.value;
    const std::string said = test::refusalOf<FieldError>([&] { document.reread(document.json); });
    EXPECT_TRUE(said.starts_with(wrong.message)) << said;
  }
}

TEST(FlowRunDocument, NotFinished_HoldsItsReasonAlone) {
  FlowRun run{.engine = "one", .status = Status::failed, .reason = "died"};
  run.profiles.resize(1);
  EXPECT_EQ(toJson(run),
            Json({{"engine", "one"}, {"packing", 0}, {"status", "failed"}, {"reason", "died"}}));
}

TEST(FlowRunDocument, WithoutSeries_HasNeitherDistributionsNorPicture) {
  FlowRun run;
  run.without = "friction";
  run.effective.emplace();
  run.distributions.resize(1);
  const Json bare = toJson(run);
  for (const char* bulky : {"series", "distributions", "picture"})
    EXPECT_FALSE(bare.contains(bulky)) << bulky;
  EXPECT_EQ(fromJson<FlowRun>(bare).without, "friction");
  run.series.emplace();
  EXPECT_TRUE(toJson(run).at("picture").is_null());  // of a packing without one
  run.effective.reset();                             // snapshots of a file: nothing was run
  EXPECT_FALSE(toJson(run).contains("picture"));
  EXPECT_TRUE(toJson(run).contains("series"));
}

TEST(Profiles, OfSeveralMethods_AreFoundByFieldAndMethod) {
  std::vector<Profile> profiles(2);
  profiles[0].method = "slicing";
  profiles[1].method = "centre";
  profiles[0].field = profiles[1].field = "spin";
  EXPECT_EQ(profileOf(profiles, "spin"), &profiles[0]);
  EXPECT_EQ(profileOf(profiles, "centre", "spin"), &profiles[1]);
  EXPECT_EQ(profileOf(profiles, "velocity"), nullptr);
}

TEST(CollisionTable, ValueMissingOrNotFinite_IsAbsent) {
  CollisionTable table;
  table.columns[QuantityId::en] = {0.5, NAN};
  EXPECT_EQ(table.at(QuantityId::en, 0), 0.5);
  EXPECT_FALSE(table.at(QuantityId::en, 1));
  EXPECT_FALSE(table.at(QuantityId::en, 2));
  EXPECT_FALSE(table.at(QuantityId::beta, 0));
}

TEST(CostPoint, Scheme_IsThatOfTheIntegratorNamed) {
  EXPECT_EQ(schemeOf("time_step", "t_c/50"), "");
  EXPECT_EQ(schemeOf("integrator", "velocity_verlet, t_c/50"), "velocity_verlet");
  EXPECT_FALSE(schemeOf("integrator", "velocity_verlet"));
  EXPECT_FALSE(schemeOf("precision", "float"));
}

TEST(CostPoint, OwnMeasure_IsPairedWithTheScenes) {
  EXPECT_EQ(ownOf("psi_f"), "psi_f_own");
  EXPECT_EQ(withoutOwn("psi_f_own"), "psi_f");
  EXPECT_TRUE(isOwn("position_rms_own"));
  EXPECT_EQ(withoutOwn("position_rms_own"), "position_rms_own");
}

/// Names and units of the program's tables can be read back from its files.
TEST(Documents, UnitsAndNamesOfAllTablesAreReadBack) {
  const auto readable = [](std::string_view name, std::string_view unit) {
    EXPECT_TRUE(isUnit(unit)) << name << ": " << unit;
  };
  for (const StabilityMeasure& each : stabilityMeasures()) readable(each.name, each.unit);
  for (const FieldSpec& each : fieldsIn(2, true)) readable(each.name, each.unit);
  for (const Endpoint& each : endpointTable()) readable(each.name, each.unit);
}

}  // namespace
}  // namespace crossgrain::inline results
