#include "runs/cost/front.hpp"

#include <algorithm>
#include <limits>

namespace crossgrain::inline runs {

std::vector<std::size_t> paretoFront(const std::vector<CostPoint>& points) {
  struct Place {
    double time, error;
    std::size_t point;
    auto operator<=>(const Place&) const = default;
  };
  std::vector<Place> places;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (const auto error = countedError(points[k]); error && points[k].wallSeconds)
      places.push_back({*points[k].wallSeconds, *error, k});
  std::ranges::sort(places);
  std::vector<std::size_t> front;
  Place best{0.0, std::numeric_limits<double>::infinity(), 0};
  for (const Place& one : places) {
    const bool equal = one.error == best.error && one.time == best.time;
    if (one.error >= best.error && !equal) continue;
    best = one;
    front.push_back(one.point);
  }
  return front;
}

namespace {

/// @param engine  empty: all
Front frontOf(const std::vector<CostPoint>& points, CostKind kind, const std::string& measure,
              const std::string& engine) {
  std::vector<CostPoint> own;
  std::vector<std::size_t> members;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k].kind != kind || points[k].measure != measure) continue;
    if (!engine.empty() && points[k].engine != engine) continue;
    own.push_back(points[k]);
    members.push_back(k);
  }
  Front front{kind, measure, engine, {}, {}};
  for (const std::size_t k : paretoFront(own)) {
    front.points.push_back(members[k]);
    front.errors.push_back(*countedError(own[k]));
  }
  return front;
}

/// In the order of the points, each once.
template <class Key>
auto distinct(const std::vector<CostPoint>& points, Key key) {
  std::vector<decltype(key(points.front()))> keys;
  for (const CostPoint& point : points)
    if (std::ranges::find(keys, key(point)) == keys.end()) keys.push_back(key(point));
  return keys;
}

}  // namespace

std::vector<Front> paretoFronts(const std::vector<CostPoint>& points) {
  const auto engines = distinct(points, [](const CostPoint& p) { return p.engine; });
  std::vector<Front> fronts;
  for (const auto& [kind, measure] :
       distinct(points, [](const CostPoint& p) { return std::pair(p.kind, p.measure); })) {
    fronts.push_back(frontOf(points, kind, measure, ""));
    for (const std::string& engine : engines)
      if (Front own = frontOf(points, kind, measure, engine); !own.points.empty())
        fronts.push_back(std::move(own));
  }
  return fronts;
}

}  // namespace crossgrain::inline runs
