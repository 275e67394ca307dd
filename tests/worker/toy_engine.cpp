#include "tests/worker/toy_engine.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <limits>

#include "adapters/worker/json.hpp"
#include "adapters/worker/serve.hpp"
#include "tests/support/thesis.hpp"

namespace crossgrain::test {

namespace {

/// To whoever reads descriptor 4.
void say(const std::string& text) {
  if (::write(4, text.data(), text.size()) < 0) std::abort();
}

/// A line of lists in lists that would take a reader's stack.
std::string deepAnswer() {
  return R"({"ok":true,"time":)" + std::string(100'000, '[') + std::string(100'000, ']') + "}\n";
}

}  // namespace

Capabilities ToyEngine::capabilities() const {
  Capabilities can;
  can.version = "1.0 \"quoted\" µ";
  can.effects[Effect::rotation] = Support::optional;
  can.effects[Effect::friction] = Support::never;
  can.lawOptions["tension"] = {"allow", "cut"};
  can.precisions = {Precision::float64, Precision::float32};
  can.slidingFlags = true;
  can.energyLedger = true;
  can.settings.push_back({"threads", 1.0, "", "how many", {}});
  can.settings.push_back({"mode", std::string("fast"), "", "which", {"fast", "slow"}});
  can.limits.inertia = {0.5, 0.1 + 0.2};
  can.limits.wallMotions = {Motion::Kind::radial};
  can.limits.cylinders = true;
  can.limits.planesAlongAxes = true;
  if (mischief_ == "option") can.lawOptions["colour"] = {"red"};
  if (mischief_ == "value") can.lawOptions["tension"] = {"red"};
  if (mischief_ == "no value") can.lawOptions["tension"] = {};
  return can;
}

EffectiveParameters ToyEngine::load(const Scene& scene, const Settings& settings) {
  if (const auto refused = settings.find("refuse"); refused != settings.end()) {
    const auto* reason = std::get_if<std::string>(&refused->second);
    throw UnsupportedScene(reason ? *reason : "has no such thing");
  }
  if (settings.contains("throw")) throw std::runtime_error("could not allocate");
  ++loads_;
  if (mischief_ == "once" && loads_ > 1) std::exit(5);
  scene_ = scene;
  steps_ = 0;
  EffectiveParameters effective;
  effective.engine = "toy";
  effective.dt = mischief_ == "step" ? 0.0 : scene.dt;
  effective.effects = effectsOf(scene);
  effective.pairs.push_back({"a – b", scene.law.kn, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6});
  effective.deviations.push_back({"rounding", 1e-300, "m", "a sentence"});
  return effective;
}

double ToyEngine::advance(double t) {
  if (mischief_ == "exit") std::exit(3);
  if (mischief_ == "die") {
    std::fputs("first line\n\nassertion failed: mass > 0\n", stderr);
    std::raise(SIGABRT);
  }
  if (mischief_ == "traceback") {
    std::fputs(
        "Welcome\nTraceback (most recent call last):\n  File \"a.py\", line 1, in <module>\n"
        "    import b\n           ^\nKeyError: 'HOME'\nbye\n",
        stderr);
    std::exit(1);
  }
  if (mischief_ == "hang") {
    std::fputs("hanging\n", stderr);
    ::pause();
  }
  if (mischief_ == "slow") ::usleep(300'000);
  const std::clock_t begin = std::clock();  // processor time
  while (mischief_ == "spin" ||
         (mischief_ == "slow" && std::clock() - begin < CLOCKS_PER_SEC * 3 / 10)) {
  }
  if (mischief_ == "garbage") say("Welcome to the engine!\n");
  if (mischief_ == "deep") say(deepAnswer());
  while (mischief_ == "endless") say(std::string(65536, 'x'));
  if (mischief_ == "log") {
    std::fprintf(stderr, "%s\nlast words\n", std::string(100'000, 'y').c_str());
    std::exit(3);
  }
  if (mischief_ == "disk" && ::ftruncate(1, off_t{5} << 30) != 0) std::abort();
  if (mischief_ == "print") std::puts("{\"ok\":false} printed, not said");
  if (mischief_ == "offspring" && ::fork() == 0) ::pause();
  if (mischief_ == "daemon" && ::fork() == 0) {
    ::setsid();
    if (::fork() != 0) ::_exit(0);
    ::pause();
  }
  if (mischief_ == "more") say("{\"ok\":true,\"time\":0.5}\n{\"ok\":true,\"time\":0.6}\n");
  if (mischief_ == "order") say("{\"ok\":true,\"stats\":{}}\n");
  if (mischief_ == "typo") say("{\"ok\":true,\"tmie\":0.5}\n");
  if (mischief_ == "type") say("{\"ok\":true,\"time\":\"soon\"}\n");
  if (mischief_ == "twice") say("{\"ok\":true,\"time\":0.5,\"time\":0.6}\n");
  if (mischief_ == "memory") {
    void* volatile const room = std::malloc(std::size_t{4} << 30);
    if (!room) std::exit(4);
  }
  steps_ = static_cast<std::uint64_t>(std::llround(t / scene_.dt));
  return static_cast<double>(steps_) * scene_.dt;
}

Snapshot ToyEngine::snapshot(ContactReport contacts) {
  const double t = static_cast<double>(steps_) * scene_.dt;
  Snapshot snapshot;
  snapshot.positionTime = t;
  snapshot.velocityTime = t - scene_.dt / 2;
  snapshot.contactTime = t - scene_.dt;
  for (std::size_t k = 0; k < scene_.disks.size(); ++k)
    snapshot.position.push_back(scene_.disks.position[k] + t * scene_.disks.velocity[k]);
  snapshot.velocity = scene_.disks.velocity;
  snapshot.spin = scene_.disks.spin;
  for (const WallBody& body : scene_.bodies) {
    const BodyState now = stateAt(body.motion, body.centre, t);
    for (const Vec2& reference : body.diskPosition)
      snapshot.wallPosition.push_back(memberPosition(now, body.centre, reference));
    snapshot.bodies.push_back({now.centre, now.angle, now.velocity, now.angularVelocity, {}, {}});
  }
  snapshot.bodies[0].force = Vec2(std::sin(t), std::cos(t));
  snapshot.bodies[1].torque = std::tan(t);
  if (contacts != ContactReport::none) {
    const Vec2 normal = (snapshot.position[0] - snapshot.position[1]).normalized();
    snapshot.contacts = Contacts{{0}, {1}, {normal}, {std::exp(t)}, {t / 3}, {-t / 7}, {1}, {}, {}};
    snapshot.energies = Energies{t / 9, t / 11};
    if (scene_.energyLedger) {
      snapshot.ledger.emplace();
      for (std::size_t k = 0; k < ledgerTerms.size(); ++k)
        *snapshot.ledger.*ledgerTerms[k].value = std::exp(t) / static_cast<double>(k + 3);
    }
  }
  if (mischief_ == "nan") snapshot.velocity[1].x() = std::numeric_limits<double>::quiet_NaN();
  if (mischief_ == "few") snapshot.position.pop_back();
  if (mischief_ == "ids") snapshot.contacts->j[0] = 99;
  if (mischief_ == "leftover" && loads_ > 1) snapshot.contacts->tangentialForce[0] += 1e-12;
  if (mischief_ == "lonely" && snapshot.contacts) snapshot.contacts = Contacts{};
  return snapshot;
}

Stats ToyEngine::stats() const {
  return {steps_, 2 * steps_, 1.0 / 3.0, 1.0 / 7.0, {{"rebuilds", 5.0}}};
}

Scene toyScene() {
  Scene scene;
  scene.name = "toy";
  scene.disks.radius = {1.0 / 3.0, 0.1};
  scene.disks.mass = {std::exp(1.0), 5e-324};
  scene.disks.inertia = {std::sqrt(2.0), 1e300};
  scene.disks.position = {{0.1, -0.0}, {std::acos(-1.0), 2.0 / 7.0}};
  scene.disks.velocity = {{1e-17, 1.0}, {-1.0 / 3.0, 1e-7}};
  scene.disks.spin = {0.1 + 0.2, -1.0};
  WallBody wheel{"wheel", {0.1, 0.2}, {{1.0 / 3.0, 0.2}, {0.1, 0.7}}, {0.01, 0.02}, {}, {}};
  wheel.motion.kind = Motion::Kind::rotating;
  wheel.motion.angularVelocity = 0.1;
  WallBody floor{"floor", {0, 0}, {}, {}, {{{0.0, -1.0 / 3.0}, {0.6, 0.8}}}, {}};
  floor.motion = {Motion::Kind::oscillating, 0.0, {0.3, 0.1}, {0.7, 1e-9}, 2.0 / 3.0, -0.1, 4.7};
  scene.bodies = {wheel, floor};
  scene.law.tangential = TangentialLaw::spring;
  scene.law.kn = thesis.kn;
  scene.law.mu = 1.0 / 3.0;
  scene.law.conventions.tension = Tension::cut;
  scene.law.conventions.integrator = Integrator::semiImplicitEuler;
  scene.bottom = thesisBottom<BottomPlate>(2e-5, false);
  scene.gravity = {0.0, -9.81};
  scene.dt = 4e-5;
  scene.energyLedger = true;
  return scene;
}

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

bool liesAboutFiles(const std::string& mischief) {
  return mischief == "short" || mischief == "many" || mischief == "pipe" || mischief == "device" ||
         mischief == "cuts" || writesOver(mischief);
}

/// A worker that needs nothing of this project but its JSON. What it says of the file of a snapshot
/// is not so: "short" has less than it promises, "many" 10⁹ contacts in a hole, "pipe" and "device"
/// are no files. "cuts" does not lie: it makes each file anew. "forgets" and "replaces" say that
/// they write over what a file holds, and write nothing, or a file of their own.
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

}  // namespace

int toyWorker(const std::string& mischief) {
  if (liesAboutFiles(mischief)) return lyingWorker(mischief);
  ToyEngine engine(mischief);
  return serve(engine);
}

}  // namespace crossgrain::test
