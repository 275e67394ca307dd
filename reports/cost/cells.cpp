#include "reports/cost/cells.hpp"

#include <fmt/format.h>

#include <array>

namespace crossgrain::reports {

Json headOf(const CostEngine& engine) {
  return {
      {"engine", engine.name}, {"colour", engine.style.colour}, {"dashed", engine.style.dashed}};
}

Json verdictCell(CostVerdict verdict, const std::string& text, std::vector<std::string> lines) {
  struct Mark {
    const char *symbol, *style;
  };
  constexpr std::array<Mark, 4> marks = {
      {{"✓", "agree"}, {"○", "undecided"}, {"✗", "disagree"}, {"…", ""}}};
  const Mark mark = marks[static_cast<std::size_t>(verdict)];
  std::erase(lines, std::string());
  return {{"symbol", mark.symbol}, {"class", mark.style}, {"text", text}, {"lines", lines}};
}

std::string decidesText(const std::string& decides) {
  return decides.empty() ? "" : "would tell: " + decides;
}

std::string lengthText(std::optional<double> length) {
  return length ? fmt::format("long enough: {:.2g} × these runs", *length) : "";
}

}  // namespace crossgrain::reports
