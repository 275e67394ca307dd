#include "runs/record/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>

#include "adapters/worker/arrays.hpp"
#include "adapters/worker/json.hpp"
#include "runs/common/engine_access.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/interrupt.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline runs {
namespace {

using nlohmann::json;

/// Where the recording does not say [s].
constexpr double usualTimeout = 120.0;

std::string inWords(const json& request) {
  const auto what = request.at("request").get<std::string>();
  if (what == "advance") return "advance to t = " + request.value("time", json()).dump() + " s";
  return what;
}

/// Asks one thing again; the listener hears the answer.
void ask(Engine& engine, const Exchange& then, const std::filesystem::path& scratch) {
  const json& request = then.request;
  const auto what = request.at("request").get<std::string>();
  if (what == "load") {
    const std::filesystem::path file = scratch / "recorded.bin";
    writeFile(file, then.sent);
    engine.load(sceneFromJson(request.at("scene"), ArrayReader(file, request.at("arrays"))),
                settingsFromJson(request.at("settings")));
  } else if (what == "advance") {
    engine.advance(request.at("time"));
  } else if (what == "snapshot") {
    engine.snapshot(contactReportFromJson(request.at("contacts")));
  } else if (what == "stats") {
    engine.stats();
  } else {
    throw std::runtime_error("it cannot be asked again");
  }
}

/// The value of a key as text, whatever it is.
std::string textOf(const json& in, const char* key) {
  const json text = in.is_object() ? in.value(key, json("")) : json("");
  return text.is_string() ? text.get<std::string>() : text.dump();
}

/// Whether the answer says what the engine is, and not what it does.
bool isDeclaration(const json& request) {
  return request.at("request") == "hello" || request.at("request") == "load";
}

bool bothAccept(const Exchange& then, const Exchange& now) {
  const json yes(true);
  return then.answer.is_object() && then.answer.value("ok", json()) == yes &&
         now.answer.is_object() && now.answer.value("ok", json()) == yes;
}

}  // namespace

Replayed replayRun(const std::filesystem::path& recording, const EngineEntry& entry,
                   double tolerance) {
  ExchangeReader reader(recording);
  Replayed result;
  result.engine = entry.name;
  result.recordedEngine = textOf(reader.head(), "engine");
  result.recordedStamp = textOf(reader.head(), "stamp");
  result.caseName = textOf(reader.head(), "case");
  const json timeout = reader.head().value("timeout", json(usualTimeout));
  const ScratchFolder scratch;
  std::optional<Exchange> now;
  std::unique_ptr<Engine> engine;
  while (const auto then = reader.next()) {
    throwIfInterrupted();
    const bool first = !engine;
    if (first != (then->request.at("request") == "hello"))
      throw BadInput(
          fmt::format("{}: hello is not its first request, and only that", recording.string()));
    ++result.asked;
    now.reset();
    try {
      if (first) {
        if (then->answer.is_object())
          result.recordedVersion = textOf(then->answer.value("capabilities", json()), "version");
        engine = startNew(entry, scratch.path,
                          timeout.is_number() ? timeout.get<double>() : usualTimeout,
                          [&](const Exchange& heard) { now = heard; });
        result.version = engine->capabilities().version;
      } else {
        ask(*engine, *then, scratch.path);
      }
    } catch (const UnsupportedScene&) {
      // An answer as any other.
    } catch (const EngineFailure& failure) {
      result.failure = failure.what();
    } catch (const OutputError&) {
      throw;
    } catch (const BadInput&) {
      throw;
    } catch (const std::exception& error) {
      throw BadInput(fmt::format("{}: request {}, {}: {}", recording.string(), result.asked,
                                 inWords(then->request), error.what()));
    }
    if (!now) break;  // it did not come to be asked
    auto differences = answerDifferences(*then, *now, tolerance, scratch.path);
    if (isDeclaration(then->request) && bothAccept(*then, *now)) {
      std::ranges::move(differences, std::back_inserter(result.declared));
    } else if (!differences.empty()) {
      result.request = inWords(then->request);
      result.differences = std::move(differences);
      break;
    }
    if (!engine || now->answer.is_null()) break;  // it has gone
  }
  if (result.asked == 0) throw BadInput(fmt::format("{}: holds no requests", recording.string()));
  return result;
}

}  // namespace crossgrain::inline runs
