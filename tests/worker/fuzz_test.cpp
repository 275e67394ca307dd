/// Any message of a worker is read to a value or to one line of refusal: no crash, no hang, no
/// large allocation. Messages depend on their number alone; tests/fuzz/README.md has how a million
/// are read.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <new>
#include <random>
#include <string_view>

#include "adapters/worker/answer.hpp"
#include "adapters/worker/json.hpp"
#include "adapters/worker/serve.hpp"
#include "support/descriptor.hpp"
#include "tests/support/input_range.hpp"
#include "tests/worker/toy_engine.hpp"

namespace {

std::atomic<std::size_t> largest{0};  ///< allocation [bytes]

}  // namespace

// All of the program's allocations pass here. Not inlined: GCC would take free() for a mistake.
[[gnu::noinline]] void* operator new(std::size_t size) {
  std::size_t before = largest.load();
  while (before < size && !largest.compare_exchange_weak(before, size)) {
  }
  if (void* room = std::malloc(size)) return room;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* room) noexcept {
  std::free(room);
}
[[gnu::noinline]] void operator delete(void* room, std::size_t) noexcept {
  std::free(room);
}

namespace crossgrain {
namespace {

using nlohmann::json;

/// An answer as it might come: the line, and the content of the array file beside it.
struct Message {
  std::string request;  ///< that it answers
  std::string line;
  std::string file;
};

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  /// 0 … count − 1; plain modulo, because the standard's distributions are not the same everywhere
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

 private:
  std::mt19937_64 random_;
};

/// Values that take another's place.
constexpr std::array<std::string_view, 26> values = {
    "null",       "true",    "-1",         "0",        "1e308",
    "1e999",      "-1e999",  "5e-324",     "2.5",      "9223372036854775807",
    "1e18",       "NaN",     "\"\"",       "[]",       "{}",
    "\"x\"",      "[[]]",    "1000000000", "-0.0",     "18446744073709551615",
    "[1,2,3]",    "\"f64\"", "{\"a\":1}",  "Infinity", "4611686018427387904",
    "\"\\ud800\""};

constexpr std::array<std::string_view, 14> pieces = {"{",
                                                     "}",
                                                     "[",
                                                     "]",
                                                     "\"",
                                                     ",",
                                                     ":",
                                                     "\\",
                                                     "\xff",
                                                     "\xc3",
                                                     "\"ok\":true,",
                                                     "\"ok\":false,",
                                                     "\"time\":1,",
                                                     "\"contacts.i\""};

bool startsValue(const std::string& text, std::size_t at) {
  return at > 0 && (text[at - 1] == ':' || text[at - 1] == ',' || text[at - 1] == '[');
}

/// A number, word or text in the line becomes another value.
void replaceValue(std::string& line, Dice& dice) {
  std::size_t at = dice.below(line.size());
  while (at < line.size() && !startsValue(line, at)) ++at;
  if (at >= line.size()) return;
  std::size_t end = line[at] == '"' ? line.find('"', at + 1) : line.find_first_of(",}]", at);
  end = end == std::string::npos ? line.size() : end + (line[at] == '"' ? 1 : 0);
  line.replace(at, end - at, values[dice.below(values.size())]);
}

void changeLine(std::string& line, const std::vector<Message>& answers, Dice& dice) {
  const std::size_t at = dice.below(line.size() + 1), length = dice.below(40);
  switch (dice.below(20)) {
    case 0:
      if (at < line.size()) line[at] = static_cast<char>(dice.below(256));
      return;
    case 1:
      line.erase(at, length);
      return;
    case 2:
      line.insert(at, line.substr(dice.below(line.size() + 1), length));
      return;
    case 3:
      line.insert(at, pieces[dice.below(pieces.size())]);
      return;
    case 4:
      line.resize(at);
      return;
    case 5:  // nested
      line.insert(at, std::string(dice.below(3000), dice.below(2) ? '[' : '{'));
      return;
    case 6: {  // of another answer
      const std::string& other = answers[dice.below(answers.size())].line;
      line.insert(at, other.substr(dice.below(other.size()), dice.below(200)));
      return;
    }
    default:
      replaceValue(line, dice);
  }
}

void changeFile(std::string& file, Dice& dice) {
  const std::size_t at = dice.below(file.size() + 1);
  switch (dice.below(4)) {
    case 0:
      file.resize(at);
      return;
    case 1:
      if (at < file.size()) file[at] = static_cast<char>(dice.below(256));
      return;
    case 2:
      for (std::size_t k = at; k < file.size() && k < at + 8; ++k) file[k] = '\xff';  // a NaN
      return;
    default:
      file.insert(at, dice.below(100), '\0');
  }
}

/// True answers of the toy engine, one to each request.
std::vector<Message> trueAnswers() {
  test::ToyEngine engine("");
  const json effective = jsonOf(engine.load(test::toyScene(), {}));
  engine.advance(0.1);
  ArrayWriter arrays;
  json snapshot = {{"ok", true},
                   {"snapshot", toJson(engine.snapshot(ContactReport::instant), arrays)}};
  snapshot["arrays"] = arrays.list();
  const json hello = {
      {"ok", true}, {"protocol", protocolVersion}, {"capabilities", jsonOf(engine.capabilities())}};
  return {{"hello", hello.dump(), {}},
          {"load", json{{"ok", true}, {"realised", effective}}.dump(), {}},
          {"advance", R"({"ok":true,"time":0.1})", {}},
          {"snapshot",
           snapshot.dump(),
           {reinterpret_cast<const char*>(arrays.bytes().data()), arrays.bytes().size()}},
          {"stats", json{{"ok", true}, {"stats", toJson(engine.stats())}}.dump(), {}},
          {"load", R"({"ok":false,"kind":"unsupported","what":"has no µ"})", {}}};
}

/// The k-th hostile message: a true answer with one to six things wrong. It depends on k alone.
Message hostileMessage(const std::vector<Message>& answers, std::uint64_t k) {
  Dice dice(k);
  Message message = answers[dice.below(answers.size())];
  for (std::size_t wrong = 1 + dice.below(2) * dice.below(6); wrong > 0; --wrong)
    if (message.file.empty() || dice.below(3) > 0)
      changeLine(message.line, answers, dice);
    else
      changeFile(message.file, dice);
  return message;
}

/// A file in memory: a million of them are to be written.
class MemoryFile {
 public:
  std::string path() const { return fmt::format("/proc/self/fd/{}", file_.get()); }
  void write(const std::string& content) const {
    if (::ftruncate(file_.get(), 0) != 0 || ::pwrite(file_.get(), content.data(), content.size(),
                                                     0) != static_cast<ssize_t>(content.size()))
      throw std::logic_error("no memory file");
  }

 private:
  Descriptor file_{::memfd_create("arrays", MFD_CLOEXEC)};
};

class Hostile : public ::testing::Test {
 protected:
  /// As WorkerEngine does. @throws std::exception naming the fault
  void read(const Message& message) {
    const json answer = parseAnswer(message.line);
    if (!answer.at("ok").get<bool>()) {
      asOneLine(answer.at("what"), longestReason);
      static_cast<void>(answer.at("kind"));
      return;
    }
    requireAnswerTo(message.request, answer);
    if (message.request == "hello") readAs<Capabilities>(answer.at("capabilities"));
    if (message.request == "load") readAs<EffectiveParameters>(answer.at("realised"));
    if (message.request == "advance") static_cast<void>(answer.at("time").get<double>());
    if (message.request == "stats") expectSound(statsFromJson(answer.at("stats")));
    if (message.request != "snapshot") return;
    file_.write(message.file);
    expectSound(snapshotFromJson(answer.at("snapshot"),
                                 ArrayReader(file_.path(), answer.at("arrays")), scene_));
  }

  static void expectSound(const Stats& stats) {
    EXPECT_LE(stats.steps, std::uint64_t{1} << 53);
    EXPECT_LE(stats.contactEvaluations, std::uint64_t{1} << 53);
    EXPECT_GE(stats.wallSeconds, 0.0);
    EXPECT_GE(stats.cpuSeconds, 0.0);
  }

  /// A snapshot that was taken can be used without further checks.
  void expectSound(const Snapshot& snapshot) const {
    const auto finite = [](const Vec2& v) { return v.allFinite(); };
    EXPECT_EQ(snapshot.position.size(), scene_.disks.size());
    EXPECT_TRUE(std::ranges::all_of(snapshot.position, finite));
    EXPECT_TRUE(std::ranges::all_of(snapshot.velocity, finite));
    EXPECT_EQ(snapshot.bodies.size(), scene_.bodies.size());
    EXPECT_TRUE(std::isfinite(snapshot.positionTime));
    if (!snapshot.contacts) return;
    const Contacts& contacts = *snapshot.contacts;
    for (std::size_t k = 0; k < contacts.i.size(); ++k) {
      EXPECT_LT(contacts.i[k], contacts.j[k]);
      EXPECT_TRUE(contacts.normal.at(k).allFinite());
      EXPECT_TRUE(std::isfinite(contacts.normalForce.at(k)));
    }
  }

  MemoryFile file_;
  Scene scene_ = test::toyScene();
};

TEST_F(Hostile, AnswersAreAValueOrOneLine) {
  const std::vector<Message> answers = trueAnswers();
  for (const Message& answer : answers) EXPECT_NO_THROW(read(answer)) << answer.line;
  largest = 0;
  std::uint64_t taken = 0, refused = 0;
  std::chrono::duration<double> slowest{0.0};
  const test::InputRange all = test::inputs(10'000);
  for (std::uint64_t k = all.from; k < all.to; ++k) {
    const Message message = hostileMessage(answers, k);
    const auto begin = std::chrono::steady_clock::now();
    try {
      read(message);
      ++taken;
    } catch (const std::exception& error) {
      const std::string line = asOneLine(withoutPrefix(error.what()), longestReason);
      EXPECT_FALSE(line.empty()) << "message " << k;
      EXPECT_EQ(line.find('\n'), std::string::npos) << "message " << k;
      ++refused;
    }
    slowest = std::max<decltype(slowest)>(slowest, std::chrono::steady_clock::now() - begin);
    ASSERT_FALSE(HasFailure()) << "message " << k << ": " << asOneLine(message.line, 2000);
  }
  fmt::print("{} taken, {} refused; the slowest took {:.1f} ms, the largest allocation {} bytes\n",
             taken, refused, 1e3 * slowest.count(), largest.load());
  // Both happen, or the messages would be no test.
  if (all.size() >= 1000) {
    EXPECT_GT(taken, all.size() / 100);
    EXPECT_GT(refused, all.size() / 10);
  }
  EXPECT_LT(largest.load(), std::size_t{1} << 20);
  EXPECT_LT(slowest.count(), 10.0);  // on however busy a machine
}

}  // namespace
}  // namespace crossgrain
