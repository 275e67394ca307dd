#include "runs/common/dry_run.hpp"

#include <fmt/format.h>

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

/// Wall time that an engine took for a run, of whatever kind [s]; 0 where it does not say.
double wallSeconds(const json& kept) {
  const json stats = kept.is_object() ? kept.value("stats", json()) : json();
  return stats.is_object() ? stats.value("wall_s", 0.0) : 0.0;
}

std::string duration(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.2g} s", seconds);
  return seconds < 6000.0 ? fmt::format("{:.0f} min", seconds / 60.0)
                          : fmt::format("{:.1f} h", seconds / 3600.0);
}

/// Of the rest, if those that are finished say; 0 if not.
double secondsLeft(const PlannedWork& work) {
  if (work.finished == 0) return 0.0;
  return work.seconds / static_cast<double>(work.finished) *
         static_cast<double>(work.total - work.finished);
}

}  // namespace

void count(PlannedWork& work, const std::optional<json>& kept) {
  ++work.total;
  if (!kept) return;
  ++work.finished;
  work.seconds += wallSeconds(*kept);
}

std::string inWords(const PlannedWork& work) {
  if (!work.refusal.empty()) return fmt::format("  {:<24} cannot: {}\n", work.engine, work.refusal);
  const std::size_t left = work.total - work.finished;
  const double seconds = secondsLeft(work);
  return fmt::format("  {:<24} {} {}: {} finished, {} to do{}\n", work.engine, work.total,
                     work.what, work.finished, left,
                     left == 0       ? ""
                     : seconds > 0.0 ? ", about " + duration(seconds) + " of computing"
                                     : ", time not known yet");
}

std::string dryRunInWords(const std::string& head, const std::vector<PlannedWork>& works,
                          const RunStore& store, const RunCommand& command) {
  std::string text = head;
  for (const PlannedWork& work : works) text += inWords(work);
  return text + fmt::format("into {}, {} side by side; nothing was run, nothing written\n",
                            store.folder().string(), command.jobs);
}

}  // namespace crossgrain::inline runs
