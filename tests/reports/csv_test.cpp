#include "reports/flow/report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reports/collide/report.hpp"
#include "reports/common/blocks.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::reports {
namespace {

/// A comparison small enough to write its tables down by hand.
CompareResults tiny() {
  CompareResults results = compareFromJson(nlohmann::json::parse(R"({
    "kind": "compare", "engines": [{"name": "one"}],
    "rings": {"r": [0.1, 0.2], "r_tilde": [0.5, 1.5]},
    "runs": [
      {"engine": "one", "packing": 0,
       "profiles": [{"method": "slicing", "field": "spin", "unit": "rad/s",
                     "mean": [0.1, null], "stderr": [1e-30, null], "n_eff": [12.5, null],
                     "dof": [7, null]}],
       "series": {"t_s": [0.0, 0.25], "wheel_torque": [null, 2e-3], "kinetic_energy": [1, 2],
                  "zz_extra": [7, 8]}},
      {"engine": "other", "packing": 1, "profiles": [], "series": {}}],
    "ensemble": [
      {"engine": "one", "profiles": [{"method": "slicing", "field": "spin", "unit": "rad/s",
                                      "mean": [0.30000000000000004, 2]}]}],
    "agreement": [
      {"a": "one", "b": "two", "field": "spin", "verdict": "undecided",
       "detects": 0.75, "rings": [{"ring": 0, "difference": -0.5, "stderr": 0.1, "low": -0.7, "high": -0.3,
                  "margin": 0.56, "verdict": "agree", "detects": 0.75, "within_share": 0.5,
                  "packings": 4},
                 {"ring": 1, "difference": 0.25, "stderr": null, "low": null, "high": null,
                  "margin": 0.56, "verdict": "undecided"}]}]})"));
  results.runs[1].engine = "a,\"b\"";
  return results;
}

std::string averageTable(const CompareResults& results, const std::string& name) {
  Report report;
  report.tables = averageTables(results);
  return csvOf(report, name);
}

/// What a spreadsheet would compute, or run, is text.
TEST(Csv, Formulas_AreText) {
  EXPECT_EQ(cell(std::string("=cmd|' /C calc'!A1")), "'=cmd|' /C calc'!A1");
  EXPECT_EQ(cell(std::string("@SUM(1,2)")), "\"'@SUM(1,2)\"");
  EXPECT_EQ(cell(std::string("+1+1")), "'+1+1");
  for (const char* plain : {"-", "-1.5e-3", "+", "grain-as-yade"})
    EXPECT_EQ(cell(std::string(plain)), plain);
  EXPECT_EQ(cell(std::optional(-0.5)), "-0.5");
}

TEST(Csv, Profiles_CountRingsFromOneAndLeaveAbsentCellsEmpty) {
  EXPECT_EQ(averageTable(tiny(), "profiles.csv"),
            "engine,packing,method,field,ring,r_m,r_tilde,mean,stderr,n_eff,unit,stderr_kind,dof,"
            "from_rotation,to_rotation,prepared_rotations\n"
            "one,0,slicing,spin,1,0.1,0.5,0.1,1e-30,12.5,rad/s,within_run,7,,,\n"
            "one,0,slicing,spin,2,0.2,1.5,,,,rad/s,within_run,,,,\n"
            "one,all,slicing,spin,1,0.1,0.5,0.30000000000000004,,,rad/s,packings,,,,\n"
            "one,all,slicing,spin,2,0.2,1.5,2,,,rad/s,packings,,,,\n");
  CompareResults results = tiny();
  results.averaging.fromRotation = 0.25;
  results.averaging.toRotation = 1.25;
  results.averaging.preparedRotations = 2.0;
  EXPECT_NE(averageTable(results, "profiles.csv").find("within_run,7,0.25,1.25,2\n"),
            std::string::npos);
}

TEST(Csv, Distributions_AreRowsOfWhatIsThere) {
  const CompareResults results = compareFromJson(nlohmann::json::parse(R"({
    "runs": [{"engine": "one", "packing": 2, "distributions": [
      {"quantity": "spin", "ring": 0, "axes": [{"low": -1, "width": 0.5, "count": 3}],
       "density": [0.25, 0, 1.5], "stderr": [0.125, 0, 0.5], "outside": 0.125, "samples": 8},
      {"quantity": "joint", "ring": null, "samples": 4, "outside": 0,
       "axes": [{"low": 0, "width": 1, "count": 2}, {"low": 10, "width": 2, "count": 1}],
       "density": [0, 0.5], "stderr": []}]}]})"));
  EXPECT_EQ(averageTable(results, "distributions.csv"),
            "engine,packing,quantity,ring,low,high,density,stderr,low_2,high_2,stderr_kind\n"
            "one,2,spin,1,-1,-0.5,0.25,0.125,,,within_run\n"
            "one,2,spin,1,0,0.5,1.5,0.5,,,within_run\n"
            "one,2,spin,1,,,0.125,,,,within_run\n"
            "one,2,joint,all,1,2,0.5,,10,12,within_run\n");
}

TEST(Csv, Agreement_HasRingsWithTheirPlaceAndNoVerdict) {
  EXPECT_EQ(agreementCsv(tiny()),
            "a,b,field,ring,difference,stderr,low,high,margin,place,detects,within_share,"
            "packings,regimes_differ\n"
            "one,two,spin,1,-0.5,0.1,-0.7,-0.3,0.56,within,0.75,0.5,4,\n"
            "one,two,spin,2,0.25,,,,0.56,open,,,,\n");
}

TEST(Csv, Endpoints_HaveTheAnswerAndWhatItRestsOn) {
  CompareResults results = tiny();
  EndpointRow row;
  row.a = "one";
  row.b = "two";
  row.endpoint = "pressure";
  row.unit = "N/m²";
  row.margin = 0.25;
  row.marginRelative = true;
  results.endpoints.rows = {row};
  const std::string head =
      "a,b,kind,endpoint,unit,margin,answer,difference,low,high,distance,distance_low,"
      "distance_high,look,packings,lost,needs,needs_at_most,carrier_a,carrier_b,bound,"
      "regimes_differ,reference,reason,reach,basis,packings_a,packings_b\n";
  // Without a reference nobody knows what a quarter of it is: the fraction stands.
  EXPECT_EQ(endpointsCsv(results),
            head + "one,two,peer,pressure,N/m²,0.25,undecided,,,,,,,,0,0,,,,,,,,,,,,\n");
  results.endpoints.rows[0].reference = 200.0;
  results.endpoints.rows[0].verdict = Verdict::pass;
  results.endpoints.rows[0].difference = 20.0;
  results.endpoints.rows[0].distance = 0.4;
  results.endpoints.rows[0].look = 2;
  results.endpoints.rows[0].packings = 15;
  results.endpoints.rows[0].lost = 1;
  results.endpoints.rows[0].reason = "why one is lost";
  results.endpoints.rows[0].surrogateB = "mirror";
  results.endpoints.rows[0].bound = 0.01;
  results.endpoints.rows[0].reach = 0.002;
  results.regimes = {{"one", "two", PairKind::peer, 4, {1, 3}}};
  EXPECT_EQ(endpointsCsv(results),
            head +
                "one,two,peer,pressure,N/m²,50,small_difference,20,,,0.4,,,2,15,1,,,,mirror,"
                "0.01,2,200,why one is lost,0.002,paired,,\n");
  results.endpoints.rows[0].unpaired = {Basis::oneScatter, 15, 1};
  EXPECT_TRUE(endpointsCsv(results).ends_with(",0.002,one_scatter,15,1\n"));
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
  EXPECT_EQ(csvOf(reportOf(results), "collisions.csv"),
            "engine,case,variant,psi_i,v_n,e_n,psi_f,e_n_reference,psi_f_reference,dt_s,status,"
            "beta,beta_reference,centre_psi_f,centre_psi_f_reference,e_t,e_t_reference,"
            "rebound_angle_rad,rebound_angle_reference_rad,spin_i_rad_s,spin_i_reference_rad_s,"
            "spin_j_rad_s,spin_j_reference_rad_s,duration_s,duration_reference_s,"
            "max_overlap_m,max_overlap_reference_m,energy_before_J,energy_before_reference_J,"
            "energy_after_J,energy_after_reference_J,"
            "lost_normal_damping_J,lost_normal_damping_reference_J,"
            "lost_tangential_damping_J,lost_tangential_damping_reference_J,"
            "lost_sliding_J,lost_sliding_reference_J,lost_stored_J,lost_stored_reference_J,"
            "lost_tangential_J,lost_tangential_reference_J,"
            "lost_stiffening_J,lost_stiffening_reference_J,reason,"
            "outcome,verdict_scene,verdict_declared,own_scheme\n"
            "one,walton,\"soft, cut\",0.5,0.0001,0.25,-0.125,0.5,,2e-05,no limit,"
            "0.25,,,,,,,,,,,,,0.002,,,,,,,,,,,,,,1e-09,,,-2e-09,,it jumps,"
            "model difference,fell short,held,2e-14\n"
            "two,walton,\"soft, cut\",,,,,,,,failed,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,it hung,"
            "failed,,,\n");
}

}  // namespace
}  // namespace crossgrain::reports
