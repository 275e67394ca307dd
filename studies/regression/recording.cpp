#include "studies/regression/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <memory>

#include "adapters/registry.hpp"
#include "adapters/worker/arrays.hpp"
#include "adapters/worker/json.hpp"
#include "cases/assembly_scene.hpp"
#include "cases/collision_scene.hpp"
#include "cases/flow.hpp"
#include "cases/time_step.hpp"
#include "studies/collide/sweep.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/engine_running.hpp"
#include "studies/core/run_store.hpp"
#include "studies/regression/diff.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/fingerprint.hpp"
#include "support/interrupt.hpp"
#include "support/json_text.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline studies {

namespace {

using nlohmann::json;

/// As long as a window of lockstep [s].
constexpr double timeOfCell = 0.1;

/// Where the recording does not say [s].
constexpr double usualTimeout = 120.0;

template <int D>
SceneOf<D> sceneOf(const Case& setup) {
  if (isCollision(setup))
    return sweepScene<D>(setup, collisionStarts(setup), collisionTimeSteps(setup).front());
  if (!hasFlow(setup)) return assemblyScene<D>(setup);
  const double step = timeStep(setup);
  const auto engine = engineRegistry().front().make();
  const auto heed = [](double) { throwIfInterrupted(); };
  return flowScene<D>(setup, flowPacking(setup, 0, step, *engine, heed), step);
}

/// @param dt  the scene's
double timeOf(const Case& setup, double dt, const EffectiveParameters& effective) {
  if (isCollision(setup)) return sweepEnd(setup, dt, effective.dt);
  return isAssembly(setup) ? assemblyDuration(setup) : timeOfCell;
}

ContactReport contactsOf(const Capabilities& can) {
  if (can.instantContacts) return ContactReport::instant;
  return can.accumulatedContacts ? ContactReport::accumulated : ContactReport::none;
}

/// "advance to t = 0.1 s", "snapshot"
std::string describe(const json& request) {
  const auto what = request.at("request").get<std::string>();
  if (what == "advance") return "advance to t = " + request.value("time", json()).dump() + " s";
  return what;
}

template <int D>
void askToLoad(Engine& engine, const Exchange& before) {
  const json& request = before.request;
  const ArrayReader arrays(before.sent, "its array file", request.at("arrays"));
  loadOn<D>(engine, sceneFromJson<D>(request.at("scene"), arrays),
            readAs<Settings>(request.at("settings")));
}

/// Puts a request again; the listener gets the answer.
/// @param dimension  of the scene that was loaded last, which a load sets
void ask(Engine& engine, const Exchange& before, int& dimension) {
  const json& request = before.request;
  const auto what = request.at("request").get<std::string>();
  if (what == "load") {
    dimension = request.at("scene").value("dimension", 2);
    dimension == 3 ? askToLoad<3>(engine, before) : askToLoad<2>(engine, before);
  } else if (what == "advance")
    engine.advance(request.at("time"));
  else if (what == "snapshot" && dimension == 3)
    engine.snapshotInSpace(readAs<ContactReport>(request.at("contacts")));
  else if (what == "snapshot")
    engine.snapshot(readAs<ContactReport>(request.at("contacts")));
  else if (what == "stats")
    engine.stats();
  else
    throw std::runtime_error("it cannot be asked again");
}

/// The value of a key as text, whatever it is.
std::string textAt(const json& in, const char* key) {
  const json text = in.is_object() ? in.value(key, json("")) : json("");
  return text.is_string() ? text.get<std::string>() : text.dump();
}

/// Whether both answers say what the engine is, and not what it does.
bool areDeclarations(const Exchange& before, const Exchange& now) {
  const auto accepted = [](const json& answer) {
    return answer.is_object() && answer.value("ok", json()) == json(true);
  };
  const json& what = before.request.at("request");
  return (what == "hello" || what == "load") && accepted(before.answer) && accepted(now.answer);
}

}  // namespace

Record recordOf(const Exchange& exchange) {
  Record record{{{"request", exchange.request},
                 {"sent", exchange.sent.size()},
                 {"received", exchange.received.size()}},
                exchange.sent + exchange.received};
  // The place of the arrays matters to that run alone.
  record.line["request"].erase("file");
  if (exchange.answer.is_null())
    record.line["failure"] = exchange.failure;
  else
    record.line["answer"] = exchange.answer;
  return record;
}

Exchange exchangeOf(Record record) {
  const json& line = record.line;
  Exchange exchange{
      line.at("request"), {}, line.value("answer", json()), {}, line.value("failure", "")};
  exchange.request.at("request").get<std::string>();
  const auto sent = line.at("sent").get<std::size_t>();
  if (sent > record.bytes.size()) throw std::runtime_error("it has fewer bytes than were sent");
  exchange.sent = record.bytes.substr(0, sent);
  exchange.received = record.bytes.substr(sent);
  return exchange;
}

namespace {

template <int D>
Recorded recordRunIn(const EngineEntry& entry, const Case& setup, const std::filesystem::path& file,
                     const RecordOptions& options) {
  checkEngineSections(setup);
  const SceneOf<D> scene = sceneOf<D>(setup);
  const ScratchFolder scratch;
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  const auto write = [&](const std::string& text) {
    errno = 0;
    out << text << std::flush;
    if (!out) throw OutputError(file, errno);
  };
  write(headText(recordingFormat, {{"engine", entry.name},
                                   {"stamp", entry.command ? entry.command().stamp : ""},
                                   {"case", setup.name},
                                   {"harness", programVersion},
                                   {"timeout", setup.run.timeout}}));
  // Of what did not run no file is to stand in the way of the next try.
  const auto forget = [&] {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
  };
  Recorded recorded;
  try {
    const auto engine =
        startNew(entry, scratch.path, setup.run.timeout, [&](const Exchange& exchange) {
          write(textOf(recordOf(exchange)));
          ++recorded.exchanges;
        });
    const Capabilities can = engine->capabilities();
    recorded.version = can.version;
    const EffectiveParameters effective = loadScene(*engine, entry, setup, scene);
    const double end = options.time.value_or(timeOf(setup, scene.dt, effective));
    snapshotOf<D>(*engine, contactsOf(can));
    for (std::size_t k = 1; k <= options.snapshots; ++k) {
      const double next = end * static_cast<double>(k) / static_cast<double>(options.snapshots);
      advanceInPieces(*engine, effective, recorded.time, next);
      snapshotOf<D>(*engine, contactsOf(can));
      recorded.time = next;
    }
    engine->stats();
  } catch (const EngineFailure& failure) {
    recorded.failure = failure.what();
  } catch (const UnsupportedScene&) {
    forget();
    throw;
  } catch (const BadInput&) {
    forget();
    throw;
  }
  return recorded;
}

}  // namespace

Recorded recordRun(const EngineEntry& entry, const Case& setup, const std::filesystem::path& file,
                   const RecordOptions& options) {
  return inDimensionOf(setup, [&]<int D>() { return recordRunIn<D>(entry, setup, file, options); });
}

ReplayResults replayRun(const std::filesystem::path& recording, const EngineEntry& entry,
                        double tolerance) {
  RecordReader reader(recording, recordingFormat);
  ReplayResults results;
  results.engine = entry.name;
  results.recordedEngine = textAt(reader.head(), "engine");
  results.recordedStamp = textAt(reader.head(), "stamp");
  results.caseName = textAt(reader.head(), "case");
  const json timeout = reader.head().value("timeout", json(usualTimeout));
  const ScratchFolder scratch;
  std::optional<Exchange> now;
  std::unique_ptr<Engine> engine;
  int dimension = 2;
  const auto refuse = [&](const std::string& what) {
    throw BadInput(fmt::format("{}: request {}{}", recording.string(), reader.count(), what));
  };
  while (auto record = reader.next()) {
    throwIfInterrupted();
    Exchange before;
    try {
      before = exchangeOf(*std::move(record));
    } catch (const std::exception& error) {
      refuse(fmt::format(" is no request: {}", withoutPrefix(error.what())));
    }
    ++results.asked;
    now.reset();
    try {
      if (!engine != (before.request.at("request") == "hello"))
        throw std::runtime_error("hello is the first request, and only that");
      if (!engine) {
        if (before.answer.is_object())
          results.recordedVersion = textAt(before.answer.value("capabilities", json()), "version");
        engine = startNew(entry, scratch.path,
                          timeout.is_number() ? timeout.get<double>() : usualTimeout,
                          [&](const Exchange& exchange) { now = exchange; });
        results.version = engine->capabilities().version;
      } else {
        ask(*engine, before, dimension);
      }
    } catch (const UnsupportedScene&) {
      // An answer as any other.
    } catch (const EngineFailure& failure) {
      results.failure = failure.what();
    } catch (const OutputError&) {
      throw;
    } catch (const BadInput&) {
      throw;
    } catch (const std::exception& error) {
      refuse(fmt::format(", {}: {}", describe(before.request), error.what()));
    }
    if (!now) break;  // it did not come to be asked
    auto differences = answerDifferences(before, *now, tolerance);
    if (areDeclarations(before, *now)) {
      std::ranges::move(differences, std::back_inserter(results.declared));
    } else if (!differences.empty()) {
      results.request = describe(before.request);
      results.differences = std::move(differences);
      break;
    }
    if (!engine || now->answer.is_null()) break;  // it has gone
  }
  if (results.asked == 0) throw BadInput(fmt::format("{}: holds no requests", recording.string()));
  return results;
}

Outcome outcomeOf(const ReplayResults& results) {
  if (!results.failure.empty()) return {exitEngineFailed, {results.failure}};
  return {results.request.empty() && results.declared.empty() ? exitPassed : exitFailed};
}

namespace {

std::string checksum(std::string_view line, std::string_view bytes) {
  return fmt::format("{:016x}", fnv1a(bytes, fnv1a(line)));
}

/// "baseline" of "baseline-3"
std::string_view kindOf(std::string_view format) {
  return format.substr(0, format.find('-'));
}

}  // namespace

std::string textOf(const Record& record) {
  json line = record.line;
  line["bytes"] = record.bytes.size();
  // An engine's answer need not be UTF-8.
  const std::string text = line.dump(-1, ' ', false, json::error_handler_t::replace);
  return text + '\n' + record.bytes + checksum(text, record.bytes) + '\n';
}

std::string headText(std::string_view format, json head) {
  head["crossgrain"] = format;
  return textOf({std::move(head), {}});
}

RecordReader::RecordReader(const std::filesystem::path& file, std::string_view format)
    : file_(file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw BadInput(fmt::format("{}: no such file", file.string()));
  length_ = std::filesystem::file_size(file, error);
  in_.open(file, std::ios::binary);
  std::optional<Record> first;
  try {
    first = next();
  } catch (const BadInput&) {
    // Reported below.
  }
  if (!first || !first->line.contains("crossgrain"))
    throw BadInput(fmt::format("{0}: is no {1}; `crossgrain {2} CASE --out FILE` makes one",
                               file.string(), kindOf(format),
                               format.starts_with("recording") ? "record" : kindOf(format)));
  head_ = std::move(first->line);
  count_ = 0;
  if (head_["crossgrain"] != format)
    throw BadInput(fmt::format("{}: has format {}, this crossgrain reads \"{}\"", file.string(),
                               asOneLine(head_["crossgrain"].dump(), 60), format));
}

std::optional<Record> RecordReader::next() {
  if (in_.peek() == std::ifstream::traits_type::eof()) return std::nullopt;
  ++count_;
  const auto damaged = [&](const std::string& what) {
    return BadInput(fmt::format("{}: is damaged: record {} {}", file_.string(), count_, what));
  };
  Record record;
  std::string text, sum;
  std::getline(in_, text);
  try {
    record.line = parseJson(text);
  } catch (const std::exception& error) {
    throw damaged(error.what());
  }
  const json bytes = record.line.is_object() ? record.line.value("bytes", json()) : json();
  const auto at = static_cast<std::uintmax_t>(std::max<std::streamoff>(0, in_.tellg()));
  if (!bytes.is_number_unsigned() || bytes.get<std::uintmax_t>() > length_ - std::min(at, length_))
    throw damaged("is cut off");
  record.bytes.resize(bytes.get<std::size_t>());
  in_.read(record.bytes.data(), static_cast<std::streamsize>(record.bytes.size()));
  std::getline(in_, sum);
  if (in_.eof()) throw damaged("is cut off");
  if (sum != checksum(text, record.bytes)) throw damaged("is not what its checksum says");
  return record;
}

Record RecordReader::require() {
  if (auto record = next()) return *std::move(record);
  throw BadInput(fmt::format("{}: is damaged: it ends after {} records", file_.string(), count_));
}

}  // namespace crossgrain::inline studies
