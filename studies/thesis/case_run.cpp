#include "studies/thesis/case_run.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>

#include "averaging/global.hpp"
#include "cases/couette.hpp"
#include "studies/flow/frame.hpp"

namespace crossgrain::inline studies {

using nlohmann::json;

ThesisHistory::ThesisHistory(const Case& setup, const Scene& scene, int settlingSnapshots)
    : setup_(setup),
      scene_(scene),
      rings_(ringsOf(setup)),
      sums_(std::make_shared<Rings>(rings_), {Weight(WeightMethod::slicing)}, scene) {
  const CellTimes& times = couetteIn(setup).times;
  const double settled = times.settleRotations;
  const double end = settled + times.rotations;
  const auto addSpans = [&](double from, double to) {
    constexpr double sliver = 1e-9;  // what rounding leaves of a rotation is no span
    for (double at = from; at < to - sliver; at += 1.0)
      spans_.push_back({at, std::min(at + 1.0, to)});
  };
  addSpans(0.0, settled);
  addSpans(settled, end);
  const double perRotation = std::max(settled > 0.0 ? settlingSnapshots / settled : 0.0,
                                      static_cast<double>(times.snapshotsPerRotation));
  half_ = 0.5 / perRotation;
}

ThesisSpan ThesisHistory::momentary(const Snapshot& snapshot) {
  const Cell& cell = couetteIn(setup_).cell;
  const GlobalNumbers numbers = globalNumbers(scene_, snapshot);
  ThesisSpan now;
  now.outerPressure = radialPressure(scene_, snapshot, ringName, cell.outerRadius, cell.height);
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
                          (cell.omega * cell.innerRadius);
  return now;
}

namespace {

bool isLargest(std::size_t quantity) {
  return spanNumbers[quantity].of == &ThesisSpan::maxOverlap;
}

}  // namespace

void ThesisHistory::add(const Snapshot& snapshot) {
  const double when = snapshot.positionTime / rotationTime(setup_) - half_;
  const auto own = std::ranges::find_if(spans_, [&](const Sums& span) { return when < span.to; });
  Sums& span = own == spans_.end() ? spans_.back() : *own;
  const ThesisSpan now = momentary(snapshot);
  for (std::size_t q = 0; q < std::size(spanNumbers); ++q) {
    const std::optional<double> value = now.*spanNumbers[q].of;
    if (!value) continue;
    span.sum[q] = isLargest(q) ? std::max(span.sum[q], *value) : span.sum[q] + *value;
    ++span.count[q];
  }
}

std::vector<ThesisSpan> ThesisHistory::spans() const {
  std::vector<ThesisSpan> spans;
  for (const Sums& sums : spans_) {
    if (std::ranges::all_of(sums.count, [](std::size_t n) { return n == 0; })) continue;
    ThesisSpan& span = spans.emplace_back();
    span.from = sums.from;
    span.to = sums.to;
    for (std::size_t q = 0; q < std::size(spanNumbers); ++q)
      if (sums.count[q] > 0)
        span.*spanNumbers[q].of =
            isLargest(q) ? sums.sum[q] : sums.sum[q] / static_cast<double>(sums.count[q]);
  }
  return spans;
}

json ThesisHistory::state() const {
  return jsonOf(spans_);
}

void ThesisHistory::restore(const json& state) {
  readFrom(state, spans_);
}

ThesisRun runCase(const FlowTask& task, const std::vector<int>& finerRings, int settlingSnapshots,
                  const std::function<void(double)>& progress) {
  struct FinerRings {
    Rings rings;
    ProfileAccumulator profiles;
  };
  const Case& setup = *task.setup;
  const Scene scene = couetteScene(setup, *task.packing, task.dt);
  const double settle = couetteIn(setup).times.settleRotations;
  SnapshotObserver watch;
  if (settle > 0.0)
    watch.settlingSnapshots =
        std::max(1, static_cast<int>(std::lround(settle * settlingSnapshots)));
  ThesisHistory history(setup, scene, watch.settlingSnapshots);
  std::deque<FinerRings> finer;
  for (const int count : finerRings) {
    const Rings rings = ringsOf(setup, count);
    finer.push_back(
        {rings, ProfileAccumulator(rings, weightsOf(setup, setup.averaging.methods), scene)});
  }
  watch.settling = [&](const Snapshot& snapshot) { history.add(snapshot); };
  watch.averaged = [&](const Snapshot& snapshot) {
    history.add(snapshot);
    for (FinerRings& own : finer) own.profiles.add(snapshot);
  };
  watch.state = [&] { return history.state(); };
  watch.restore = [&](const json& state) { history.restore(state); };

  ThesisRun result;
  result.run = runFlow(task, progress, watch);
  result.run.picture.reset();
  result.engine = task.entry.name;
  result.packing = task.packingIndex;
  result.seed = setup.preparation.seed;
  result.history = history.spans();
  for (const FinerRings& own : finer) {
    result.finer.push_back({own.rings.count(), placesOf(own.rings), own.profiles.profiles()});
    for (Profile& profile : result.finer.back().profiles) {  // half of a run's file
      profile.nEff.clear();
      profile.dof.clear();
    }
  }
  return result;
}

}  // namespace crossgrain::inline studies
