#include "studies/core/executor.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "support/numbers.hpp"
#include "support/terminal.hpp"

namespace crossgrain::inline studies {

using Clock = std::chrono::steady_clock;

namespace {

/// A terminal that has gone must not end a run, so nothing is thrown.
template <typename... Values>
void show(fmt::format_string<Values...> text, Values&&... values) {
  std::fputs(fmt::format(text, std::forward<Values>(values)...).c_str(), stderr);
}

}  // namespace

std::string timeLeft(double fraction, double elapsed) {
  if (fraction <= 0.01 || elapsed < 1.0) return "estimating the time left";
  const auto seconds = static_cast<long>(std::ceil(elapsed * (1.0 - fraction) / fraction));
  if (seconds < 60) return fmt::format("{} s left", seconds);
  if (seconds < 3600) return fmt::format("{} min {:02d} s left", seconds / 60, seconds % 60);
  return fmt::format("{} h {:02d} min left", seconds / 3600, seconds / 60 % 60);
}

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  const std::scoped_lock lock(mutex_);
  showKept();
}

void Progress::begin(const std::string& stage, std::vector<double> weights) {
  const std::scoped_lock lock(mutex_);
  erase();
  stage_ = stage;
  weights_ = std::move(weights);
  fractions_.assign(weights_.size(), 0.0);
  finished_ = 0;
  running_.assign(weights_.size(), {});
  started_ = drawn_ = Clock::now();
  headShown_ = false;
}

/// Before anything of a stage: one without work is none.
void Progress::showHead() {
  if (std::exchange(headShown_, true)) return;
  showKept();
  if (!quiet_ && !terminal_) show("{}: {} to do\n", stage_, weights_.size());
}

void Progress::update(std::size_t index, const std::string& label, double fraction) {
  const std::scoped_lock lock(mutex_);
  showHead();
  fractions_[index] = fraction;
  running_[index] = fmt::format("{} {:.0f} %", label, 100.0 * fraction);
  draw();
}

void Progress::finish(std::size_t index, const std::string& line) {
  const std::scoped_lock lock(mutex_);
  fractions_[index] = 1.0;
  running_[index].clear();
  ++finished_;
  if (line.empty()) return;
  showHead();
  if (quiet_) return;
  erase();
  show("[{}/{}] {}\n", finished_, fractions_.size(), line);
  drawn_ = {};
  draw();
}

void Progress::keep(std::size_t count, const std::string& noun) {
  const std::scoped_lock lock(mutex_);
  if (count > 0) kept_[noun] += count;
}

void Progress::showKept() {
  erase();
  std::string text;
  for (const auto& [noun, count] : kept_)
    text += (text.empty() ? "" : " and ") + counted(count, noun);
  if (!quiet_ && !text.empty()) show("{} kept\n", text);
  kept_.clear();
}

void Progress::say(const std::string& line) {
  const std::scoped_lock lock(mutex_);
  if (quiet_) return;
  erase();
  show("{}\n", line);
}

void Progress::draw() {
  using namespace std::chrono_literals;
  if (quiet_ || !terminal_ || Clock::now() - drawn_ < 200ms) return;
  drawn_ = Clock::now();
  const double whole = std::accumulate(weights_.begin(), weights_.end(), 0.0);
  const double done = std::inner_product(weights_.begin(), weights_.end(), fractions_.begin(), 0.0);
  const double fraction = whole > 0.0 ? done / whole : 0.0;
  const double elapsed = std::chrono::duration<double>(drawn_ - started_).count();
  std::string line =
      fmt::format("{}: {:3.0f} %, {}", stage_, 100.0 * fraction, timeLeft(fraction, elapsed));
  for (const std::string& label : running_)
    if (!label.empty()) line += "  ·  " + label;

  const std::size_t width = terminalWidth(STDERR_FILENO);
  if (line.size() > width) line.resize(width);
  while (!line.empty() && (static_cast<unsigned char>(line.back()) & 0x80u) != 0) line.pop_back();
  show("\r\033[K{}", line);
  std::fflush(stderr);
  lineOpen_ = true;
}

void Progress::erase() {
  if (lineOpen_) std::fputs("\r\033[K", stderr);
  lineOpen_ = false;
}

using nlohmann::json;

namespace {

/// Wall time that an engine took for a run, of whatever kind, or for each of some [s]; 0 where it
/// does not say.
double wallSeconds(const json& kept) {
  if (kept.is_array()) {
    double sum = 0.0;
    for (const json& each : kept) sum += wallSeconds(each);
    return sum;
  }
  const json stats = kept.is_object() ? kept.value("stats", json()) : json();
  return stats.is_object() ? stats.value("wall_s", 0.0) : 0.0;
}

std::string duration(double seconds) {
  if (seconds < 100.0) return fmt::format("{:.2g} s", seconds);
  return seconds < 6000.0 ? fmt::format("{:.0f} min", seconds / 60.0)
                          : fmt::format("{:.1f} h", seconds / 3600.0);
}

/// Of the rest, if those that are finished say; 0 if not.
double secondsLeft(const PlannedWork& work) {
  if (work.finished == 0) return 0.0;
  return work.seconds / static_cast<double>(work.finished) *
         static_cast<double>(work.total - work.finished);
}

}  // namespace

void count(PlannedWork& work, const std::optional<json>& kept) {
  ++work.total;
  if (!kept) return;
  ++work.finished;
  work.seconds += wallSeconds(*kept);
}

std::string describe(const PlannedWork& work) {
  if (!work.refusal.empty()) return fmt::format("  {:<24} cannot: {}\n", work.engine, work.refusal);
  const std::size_t left = work.total - work.finished;
  const double seconds = secondsLeft(work);
  return fmt::format("  {:<24} {} {}: {} finished, {} to do{}\n", work.engine, work.total,
                     work.what, work.finished, left,
                     left == 0       ? ""
                     : seconds > 0.0 ? ", about " + duration(seconds) + " of computing"
                                     : ", time not known yet");
}

std::string describeDryRun(const std::string& head, const std::vector<PlannedWork>& works,
                           const RunStore& store, const RunCommand& command) {
  std::string text = head;
  for (const PlannedWork& work : works) text += describe(work);
  return text + fmt::format("into {}, {} side by side; nothing was run, nothing written\n",
                            store.folder().string(), command.jobs);
}

}  // namespace crossgrain::inline studies
