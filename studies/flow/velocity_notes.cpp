#include "studies/flow/velocity_notes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <optional>

#include "averaging/agreement.hpp"
#include "averaging/statistics.hpp"
#include "studies/flow/paired_rings.hpp"

namespace crossgrain::inline studies {

namespace {

constexpr double measuringError = 0.15;
constexpr std::size_t rings = 3;

using ByPacking = std::map<int, Numbers>;

ByPacking velocitiesOf(const FlowStudy& study, const std::string& engine) {
  ByPacking found;
  for (const FlowRun* run : finishedRuns(study.runs, engine))
    if (const Profile* profile =
            profileOf(run->profiles, study.averaging.method, "azimuthal_velocity"))
      found[run->packing] = profile->mean;
  return found;
}

/// Paired difference of two engines in one ring, as a fraction of the first one's mean.
struct Difference {
  double fraction = 0.0;
  double halfWidth = INFINITY;  ///< of the 95 % interval; infinite with fewer than two packings
  bool holds() const {
    return std::abs(fraction) <= measuringError || std::abs(fraction) <= halfWidth;
  }
};

std::optional<Difference> difference(const ByPacking& from, const ByPacking& to, std::size_t ring) {
  Numbers differences, references;
  for (const auto& [packing, reference] : from) {
    const auto other = to.find(packing);
    if (other == to.end() || ring >= reference.size() || ring >= other->second.size()) continue;
    if (!reference[ring] || !other->second[ring]) continue;
    differences.emplace_back(*other->second[ring] - *reference[ring]);
    references.push_back(reference[ring]);
  }
  const auto mean = ensembleMean(differences);
  const auto reference = ensembleMean(references);
  if (!mean || reference->mean == 0.0) return std::nullopt;
  Difference result;
  result.fraction = mean->mean / std::abs(reference->mean);
  if (mean->standardError)
    result.halfWidth = studentQuantile(0.95, mean->packings - 1) * *mean->standardError /
                       std::abs(reference->mean);
  return result;
}

std::string percent(const Difference& d) {
  return std::isfinite(d.halfWidth)
             ? fmt::format("{:+.0f} ± {:.0f} %", 100.0 * d.fraction, 100.0 * d.halfWidth)
             : fmt::format("{:+.0f} %", 100.0 * d.fraction);
}

std::string mirrorSentence(const FlowStudy& study, const std::string& peer,
                           const ByPacking& reference, const ByPacking& measured, std::size_t ring,
                           const char* bin) {
  for (const EngineRow& engine : study.engines) {
    if (engine.mirrors != peer) continue;
    const ByPacking mirror = velocitiesOf(study, engine.name);
    const auto model = difference(reference, mirror, ring);
    const auto rest = difference(mirror, measured, ring);
    if (!model || !rest) continue;
    const char* reading = rest->holds() && !model->holds() ? "the model makes the difference"
                          : model->holds() && !rest->holds()
                              ? "what it mirrors is not what makes the difference"
                              : "it explains a part, as far as these packings show";
    return fmt::format(" Its mirror {} (same {}) is {} off the reference and {} off it: {}.",
                       engine.name, bin, percent(*model), percent(*rest), reading);
  }
  return " It has no mirror.";
}

}  // namespace

std::vector<std::string> velocityNotes(const FlowStudy& study) {
  std::vector<std::string> notes;
  const std::string& first = study.engines.front().name;
  const char* const bin = study.region ? "bin" : "ring";
  const ByPacking reference = velocitiesOf(study, first);
  for (const EngineRow& engine : study.engines) {
    const std::string& name = engine.name;
    if (name == first || !engine.mirrors.empty()) continue;
    const ByPacking measured = velocitiesOf(study, name);
    std::vector<std::string> differences;
    std::string beyond;
    for (std::size_t ring = 0; ring < rings; ++ring) {
      const auto found = difference(reference, measured, ring);
      if (!found || !std::isfinite(found->halfWidth)) continue;  // one packing has no interval
      differences.push_back(percent(*found));
      if (!found->holds() && beyond.empty())
        beyond = fmt::format(" In {} {} it is beyond both.", bin, ring + 1) +
                 mirrorSentence(study, name, reference, measured, ring, bin);
    }
    if (differences.empty()) continue;
    notes.push_back(
        fmt::format("v_φ of {} in {}s 1 to {} against {} (95 % interval over packings): {}. {}{}",
                    name, bin, differences.size(), first, fmt::join(differences, ", "),
                    beyond.empty() ? "Within 15 % or within the interval in each."
                                   : "Not within 15 % or the "
                                     "interval everywhere.",
                    beyond));
  }
  return notes;
}

}  // namespace crossgrain::inline studies
