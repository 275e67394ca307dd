#include "runs/conformance/examination.hpp"

#include <fmt/format.h>

#include <chrono>

#include "runs/common/engine_access.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::conformance {
namespace {

constexpr double timeout = 60.0;  // for one answer [s]
constexpr int mostBreakdowns = 3;

/// Workers of one engine: the one that all checks share, and further ones.
class Workers {
 public:
  Workers(const EngineEntry& entry, std::filesystem::path scratch)
      : entry_(entry), scratch_(std::move(scratch)) {}

  Engine& shared() {
    if (!shared_) shared_ = start(entry_);
    return *shared_;
  }
  void end() { shared_.reset(); }
  std::unique_ptr<Engine> start(const EngineEntry& of) {
    return startNew(of, scratch_ / fmt::format("{}-{}", of.name, ++count_), timeout);
  }

 private:
  const EngineEntry& entry_;
  std::filesystem::path scratch_;
  std::unique_ptr<Engine> shared_;
  int count_ = 0;
};

void judge(const Check& check, const EngineEntry& entry, Workers& workers, ConformanceRow& row,
           Examination& result) {
  const Exam::Start start = [&](const EngineEntry& of) { return workers.start(of); };
  Exam exam(workers.shared(), entry, start);
  try {
    check.run(exam);
  } catch (const Skipped& skip) {
    row.outcome = ConformanceOutcome::skipped;
    row.detail = skip.reason;
  } catch (const GivenUp&) {
  } catch (const EngineFailure& failure) {
    row.outcome = ConformanceOutcome::brokeDown;
    row.detail = failure.what();
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    exam.fault(error.what());
  }
  row.faults = exam.faults().size();
  if (row.outcome != ConformanceOutcome::brokeDown)
    result.examined.insert(exam.examined().begin(), exam.examined().end());
  result.refused.insert(exam.refusedToo().begin(), exam.refusedToo().end());
  if (exam.faults().empty()) return;
  if (row.outcome != ConformanceOutcome::brokeDown) {
    row.outcome = ConformanceOutcome::failed;
    row.detail = exam.faults().front();
    row.cause = exam.cause();
  }
}

}  // namespace

Examination examine(const EngineEntry& entry, const std::vector<Check>& checks,
                    const std::filesystem::path& scratch,
                    const std::function<void(const std::string&, double)>& progress) {
  using Clock = std::chrono::steady_clock;
  Workers workers(entry, scratch);
  Examination result;
  result.declared = declaredBy(workers.shared().capabilities());
  std::vector<ConformanceRow>& rows = result.rows;
  int breakdowns = 0;
  for (const Check& check : checks) {
    throwIfInterrupted();
    progress(check.name, static_cast<double>(rows.size()) / static_cast<double>(checks.size()));
    ConformanceRow& row = rows.emplace_back();
    row.part = "suite";
    row.name = check.name;
    row.what = check.what;
    if (breakdowns >= mostBreakdowns) {
      row.outcome = ConformanceOutcome::skipped;
      row.detail = fmt::format("not tried: it broke down {} times before", breakdowns);
      continue;
    }
    const auto began = Clock::now();
    judge(check, entry, workers, row, result);
    row.seconds = std::chrono::duration<double>(Clock::now() - began).count();
    breakdowns += row.outcome == ConformanceOutcome::brokeDown;
    // It may have died of it; the next check is to have a sound one.
    if (row.outcome == ConformanceOutcome::brokeDown || row.outcome == ConformanceOutcome::failed)
      workers.end();
  }
  return result;
}

}  // namespace crossgrain::conformance
