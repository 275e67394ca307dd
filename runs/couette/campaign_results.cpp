#include <fmt/format.h>

#include <algorithm>

#include "runs/couette/campaign.hpp"
#include "runs/couette/frame.hpp"

namespace crossgrain::inline runs {

std::vector<EngineRow> Campaign::engineRows() const {
  std::vector<EngineRow> rows;
  for (const CampaignEngine& own : engines_) {
    EngineRow row{own.entry.name,    own.entry.summary, own.version,
                  own.entry.mirrors, EngineStatus::ran, own.refusal};
    if (!own.refusal.empty()) row.status = EngineStatus::refused;
    for (const CouetteRun& run : runs_)
      if (run.engine == row.name && run.status == RunStatus::failed && row.reason.empty()) {
        row.status = EngineStatus::failed;
        row.reason = run.reason;
      }
    rows.push_back(std::move(row));
  }
  return rows;
}

CouetteStudy Campaign::study(std::string_view kind) const {
  CouetteStudy study;
  static_cast<CouetteFrame&>(study) =
      couetteFrame(kind, setup_, command_.commandLine, packings_.front().disks);
  study.engines = engineRows();
  for (std::size_t k = 0; k < packings_.size(); ++k)
    study.packings.push_back(
        {k, setup_.preparation.seed, packings_[k].hash, packings_[k].fromCache});
  study.runs = runs_;
  const bool all = std::ranges::find(command_.engines, "all") != command_.engines.end();
  for (const EngineEntry& entry : engineRegistry())
    if (all && entry.missing && !entry.missing().empty())
      study.notes.push_back(
          fmt::format("{} was left out: it is not installed ({}).", entry.name, entry.missing()));
  if (const EngineRow& first = study.engines.front(); !all && !command_.engines.empty() &&
                                                      first.name != command_.engines.front() &&
                                                      first.mirrors.empty())
    study.notes.push_back(
        fmt::format("{} was named first and cannot run the case: the reference is {}.",
                    command_.engines.front(), first.name));
  study.elapsed = elapsed();
  return study;
}

}  // namespace crossgrain::inline runs
