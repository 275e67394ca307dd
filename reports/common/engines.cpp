#include "reports/common/engines.hpp"

#include <array>

namespace crossgrain::reports {

namespace {

/// The open mark that goes with a filled one.
int openMark(int pointType) {
  return pointType - 1;
}

}  // namespace

LineStyle engineStyle(std::size_t index) {
  static const std::array<std::string, 7> colours = {"#000000", "#d55e00", "#0072b2", "#009e73",
                                                     "#cc79a7", "#e69f00", "#56b4e9"};
  static const std::array marks = {7, 5, 9, 13, 11};  // filled: disk, square, triangles, diamond
  return {colours[index % colours.size()], marks[index % marks.size()], false};
}

std::vector<LineStyle> engineStyles(const std::vector<EngineRow>& engines) {
  std::vector<LineStyle> styles(engines.size());
  std::size_t next = 0;
  for (std::size_t k = 0; k < engines.size(); ++k)
    if (engines[k].mirrors.empty()) styles[k] = engineStyle(next++);
  for (std::size_t k = 0; k < engines.size(); ++k) {
    const std::string& peer = engines[k].mirrors;
    if (peer.empty()) continue;
    std::size_t p = 0;
    while (p < engines.size() && engines[p].name != peer) ++p;
    styles[k] = p < engines.size() ? styles[p] : engineStyle(next++);
    styles[k].pointType = openMark(styles[k].pointType);
    styles[k].dashed = true;
  }
  return styles;
}

}  // namespace crossgrain::reports
