#include "runs/couette/velocity_notes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>

#include "averaging/agreement.hpp"
#include "averaging/statistics.hpp"
#include "runs/common/records.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

constexpr double tolerance = 0.15;
constexpr std::size_t rings = 3;

using ByPacking = std::map<int, std::vector<std::optional<double>>>;

ByPacking velocitiesOf(const json& results, const std::string& engine) {
  ByPacking found;
  for (const json& run : results["runs"]) {
    if (run["engine"] != engine || run["status"] != "finished") continue;
    for (const json& profile : run["profiles"])
      if (profile["field"] == "azimuthal_velocity" &&
          profile["method"] == results["averaging"]["method"])
        found[run["packing"]] = optionalNumbers(profile["mean"]);
  }
  return found;
}

/// Paired difference of two engines in one ring, as a share of the first one's mean.
struct Difference {
  double share = 0.0;
  double halfWidth = INFINITY;  ///< of the 95 % interval; infinite with fewer than two packings
  bool holds() const { return std::abs(share) <= tolerance || std::abs(share) <= halfWidth; }
};

std::optional<Difference> difference(const ByPacking& from, const ByPacking& to, std::size_t ring) {
  std::vector<std::optional<double>> differences, references;
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
  result.share = mean->mean / std::abs(reference->mean);
  if (mean->standardError)
    result.halfWidth = studentQuantile(0.95, mean->packings - 1) * *mean->standardError /
                       std::abs(reference->mean);
  return result;
}

std::string percent(const Difference& d) {
  return std::isfinite(d.halfWidth)
             ? fmt::format("{:+.0f} ± {:.0f} %", 100.0 * d.share, 100.0 * d.halfWidth)
             : fmt::format("{:+.0f} %", 100.0 * d.share);
}

std::string mirrorSentence(const json& results, const std::string& peer, const ByPacking& reference,
                           const ByPacking& measured, std::size_t ring) {
  for (const json& engine : results["engines"]) {
    if (engine["mirrors"] != peer) continue;
    const std::string name = engine["name"];
    const ByPacking mirror = velocitiesOf(results, name);
    const auto model = difference(reference, mirror, ring);
    const auto rest = difference(mirror, measured, ring);
    if (!model || !rest) continue;
    const char* reading = rest->holds() && !model->holds() ? "the model makes the difference"
                          : model->holds() && !rest->holds()
                              ? "what it mirrors is not what makes the difference"
                              : "it explains a part, as far as these packings can tell";
    return fmt::format(" Its mirror {} (same ring) is {} off the reference and {} off it: {}.",
                       name, percent(*model), percent(*rest), reading);
  }
  return " It has no mirror.";
}

}  // namespace

json velocityNotes(const json& results) {
  json notes = json::array();
  const std::string first = results["engines"][0]["name"];
  const ByPacking reference = velocitiesOf(results, first);
  for (const json& engine : results["engines"]) {
    const std::string name = engine["name"];
    if (name == first || engine["mirrors"] != "") continue;
    const ByPacking measured = velocitiesOf(results, name);
    std::vector<std::string> shares;
    std::string beyond;
    for (std::size_t ring = 0; ring < rings; ++ring) {
      const auto found = difference(reference, measured, ring);
      if (!found) continue;
      shares.push_back(percent(*found));
      if (!found->holds() && beyond.empty())
        beyond = fmt::format(" Ring {} is beyond both.", ring + 1) +
                 mirrorSentence(results, name, reference, measured, ring);
    }
    if (shares.empty()) continue;
    notes.push_back(
        fmt::format("v_φ of {} in rings 1 to {} against {} (95 % interval over packings): {}. {}{}",
                    name, shares.size(), first, fmt::join(shares, ", "),
                    beyond.empty() ? "Within 15 % or within the interval in each."
                                   : "Not within 15 % or the "
                                     "interval everywhere.",
                    beyond));
  }
  return notes;
}

}  // namespace crossgrain::inline runs
