#include "studies/core/study.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "adapters/files/file_units.hpp"
#include "adapters/registry.hpp"
#include "cases/case_keys.hpp"
#include "cases/flow.hpp"
#include "cases/keys.hpp"
#include "cases/loader.hpp"
#include "stability/recording.hpp"
#include "studies/core/mirrors.hpp"
#include "studies/core/run_store.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/interrupt.hpp"
#include "support/terminal.hpp"

namespace crossgrain::inline studies {

namespace fs = std::filesystem;

namespace {

/// x0, y0, x1 …, as pictures have it.
std::vector<double> flat(const std::vector<Vec2>& outline) {
  std::vector<double> numbers;
  for (const Vec2& vertex : outline) numbers.insert(numbers.end(), {vertex.x(), vertex.y()});
  return numbers;
}

}  // namespace

ScenePicture scenePicture(const Scene& scene, const Snapshot& now, double rotation) {
  ScenePicture picture;
  picture.radius = scene.disks.radius;
  picture.speed.emplace();
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    picture.x.push_back(now.position[i].x());
    picture.y.push_back(now.position[i].y());
    picture.speed->push_back(now.velocity[i].norm());
    const Vec2& start = scene.disks.position[i];
    picture.startR.push_back(start.norm());
    picture.startPhi.push_back(std::atan2(start.y(), start.x()));
  }
  if (now.turn) {
    picture.outlines.emplace(scene.disks.size());
    for (std::size_t i = 0; i < scene.disks.size(); ++i)
      if (scene.isConvex(i)) {
        auto outline = outlineOf(scene.shapeOf(i));
        for (Vec2& vertex : outline)
          vertex = now.position[i] + matrixOf<2>((*now.turn)[i]) * vertex;
        (*picture.outlines)[i] = flat(outline);
      }
  }
  for (const Vec2& position : now.wallPosition) {
    picture.wallX.push_back(position.x());
    picture.wallY.push_back(position.y());
  }
  for (const WallBody& body : scene.bodies)
    picture.wallRadius.insert(picture.wallRadius.end(), body.diskRadius.begin(),
                              body.diskRadius.end());
  picture.planes.emplace();
  for (const Plane& plane : planesAt(scene, now.positionTime))
    picture.planes->push_back(
        {plane.point.x(), plane.point.y(), plane.normal.x(), plane.normal.y()});
  picture.time = now.positionTime;
  picture.rotation = rotation;
  if (now.contacts) {
    picture.contactI.emplace(now.contacts->i.begin(), now.contacts->i.end());
    picture.contactJ.emplace(now.contacts->j.begin(), now.contacts->j.end());
    picture.contactForce = now.contacts->normalForce;
  }
  return picture;
}

namespace {

/// The plane y = cut that pictures of space begin at: the middle, or in front of a few spheres.
double cutOf(const SpaceScene& scene, const SpaceSnapshot& now) {
  constexpr std::size_t few = 50;
  if (now.position.empty()) return 0.0;
  const auto [left, right] =
      std::ranges::minmax(now.position, {}, [](const Vec3& x) { return x.y(); });
  if (now.position.size() <= few && !now.turn && !scene.box) return left.y();
  return scene.box ? 0.5 * (scene.box->low + scene.box->high).y() : 0.5 * (left + right).y();
}

/// Lines and circles that planes and cylinders cut out of the plane y = cut.
void addWalls(const SpaceScene& scene, double t, double cut, ScenePicture& picture) {
  constexpr double steep = 0.1;
  picture.planes.emplace();
  picture.circles.emplace();
  for (const PlaneOf<3>& plane : planesAt(scene, t)) {
    const Vec2 across(plane.normal.x(), plane.normal.z());
    if (across.norm() < steep) continue;
    const Vec2 at = Vec2(plane.point.x(), plane.point.z()) +
                    across * plane.normal.y() * (plane.point.y() - cut) / across.squaredNorm();
    picture.planes->push_back({at.x(), at.y(), across.normalized().x(), across.normalized().y()});
  }
  for (const auto& body : scene.bodies)
    for (const Cylinder& cylinder : body.cylinders) {
      const Vec2 at(cylinder.point.x(), cylinder.point.z());
      const Vec2 along(cylinder.axis.x(), cylinder.axis.z());
      const double away = cylinder.point.y() - cut;
      if (along.norm() < steep) {
        picture.circles->push_back({at.x(), at.y(), cylinder.radius});
      } else if (std::abs(cylinder.axis.y()) < steep && std::abs(away) < cylinder.radius) {
        const double half = std::sqrt(cylinder.radius * cylinder.radius - away * away);
        const Vec2 across(along.y() / along.norm(), -along.x() / along.norm());
        for (const double side : {-1.0, 1.0})
          picture.planes->push_back({at.x() + side * half * across.x(),
                                     at.y() + side * half * across.y(), across.x(), across.y()});
      }
    }
}

}  // namespace

ScenePicture scenePicture(const SpaceScene& scene, const SpaceSnapshot& now, double rotation) {
  const auto wrapped = [&](const Vec3& x) { return scene.box ? scene.box->wrapped(x) : x; };
  const double cut = cutOf(scene, now);
  const auto behind = [&](const Vec3& x) {
    const Vec3 away = x - cut * Vec3::UnitY();
    return scene.box ? scene.box->nearest(away).y() : away.y();
  };
  ScenePicture picture;
  picture.cut = cut;
  picture.speed.emplace();
  if (now.turn)
    picture.outlines.emplace();
  else
    picture.depth.emplace();
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    const Vec3 x = wrapped(now.position[i]), start = wrapped(scene.disks.position[i]);
    const double depth = behind(now.position[i]);
    double radius = scene.disks.radius[i];
    // Convex bodies show the section that the cut is, and so do spheres beside them.
    if (now.turn) {
      const double square = radius * radius - depth * depth;
      if (square <= 0.0) continue;
      radius = std::sqrt(square);
      std::vector<Vec2> section;
      if (scene.isConvex(i)) {
        section = sectionOf(scene.shapeOf(i), (*now.turn)[i], -depth);
        if (section.size() < 3) continue;
      }
      for (Vec2& place : section) place += Vec2(x.x(), x.z());
      picture.outlines->push_back(flat(section));
    } else if (depth < 0.0) {
      continue;
    } else {
      picture.depth->push_back(depth);
    }
    picture.radius.push_back(radius);
    picture.x.push_back(x.x());
    picture.y.push_back(x.z());
    picture.speed->push_back(now.velocity[i].norm());
    picture.startR.push_back(std::hypot(start.x(), start.z()));
    picture.startPhi.push_back(std::atan2(start.z(), start.x()));
  }
  const std::vector<double> radii = scene.radii();
  picture.wallDepth.emplace();
  for (std::size_t w = 0; w < now.wallPosition.size(); ++w) {
    const double depth = behind(now.wallPosition[w]);
    if (depth < 0.0) continue;
    const Vec3 x = wrapped(now.wallPosition[w]);
    picture.wallX.push_back(x.x());
    picture.wallY.push_back(x.z());
    picture.wallRadius.push_back(radii[scene.disks.size() + w]);
    picture.wallDepth->push_back(depth);
  }
  addWalls(scene, now.positionTime, cut, picture);
  picture.time = now.positionTime;
  picture.rotation = rotation;
  return picture;
}

int resumably(const RunCommand& command, const std::function<int()>& work) {
  const std::string same =
      fmt::format("the same command{} goes on from there", command.fresh ? " without --fresh" : "");
  const auto stopped = [&] {
    return Interrupted(holdsWork(command.out)
                           ? fmt::format("interrupted; what is finished is kept in {}: {}",
                                         command.out.string(), same)
                           : std::string("interrupted; nothing was finished yet"));
  };
  const auto explained = [&](const OutputError& error) {
    if (!error.noRoom) return error;
    return error.with(fmt::format("; what is finished is kept: make room, and {}", same));
  };
  try {
    return work();
  } catch (const Interrupted&) {
    throw stopped();
  } catch (const OutputError& error) {
    throw explained(error);
  } catch (const std::system_error& error) {
    throw explained(OutputError(error));
  } catch (const std::exception&) {
    // Ctrl-C goes to all programs of a terminal: what fails after it failed of it.
    if (interrupted()) throw stopped();
    throw;
  }
}

namespace {

/// A positive number and one of some units. @throws BadInput
double numberWithUnit(const std::string& option, const std::string& text,
                      const std::map<std::string, double>& units, const char* example) {
  std::size_t end = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  const auto unit = units.find(text.substr(end));
  if (end == 0 || unit == units.end() || !(value > 0.0) || !std::isfinite(value))
    throw BadInput(fmt::format("{} {}: must be like {}", option, text, example));
  return value * unit->second;
}

}  // namespace

double wholeNumberOf(const std::string& option, double value, double least, double most) {
  if (value != std::floor(value) || !(value >= least && value <= most))
    throw BadInput(fmt::format("{}: {:g} must be a whole number from {:g} to {:g}", option, value,
                               least, most));
  return value;
}

double secondsOf(const std::string& budget) {
  return numberWithUnit("--budget", budget,
                        {{"", 1.0}, {"s", 1.0}, {"m", 60.0}, {"min", 60.0}, {"h", 3600.0}},
                        "90s, 10m or 1h");
}

double accuracyOf(const std::string& target, bool inMargins) {
  if (inMargins) return numberWithUnit("--want", target, {{"", 1.0}}, "1 or 0.5, in margins");
  return numberWithUnit("--want", target, {{"", 1.0}, {"%", 0.01}}, "1% or 1e-3");
}

Outcome notJudged(std::string why, bool byRequest) {
  return {byRequest ? exitPassed : exitFailed, {}, std::move(why)};
}

std::vector<std::string> refusals(const std::vector<EngineRow>& engines,
                                  const std::vector<std::string>& named) {
  std::vector<std::string> lines;
  for (const EngineRow& engine : engines)
    if (engine.status == Status::refused && std::ranges::find(named, engine.name) != named.end())
      lines.push_back(engine.reason);
  return lines;
}

EngineRow engineRow(const EngineEntry& entry, const std::string& version) {
  return {entry.name, entry.summary, version, entry.mirrors, Status::finished, ""};
}

std::vector<std::string> keysWithoutUse(const Case& setup, std::string_view command) {
  addMirrors(setup.run.timeout);  // sections may be theirs
  std::vector<std::string> keys;
  const std::vector<SettingSpec> forFiles = files::fileSettings("", 2);
  const bool filesLackSettings = std::ranges::any_of(engineRegistry(), [&](const auto& entry) {
    return !entry.format.empty() && !setup.engines.contains(entry.name);
  });
  for (const auto& [name, settings] : setup.engines) {
    const bool ofFiles = std::ranges::all_of(settings, [&](const auto& setting) {
      return std::ranges::find(forFiles, setting.first, &SettingSpec::name) != forFiles.end();
    });
    // How files are read that another command is given; those of `average` may be of any name.
    if (findEngine(name) || command == "average" || (ofFiles && !filesLackSettings)) continue;
    keys.push_back(fmt::format("engines.{} (nothing of this name takes part: --engines names {})",
                               name,
                               ofFiles ? fmt::format("result files as {}=FILES", name)
                                       : "a program of your own by its file"));
  }
  if (command == "check") return keys;
  for (const auto& [key, value] : caseKeys(setup.resolvedToml)) {
    const KeyUse* use = nullptr;  // the longest name that holds the key
    for (const KeyUse& each : keyUses())
      if (isIn(each.name, key) && (!use || each.name.size() > use->name.size())) use = &each;
    if (!use || use->by(command)) continue;
    // A section of which some keys are used is named key by key.
    const bool partly = std::ranges::any_of(keyUses(), [&](const KeyUse& each) {
      return isIn(use->name, each.name) && each.by(command);
    });
    const std::string& name = partly ? key : use->name;
    if (std::ranges::find(keys, name) == keys.end()) keys.push_back(name);
  }
  return keys;
}

namespace {
std::vector<std::pair<std::FILE*, std::string>> heldNotes;
}  // namespace

void reportKeysWithoutUse(const Case& setup, std::string_view command, std::FILE* to) {
  const std::vector<std::string> keys = keysWithoutUse(setup, command);
  if (!keys.empty())
    heldNotes.emplace_back(to, fmt::format("{}{}: {} does not use {}\n",
                                           to == stdout ? "# " : "note: ", setup.file.string(),
                                           command, fmt::join(keys, ", ")));
}

void printNotes() {
  for (const auto& [to, text] : std::exchange(heldNotes, {})) printLines(to, text);
}

void reportKeysWithoutUse(const std::vector<Case>& cases, std::string_view command, std::FILE* to) {
  const fs::path* last = nullptr;
  for (const Case& setup : cases)
    if (!last || *last != setup.file) {
      reportKeysWithoutUse(setup, command, to);
      last = &setup.file;
    }
}

std::vector<std::string> quickOverrides(const Case& setup, double rotations) {
  const std::string packings =
      fmt::format("preparation.packings={}", std::min(2, setup.preparation.packings));
  if (hasClosedForms(setup)) return {packings};  // few bodies, and times of what they do
  if (!cellOf(setup))
    return {packings, fmt::format("average.snapshots={}", std::min(20, setup.region->snapshots))};
  const auto& [cell, particles, filling, times] = couetteIn(setup);
  return {packings, fmt::format("preparation.rotations={}", std::min(0.1, filling.rotations)),
          fmt::format("averaging.settle_rotations={}", std::min(0.02, times.settleRotations)),
          fmt::format("averaging.rotations={}", std::min(rotations, times.rotations)),
          "averaging.snapshots_per_rotation=400"};
}

Case onlyFlow(const CommandLine& line, const FlowUse& use) {
  const fs::path& file = line.inputs.front();
  const char* const command = use.command;
  const auto isOfFiles = [](const std::string& name) {
    const EngineEntry* const entry = findEngine(name);
    return entry && entry->ofFiles();
  };
  const auto& engines = line.run.engines;
  const bool filesAlone = !engines.empty() && std::ranges::all_of(engines, isOfFiles);
  const Starts starts = filesAlone ? Starts::notMade : use.starts;
  const std::vector<Case> cases = loadCase(file, line.overrides, {}, starts);
  if (!hasFlow(cases.front())) {
    if (isCollision(cases.front()))
      throw BadInput(
          fmt::format("{}: {} needs a flow, and here two bodies meet once; crossgrain collide can "
                      "run it",
                      file.string(), command));
    throw BadInput(fmt::format(
        "{}: {} cannot run an assembly that does not say what is averaged: give it [average] and "
        "[[endpoints]]",
        file.string(), command));
  }
  if (cases.size() > 1)
    throw BadInput(fmt::format("{}: {} takes a case without variants", file.string(), command));
  if (use.beginsFromGrain && anyConvex(cases.front()))
    throw BadInput(
        fmt::format("{}: {} needs grain, which has no convex bodies", file.string(), command));
  if (use.notesKeys) reportKeysWithoutUse(cases.front(), command, line.json ? stderr : stdout);
  std::vector<std::string> overrides;
  if (line.quick) overrides = quickOverrides(cases.front());
  overrides.insert(overrides.end(), line.overrides.begin(), line.overrides.end());
  const bool shares =
      use.sharesConventions && shareConventions(cases.front(), line.run.engines, overrides);
  return shares || line.quick ? loadCase(file, overrides, {}, starts).front() : cases.front();
}

void printWarnings(const Case& setup) {
  for (const std::string& warning : setup.warnings)
    printLines(stderr, fmt::format("caution: {}\n", warning));
}

}  // namespace crossgrain::inline studies
