#include "tests/reports/sample_common.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::sample {

namespace {

LockstepRow row(const std::string& engine, Equivalence verdict, double equivalent) {
  LockstepRow row;
  row.engine = engine;
  row.verdict = verdict;
  row.equivalent = equivalent;
  row.equivalentLow = 0.5 * equivalent;
  row.equivalentHigh = 2.0 * equivalent;
  row.starts = row.read = 16;
  row.readings.assign(16, {equivalent, 0.01, verdict == Equivalence::differs});
  row.beyond = verdict == Equivalence::differs ? 16 : 0;
  row.shareHigh = verdict == Equivalence::differs ? 1.0 : 0.17;
  for (const double time : {0.001, 0.01, 0.05, 0.1})
    row.separations.push_back(
        {time, 1e-4 * time * equivalent, time * equivalent, 1e-3 * time, {}, equivalent});
  row.trackTime = {0.001, 0.01, 0.05, 0.1};
  row.track = {1e-3 * equivalent, 1e-2 * equivalent, 5e-2 * equivalent, 0.1 * equivalent};
  row.forces = LockstepForces{4000, 0, 0, 1e-3 * equivalent, 2e-3 * equivalent};
  row.wallSeconds = 0.4;
  return row;
}

}  // namespace

LockstepResults lockstepResults() {
  LockstepResults results;
  results.head = resultsHead("lockstep", "quick");
  results.engines = {engineRow("yade", "YADE's viscoelastic law"), engineRow("odd-one", awkward),
                     engineRow("rigid", "another normal law")};
  results.lockstep.rules = {1e-10, 1e-3, 1e-3, "kn", 0.05};
  results.lockstep.starts.assign(16, {0, 0.1, 0.1});
  results.lockstep.rows = {
      row("yade", Equivalence::sameLaw, 1e-5), row("odd-one", Equivalence::differs, 0.02), {}};
  LockstepRow& differs = results.lockstep.rows[1];
  differs.first = FirstExceedance{3, 0.0, 4e-4, 17, 203, "sliding", 1};
  differs.term = NamedTerm{"gt", 0.5, 0.02};
  LockstepRow& none = results.lockstep.rows[2];
  none.engine = "rigid";
  none.reason = "has another normal law in place of the case's";
  return results;
}

}  // namespace crossgrain::sample
