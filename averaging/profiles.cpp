#include "averaging/profiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "averaging/patience.hpp"
#include "averaging/statistics.hpp"

namespace crossgrain::inline averaging {

namespace {

/// All moments of all slots as one row of numbers, in the order of Linear's indices.
template <std::size_t Count>
std::span<const double> flat(const std::vector<std::array<double, Count>>& moments) {
  static_assert(sizeof(moments.front()) == Count * sizeof(double));
  return {moments.front().data(), moments.size() * Count};
}

template <typename Moments>
std::vector<Moments> perSlot(const std::vector<double>& flat) {
  constexpr std::size_t count = std::tuple_size_v<Moments>;
  std::vector<Moments> result(flat.size() / count);
  for (std::size_t slot = 0; slot < result.size(); ++slot)
    std::copy_n(flat.begin() + static_cast<std::ptrdiff_t>(slot * count), count,
                result[slot].begin());
  return result;
}

/// Each index once.
std::vector<std::pair<std::size_t, double>> collected(
    std::vector<std::pair<std::size_t, double>> slopes) {
  std::ranges::sort(slopes, {}, &std::pair<std::size_t, double>::first);
  std::vector<std::pair<std::size_t, double>> result;
  for (const auto& [index, slope] : slopes)
    if (!result.empty() && result.back().first == index)
      result.back().second += slope;
    else
      result.emplace_back(index, slope);
  return result;
}

}  // namespace

template <int D>
void ProfileAccumulatorOf<D>::add(const SnapshotOf<D>& snapshot) {
  std::vector<const FieldSpec*> fields;
  for (const FieldSpec& field : averaging::fieldsOf(*coordinates_))
    if (field.needs != Needs::dissipation && available(field, snapshot, springs_))
      fields.push_back(&field);
  if (snapshots_ > 0 && fields != fields_)
    throw std::invalid_argument(fmt::format(
        "averaging: the snapshot at {} s {} spin and {} contacts, unlike the ones before it; "
        "all snapshots of one average must hold the same",
        snapshot.positionTime, snapshot.spin ? "has" : "lacks",
        snapshot.contacts ? "has" : "lacks"));
  // A snapshot without contacts is not one of an engine that does not report it.
  const bool some = snapshot.contacts && !snapshot.contacts->dissipation.empty();
  reportsHeat_ |= some;
  lacksHeat_ |= !snapshot.contacts || (!some && snapshot.contacts->size() > 0);
  sums_.compute(snapshot, momentary_);
  for (std::size_t k = 0; k < series_.size(); ++k) series_[k].add(flat(momentary_[k]));
  ++snapshots_;
  fields_ = std::move(fields);
}

template <int D>
auto ProfileAccumulatorOf<D>::meanMoments(std::size_t weight) const -> std::vector<Moments> {
  return perSlot<Moments>(series_[weight].means());
}

template <int D>
template <typename MeansOf>
std::vector<Profile> ProfileAccumulatorOf<D>::profilesOf(MeansOf&& meansOf, bool errors) const {
  std::vector<Profile> result;
  if (snapshots_ == 0) return result;
  for (std::size_t weight = 0; weight < weights_.size(); ++weight) {
    const std::vector<Moments> mean = meansOf(weight);
    for (const FieldSpec* field : fields_) result.push_back(profile(weight, *field, mean, errors));
    if (!reportsHeat_ || lacksHeat_) continue;
    for (const FieldSpec& field : averaging::fieldsOf(*coordinates_))
      if (field.needs == Needs::dissipation) result.push_back(profile(weight, field, mean, errors));
  }
  return result;
}

template <int D>
std::vector<Profile> ProfileAccumulatorOf<D>::profiles() const {
  return profilesOf([this](std::size_t weight) { return meanMoments(weight); }, true);
}

template <int D>
std::optional<std::pair<std::size_t, std::size_t>> ProfileAccumulatorOf<D>::part(
    std::size_t k, std::size_t n) const {
  if (series_.empty() || series_.front().blocks() < n) return std::nullopt;
  const std::size_t blocks = series_.front().blocks(), length = series_.front().blockLength();
  return std::pair(k * blocks / n * length, (k + 1) * blocks / n * length);
}

template <int D>
std::vector<Profile> ProfileAccumulatorOf<D>::profilesWithout(std::size_t k, std::size_t n) const {
  const auto [first, last] = *part(k, n);
  return profilesOf(
      [&](std::size_t weight) {
        const BlockSeries& series = series_[weight];
        std::vector<double> means = series.sums();
        const std::size_t length = series.blockLength();
        for (std::size_t b = first / length; b < last / length; ++b) {
          throwIfLongInterrupted();
          for (std::size_t m = 0; m < means.size(); ++m) means[m] -= series.sums(b)[m];
        }
        for (double& mean : means) mean /= static_cast<double>(series.samples() - (last - first));
        return perSlot<Moments>(means);
      },
      false);
}

template <int D>
Profile ProfileAccumulatorOf<D>::profile(std::size_t weight, const FieldSpec& field,
                                         const std::vector<Moments>& mean, bool errors) const {
  Profile result;
  result.method = toString(weights_[weight].method);
  result.field = field.name;
  result.unit = field.unit;
  const BlockSeries& series = series_[weight];
  const std::span<const double> means = flat(mean);
  std::vector<double> residual(series.blocks());
  for (std::size_t slot = 0; slot < mean.size(); ++slot) {
    throwIfLongInterrupted();
    if (coordinates_->isOverflow(slot)) continue;
    const auto value = evaluate(field, BinView(*coordinates_, mean, slot, springs_));
    result.mean.push_back(value ? std::optional(value->value) : std::nullopt);
    result.standardError.emplace_back();
    result.nEff.emplace_back();
    result.dof.emplace_back();
    if (!errors || !value || residual.empty()) continue;
    const auto slopes = collected(value->slopes);
    for (std::size_t b = 0; b < residual.size(); ++b) {
      residual[b] = 0.0;
      for (const auto& [index, slope] : slopes)
        residual[b] += slope * (series.blockMean(b, index) - means[index]);
    }
    const MeanEstimate estimate = estimateMean(residual);
    if (!estimate.standardError) continue;
    result.standardError.back() = estimate.standardError;
    result.nEff.back() = estimate.nEff;
    result.dof.back() = estimate.dof;
  }
  return result;
}

template class ProfileAccumulatorOf<2>;
template class ProfileAccumulatorOf<3>;

}  // namespace crossgrain::inline averaging
