#include "runs/thesis/history.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "averaging/global.hpp"
#include "cases/couette.hpp"
#include "runs/couette/run.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

/// All numbers of a span.
constexpr std::optional<double> ThesisSpan::*spanQuantities[] = {&ThesisSpan::outerPressure,
                                                                 &ThesisSpan::wheelTorque,
                                                                 &ThesisSpan::wheelContacts,
                                                                 &ThesisSpan::wheelTouched,
                                                                 &ThesisSpan::coordination,
                                                                 &ThesisSpan::volumeFractionAtWheel,
                                                                 &ThesisSpan::volumeFractionOutside,
                                                                 &ThesisSpan::velocityAtWheel,
                                                                 &ThesisSpan::kineticEnergy,
                                                                 &ThesisSpan::maxOverlap,
                                                                 &ThesisSpan::meanOverlap};
constexpr std::size_t spanQuantityCount = std::size(spanQuantities);

bool isLargest(std::size_t quantity) {
  return spanQuantities[quantity] == &ThesisSpan::maxOverlap;
}

}  // namespace

ThesisHistory::ThesisHistory(const Case& setup, const Scene& scene, int settlingSnapshots)
    : setup_(setup),
      scene_(scene),
      rings_(ringsOf(setup)),
      sums_(std::make_shared<Rings>(rings_), {Weight(WeightMethod::slicing)}, scene) {
  const double settled = setup.averaging.settleRotations;
  const double end = settled + setup.averaging.rotations;
  const auto addSpans = [&](double from, double to) {
    constexpr double sliver = 1e-9;  // what rounding leaves of a rotation is no span
    for (double at = from; at < to - sliver; at += 1.0)
      spans_.push_back({at, std::min(at + 1.0, to), std::vector<double>(spanQuantityCount, 0.0),
                        std::vector<std::size_t>(spanQuantityCount, 0)});
  };
  addSpans(0.0, settled);
  addSpans(settled, end);
  const double perRotation = std::max(settled > 0.0 ? settlingSnapshots / settled : 0.0,
                                      static_cast<double>(setup.averaging.snapshotsPerRotation));
  half_ = 0.5 / perRotation;
}

ThesisSpan ThesisHistory::momentary(const Snapshot& snapshot) {
  const GlobalNumbers numbers = globalNumbers(scene_, snapshot);
  ThesisSpan now;
  now.outerPressure =
      radialPressure(scene_, snapshot, ringName, setup_.cell.outerRadius, setup_.cell.height);
  now.wheelTorque = drivingTorque(scene_, snapshot, wheelName);
  now.wheelContacts = contactsOf(scene_, snapshot, wheelName);
  if (now.wheelContacts) now.wheelTouched = *now.wheelContacts > 0.0 ? 1.0 : 0.0;
  now.coordination = numbers.coordination;
  now.kineticEnergy = numbers.kineticEnergy;
  now.maxOverlap = numbers.maxOverlap;
  now.meanOverlap = numbers.meanOverlap;

  sums_.compute(snapshot, moments_);
  const std::vector<Moments>& rings = moments_.front();
  const auto volumeOf = [&](int ring) { return at(rings[rings_.slot(ring)], Moment::volume); };
  double disks = 0.0, room = 0.0;
  for (int ring = rings_.count() / 2; ring < rings_.count(); ++ring) {
    disks += volumeOf(ring);
    room += rings_.ringVolume(ring);
  }
  now.volumeFractionOutside = disks / room;
  now.volumeFractionAtWheel = volumeOf(0) / rings_.ringVolume(0);
  if (volumeOf(0) > 0.0)
    now.velocityAtWheel = at(rings[rings_.slot(0)], Moment::velocityP) / volumeOf(0) /
                          (setup_.cell.omega * setup_.cell.innerRadius);
  return now;
}

void ThesisHistory::add(const Snapshot& snapshot) {
  const double when = snapshot.positionTime / rotationTime(setup_) - half_;
  const auto own = std::ranges::find_if(spans_, [&](const Sums& span) { return when < span.to; });
  Sums& span = own == spans_.end() ? spans_.back() : *own;
  const ThesisSpan now = momentary(snapshot);
  for (std::size_t q = 0; q < spanQuantityCount; ++q) {
    const std::optional<double> value = now.*spanQuantities[q];
    if (!value) continue;
    span.sum[q] = isLargest(q) ? std::max(span.sum[q], *value) : span.sum[q] + *value;
    ++span.count[q];
  }
}

std::vector<ThesisSpan> ThesisHistory::spans() const {
  std::vector<ThesisSpan> spans;
  for (const Sums& sums : spans_) {
    if (std::ranges::all_of(sums.count, [](std::size_t n) { return n == 0; })) continue;
    ThesisSpan span;
    span.from = sums.from;
    span.to = sums.to;
    for (std::size_t q = 0; q < spanQuantityCount; ++q)
      if (sums.count[q] > 0)
        span.*spanQuantities[q] =
            isLargest(q) ? sums.sum[q] : sums.sum[q] / static_cast<double>(sums.count[q]);
    spans.push_back(span);
  }
  return spans;
}

json ThesisHistory::state() const {
  json state = json::array();
  for (const Sums& span : spans_) state.push_back({{"sum", span.sum}, {"count", span.count}});
  return state;
}

void ThesisHistory::restore(const json& state) {
  for (std::size_t k = 0; k < spans_.size(); ++k) {
    spans_[k].sum = state.at(k).at("sum").get<std::vector<double>>();
    spans_[k].count = state.at(k).at("count").get<std::vector<std::size_t>>();
  }
}

}  // namespace crossgrain::inline runs
