#include "cli/outcome.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "reports/common/numbers.hpp"
#include "reports/common/overview.hpp"
#include "support/busy_time.hpp"

namespace crossgrain::inline cli {

namespace {

const std::chrono::steady_clock::time_point programBegan = std::chrono::steady_clock::now();

}  // namespace

void printFailure(const std::string& reason) {
  fmt::print(stderr, "crossgrain: {}\n", reason);
}

bool printRefusals(const CommandLine& line, const std::vector<EngineRow>& engines) {
  const std::vector<std::string> refused = refusals(engines, line.run.engines);
  for (const std::string& reason : refused) printFailure(reason);
  return !refused.empty();
}

void printResults(const CommandLine& line, const std::string& text, const Overview& overview,
                  bool timeSpent) {
  if (line.json) {
    fmt::print("{}\n", (line.run.out / "results.json").string());
    return;
  }
  fmt::print("{}", text);
  printOverview(overview);
  fmt::print("report: {}\n", (line.run.out / "report.html").string());
  if (timeSpent && !line.run.quiet) printTimeSpent();
}

int printOutcome(const CommandLine& line, const Outcome& outcome) {
  for (const std::string& reason : outcome.failures) printFailure(reason);
  if (outcome.nothingJudged) nothingWasJudged(line, *outcome.nothingJudged);
  return outcome.status;
}

int told(const std::string& plan) {
  fmt::print("{}", plan);
  return exitHeld;
}

int nothingWasJudged(const CommandLine& line, const std::string& reason, bool byRequest,
                     bool strict) {
  const std::string text = "nothing was judged: " + reason;
  if (line.json)
    fmt::print(stderr, "crossgrain: {}\n", text);
  else
    fmt::print("{}\n", text);
  return byRequest && !strict ? exitHeld : exitFellShort;
}

void printTimeSpent() {
  const std::chrono::duration<double> all = std::chrono::steady_clock::now() - programBegan;
  const double stepping = steppingTime().seconds(), drawing = drawingTime().seconds();
  fmt::print(stderr, "{}: engines stepped for {} ({:.0f} %), plots took {} ({:.0f} %)\n",
             reports::shortDuration(all.count()), reports::shortDuration(stepping),
             100.0 * stepping / all.count(), reports::shortDuration(drawing),
             100.0 * drawing / all.count());
}

void printOverview(const Overview& overview) {
  reports::TextLook look;
  if (::isatty(STDOUT_FILENO) == 1) {
    // https://no-color.org: set to anything but nothing, there are no colours.
    const char* const noColour = std::getenv("NO_COLOR");
    look.coloured = !noColour || *noColour == '\0';
    winsize window{};
    const bool known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0;
    look.width = known ? window.ws_col : 80;
  }
  fmt::print("{}", reports::overviewText(overview, look));
}

}  // namespace crossgrain::inline cli
