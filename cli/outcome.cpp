#include "cli/outcome.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "reports/common/overview.hpp"
#include "support/busy_time.hpp"
#include "support/numbers.hpp"
#include "support/terminal.hpp"

namespace crossgrain::inline cli {

namespace {

const std::chrono::steady_clock::time_point programBegan = std::chrono::steady_clock::now();

void printTimeSpent() {
  const std::chrono::duration<double> all = std::chrono::steady_clock::now() - programBegan;
  const double stepping = steppingTime().seconds(), drawing = drawingTime().seconds();
  fmt::print(stderr, "{}: engines stepped for {} ({:.0f} %), plots took {} ({:.0f} %)\n",
             shortDuration(all.count()), shortDuration(stepping), 100.0 * stepping / all.count(),
             shortDuration(drawing), 100.0 * drawing / all.count());
}

/// The text without the middle of long runs of digits, and of a long text. Characters of several
/// bytes stay whole.
std::string shortened(const std::string& text) {
  constexpr std::size_t mostDigits = 40, begin = 900, end = 300;
  std::string some;
  std::size_t digits = 0;
  for (const char c : text) {
    digits = c >= '0' && c <= '9' ? digits + 1 : 0;
    if (digits <= mostDigits) some += c;
    if (digits == mostDigits + 1) some += "…";
  }
  if (some.size() <= begin + end) return some;
  const auto isWithin = [&](std::size_t at) {
    return (static_cast<unsigned char>(some[at]) & 0xc0u) == 0x80u;
  };
  std::size_t head = begin, tail = some.size() - end;
  while (isWithin(head)) --head;
  while (isWithin(tail)) ++tail;
  return some.substr(0, head) + " … " + some.substr(tail);
}

}  // namespace

void printFailure(const std::string& reason) {
  printLines(stderr, fmt::format("crossgrain: {}\n", shortened(reason)));
}

void printResults(const CommandLine& line, const std::string& text,
                  const reports::Overview& overview, bool timeSpent) {
  if (line.json) {
    fmt::print("{}\n", (line.run.out / "results.json").string());
    return;
  }
  printText(text);
  printOverview(overview);
  fmt::print("report: {}\n", (line.run.out / "report.html").string());
  if (timeSpent && !line.run.quiet) printTimeSpent();
}

void printJson(const nlohmann::json& results) {
  fmt::print("{}\n", results.dump());
}

int printPlanned(const CommandLine& line, const std::string& what) {
  if (line.json)
    printJson({{"planned", what}});
  else
    printText(what + "; nothing was done\n");
  return exitPassed;
}

int printOutcome(const CommandLine& line, const Outcome& outcome) {
  for (const std::string& reason : outcome.failures) printFailure(reason);
  const auto print = [&](const std::string& sentence) {
    if (line.json)
      printLines(stderr, fmt::format("crossgrain: {}\n", sentence));
    else
      printText(sentence);
  };
  if (outcome.nothingJudged) print("nothing was judged: " + *outcome.nothingJudged);
  if (outcome.status == exitFailed && !outcome.fails.empty())
    print(fmt::format("status 1: {}", fmt::join(outcome.fails, "; ")));
  return outcome.status;
}

void printText(const std::string& text) {
  fmt::print("{}", wrappedLines(text, terminalWidth(STDOUT_FILENO)));
}

void printOverview(const reports::Overview& overview) {
  reports::TextLook look{terminalWidth(STDOUT_FILENO)};
  if (::isatty(STDOUT_FILENO) == 1) {
    // https://no-color.org: set to anything but nothing, there are no colours.
    const char* const noColour = std::getenv("NO_COLOR");
    look.coloured = !noColour || *noColour == '\0';
  }
  fmt::print("{}", reports::overviewText(overview, look));
}

}  // namespace crossgrain::inline cli
