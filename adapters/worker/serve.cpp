#include "adapters/worker/serve.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <new>
#include <optional>
#include <string>

#include "adapters/worker/json.hpp"

namespace crossgrain {
namespace {

using nlohmann::json;

constexpr int requestDescriptor = 3;
constexpr int replyDescriptor = 4;

/// The next request without its end; absent when there are no more.
std::optional<std::string> nextLine(std::string& buffer) {
  for (;;) {
    if (const std::size_t end = buffer.find('\n'); end != std::string::npos) {
      std::string line = buffer.substr(0, end);
      buffer.erase(0, end + 1);
      return line;
    }
    char chunk[65536];
    const ssize_t count = ::read(requestDescriptor, chunk, sizeof chunk);
    if (count > 0)
      buffer.append(chunk, static_cast<std::size_t>(count));
    else if (count == 0 || errno != EINTR)
      return std::nullopt;
  }
}

bool writeLine(const std::string& line) {
  const std::string text = line + '\n';
  std::size_t sent = 0;
  while (sent < text.size()) {
    const ssize_t count = ::write(replyDescriptor, text.data() + sent, text.size() - sent);
    if (count > 0)
      sent += static_cast<std::size_t>(count);
    else if (errno != EINTR)
      return false;
  }
  return true;
}

/// The file that a request names, in the scratch directory.
std::filesystem::path fileOf(const json& request) {
  return request.at("file").get<std::string>();
}

/// @param dimension  of the scene that is loaded
json answer(Engine& engine, int& dimension, const json& request) {
  const auto what = request.at("request").get<std::string>();
  if (what == "hello")
    return {{"protocol", protocolVersion},
            {"capabilities", jsonOf(engine.capabilities())},
            {"writes_over", true}};
  if (what == "load") {
    const ArrayReader arrays(fileOf(request), request.at("arrays"));
    const json& scene = request.at("scene");
    const auto settings = readAs<Settings>(request.at("settings"));
    dimension = dimensionOf(scene);
    return {{"realised",
             jsonOf(dimension == 3 ? engine.loadInSpace(sceneFromJson<3>(scene, arrays), settings)
                                   : engine.load(sceneFromJson(scene, arrays), settings))}};
  }
  if (what == "advance") return {{"time", engine.advance(request.at("time"))}};
  if (what == "snapshot") {
    ArrayWriter arrays;
    const auto contacts = readAs<ContactReport>(request.at("contacts"));
    json reply = {{"snapshot", dimension == 3 ? toJson(engine.snapshotInSpace(contacts), arrays)
                                              : toJson(engine.snapshot(contacts), arrays)}};
    reply["arrays"] = arrays.writeOver(fileOf(request));
    return reply;
  }
  if (what == "stats") return {{"stats", toJson(engine.stats())}};
  if (what == "checkpoint" || what == "restore") {
    what == "checkpoint" ? engine.checkpoint(fileOf(request)) : engine.restore(fileOf(request));
    return json::object();
  }
  if (what == "quit") return json::object();
  throw std::runtime_error(
      fmt::format("no request '{}' (there are: hello, load, advance, snapshot, stats, checkpoint, "
                  "restore, quit)",
                  what));
}

json refusal(const char* kind, const std::exception& error) {
  return {{"ok", false}, {"kind", kind}, {"what", error.what()}};
}

}  // namespace

int serve(Engine& engine) {
  std::string buffer;
  int dimension = 2;
  while (const auto line = nextLine(buffer)) {
    json reply;
    bool last = false;
    try {
      const json request = json::parse(*line);
      reply = answer(engine, dimension, request);
      reply["ok"] = true;
      last = request.at("request") == "quit";
    } catch (const UnsupportedScene& error) {
      reply = refusal("unsupported", error);
    } catch (const std::bad_alloc&) {
      reply = refusal("failed", std::runtime_error("out of memory"));
    } catch (const std::exception& error) {
      reply = refusal("failed", error);
    }
    std::fflush(stdout);  // what it printed is in the log of this run, and not of the next
    // The message of an engine's exception need not be UTF-8.
    if (!writeLine(reply.dump(-1, ' ', false, json::error_handler_t::replace)) || last) break;
  }
  return 0;
}

}  // namespace crossgrain
