#include "reports/thesis/leg_rings.hpp"

#include <algorithm>
#include <cmath>

#include "reports/common/numbers.hpp"

namespace crossgrain::reports {

namespace {

/// Labels have three digits.
constexpr double sameLabel = 5e-4;

/// Equally wide, from the wheel to the ring.
RingPlaces placesOfCase(const CouetteCell& cell, std::size_t count) {
  RingPlaces places;
  const double width = (cell.outerRadius - cell.innerRadius) / static_cast<double>(count);
  places.width = width;
  for (std::size_t k = 0; k < count; ++k) {
    const double fromWheel = (static_cast<double>(k) + 0.5) * width;
    places.r.push_back(cell.innerRadius + fromWheel);
    places.rTilde.push_back(fromWheel / cell.diameter);
  }
  return places;
}

Numbers fieldIn(const RingView& view, const std::string& field) {
  const CouetteCell& cell = view.leg->cell;
  const auto ofPlaces = [&](double (*f)(double r, const CouetteCell&)) {
    Numbers numbers;
    for (const double r : view.places.r) numbers.push_back(f(r, cell));
    return numbers;
  };
  if (field == "r_m") return ofPlaces([](double r, const CouetteCell&) { return r; });
  if (field == "r_tilde")
    return ofPlaces(
        [](double r, const CouetteCell& c) { return (r - c.innerRadius) / c.diameter; });
  if (field == "r_over_inner")
    return ofPlaces([](double r, const CouetteCell& c) { return r / c.innerRadius; });
  if (field == "xi")
    return ofPlaces([](double r, const CouetteCell& c) {
      return (r - c.innerRadius) / (c.outerRadius - c.innerRadius);
    });
  const Profile* profile = profileOf(*view.profiles, view.method, field);
  return profile ? profile->mean : Numbers(view.places.r.size());
}

}  // namespace

const ThesisLeg* packingLeg(const ThesisResults& results, double label) {
  const auto legs = packingLegs(results);
  const auto found = std::ranges::find_if(
      legs, [&](const ThesisLeg* leg) { return std::abs(leg->label - label) < sameLabel; });
  return found == legs.end() ? nullptr : *found;
}

std::vector<const ThesisLeg*> packingLegs(const ThesisResults& results) {
  std::vector<const ThesisLeg*> legs;
  for (const ThesisLeg& leg : results.legs)
    if (std::ranges::find(leg.families, "packings") != leg.families.end()) legs.push_back(&leg);
  std::ranges::stable_sort(legs, {}, &ThesisLeg::label);
  return legs;
}

std::vector<std::string> enginesWithRuns(const ThesisResults& results) {
  std::vector<std::string> engines;
  for (const ThesisRun& run : results.runs)
    if (run.run.finished() && std::ranges::find(engines, run.engine) == engines.end())
      engines.push_back(run.engine);
  return engines;
}

std::vector<const ThesisRun*> finishedRuns(const ThesisResults& results, const ThesisLeg& leg,
                                           std::string_view engine) {
  std::vector<const ThesisRun*> runs;
  for (const ThesisRun& run : results.runs)
    if (run.leg == leg.name && run.engine == engine && run.run.finished()) runs.push_back(&run);
  return runs;
}

std::optional<RingView> ringViewOf(const ThesisLeg& leg, const ThesisRun& run, RingWidth width,
                                   std::string_view method) {
  RingView view{&leg, &run, &run.run.profiles, std::string(method), {}};
  const auto finest = std::ranges::max_element(run.finer, {}, &RingAverages::rings);
  if (width == RingWidth::finest && finest != run.finer.end()) {
    view.profiles = &finest->profiles;
    view.places = finest->places;
  }
  if (view.profiles->empty()) return std::nullopt;
  if (view.places.r.empty())
    view.places = placesOfCase(leg.cell, view.profiles->front().mean.size());
  if (view.method.empty()) view.method = view.profiles->front().method;
  return view;
}

std::vector<RingView> ringViews(const ThesisResults& results, const ThesisLeg& leg,
                                std::string_view engine, RingWidth width, std::string_view method) {
  std::vector<RingView> views;
  for (const ThesisRun* run : finishedRuns(results, leg, engine))
    if (auto view = ringViewOf(leg, *run, width, method)) views.push_back(std::move(*view));
  return views;
}

Numbers valuesIn(const RingView& view, const Quantity& quantity) {
  Numbers values = fieldIn(view, quantity.field);
  const double scale = quantity.scale ? quantity.scale(*view.leg) : 1.0;
  const auto combine = [&](const std::string& field, auto&& operation) {
    const Numbers other = fieldIn(view, field);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto second = at(other, k);
      values[k] = values[k] && second ? finite(operation(*values[k], *second)) : std::nullopt;
    }
  };
  for (const std::string& field : quantity.times) combine(field, std::multiplies<>());
  if (!quantity.over.empty()) combine(quantity.over, std::divides<>());
  for (auto& value : values)
    if (value) value = quantity.magnitude ? std::abs(*value * scale) : *value * scale;
  return values;
}

MeanOfRuns meanOfRuns(const std::vector<std::optional<double>>& values) {
  std::vector<double> there;
  for (const auto& value : values)
    if (value) there.push_back(*value);
  if (there.empty()) return {};
  const auto count = static_cast<double>(there.size());
  double mean = 0.0, squares = 0.0;
  for (const double value : there) mean += value / count;
  for (const double value : there) squares += (value - mean) * (value - mean);
  if (there.size() < 2) return {mean, {}};
  return {mean, std::sqrt(squares / (count - 1.0) / count)};
}

std::vector<Point> meanPoints(const std::vector<RingView>& views, const Quantity& x,
                              const Quantity& y) {
  std::vector<Point> points;
  if (views.empty()) return points;
  std::vector<Numbers> across, up;
  for (const RingView& view : views) {
    across.push_back(valuesIn(view, x));
    up.push_back(valuesIn(view, y));
  }
  const Profile* single = views.size() == 1 && y.over.empty() && y.times.empty()
                              ? profileOf(*views[0].profiles, views[0].method, y.field)
                              : nullptr;
  for (std::size_t ring = 0; ring < views[0].places.r.size(); ++ring) {
    std::vector<std::optional<double>> xs, ys;
    for (std::size_t k = 0; k < views.size(); ++k) {
      xs.push_back(at(across[k], ring));
      ys.push_back(at(up[k], ring));
    }
    const auto [meanX, errorX] = meanOfRuns(xs);
    const auto [meanY, errorY] = meanOfRuns(ys);
    if (!meanX || !meanY) continue;
    Point point{*meanX, *meanY, errorY};
    if (single)
      if (const auto error = at(single->standardError, ring))
        point.error = *error * std::abs(y.scale ? y.scale(*views[0].leg) : 1.0);
    points.push_back(point);
  }
  return points;
}

}  // namespace crossgrain::reports
