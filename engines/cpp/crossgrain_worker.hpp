#pragma once

// The worker's side of the protocol (adapters/worker/README.md) for engines in C++17: framing,
// arrays, errors. Needs nlohmann's json.hpp and nothing of the project.
//
// serve(engine) answers requests with the members of `engine`:
//     Json capabilities();
//     Json load(const Json& scene, const Arrays& arrays, const Json& settings);  throws Unsupported
//     double advance(double time);
//     Json snapshot(const std::string& contacts, ArrayFile& arrays);
//     Json stats();
// and, of an engine with the capability `checkpoints`, all that its future depends on:
//     void checkpoint(const std::string& file);
//     void restore(const std::string& file);  after a load of the same scene
// Json objects are the protocol's; arrays go under the protocol's names.

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace crossgrain_worker {

using Json = nlohmann::json;

/// The engine cannot do what the scene calls for; the text names the first such thing.
struct Unsupported : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The arrays of a scene by name. All are f64 but `disks.material`, whose numbers are doubles here.
using Arrays = std::map<std::string, std::vector<double>>;

inline Arrays readArrays(const std::string& path, const Json& entries) {
  std::ifstream file(path, std::ios::binary);
  Arrays arrays;
  for (const Json& entry : entries) {
    const auto count = entry.at("count").get<std::size_t>();
    const auto read = [&](auto values) {
      file.seekg(entry.at("offset").get<std::streamoff>());
      file.read(reinterpret_cast<char*>(values.data()),
                static_cast<std::streamsize>(values.size() * sizeof values[0]));
      if (!file) throw std::runtime_error(path + " is too short");
      arrays[entry.at("name")] = {values.begin(), values.end()};
    };
    if (entry.at("type") == "i32")
      read(std::vector<std::int32_t>(count));
    else
      read(std::vector<double>(count));
  }
  return arrays;
}

/// A file of arrays that is being written.
class ArrayFile {
 public:
  /// Over what is there, and not cut off first: the harness names one file again and again.
  explicit ArrayFile(const std::string& path)
      : file_(path, std::ios::binary | std::ios::in | std::ios::out) {
    if (!file_) file_.open(path, std::ios::binary | std::ios::out);
  }

  void add(const std::string& name, const std::vector<double>& values) { put(name, "f64", values); }
  void add(const std::string& name, const std::vector<std::int32_t>& values) {
    put(name, "i32", values);
  }
  void add(const std::string& name, const std::vector<std::uint8_t>& values) {
    put(name, "u8", values);
  }

  /// Ends the file. @returns the list that describes it
  const Json& close() {
    file_.close();
    if (!file_) throw std::runtime_error("an array file cannot be written");
    return entries_;
  }

 private:
  template <typename T>
  void put(const std::string& name, const char* type, const std::vector<T>& values) {
    while (offset_ % 8 != 0) {
      file_.put(0);
      ++offset_;
    }
    entries_.push_back(
        {{"name", name}, {"type", type}, {"count", values.size()}, {"offset", offset_}});
    const std::size_t bytes = values.size() * sizeof(T);
    file_.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(bytes));
    offset_ += bytes;
  }

  std::fstream file_;
  std::size_t offset_ = 0;
  Json entries_ = Json::array();
};

/// Steps done of a run and what they took, for `advance` and `stats`.
class StepCount {
 public:
  StepCount() = default;
  /// @param steps  done before, of a run that is restored
  explicit StepCount(double dt, long long steps = 0) : dt_(dt), steps_(steps) {}

  long long steps() const { return steps_; }

  double now() const { return static_cast<double>(steps_) * dt_; }

  /// Has steps done until `time`; in each, now() is its end. @returns now()
  template <typename Step>
  double advance(double time, const Step& step) {
    using Clock = std::chrono::steady_clock;
    const auto wall = Clock::now();
    const std::clock_t cpu = std::clock();
    while (steps_ < std::llround(time / dt_)) {
      ++steps_;
      step();
    }
    wallSeconds_ += std::chrono::duration<double>(Clock::now() - wall).count();
    cpuSeconds_ += static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    return now();
  }

  Json stats(unsigned long long evaluations, Json counters = Json::object()) const {
    return {{"steps", steps_},
            {"contact_evaluations", evaluations},
            {"wall_seconds", wallSeconds_},
            {"cpu_seconds", cpuSeconds_},
            {"counters", std::move(counters)}};
  }

 private:
  double dt_ = 0.0;
  long long steps_ = 0;
  double wallSeconds_ = 0.0, cpuSeconds_ = 0.0;
};

template <typename Engine, typename = void>
struct HasCheckpoints : std::false_type {};
template <typename Engine>
struct HasCheckpoints<Engine,
                      std::void_t<decltype(&Engine::checkpoint), decltype(&Engine::restore)>>
    : std::true_type {};

template <typename Engine>
Json answer(Engine& engine, const Json& request) {
  const std::string what = request.at("request");
  if (what == "hello")
    return {{"protocol", 1}, {"capabilities", engine.capabilities()}, {"writes_over", true}};
  if (what == "load") {
    const Arrays arrays = readArrays(request.at("file"), request.at("arrays"));
    return {{"realised", engine.load(request.at("scene"), arrays, request.at("settings"))}};
  }
  if (what == "advance") return {{"time", engine.advance(request.at("time"))}};
  if (what == "snapshot") {
    ArrayFile arrays(request.at("file"));
    Json snapshot = engine.snapshot(request.at("contacts"), arrays);
    return {{"snapshot", std::move(snapshot)}, {"arrays", arrays.close()}};
  }
  if (what == "stats") return {{"stats", engine.stats()}};
  if (what == "quit") return Json::object();
  if constexpr (HasCheckpoints<Engine>::value) {
    const std::string file = request.value("file", "");
    if (what == "checkpoint") return engine.checkpoint(file), Json::object();
    if (what == "restore") return engine.restore(file), Json::object();
  }
  throw std::runtime_error("no request '" + what + "'");
}

/// Answers requests until "quit" or until they end. @returns the exit status of the program
template <typename Engine>
int serve(Engine&& engine) {
  std::FILE* const requests = fdopen(3, "r");
  std::FILE* const replies = fdopen(4, "w");
  if (!requests || !replies) return 2;
  std::string line;
  for (int c = 0; (c = std::fgetc(requests)) != EOF;) {
    if (c != '\n') {
      line += static_cast<char>(c);
      continue;
    }
    const Json request = Json::parse(line);
    line.clear();
    Json reply;
    try {
      reply = answer(engine, request);
      reply["ok"] = true;
    } catch (const Unsupported& refusal) {
      reply = {{"ok", false}, {"kind", "unsupported"}, {"what", refusal.what()}};
    } catch (const std::exception& error) {
      reply = {{"ok", false}, {"kind", "failed"}, {"what", error.what()}};
    }
    std::fflush(stdout);  // what it printed is in the log of this run, and not of the next
    const std::string text = reply.dump() + "\n";
    std::fwrite(text.data(), 1, text.size(), replies);
    std::fflush(replies);
    if (request.at("request") == "quit") return 0;
  }
  return 0;
}

}  // namespace crossgrain_worker
