/// What a worker says is read to a value or to one line of refusal, whatever it is: no crash, no
/// hang, no large allocation. Messages depend on their number alone; tests/fuzz/README.md has how a
/// million are read.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <new>

#include "adapters/worker/answer.hpp"
#include "adapters/worker/json.hpp"
#include "support/descriptor.hpp"
#include "tests/support/input_range.hpp"
#include "tests/worker/hostile_messages.hpp"
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
using test::Message;

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
  /// As WorkerEngine does. @throws std::exception what is wrong with it
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

  /// What is taken can be used without a further look.
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
  const std::vector<Message> answers = test::trueAnswers();
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
