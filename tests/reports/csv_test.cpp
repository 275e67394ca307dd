#include "reports/flow/report.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reports/collide/report.hpp"
#include "reports/common/blocks.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::reports {
namespace {

std::string averageTable(const CompareResults& results, const std::string& name) {
  Report report;
  report.tables = averageTables(results);
  return csvOf(report, name);
}

/// Without the head, which goldens have.
std::string rowsOf(const std::string& table) {
  return table.substr(table.find('\n') + 1);
}

/// Cells that a spreadsheet would compute, or run, are text.
TEST(Csv, Formulas_AreText) {
  EXPECT_EQ(cell(std::string("=cmd|' /C calc'!A1")), "'=cmd|' /C calc'!A1");
  EXPECT_EQ(cell(std::string("@SUM(1,2)")), "\"'@SUM(1,2)\"");
  EXPECT_EQ(cell(std::string("+1+1")), "'+1+1");
  for (const char* plain : {"-", "-1.5e-3", "+", "grain-as-yade"})
    EXPECT_EQ(cell(std::string(plain)), plain);
  EXPECT_EQ(cell(std::optional(-0.5)), "-0.5");
}

TEST(Csv, Distributions_AreRowsOfWhatIsThere) {
  const CompareResults results = fromJson<CompareResults>(nlohmann::json::parse(R"({
    "runs": [{"engine": "one", "packing": 2, "distributions": [
      {"quantity": "spin", "ring": 0, "axes": [{"low": -1, "width": 0.5, "count": 3}],
       "density": [0.25, 0, 1.5], "stderr": [0.125, 0, 0.5], "outside": 0.125, "samples": 8},
      {"quantity": "joint", "ring": null, "samples": 4, "outside": 0,
       "axes": [{"low": 0, "width": 1, "count": 2}, {"low": 10, "width": 2, "count": 1}],
       "density": [0, 0.5], "stderr": []}]}]})"));
  EXPECT_EQ(rowsOf(averageTable(results, "distributions.csv")),
            "one,2,spin,1,-1,-0.5,0.25,0.125,,,within_run\n"
            "one,2,spin,1,0,0.5,1.5,0.5,,,within_run\n"
            "one,2,spin,1,,,0.125,,,,within_run\n"
            "one,2,joint,all,1,2,0.5,,10,12,within_run\n");
}

TEST(Csv, Endpoints_HaveTheAnswerAndWhatItRestsOn) {
  CompareResults results;
  EndpointRow& row = results.endpoints.rows.emplace_back();
  row.a = "one";
  row.b = "two";
  row.endpoint = "pressure";
  row.unit = "N/m²";
  row.margin = 0.25;
  row.marginRelative = true;
  // Without a reference a quarter of it is unknown: the fraction stands.
  EXPECT_EQ(rowsOf(endpointsCsv(results)),
            "one,two,peer,pressure,N/m²,0.25,undecided,,,,,,,,0,0,,,,,,,,,,,,,,,\n");
  row.reference = 200.0;
  row.referenceHalf = 12.0;
  row.valueHalf = 14.0;
  row.verdict = Verdict::pass;
  row.difference = 20.0;
  row.distance = 0.4;
  row.look = 2;
  row.packings = 15;
  row.lost = 1;
  row.reason = "why one is lost";
  row.surrogateB = "mirror";
  row.bound = 0.01;
  row.reach = 0.002;
  results.regimes = {{"one", "two", PairKind::peer, 4, {1, 3}}};
  EXPECT_EQ(rowsOf(endpointsCsv(results)),
            "one,two,peer,pressure,N/m²,50,small_difference,20,,,0.4,,,2,15,1,,,,mirror,"
            "0.01,2,200,why one is lost,0.002,paired,,,12,220,14\n");
  row.unpaired = {Basis::oneScatter, 15, 1};
  EXPECT_TRUE(endpointsCsv(results).ends_with(",0.002,one_scatter,15,1,12,220,14\n"));
}

TEST(Csv, SweepWithoutPoints_IsOneRowWithItsStatus) {
  CollisionVariant variant;
  variant.variant = "soft, cut";
  variant.reference.psi = {0.5};
  variant.reference.columns[QuantityId::en] = {0.5};
  variant.reference.columns[QuantityId::psiF] = {std::nullopt};
  variant.reference.columns[QuantityId::duration] = {2e-3};
  variant.reference.columns[QuantityId::lostStored] = {1e-9};
  CollisionCurve& one = variant.curves.emplace_back();
  one.engine = "one";
  one.dt = 2e-5;
  one.points.psi = {0.5};
  one.points.vn = {1e-4};
  one.points.columns[QuantityId::en] = {0.25};
  one.points.columns[QuantityId::psiF] = {-0.125};
  one.points.columns[QuantityId::beta] = {0.25};
  one.points.columns[QuantityId::lostStiffening] = {-2e-9};
  one.points.reason = {"it jumps"};
  one.score.verdict = Verdict::fail;
  one.declared.emplace().score.verdict = Verdict::pass;
  one.ownScheme.emplace().position = 1e-14;
  one.ownScheme->velocity = 2e-14;
  CollisionCurve& two = variant.curves.emplace_back();
  two.engine = "two";
  two.dt = NAN;
  two.status = Status::failed;
  two.reason = "it hung";
  CollideResults results;
  results.head.setup.name = "walton";
  results.variants = {variant};
  EXPECT_EQ(rowsOf(csvOf(reportOf(results), "collisions.csv")),
            "one,walton,\"soft, cut\",0.5,0.0001,0.25,-0.125,0.5,,2e-05,no limit,"
            "0.25,,,,,,,,,,,,,0.002,,,,,,,,,,,,,,1e-09,,,-2e-09,,it jumps,"
            "model difference,fell short,held,2e-14\n"
            "two,walton,\"soft, cut\",,,,,,,,failed,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,it hung,"
            "failed,,,\n");
}

}  // namespace
}  // namespace crossgrain::reports
