#include "reports/common/engines.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "adapters/registry.hpp"
#include "support/fingerprint.hpp"

namespace crossgrain::reports {

namespace {

const std::array<std::string, 7> enginesColours = {"#000000", "#d55e00", "#0072b2", "#009e73",
                                                   "#cc79a7", "#e69f00", "#56b4e9"};
/// Filled disk, square, triangle, diamond. Not the other triangle, whose open one stands for an
/// upper bound in plots of cost.
constexpr std::array filledMarks = {7, 5, 9, 13};

/// Darker ones, for engines that this build does not know; each with all filledMarks.
const std::array<std::string, 7> externalColours = {"#882255", "#332288", "#117733", "#999933",
                                                    "#661100", "#e69f00", "#56b4e9"};
constexpr std::size_t externalStyles = externalColours.size() * filledMarks.size();

/// The open mark that goes with a filled one.
int openMark(int pointType) {
  return pointType - 1;
}

/// Engines of this build that are no mirrors: their place among themselves.
std::optional<std::size_t> placeOf(const std::string& name) {
  std::size_t place = 0;
  for (std::size_t k = 0; k < builtInEngines(); ++k) {
    const EngineEntry& entry = engineRegistry()[k];
    if (!entry.mirrors.empty()) continue;
    if (entry.name == name) return place;
    ++place;
  }
  return std::nullopt;
}

/// The peer that a mirror of this build is of; empty of others.
std::string peerOf(const std::string& name) {
  for (std::size_t k = 0; k < builtInEngines(); ++k)
    if (engineRegistry()[k].name == name) return engineRegistry()[k].mirrors;
  return {};
}

LineStyle strangersStyle(std::size_t number) {
  return {externalColours[number % externalColours.size()],
          filledMarks[number / externalColours.size() % filledMarks.size()], false};
}

LineStyle asMirror(LineStyle style) {
  style.pointType = openMark(style.pointType);
  style.dashed = true;
  return style;
}

/// Who gives an engine its colour: its peer, of a mirror, else itself.
std::string ownerOf(const EngineRow& engine) {
  if (!engine.mirrors.empty()) return engine.mirrors;
  const std::string peer = peerOf(engine.name);
  return peer.empty() ? engine.name : peer;
}

}  // namespace

const std::string& inHouse() {
  return engineRegistry().front().name;
}

LineStyle engineStyle(std::size_t index) {
  return {enginesColours[index % enginesColours.size()], filledMarks[index % filledMarks.size()],
          false};
}

std::vector<LineStyle> engineStyles(const std::vector<EngineRow>& engines) {
  std::map<std::string, LineStyle> styles;  // by owner
  std::vector<bool> taken(externalStyles, false);
  for (const EngineRow& engine : engines) {
    const std::string owner = ownerOf(engine);
    if (styles.contains(owner)) continue;
    if (const auto place = placeOf(owner)) {
      styles[owner] = engineStyle(*place);
      continue;
    }
    // The same on every machine, but for a colour that another engine has.
    const std::size_t first = fnv1a(owner) % externalStyles;
    std::size_t number = first;
    const auto find = [&](auto&& isFree) {
      for (std::size_t tried = 0; tried < externalStyles; ++tried) {
        number = (first + tried) % externalStyles;
        if (isFree()) return true;
      }
      return false;
    };
    const auto ownColour = [&] {
      for (std::size_t k = number % externalColours.size(); k < externalStyles;
           k += externalColours.size())
        if (taken[k]) return false;
      return true;
    };
    if (!find(ownColour)) find([&] { return !taken[number]; });
    taken[number] = true;
    styles[owner] = strangersStyle(number);
  }
  std::vector<LineStyle> result;
  for (const EngineRow& engine : engines) {
    const std::string owner = ownerOf(engine);
    result.push_back(owner == engine.name ? styles[owner] : asMirror(styles[owner]));
  }
  return result;
}

}  // namespace crossgrain::reports
