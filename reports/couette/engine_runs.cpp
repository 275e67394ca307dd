#include "reports/couette/engine_runs.hpp"

#include "reports/common/engines.hpp"

namespace crossgrain::reports {

namespace {

/// A member of the ensemble, else of the only finished run.
template <typename T>
const T& meansOf(const EngineRuns& engine, T CouetteEnsemble::*ofEnsemble, T CouetteRun::*ofRun) {
  static const T none;
  if (engine.ensemble) return engine.ensemble->*ofEnsemble;
  return engine.finished.empty() ? none : engine.finished.front()->*ofRun;
}

}  // namespace

const std::vector<Profile>& EngineRuns::profiles() const {
  return meansOf(*this, &CouetteEnsemble::profiles, &CouetteRun::profiles);
}
const std::vector<Distribution>& EngineRuns::distributions() const {
  return meansOf(*this, &CouetteEnsemble::distributions, &CouetteRun::distributions);
}
const std::vector<FitRow>& EngineRuns::fits() const {
  return meansOf(*this, &CouetteEnsemble::fits, &CouetteRun::fits);
}
const std::vector<HeadNumber>& EngineRuns::head() const {
  return meansOf(*this, &CouetteEnsemble::head, &CouetteRun::head);
}

const Realised* EngineRuns::realised() const {
  for (const CouetteRun* run : runs)
    if (run->realised) return &*run->realised;
  return nullptr;
}

void EngineRuns::takeRuns(const std::vector<CouetteRun>& all,
                          const std::vector<CouetteEnsemble>& ensembles, const std::string& engine,
                          const std::string& without) {
  for (const CouetteRun& run : all) {
    if (run.engine != engine || run.without != without) continue;
    runs.push_back(&run);
    if (run.finished()) finished.push_back(&run);
  }
  for (const CouetteEnsemble& mean : ensembles)
    if (mean.engine == engine && mean.without == without && finished.size() > 1) {
      ensemble = &mean;
      break;
    }
}

std::vector<EngineRuns> engineRuns(const CouetteStudy& study,
                                   const std::vector<CouetteEnsemble>& ensembles) {
  const std::vector<LineStyle> styles = engineStyles(study.engines);
  std::vector<EngineRuns> engines;
  for (const EngineRow& row : study.engines) {
    EngineRuns engine{row, styles[engines.size()], {}, {}, nullptr};
    engine.takeRuns(study.runs, ensembles, row.name, "");
    engines.push_back(std::move(engine));
  }
  return engines;
}

Json columnsView(const std::vector<EngineRuns>& engines) {
  Json columns = Json::array();
  for (const EngineRuns& engine : engines)
    columns.push_back({{"name", engine.name},
                       {"colour", engine.style.colour},
                       {"dashed", engine.style.dashed},
                       {"hasData", !engine.finished.empty()}});
  return columns;
}

}  // namespace crossgrain::reports
