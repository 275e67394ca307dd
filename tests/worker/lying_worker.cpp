#include "tests/worker/lying_worker.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "adapters/worker/json.hpp"
#include "adapters/worker/serve.hpp"
#include "tests/worker/toy_engine.hpp"

namespace crossgrain::test {
namespace {

/// Says that it writes over what a file holds.
bool writesOver(const std::string& mischief) {
  return mischief == "forgets" || mischief == "replaces";
}

nlohmann::json arraysOf(const std::string& mischief, const std::string& file) {
  if (mischief == "pipe" && ::mkfifo(file.c_str(), 0600) != 0) std::abort();
  if (mischief == "device") std::filesystem::create_symlink("/dev/zero", file);
  if (mischief == "short") std::ofstream(file) << "8 bytes.";
  if (mischief == "many" || mischief == "cuts" || writesOver(mischief)) {
    ToyEngine toy;
    toy.load(toyScene(), {});
    ArrayWriter arrays;
    toJson(toy.snapshot(ContactReport::instant), arrays);
    if (mischief == "forgets") return arrays.list();
    nlohmann::json list = arrays.write(file);
    if (mischief != "many") return list;
    std::filesystem::resize_file(file, std::uintmax_t{3} << 30);
    for (nlohmann::json& each : list)
      if (each.at("name") == "contacts.i") each["count"] = 500'000'000;
    return list;
  }
  return {{{"name", "position"}, {"type", "f64"}, {"count", 4}, {"offset", 0}}};
}

nlohmann::json snapshotOf() {
  ToyEngine toy;
  toy.load(toyScene(), {});
  ArrayWriter ignored;
  return toJson(toy.snapshot(ContactReport::instant), ignored);
}

}  // namespace

bool liesAboutFiles(const std::string& mischief) {
  return mischief == "short" || mischief == "many" || mischief == "pipe" || mischief == "device" ||
         mischief == "cuts" || writesOver(mischief);
}

void say(const std::string& text) {
  if (::write(4, text.data(), text.size()) < 0) std::abort();
}

std::string deepAnswer() {
  return R"({"ok":true,"time":)" + std::string(100'000, '[') + std::string(100'000, ']') + "}\n";
}

int lyingWorker(const std::string& mischief) {
  std::FILE* requests = ::fdopen(3, "r");
  char* line = nullptr;
  std::size_t size = 0;
  EffectiveParameters effective;
  effective.dt = toyScene().dt;
  while (::getline(&line, &size, requests) > 0) {
    const auto request = nlohmann::json::parse(line);
    nlohmann::json reply = {{"ok", true},
                            {"protocol", protocolVersion},
                            {"capabilities", jsonOf(ToyEngine().capabilities())},
                            {"writes_over", writesOver(mischief)},
                            {"realised", jsonOf(effective)}};
    if (request.at("request") == "snapshot") {
      reply["snapshot"] = snapshotOf();
      reply["arrays"] = arraysOf(mischief, request.at("file"));
    }
    say(reply.dump() + "\n");
  }
  std::free(line);
  return 0;
}

}  // namespace crossgrain::test
