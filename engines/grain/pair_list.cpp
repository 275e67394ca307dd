#include "engines/grain/pair_list.hpp"

#include <algorithm>
#include <tuple>

namespace grain {
namespace {

/// Of two centres, 0 where any overlap will do [m].
double leastDistance(double a, double b, double maxOverlap) {
  return std::max(a + b - maxOverlap * std::min(a, b), 0.0);
}

}  // namespace

template <class Real>
void PairList<Real>::clear() {
  farI.clear();
  farJ.clear();
  count = 0;
}

template <class Real>
void PairList<Real>::append(std::int32_t diskI, std::int32_t diskJ) {
  farI.push_back(diskI);
  farJ.push_back(diskJ);
}

/// Each kind of memory that pairs have: visit(by near pair, by far pair, of a kept one).
template <class Real, class Visit>
void forMemories(PairList<Real>& list, PairSprings springs, Visit&& visit) {
  if (springs.sliding) visit(list.spring, list.farSpring, &KeptSpring::spring);
  if (springs.rolling) visit(list.angle, list.farAngle, &KeptSpring::angle);
  if (springs.memory) visit(list.memory, list.farMemory, &KeptSpring::memory);
  if (springs.rest) visit(list.rest, list.farRest, &KeptSpring::rest);
}

template <class Real>
void PairList<Real>::storeSprings(PairSprings springs) {
  forMemories(*this, springs, [this](const auto& near, auto& all, auto) {
    for (std::size_t k = 0; k < count; ++k) all[far[k]] = near[k];
  });
}

template <class Real>
void PairList<Real>::carry(PairSprings springs) {
  kept.clear();
  for (std::size_t p = 0; p < farI.size(); ++p) {
    KeptSpring pair{farI[p], farJ[p], 0.0, 0.0};
    bool any = false;
    forMemories(*this, springs, [&](const auto&, const auto& all, auto member) {
      pair.*member = all[p];
      any |= all[p] != Real(0);
    });
    if (any) kept.push_back(pair);
  }
}

template <class Real>
void PairList<Real>::takeKept(PairSprings springs) {
  forMemories(*this, springs,
              [this](const auto&, auto& all, auto) { all.assign(farI.size(), Real(0)); });
  auto next = kept.begin();
  for (std::size_t p = 0; p < farI.size(); ++p) {
    while (next != kept.end() && std::tie(next->i, next->j) < std::tie(farI[p], farJ[p])) ++next;
    if (next == kept.end()) return;
    if (next->i != farI[p] || next->j != farJ[p]) continue;
    forMemories(*this, springs, [&](const auto&, auto& all, auto member) {
      all[p] = static_cast<Real>(*next.*member);
    });
  }
}

/// @pre there is one
template <class Real>
TooDeep PairList<Real>::firstDeep(const Places& now, double maxOverlap) const {
  for (std::size_t p = 0;; ++p) {
    const auto a = static_cast<std::size_t>(farI[p]);
    const auto b = static_cast<std::size_t>(farJ[p]);
    const Vec<double> d = now.position[a] - now.position[b];
    const double closest = leastDistance(now.radius[a], now.radius[b], maxOverlap);
    if (d.x * d.x + d.y * d.y <= closest * closest) return {a, b};
  }
}

template <class Real>
std::size_t PairList<Real>::chooseNear(const Places& now, std::span<const double> allowance,
                                       double maxOverlap, PairSprings springs, double range) {
  const std::size_t room = farI.size();
  for (auto* ids : {&i, &j})
    if (ids->size() < room) ids->resize(room);
  if (far.size() < room) far.resize(room);
  for (auto* radii : {&radiusI, &radiusJ})
    if (radii->size() < room) radii->resize(room);
  forMemories(*this, springs, [room](auto& near, const auto&, auto) {
    if (near.size() < room) near.resize(room);
  });
  std::size_t n = 0, touching = 0, deep = 0;
  for (std::size_t p = 0; p < room; ++p) {
    const auto a = static_cast<std::size_t>(farI[p]);
    const auto b = static_cast<std::size_t>(farJ[p]);
    const Vec<double> d = now.position[a] - now.position[b];
    const double distance2 = d.x * d.x + d.y * d.y;
    const double reach = now.radius[a] + now.radius[b];
    // Written whether near or not: the next pair overwrites it, and there is no branch to guess.
    i[n] = farI[p];
    j[n] = farJ[p];
    far[n] = static_cast<std::uint32_t>(p);
    radiusI[n] = static_cast<Real>(now.radius[a]);
    radiusJ[n] = static_cast<Real>(now.radius[b]);
    const double within = reach + range + allowance[a] + allowance[b];
    n += distance2 < within * within;
    touching += distance2 < reach * reach;
    const double closest = leastDistance(now.radius[a], now.radius[b], maxOverlap);
    deep += distance2 <= closest * closest;
  }
  if (deep > 0) throw firstDeep(now, maxOverlap);
  count = n;
  forMemories(*this, springs, [this](auto& near, const auto& all, auto) {
    for (std::size_t k = 0; k < count; ++k) near[k] = all[far[k]];
  });
  if (now.origin.empty()) return touching;
  shift.resize(room);
  for (std::size_t k = 0; k < count; ++k) {
    const Vec<float> between =
        now.origin[static_cast<std::size_t>(i[k])] - now.origin[static_cast<std::size_t>(j[k])];
    shift[k] = {static_cast<Real>(between.x), static_cast<Real>(between.y)};
  }
  return touching;
}

template <class Real>
PairView<Real> PairList<Real>::view(AddTo addTo, bool record, bool rotation, bool rolls) {
  if (record)
    for (auto* array : {&normal, &tangential, &sliding}) array->resize(i.size());
  if (record && rolls)
    for (auto* array : {&rolling, &rollingSlides}) array->resize(i.size());
  if (addTo == AddTo::none) force.resize(i.size());
  if (addTo == AddTo::none && rotation) {
    leverI.resize(i.size());
    leverJ.resize(i.size());
  }
  return {count,
          i.data(),
          j.data(),
          radiusI.data(),
          radiusJ.data(),
          shift.data(),
          {spring.empty() ? nullptr : spring.data(), angle.empty() ? nullptr : angle.data(),
           memory.empty() ? nullptr : memory.data(), rest.empty() ? nullptr : rest.data()},
          record ? normal.data() : nullptr,
          record ? tangential.data() : nullptr,
          record ? sliding.data() : nullptr,
          record && rolls ? rolling.data() : nullptr,
          record && rolls ? rollingSlides.data() : nullptr,
          addTo,
          {force.data(), leverI.data(), leverJ.data()}};
}

template struct PairList<double>;
template struct PairList<float>;

}  // namespace grain
