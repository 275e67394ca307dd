#include "reports/common/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>

#include "reports/common/engines.hpp"
#include "reports/common/numbers.hpp"
#include "support/files.hpp"

namespace crossgrain::reports {

namespace {

constexpr double pictureSize = 520.0;  // px

struct Disk {
  double x = 0.0, y = 0.0, radius = 0.0;
};

std::vector<Disk> disksOf(const Json& picture, const char* x, const char* y, const char* radius) {
  std::vector<Disk> disks;
  for (std::size_t k = 0; k < list(picture, x).size(); ++k) {
    const auto px = number(list(picture, x)[k]), py = number(element(list(picture, y), k)),
               r = number(element(list(picture, radius), k));
    disks.push_back({px.value_or(0.0), py.value_or(0.0), px && py ? r.value_or(0.0) : 0.0});
  }
  return disks;
}

Stroke dot(const Disk& disk) {
  return {disk.x, disk.y, disk.x, disk.y};
}

/// Groups strokes by colour and width, in the order of the keys.
class Groups {
 public:
  void add(const std::string& colour, double width, const Stroke& stroke) {
    if (width > 0.0) groups_[{width, colour}].push_back(stroke);
  }
  void moveTo(Drawing& drawing) {
    for (auto& [key, strokes] : groups_)
      drawing.groups.push_back({key.second, key.first, std::move(strokes)});
    groups_.clear();
  }

 private:
  std::map<std::pair<double, std::string>, std::vector<Stroke>> groups_;
};

/// Twelve sectors of starting angle in four colours, paler in every other band of radius.
std::string originColour(double radius, double angle, double bandWidth, double inner) {
  static const char* const strong[] = {"#0072b2", "#e69f00", "#009e73", "#cc79a7"};
  static const char* const pale[] = {"#8cc3e0", "#f5d58c", "#8cd3bd", "#e8c6d9"};
  constexpr int sectors = 12;
  const double turn = angle / (2.0 * std::numbers::pi);
  const int sector = static_cast<int>((turn - std::floor(turn)) * sectors) % 4;
  const auto band = static_cast<long>(std::floor((radius - inner) / bandWidth));
  return band % 2 == 0 ? strong[sector] : pale[sector];
}

void addWalls(const std::vector<Disk>& walls, Drawing& drawing) {
  Groups groups;
  for (const Disk& wall : walls) groups.add("#555555", 2.0 * wall.radius, dot(wall));
  groups.moveTo(drawing);
}

Drawing emptyDrawing(const std::vector<Disk>& disks, const std::vector<Disk>& walls) {
  Drawing drawing;
  double reach = 0.0;
  for (const auto* group : {&disks, &walls})
    for (const Disk& disk : *group)
      if (disk.radius > 0.0) reach = std::max(reach, std::hypot(disk.x, disk.y) + disk.radius);
  drawing.halfWidth = reach > 0.0 ? reach * 1.01 : 1.0;
  return drawing;
}

Drawing originsDrawing(const Json& picture, const Json& cell) {
  const auto disks = disksOf(picture, "x", "y", "radius");
  const auto walls = disksOf(picture, "wall_x", "wall_y", "wall_radius");
  Drawing drawing = emptyDrawing(disks, walls);
  const double inner = number(cell, "inner_radius").value_or(0.0);
  const double band = 2.0 * number(cell, "diameter").value_or(drawing.halfWidth / 15.0);
  Groups groups;
  for (std::size_t k = 0; k < disks.size(); ++k) {
    const auto radius = number(element(list(picture, "start_r"), k)),
               angle = number(element(list(picture, "start_phi"), k));
    const bool known = radius && angle;
    groups.add(known ? originColour(*radius, *angle, band, inner) : "#cccccc",
               2.0 * disks[k].radius, dot(disks[k]));
  }
  groups.moveTo(drawing);
  addWalls(walls, drawing);
  return drawing;
}

/// A force as a share of the widest line's, in steps of 1/16, 0 … 1.
double shareOf(double force, double widest) {
  return std::round(std::clamp(force / widest, 0.0, 1.0) * 16.0) / 16.0;
}

std::string greyOf(double share) {
  const int level = static_cast<int>(std::lround(170.0 * (1.0 - share)));
  return fmt::format("#{0:02x}{0:02x}{0:02x}", level);
}

void addForces(const Json& picture, const std::vector<Disk>& bodies, double widest, double width,
               Drawing& drawing) {
  Groups groups;
  for (std::size_t k = 0; k < list(picture, "contact_i").size(); ++k) {
    const auto i = number(list(picture, "contact_i")[k]),
               j = number(element(list(picture, "contact_j"), k)),
               force = number(element(list(picture, "contact_force"), k));
    const auto last = static_cast<double>(bodies.size());
    if (!i || !j || !force || *i < 0 || *j < 0 || *i >= last || *j >= last) continue;
    const Disk &a = bodies[static_cast<std::size_t>(*i)], &b = bodies[static_cast<std::size_t>(*j)];
    const double share = shareOf(*force, widest);
    groups.add(greyOf(share), width * share, {a.x, a.y, b.x, b.y});
  }
  groups.moveTo(drawing);
}

}  // namespace

Drawing forcesDrawing(const Json& picture, double widest, double width) {
  auto disks = disksOf(picture, "x", "y", "radius");
  const auto walls = disksOf(picture, "wall_x", "wall_y", "wall_radius");
  Drawing drawing = emptyDrawing(disks, walls);
  const double outline = drawing.halfWidth / 500.0;
  double largest = 0.0;
  Groups rims, fills;
  for (const Disk& disk : disks) {
    rims.add("#c8d4dc", 2.0 * disk.radius, dot(disk));
    fills.add("#f6f9fb", std::max(0.0, 2.0 * disk.radius - 2.0 * outline), dot(disk));
    largest = std::max(largest, disk.radius);
  }
  rims.moveTo(drawing);
  fills.moveTo(drawing);
  addWalls(walls, drawing);
  disks.insert(disks.end(), walls.begin(), walls.end());
  addForces(picture, disks, widest, width * largest, drawing);
  return drawing;
}

namespace {

const Json& firstPicture(const EngineResults& engine) {
  for (const Json* run : engine.runs)
    if (member(*run, "picture").is_object()) return member(*run, "picture");
  static const Json none;
  return none;
}

/// Letters, digits and dashes only: names of engines become names of files.
std::string fileWord(const std::string& name) {
  std::string word = name;
  for (char& c : word)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return word;
}

}  // namespace

std::optional<double> widestForce(const Json& picture) {
  std::vector<double> forces;
  for (const Json& force : list(picture, "contact_force"))
    if (const auto value = number(force); value && *value > 0.0) forces.push_back(*value);
  if (forces.empty()) return std::nullopt;
  const auto place = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(forces.size() - 1));
  std::ranges::nth_element(forces, forces.begin() + place);
  return forces[static_cast<std::size_t>(place)];
}

std::vector<Picture> comparePictures(const Json& results) {
  std::vector<Picture> origins, forces;
  for (const EngineResults& engine : engineResults(results)) {
    const Json& picture = firstPicture(engine);
    if (list(picture, "x").empty()) continue;
    const std::string word = fmt::format("{}_{}", origins.size() + 1, fileWord(engine.name));
    origins.push_back({"origins_" + word, engine.name,
                       engine.name + ": disks coloured by where they started", "",
                       Picture::Shows::origins, originsDrawing(picture, member(results, "cell"))});
    if (const auto widest = widestForce(picture))
      forces.push_back({"forces_" + word, engine.name, engine.name + ": forces between disks",
                        fmt::format("Widest line: {} N and more.", readable(widest)),
                        Picture::Shows::forces, forcesDrawing(picture, *widest, 0.75)});
  }
  for (Picture& picture : forces) origins.push_back(std::move(picture));
  return origins;
}

void writePicture(const Picture& picture, const std::filesystem::path& dir) {
  writeFile(dir / (picture.name + ".svg"), toSvg(picture.drawing, pictureSize, picture.title));
  writeFile(dir / (picture.name + ".pdf"), toPdf(picture.drawing, pictureSize));
}

}  // namespace crossgrain::reports
