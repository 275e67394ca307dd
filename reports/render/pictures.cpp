#include "reports/common/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "reports/common/text.hpp"
#include "results/scene_picture.hpp"
#include "support/files.hpp"

namespace crossgrain::reports {

namespace {

constexpr double pictureSize = 520.0;    // px
constexpr std::size_t mostBalls = 4000;  ///< of a drawing: the nearest ones

struct Disk {
  double x = 0.0, y = 0.0, radius = 0.0;
  std::vector<double> outline = {};  ///< of a convex body
  std::string colour = {};
};

constexpr const char *wallColour = "#555555", *plainColour = "#cccccc";

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

/// 0 … 1 in steps of 1/16 along viridis (Smith and van der Walt, 2015), which any colour vision
/// and greys keep in order.
std::string shadeOf(double share) {
  static constexpr std::array<std::array<int, 3>, 5> stops = {
      {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
  const double place = 0.25 * std::round(16.0 * std::clamp(share, 0.0, 1.0));
  const std::size_t from = std::min<std::size_t>(3, static_cast<std::size_t>(place));
  const double part = place - static_cast<double>(from);
  std::string colour = "#";
  for (std::size_t k = 0; k < 3; ++k)
    colour += fmt::format(
        "{:02x}", std::lround(stops[from][k] + part * (stops[from + 1][k] - stops[from][k])));
  return colour;
}

/// Window that holds all of them, with a rim.
Window windowOf(const ScenePicture& picture, const std::vector<Disk>& disks,
                const std::vector<Disk>& walls) {
  Window window;
  for (const auto* group : {&disks, &walls})
    for (const Disk& disk : *group)
      if (disk.radius > 0.0)
        window.add({disk.x - disk.radius, disk.x + disk.radius, disk.y - disk.radius,
                    disk.y + disk.radius});
  if (picture.circles)
    for (const auto& [x, y, radius] : *picture.circles)
      window.add({x - radius, x + radius, y - radius, y + radius});
  window.widen(0.01);
  return window;
}

/// Wall disks, planes as lines through the whole window, and circles.
void addWalls(const ScenePicture& picture, const std::vector<Disk>& walls, Drawing& drawing) {
  Groups groups;
  for (const Disk& wall : walls) groups.add(wallColour, 2.0 * wall.radius, dot(wall));
  const double line = drawing.window.larger() / 200.0;
  if (picture.planes)
    for (const auto& [x, y, nx, ny] : *picture.planes) {
      const Window& window = drawing.window;
      const double half = 2.0 * window.larger();
      const double away = (0.5 * (window.left + window.right) - x) * nx +
                          (0.5 * (window.bottom + window.top) - y) * ny;
      const double footX = 0.5 * (window.left + window.right) - away * nx,
                   footY = 0.5 * (window.bottom + window.top) - away * ny;
      if (std::abs(away) < window.larger())
        groups.add(wallColour, line,
                   {footX - half * ny, footY + half * nx, footX + half * ny, footY - half * nx});
    }
  if (picture.circles)
    for (const auto& [x, y, radius] : *picture.circles) {
      constexpr int sides = 96;
      const auto at = [&](int k) {
        const double angle = 2.0 * std::numbers::pi * k / sides;
        return std::pair(x + radius * std::cos(angle), y + radius * std::sin(angle));
      };
      for (int k = 0; k < sides; ++k)
        groups.add(wallColour, line,
                   {at(k).first, at(k).second, at(k + 1).first, at(k + 1).second});
    }
  groups.moveTo(drawing);
}

/// Bodies in their colours, and walls: spheres as balls, the farthest first.
Drawing bodiesDrawing(const ScenePicture& picture, const std::vector<Disk>& disks) {
  auto walls = wallsOf(picture);
  Drawing drawing{windowOf(picture, disks, walls), {}};
  if (picture.depth) {
    std::vector<std::pair<double, Ball>> balls;
    const auto add = [&](const std::vector<Disk>& some,
                         const std::optional<std::vector<double>>& depth) {
      for (std::size_t k = 0; k < some.size(); ++k)
        if (some[k].radius > 0.0 && depth)
          balls.push_back({at(*depth, k).value_or(0.0),
                           {some[k].x, some[k].y, some[k].radius, some[k].colour}});
    };
    for (Disk& wall : walls) wall.colour = wallColour;
    add(disks, picture.depth);
    add(walls, picture.wallDepth);
    std::ranges::stable_sort(balls, std::greater(), [](const auto& ball) { return ball.first; });
    balls.erase(balls.begin(), balls.end() - std::min(balls.size(), mostBalls));
    for (auto& [depth, ball] : balls) drawing.balls.push_back(std::move(ball));
    walls.clear();
  }
  Groups groups;
  if (!picture.depth)
    for (const Disk& disk : disks) groups.add(disk.colour, disk);
  groups.moveTo(drawing);
  addWalls(picture, walls, drawing);
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

/// "1 0 0 RG"; of what is filled "rg".
std::string pdfColour(const std::string& colour, const char* what) {
  return fmt::format("{:.3f} {:.3f} {:.3f} {}", channel(colour, 0), channel(colour, 1),
                     channel(colour, 2), what);
}

/// PDF's operators of a page: colour, width, then a path to stroke.
std::string pdfContent(const Drawing& drawing, double points) {
  const Window& window = drawing.window;
  const double scale = points / window.larger();
  const auto x = [&](double v) { return shortNumber((v - window.left) * scale); };
  const auto y = [&](double v) { return shortNumber((v - window.bottom) * scale); };
  std::string content = "1 J\n";
  for (const Ball& ball : drawing.balls)
    for (const auto& [share, colour] :
         {std::pair(1.0, std::string("#333333")), {0.94, ball.colour}})
      content += fmt::format("{} {} w\n{} {} m {} {} l S\n", pdfColour(colour, "RG"),
                             shortNumber(2.0 * share * ball.radius * scale), x(ball.x), y(ball.y),
                             x(ball.x), y(ball.y));
  for (const StrokeGroup& group : drawing.groups) {
    content +=
        fmt::format("{} {} w\n", pdfColour(group.colour, "RG"), shortNumber(group.width * scale));
    for (const Stroke& s : group.strokes)
      content += fmt::format("{} {} m {} {} l\n", x(s.x1), y(s.y1), x(s.x2), y(s.y2));
    content += "S\n";
    if (group.outlines.empty()) continue;
    content += pdfColour(group.colour, "rg") + "\n";
    for (const std::vector<double>& outline : group.outlines) {
      for (std::size_t k = 0; k + 1 < outline.size(); k += 2)
        content += fmt::format("{} {} {} ", x(outline[k]), y(outline[k + 1]), k == 0 ? "m" : "l");
      content += "f\n";
    }
  }
  return content;
}

/// Balls with their light from above left, a gradient for each colour.
std::string svgBalls(const Drawing& drawing, const auto& x, const auto& y, double scale) {
  Names colours;
  std::string text, gradients;
  for (const Ball& ball : drawing.balls) {
    addOnce(colours, ball.colour);
    const auto id = std::ranges::find(colours, ball.colour) - colours.begin();
    text += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"url(#b{})\"/>\n", x(ball.x),
                        y(ball.y), shortNumber(ball.radius * scale), id);
  }
  const auto mixed = [](const std::string& colour, double white) {
    std::string result = "#";
    for (std::size_t k = 0; k < 3; ++k)
      result += fmt::format(
          "{:02x}", std::lround(255.0 * (white > 0.0 ? channel(colour, k) * (1.0 - white) + white
                                                     : channel(colour, k) * (1.0 + white))));
    return result;
  };
  for (std::size_t k = 0; k < colours.size(); ++k)
    gradients += fmt::format(
        "<radialGradient id=\"b{}\" cx=\".36\" cy=\".32\" r=\".75\"><stop offset=\"0\" "
        "stop-color=\"{}\"/><stop offset=\".5\" stop-color=\"{}\"/><stop offset=\"1\" "
        "stop-color=\"{}\"/></radialGradient>\n",
        k, mixed(colours[k], 0.6), colours[k], mixed(colours[k], -0.55));
  return text.empty() ? text : "<defs>\n" + gradients + "</defs>\n" + text;
}

}  // namespace

void Window::widen(double share) {
  if (!(left <= right)) *this = {-1.0, 1.0, -1.0, 1.0};
  const double rim = share * larger();
  *this = {left - rim, right + rim, bottom - rim, top + rim};
}

void Window::add(const Window& other) {
  *this = {std::min(left, other.left), std::max(right, other.right), std::min(bottom, other.bottom),
           std::max(top, other.top)};
}

double fastestOf(const ScenePicture& picture) {
  std::vector<double> speeds;
  if (picture.speed)
    for (const double speed : *picture.speed)
      if (std::isfinite(speed)) speeds.push_back(speed);
  if (speeds.empty()) return 0.0;
  const auto place =
      static_cast<std::ptrdiff_t>(std::ceil(0.98 * static_cast<double>(speeds.size() - 1)));
  std::ranges::nth_element(speeds, speeds.begin() + place);
  return std::max(speeds[static_cast<std::size_t>(place)], restingSpeed(picture));
}

double restingSpeed(const ScenePicture& picture) {
  if (picture.radius.empty() || !(picture.time > 0.0)) return 0.0;
  return 0.01 * 2.0 * std::ranges::min(picture.radius) / picture.time;
}

Drawing sceneDrawing(const ScenePicture& picture, double fastest) {
  auto disks = disksOf(picture);
  double low = INFINITY, high = 0.0;
  for (const Disk& disk : disks) {
    low = std::min(low, disk.radius);
    high = std::max(high, disk.radius);
  }
  const double resting = restingSpeed(picture);
  for (std::size_t k = 0; k < disks.size(); ++k) {
    const auto speed = picture.speed ? at(*picture.speed, k) : std::nullopt;
    if (fastest > 0.0)
      disks[k].colour =
          speed ? shadeOf(*speed > resting ? std::sqrt(*speed / fastest) : 0.0) : plainColour;
    else
      disks[k].colour = shadeOf(high > low ? (disks[k].radius - low) / (high - low) : 0.5);
  }
  return bodiesDrawing(picture, disks);
}

Drawing stripDrawing(const std::vector<ScenePicture>& pictures, double fastest) {
  constexpr double pitch = 1.06;  // of the widest
  Drawing strip;
  std::vector<Drawing> frames;
  for (const ScenePicture& picture : pictures)
    strip.window.add(frames.emplace_back(sceneDrawing(picture, fastest)).window);
  const double step = pitch * strip.window.width();
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const double right = static_cast<double>(k) * step;
    for (StrokeGroup& group : frames[k].groups) {
      for (Stroke& stroke : group.strokes) stroke.x1 += right, stroke.x2 += right;
      for (std::vector<double>& outline : group.outlines)
        for (std::size_t c = 0; c < outline.size(); c += 2) outline[c] += right;
    }
    for (Ball& ball : frames[k].balls) ball.x += right;
    std::ranges::move(frames[k].groups, std::back_inserter(strip.groups));
    std::ranges::move(frames[k].balls, std::back_inserter(strip.balls));
  }
  if (!frames.empty()) strip.window.right += step * static_cast<double>(frames.size() - 1);
  return strip;
}

Drawing originsDrawing(const ScenePicture& picture, double inner, double diameter) {
  auto disks = disksOf(picture);
  double reach = 0.0;
  for (const Disk& disk : disks) reach = std::max(reach, std::hypot(disk.x, disk.y));
  const double band = 2.0 * (diameter > 0.0 ? diameter : reach / 15.0);
  for (std::size_t k = 0; k < disks.size(); ++k) {
    const auto radius = at(picture.startR, k), angle = at(picture.startPhi, k);
    disks[k].colour = radius && angle ? originColour(*radius, *angle, band, inner) : plainColour;
  }
  return bodiesDrawing(picture, disks);
}

Drawing forcesDrawing(const ScenePicture& picture, double widest, double width) {
  auto disks = disksOf(picture);
  if (picture.depth) {  // without contacts
    for (Disk& disk : disks) disk.colour = "#c8d4dc";
    return bodiesDrawing(picture, disks);
  }
  const auto walls = wallsOf(picture);
  Drawing drawing{windowOf(picture, disks, walls), {}};
  const double outline = drawing.window.larger() / 1000.0;
  double largest = 0.0;
  Groups rims, fills;
  for (const Disk& disk : disks) {
    rims.add("#c8d4dc", disk);
    fills.add("#f6f9fb", disk, outline);
    largest = std::max(largest, disk.radius);
  }
  rims.moveTo(drawing);
  fills.moveTo(drawing);
  addWalls(picture, walls, drawing);
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
  const Window& window = drawing.window;
  const double scale = size / window.larger();
  const auto x = [&](double v) { return shortNumber((v - window.left) * scale); };
  const auto y = [&](double v) { return shortNumber((window.top - v) * scale); };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\">\n<title>{2}</title>\n{3}<g fill=\"none\" stroke-linecap=\"round\">\n",
      shortNumber(window.width() * scale), shortNumber(window.height() * scale), escaped(title),
      svgBalls(drawing, x, y, scale));
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
  const double points = size * 72.0 / 96.0, scale = points / drawing.window.larger();
  const std::string content = pdfContent(drawing, points);
  const Names objects = {
      "<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
      fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {} {}] /Contents 4 0 R >>",
                  shortNumber(drawing.window.width() * scale),
                  shortNumber(drawing.window.height() * scale)),
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
  const double size = picture.shows == Picture::Shows::strip ? 2.0 * pictureSize : pictureSize;
  writeFile(dir / (picture.name + ".svg"), toSvg(picture.drawing, size, picture.title));
  writeFile(dir / (picture.name + ".pdf"), toPdf(picture.drawing, size));
}

}  // namespace crossgrain::reports
