#include "averaging/space_bins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "averaging/volumes.hpp"

namespace crossgrain::inline averaging {

namespace {

constexpr std::array<const char*, 3> axisNames = {"x", "y", "z"};

double period(const std::optional<BoxOf<3>>& box, int direction) {
  if (!box || !box->periodic[static_cast<std::size_t>(direction)]) return 0.0;
  return box->high[direction] - box->low[direction];
}

}  // namespace

KernelIn1d kernelOf(const Weight& weight) {
  const Kernel kind = weight.method == WeightMethod::heaviside ? Kernel::heaviside
                      : weight.method == WeightMethod::lucy    ? Kernel::lucy
                                                               : Kernel::gauss;
  return {kind, weight.width};
}

Parts::Parts(double low, double high, int count, double period, const char* name)
    : low_(low), high_(high), width_((high - low) / count), period_(period), count_(count) {
  // The box's own sides, as a case file says them, are not longer than the box.
  constexpr double rounding = 1e-9;
  if (count < 1)
    throw std::invalid_argument(fmt::format("bins: along {} at least one is needed", name));
  if (!std::isfinite(low) || !std::isfinite(high) || !(high > low))
    throw std::invalid_argument(fmt::format(
        "bins: along {} the high end, {} m, must lie above the low one, {} m", name, high, low));
  const double whole = std::abs(high - low - period);
  if (period > 0.0 && high - low > period && whole > rounding * period)
    throw std::invalid_argument(fmt::format(
        "bins: along {} they take {} m, more than the {} m after which all is there again", name,
        high - low, period));
  all_ = count == 1 && period > 0.0 && whole <= rounding * period;
}

std::optional<int> Parts::at(double x) const {
  if (all_) return 0;
  if (period_ > 0.0) x -= period_ * std::floor((x - low_) / period_);
  if (!(x >= low_ && x < high_)) return std::nullopt;
  int k = std::min(static_cast<int>((x - low_) / width_), count_ - 1);
  // The division may round across an edge.
  if (x < edge(k)) --k;
  if (x >= edge(k + 1)) ++k;
  return k;
}

int Parts::partFrom(double place) const {
  return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(count_)));
}

void Parts::cut(double x, double r, std::vector<Cut>& cuts) const {
  cuts.clear();
  constexpr double inf = std::numeric_limits<double>::infinity();
  if (all_) {
    cuts.push_back({0, -inf, inf});
    return;
  }
  const bool repeats = period_ > 0.0;
  const double first = repeats ? std::ceil((low_ - r - x) / period_) : 0.0;
  const double last = repeats ? std::floor((high_ + r - x) / period_) : 0.0;
  const double images = last - first;  // far away ++ would leave a double as it is
  for (double n = 0.0; n <= images; ++n) {
    const double c = x + (first + n) * period_;
    const int from = partFrom(std::floor((c - r - low_) / width_));
    for (int k = from; k < count_ && edge(k) < c + r; ++k)
      if (edge(k + 1) > c - r) cuts.push_back({k, edge(k) - c, edge(k + 1) - c});
  }
}

void Parts::crossings(double x, double step, std::vector<double>& s) const {
  if (all_ || step == 0.0) return;
  const double from = std::min(x, x + step), to = std::max(x, x + step);
  const bool repeats = period_ > 0.0;
  const double first = repeats ? std::ceil((from - high_) / period_) : 0.0;
  const double last = repeats ? std::floor((to - low_) / period_) : 0.0;
  const double images = last - first;
  for (double n = 0.0; n <= images; ++n) {
    const double shift = (first + n) * period_;
    const int begin = partFrom(std::ceil((from - shift - low_) / width_));
    for (int k = begin; k <= count_ && edge(k) + shift < to; ++k)
      if (const double place = (edge(k) + shift - x) / step; place > 0.0 && place < 1.0)
        s.push_back(place);
  }
}

void SpaceBins::require(const Weight& weight) const {
  if (std::ranges::find(spaceWeightNames, toString(weight.method)) == spaceWeightNames.end())
    throw std::invalid_argument(
        fmt::format("weights: {} is of the plane", toString(weight.method)));
  if (weight.isFunction())
    throw std::invalid_argument(
        fmt::format("weights: {} is a function of one coordinate: it goes with slabs",
                    toString(weight.method)));
}

void SpaceBins::sphereFractions(const Vec3& x, double a, const Weight& weight,
                                BinFractions& fractions) const {
  fractions.clear();
  if (weight.isFunction())
    addByFunction(x, kernelOf(weight), fractions);
  else if (weight.method == WeightMethod::centre || a == 0.0)
    fractions.push_back({slotAt(x), 1.0});
  else
    addVolumes(x, a, fractions);
}

void SpaceBins::bodyFractions(const Vec3& x, double a, const std::vector<Vec3>& points,
                              const Weight& weight, BinFractions& fractions) const {
  sphereFractions(x, weight.method == WeightMethod::centre ? 0.0 : a, weight, fractions);
  if (weight.isFunction() || fractions.size() == 1) return;
  fractions.clear();
  for (const Vec3& point : points) {
    const std::size_t slot = slotAt(point);
    auto found = std::ranges::find(fractions, slot, &BinFraction::slot);
    if (found == fractions.end()) found = fractions.insert(found, {slot, 0.0});
    found->fraction += 1.0 / static_cast<double>(points.size());
  }
}

Cells::Cells(const Vec3& low, const Vec3& high, const std::array<int, 3>& count,
             const std::optional<BoxOf<3>>& box, std::optional<int> axis)
    : parts_{Parts(low.x(), high.x(), count[0], period(box, 0), axisNames[0]),
             Parts(low.y(), high.y(), count[1], period(box, 1), axisNames[1]),
             Parts(low.z(), high.z(), count[2], period(box, 2), axisNames[2])},
      axis_(axis),
      volume_((high - low).prod() / cells()) {
  for (int k = 0; axis && k < 3; ++k)
    if (k != *axis && parts(k).count() > 1)
      throw std::invalid_argument("bins: slabs lie along one axis");
}

Vec3 Cells::centre(int n) const {
  const int nx = parts_[0].count(), ny = parts_[1].count();
  return {parts_[0].centre(n % nx), parts_[1].centre(n / nx % ny), parts_[2].centre(n / nx / ny)};
}

std::size_t Cells::slotAt(const Vec3& x) const {
  const auto i = parts_[0].at(x.x()), j = parts_[1].at(x.y()), k = parts_[2].at(x.z());
  return i && j && k ? slot(*i, *j, *k) : 0;
}

void Cells::require(const Weight& weight) const {
  if (weight.isFunction() && axis_)
    kernelOf(weight);  // its width
  else
    SpaceBins::require(weight);
}

void Cells::spread(const Vec3& x, double half, const KernelIn1d& kernel, auto&& put) const {
  const auto axis = static_cast<std::size_t>(*axis_);
  std::vector<Parts::Cut> cuts;
  bool beside = false;
  for (int k = 0; k < 3; ++k) beside |= k != *axis_ && !parts(k).at(x[k]);
  double rest = 1.0;
  if (!beside) parts_[axis].cut(x[*axis_], half + kernel.reach(), cuts);
  for (const auto& [part, from, to] : cuts) {
    const double fraction = parts_[axis].isAll() ? 1.0
                                                 : kernel.lineBelow(to, -half, half) -
                                                       kernel.lineBelow(from, -half, half);
    std::array<int, 3> cell{};
    cell[axis] = part;
    put(slot(cell[0], cell[1], cell[2]), fraction);
    rest -= fraction;
  }
  put(0, std::max(rest, 0.0));
}

void Cells::addByFunction(const Vec3& x, const KernelIn1d& kernel, BinFractions& fractions) const {
  spread(x, 0.0, kernel, [&](std::size_t slot, double fraction) {
    fractions.push_back({slot, fraction});
  });
}

void Cells::addVolumes(const Vec3& x, double a, BinFractions& fractions) const {
  std::array<std::vector<Parts::Cut>, 3> cuts;
  for (int k = 0; k < 3; ++k) parts(k).cut(x[k], a, cuts[static_cast<std::size_t>(k)]);
  double rest = 1.0;
  for (const auto& along : cuts[2])
    for (const auto& row : cuts[1])
      for (const auto& column : cuts[0]) {
        const double fraction = fractionWithin(Vec3(column.from, row.from, along.from) / a,
                                               Vec3(column.to, row.to, along.to) / a);
        fractions.push_back({slot(column.part, row.part, along.part), fraction});
        rest -= fraction;
      }
  fractions.push_back({0, std::max(rest, 0.0)});
}

void Cells::lineFractions(const Vec3& x, const Vec3& step, const Weight& weight,
                          std::vector<LineFraction>& fractions) const {
  fractions.clear();
  std::vector<double> ends = {0.0, 1.0};
  for (int k = 0; k < 3; ++k)
    if (!weight.isFunction() || k != *axis_) parts(k).crossings(x[k], step[k], ends);
  std::ranges::sort(ends);
  for (std::size_t piece = 0; piece + 1 < ends.size(); ++piece) {
    const double part = ends[piece + 1] - ends[piece];
    if (part == 0.0) continue;
    const Vec3 middle = x + 0.5 * (ends[piece] + ends[piece + 1]) * step;
    if (weight.isFunction())
      spread(middle, 0.5 * part * std::abs(step[*axis_]), kernelOf(weight),
             [&](std::size_t slot, double fraction) {
               fractions.push_back({slot, part * fraction, middle});
             });
    else
      fractions.push_back({slotAt(middle), part, middle});
  }
}

}  // namespace crossgrain::inline averaging
