#include "reports/common/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "reports/common/text.hpp"
#include "results/scene_picture.hpp"
#include "support/files.hpp"

namespace crossgrain::reports {

namespace {

constexpr double pictureSize = 520.0;  // px

struct Disk {
  double x = 0.0, y = 0.0, radius = 0.0;
  std::vector<double> outline = {};  ///< of a convex body
};

/// Disks to draw; one without a position has radius 0.
std::vector<Disk> disksOf(const std::vector<double>& x, const std::vector<double>& y,
                          const std::vector<double>& radius) {
  std::vector<Disk> disks;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const auto px = at(x, k), py = at(y, k), r = at(radius, k);
    disks.push_back({px.value_or(0.0), py.value_or(0.0), px && py ? r.value_or(0.0) : 0.0});
  }
  return disks;
}

std::vector<Disk> disksOf(const ScenePicture& picture) {
  std::vector<Disk> disks = disksOf(picture.x, picture.y, picture.radius);
  if (picture.outlines)
    for (std::size_t k = 0; k < std::min(disks.size(), picture.outlines->size()); ++k)
      disks[k].outline = (*picture.outlines)[k];
  return disks;
}

std::vector<Disk> wallsOf(const ScenePicture& picture) {
  return disksOf(picture.wallX, picture.wallY, picture.wallRadius);
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
  /// A disk, or a convex body shrunk by `rim` on all sides, as far as that goes.
  void add(const std::string& colour, const Disk& disk, double rim = 0.0) {
    if (disk.outline.empty())
      return add(colour, std::max(0.0, 2.0 * disk.radius - 2.0 * rim), dot(disk));
    const double share = std::max(0.0, 1.0 - 1.4 * rim / disk.radius);
    std::vector<double>& outline = outlines_[colour].emplace_back(disk.outline);
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const double middle = k % 2 == 0 ? disk.x : disk.y;
      outline[k] = middle + share * (outline[k] - middle);
    }
  }
  void moveTo(Drawing& drawing) {
    for (auto& [key, strokes] : groups_)
      drawing.groups.push_back({key.second, key.first, std::move(strokes)});
    for (auto& [colour, outlines] : outlines_)
      drawing.groups.push_back({colour, 0.0, {}, std::move(outlines)});
    groups_.clear();
    outlines_.clear();
  }

 private:
  std::map<std::pair<double, std::string>, std::vector<Stroke>> groups_;
  std::map<std::string, std::vector<std::vector<double>>> outlines_;
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

/// A force over the widest line's, in steps of 1/16, 0 … 1.
double weightOf(double force, double widest) {
  return std::round(std::clamp(force / widest, 0.0, 1.0) * 16.0) / 16.0;
}

std::string greyOf(double weight) {
  const int level = static_cast<int>(std::lround(170.0 * (1.0 - weight)));
  return fmt::format("#{0:02x}{0:02x}{0:02x}", level);
}

void addForces(const ScenePicture& picture, const std::vector<Disk>& bodies, double widest,
               double width, Drawing& drawing) {
  if (!picture.contactI || !picture.contactJ || !picture.contactForce) return;
  Groups groups;
  const auto count = static_cast<int>(bodies.size());
  const std::size_t contacts =
      std::min({picture.contactI->size(), picture.contactJ->size(), picture.contactForce->size()});
  for (std::size_t k = 0; k < contacts; ++k) {
    const int i = (*picture.contactI)[k], j = (*picture.contactJ)[k];
    const auto force = at(*picture.contactForce, k);
    if (!force || i < 0 || j < 0 || i >= count || j >= count) continue;
    const Disk &a = bodies[static_cast<std::size_t>(i)], &b = bodies[static_cast<std::size_t>(j)];
    const double weight = weightOf(*force, widest);
    groups.add(greyOf(weight), width * weight, {a.x, a.y, b.x, b.y});
  }
  groups.moveTo(drawing);
}

/// At most two decimals and no trailing zeros.
std::string shortNumber(double value) {
  std::string result = fmt::format("{:.2f}", value);
  result.erase(result.find_last_not_of('0') + 1);
  if (result.back() == '.') result.pop_back();
  return result == "-0" ? "0" : result;
}

double channel(const std::string& colour, std::size_t index) {
  return std::stoi(colour.substr(1 + 2 * index, 2), nullptr, 16) / 255.0;
}

/// PDF's operators of a page: colour, width, then a path to stroke.
std::string pdfContent(const Drawing& drawing, double points) {
  const double scale = points / (2.0 * drawing.halfWidth);
  const auto place = [&](double v) { return shortNumber((v + drawing.halfWidth) * scale); };
  std::string content = "1 J\n";
  for (const StrokeGroup& group : drawing.groups) {
    content += fmt::format("{:.3f} {:.3f} {:.3f} RG {} w\n", channel(group.colour, 0),
                           channel(group.colour, 1), channel(group.colour, 2),
                           shortNumber(group.width * scale));
    for (const Stroke& s : group.strokes)
      content +=
          fmt::format("{} {} m {} {} l\n", place(s.x1), place(s.y1), place(s.x2), place(s.y2));
    content += "S\n";
    if (group.outlines.empty()) continue;
    content += fmt::format("{:.3f} {:.3f} {:.3f} rg\n", channel(group.colour, 0),
                           channel(group.colour, 1), channel(group.colour, 2));
    for (const std::vector<double>& outline : group.outlines) {
      for (std::size_t k = 0; k + 1 < outline.size(); k += 2)
        content +=
            fmt::format("{} {} {} ", place(outline[k]), place(outline[k + 1]), k == 0 ? "m" : "l");
      content += "f\n";
    }
  }
  return content;
}

}  // namespace

Drawing originsDrawing(const ScenePicture& picture, double inner, double diameter) {
  const auto disks = disksOf(picture);
  const auto walls = wallsOf(picture);
  Drawing drawing = emptyDrawing(disks, walls);
  const double band = 2.0 * (diameter > 0.0 ? diameter : drawing.halfWidth / 15.0);
  Groups groups;
  for (std::size_t k = 0; k < disks.size(); ++k) {
    const auto radius = at(picture.startR, k), angle = at(picture.startPhi, k);
    const bool known = radius && angle;
    groups.add(known ? originColour(*radius, *angle, band, inner) : "#cccccc", disks[k]);
  }
  groups.moveTo(drawing);
  addWalls(walls, drawing);
  return drawing;
}

Drawing forcesDrawing(const ScenePicture& picture, double widest, double width) {
  auto disks = disksOf(picture);
  const auto walls = wallsOf(picture);
  Drawing drawing = emptyDrawing(disks, walls);
  const double outline = drawing.halfWidth / 500.0;
  double largest = 0.0;
  Groups rims, fills;
  for (const Disk& disk : disks) {
    rims.add("#c8d4dc", disk);
    fills.add("#f6f9fb", disk, outline);
    largest = std::max(largest, disk.radius);
  }
  rims.moveTo(drawing);
  fills.moveTo(drawing);
  addWalls(walls, drawing);
  disks.insert(disks.end(), walls.begin(), walls.end());
  addForces(picture, disks, widest, width * largest, drawing);
  return drawing;
}

std::optional<double> widestForce(const ScenePicture& picture) {
  std::vector<double> forces;
  if (picture.contactForce)
    for (const double force : *picture.contactForce)
      if (std::isfinite(force) && force > 0.0) forces.push_back(force);
  if (forces.empty()) return std::nullopt;
  const auto place = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(forces.size() - 1));
  std::ranges::nth_element(forces, forces.begin() + place);
  return forces[static_cast<std::size_t>(place)];
}

ForceCount countForces(const ScenePicture& picture, double force) {
  ForceCount count;
  if (picture.contactForce)
    for (const double own : *picture.contactForce) {
      if (!std::isfinite(own)) continue;
      ++count.contacts;
      if (own >= force) ++count.above;
      count.mean += own;
    }
  if (count.contacts > 0) count.mean /= static_cast<double>(count.contacts);
  return count;
}

std::string toSvg(const Drawing& drawing, double size, const std::string& title) {
  const double scale = size / (2.0 * drawing.halfWidth);
  const auto x = [&](double v) { return shortNumber((v + drawing.halfWidth) * scale); };
  const auto y = [&](double v) { return shortNumber((drawing.halfWidth - v) * scale); };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{0}\" viewBox=\"0 0 {0} "
      "{0}\">\n<title>{1}</title>\n<g fill=\"none\" stroke-linecap=\"round\">\n",
      size, escaped(title));
  for (const StrokeGroup& group : drawing.groups) {
    for (const std::vector<double>& outline : group.outlines) {
      svg += fmt::format("<path fill=\"{}\" d=\"", group.colour);
      for (std::size_t k = 0; k + 1 < outline.size(); k += 2)
        svg += (k == 0 ? "M" : "L") + x(outline[k]) + " " + y(outline[k + 1]);
      svg += "z\"/>\n";
    }
    if (group.strokes.empty()) continue;
    svg += fmt::format("<path stroke=\"{}\" stroke-width=\"{}\" d=\"", group.colour,
                       shortNumber(group.width * scale));
    for (const Stroke& s : group.strokes) {
      svg += "M" + x(s.x1) + " " + y(s.y1);
      svg += s.x1 == s.x2 && s.y1 == s.y2 ? "h0" : "L" + x(s.x2) + " " + y(s.y2);
    }
    svg += "\"/>\n";
  }
  return svg + "</g>\n</svg>\n";
}

std::string toPdf(const Drawing& drawing, double size) {
  const double points = size * 72.0 / 96.0;
  const std::string content = pdfContent(drawing, points);
  const Names objects = {
      "<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
      fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {0} {0}] /Contents 4 0 R >>",
                  points),
      fmt::format("<< /Length {} >>\nstream\n{}endstream", content.size(), content)};
  std::string pdf = "%PDF-1.4\n";
  std::string places;
  for (std::size_t k = 0; k < objects.size(); ++k) {
    places += fmt::format("{:010} 00000 n \n", pdf.size());
    pdf += fmt::format("{} 0 obj\n{}\nendobj\n", k + 1, objects[k]);
  }
  const std::size_t table = pdf.size();
  return pdf + fmt::format(
                   "xref\n0 {0}\n0000000000 65535 f \n{1}trailer\n<< /Size {0} /Root 1 0 R "
                   ">>\nstartxref\n{2}\n%%EOF\n",
                   objects.size() + 1, places, table);
}

void writePicture(const Picture& picture, const std::filesystem::path& dir) {
  writeFile(dir / (picture.name + ".svg"), toSvg(picture.drawing, pictureSize, picture.title));
  writeFile(dir / (picture.name + ".pdf"), toPdf(picture.drawing, pictureSize));
}

}  // namespace crossgrain::reports
