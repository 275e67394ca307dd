#include "averaging/profiles.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "averaging/statistics.hpp"

namespace crossgrain {

ProfileAccumulator::ProfileAccumulator(Rings rings, std::vector<WeightMethod> methods,
                                       const Scene& scene, bool countWallDisks)
    : rings_(std::move(rings)),
      methods_(std::move(methods)),
      sums_(rings_, scene, countWallDisks) {}

void ProfileAccumulator::add(const Snapshot& snapshot) {
  std::vector<const FieldSpec*> fields;
  for (const FieldSpec& field : fieldTable())
    if (available(field, snapshot)) fields.push_back(&field);
  if (!series_.empty() && fields != fields_)
    throw std::invalid_argument(fmt::format(
        "averaging: the snapshot at {} s {} spin and {} contacts, unlike the ones before it; "
        "all snapshots of one average must hold the same",
        snapshot.positionTime, snapshot.spin ? "has" : "lacks",
        snapshot.contacts ? "has" : "lacks"));
  std::vector<std::vector<Moments>> bins;
  sums_.compute(snapshot, methods_, bins);
  series_.push_back(std::move(bins));
  fields_ = std::move(fields);
}

std::vector<Moments> ProfileAccumulator::meanMoments(std::size_t method) const {
  std::vector<Moments> mean(rings_.slots(), Moments{});
  for (const auto& snapshot : series_)
    for (std::size_t slot = 0; slot < mean.size(); ++slot)
      for (std::size_t q = 0; q < momentCount; ++q) mean[slot][q] += snapshot[method][slot][q];
  for (Moments& moments : mean)
    for (double& moment : moments) moment /= static_cast<double>(series_.size());
  return mean;
}

std::vector<Profile> ProfileAccumulator::profiles() const {
  std::vector<Profile> result;
  if (series_.empty()) return result;
  for (std::size_t method = 0; method < methods_.size(); ++method) {
    const std::vector<Moments> mean = meanMoments(method);
    for (const FieldSpec* field : fields_) result.push_back(profile(method, *field, mean));
  }
  return result;
}

Profile ProfileAccumulator::profile(std::size_t method, const FieldSpec& field,
                                    const std::vector<Moments>& mean) const {
  Profile result;
  result.method = toString(methods_[method]);
  result.field = field.name;
  result.unit = field.unit;
  std::vector<double> residual(series_.size());
  for (int ring = 0; ring < rings_.count(); ++ring) {
    const std::size_t slot = rings_.slot(ring);
    const auto value = evaluate(field, mean[slot], rings_.volume(ring));
    result.mean.push_back(value ? std::optional(value->value) : std::nullopt);
    result.standardError.emplace_back();
    result.nEff.emplace_back();
    result.dof.emplace_back();
    if (!value) continue;
    for (std::size_t t = 0; t < series_.size(); ++t) {
      residual[t] = 0.0;
      for (std::size_t q = 0; q < momentCount; ++q)
        residual[t] += value->gradient[q] * (series_[t][method][slot][q] - mean[slot][q]);
    }
    const MeanEstimate estimate = estimateMean(residual);
    if (!estimate.standardError) continue;
    result.standardError.back() = estimate.standardError;
    result.nEff.back() = estimate.nEff;
    result.dof.back() = estimate.dof;
  }
  return result;
}

}  // namespace crossgrain
