#include "adapters/files/file_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "support/bad_input.hpp"

namespace crossgrain::files {
namespace {

/// Limit of motion and offsets out of the plane, relative to the largest velocity, spin or extent.
constexpr double outOfPlane = 1e-6;

constexpr std::array<std::string_view, 3> planeNames = {"xy", "xz", "yz"};
constexpr char axisName(int axis) {
  return "xyz"[axis];
}

/// YADE works its contacts out at the beginning of a step, and then moves on; all of these formats
/// are its exports.
bool isYades(std::string_view format) {
  return format == "yade-text" || format == "vtk" || format == "ondem";
}

}  // namespace

void fail(const FileFrame& frame, const std::string& what) {
  throw BadInput(fmt::format("{}: {}", frame.where, what));
}

std::vector<SettingSpec> fileSettings(std::string_view format, int dimension) {
  const double behind = isYades(format) ? 1.0 : 0.0;
  std::vector<SettingSpec> settings = {
      {"length", 1.0, "m", "unit of length of the files: 0.001 where they are in mm", {}},
      {"time", 1.0, "s", "unit of time of the files", {}},
      {"mass", 1.0, "kg", "unit of mass of the files", {}},
      {"dt",
       0.0,
       "file's time",
       "time step of files that count steps and have no times; 0: not said",
       {}},
      {"start", 0.0, "file's time", "when the case's t = 0 is", {}, -INFINITY},
      {"contacts_behind", behind, "steps", "by which contacts are older than positions", {}},
      {"plane",
       std::string("xy"),
       "",
       "axes of the files that are x and y of the case",
       {planeNames.begin(), planeNames.end()}},
      {"columns",
       std::string(),
       "",
       "what columns mean whose names are the user's own (docs/file-formats.md)",
       {}}};
  if (dimension == 3)
    std::erase_if(settings, [](const SettingSpec& spec) { return spec.name == "plane"; });
  return settings;
}

FileUnits fileUnits(std::string_view format, const Settings& settings) {
  Settings all;
  for (const SettingSpec& spec : fileSettings(format, 2)) all[spec.name] = spec.defaultValue;
  for (const auto& [name, value] : settings) all[name] = value;
  const auto number = [&](const char* name) { return std::get<double>(all.at(name)); };
  FileUnits units;
  units.length = number("length");
  units.time = number("time");
  units.mass = number("mass");
  for (const auto& [name, value] :
       {std::pair("length", units.length), {"time", units.time}, {"mass", units.mass}})
    if (!(value > 0.0)) throw BadInput(fmt::format("{} = {:g}: a unit must be > 0", name, value));
  units.dt = number("dt");
  units.start = number("start");
  units.contactsBehind = number("contacts_behind");
  // The third axis, seen so that the second is a quarter turn counter-clockwise from the first:
  // z × x = y, y × z = x, but x × z = −y.
  const std::string& plane = std::get<std::string>(all.at("plane"));
  units.axes[0] = plane == "yz" ? 1 : 0;
  units.axes[1] = plane == "xy" ? 1 : 2;
  units.axes[2] = units.third();
  units.turn = plane == "xz" ? -1.0 : 1.0;
  return units;
}

namespace {

/// Refuses particles that lie beside the others, or move out of the plane.
void checkPlane(const FileFrame& frame, const FileUnits& units) {
  const FileParticles& all = frame.particles;
  const int third = units.third();
  const Vec3& first = all.position.front();
  Vec3 low = first, high = first;
  for (const Vec3& x : all.position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double extent = (high - low).maxCoeff();
  if (high[third] - low[third] > outOfPlane * extent) {
    std::string hint = ", in space it has dimension = 3";
    for (std::size_t k = 0; k < planeNames.size(); ++k)  // the plane without axis 2, 1, 0
      if (const int other = 2 - static_cast<int>(k); (high - low)[other] <= outOfPlane * extent)
        hint = fmt::format("; nothing differs in {}: say plane = \"{}\"", axisName(other),
                           planeNames[k]);
    fail(frame, fmt::format("particles lie from {} = {:.6g} to {:.6g}: the case is plane{}",
                            axisName(third), low[third], high[third], hint));
  }
  double speed = 0.0, spin = 0.0;
  for (const Vec3& v : all.velocity) speed = std::max(speed, v.norm());
  for (const Vec3& w : all.spin) spin = std::max(spin, w.norm());
  for (std::size_t k = 0; k < all.velocity.size(); ++k)
    if (std::abs(all.velocity[k][third]) > outOfPlane * speed)
      fail(frame, fmt::format("particle {} moves along {}: the case is plane", all.id[k],
                              axisName(third)));
  for (std::size_t k = 0; k < all.spin.size(); ++k)
    if (Vec3 w = all.spin[k]; w[third] = 0.0, w.norm() > outOfPlane * spin)
      fail(frame, fmt::format("particle {} spins about an axis that lies in the plane", all.id[k]));
}

/// "a case in space takes all three components", "plane = \"xz\" takes x and z of the files"
std::string describeNeed(const FileUnits& units) {
  if (units.dimension == 3) return "a case in space takes all three components";
  return fmt::format("plane = \"{0}{1}\" takes {0} and {1} of the files", axisName(units.axes[0]),
                     axisName(units.axes[1]));
}

void checkComponents(const FileFrame& frame, const FileUnits& units) {
  if (const auto* const lack = neededComponent(frame.particles.missing, units, false))
    fail(frame, fmt::format("there is no column {}: {}", lack->column, describeNeed(units)));
  if (!frame.contacts) return;
  for (const bool axial : {false, true})
    if (const auto* const lack = neededComponent(frame.contacts->missing, units, axial))
      fail(frame, fmt::format("its contacts have no column {}: {}", lack->column,
                              axial ? "a torque has that component" : describeNeed(units)));
}

/// Of an edge that the case does not have, whatever crosses it has an image there that the case
/// does not know.
void checkEdge(const FileFrame& frame, int axis) {
  const FileParticles& all = frame.particles;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double x = all.position[k][axis], a = all.radius.empty() ? 0.0 : all.radius[k];
    if (x - a < frame.box->low[axis] || x + a > frame.box->high[axis])
      fail(frame, fmt::format(
                      "particle {} reaches over the periodic edge at {} = {:.6g}: the case has no "
                      "periodic edge there",
                      all.id[k], axisName(axis),
                      x - a < frame.box->low[axis] ? frame.box->low[axis] : frame.box->high[axis]));
  }
}

/// Decimal digits that a number needs; those that only its change of unit has added do not count.
int digitsOf(double x) {
  const std::string text = fmt::format("{:.14g}", std::abs(x)),
                    mantissa = text.substr(0, text.find('e'));
  int digits = 0, zeros = 0;
  for (const char c : mantissa) {
    if (c == '.') continue;
    if (c == '0') {
      zeros += digits > 0;  // those in front do not count, those behind are not known yet
      continue;
    }
    digits += zeros + 1;
    zeros = 0;
  }
  return digits;
}

}  // namespace

template <int D>
FileBox boxInFiles(const BoxOf<D>& box, const FileUnits& units) {
  FileBox made;
  for (int k = 0; k < D; ++k) {
    const int axis = units.axes[k];
    made.low[axis] = box.low[k] / units.length;
    made.high[axis] = box.high[k] / units.length;
    made.periodic[axis] = box.periodic[static_cast<std::size_t>(k)];
  }
  return made;
}
template FileBox boxInFiles(const BoxOf<2>&, const FileUnits&);
template FileBox boxInFiles(const BoxOf<3>&, const FileUnits&);

const MissingComponent* neededComponent(const std::vector<MissingComponent>& missing,
                                        const FileUnits& units, bool axial) {
  const auto found = std::ranges::find_if(missing, [&](const MissingComponent& one) {
    return one.axial == axial && (units.dimension == 3 || (one.axis == units.third()) == axial);
  });
  return found == missing.end() ? nullptr : &*found;
}

template <int D>
void checkParticles(const FileFrame& frame, const FileUnits& units,
                    const std::optional<BoxOf<D>>& box) {
  checkComponents(frame, units);
  if (D == 2) checkPlane(frame, units);
  if (!frame.box) return;
  constexpr double samePeriod = 1e-5;  // of six digits
  for (int k = 0; k < D; ++k) {
    const int axis = units.axes[k];
    const double width = units.length * (frame.box->high[axis] - frame.box->low[axis]);
    const bool isPeriodic = box && box->periodic[static_cast<std::size_t>(k)];
    const double period = isPeriodic ? box->high[k] - box->low[k] : 0.0;
    if (!frame.box->periodic[axis]) {
      if (isPeriodic && frame.box->saidFixed[axis])
        fail(frame, fmt::format("its box is fixed along {} and {:.7g} m wide, the case's is "
                                "periodic over {:.7g} m",
                                axisName(axis), width, period));
    } else if (!isPeriodic) {
      checkEdge(frame, axis);
    } else if (std::abs(width - period) > samePeriod * period) {
      fail(frame,
           fmt::format("its box is periodic along {} over {:.7g} m, the case's over {:.7g} m",
                       axisName(axis), width, period));
    }
  }
}
template void checkParticles(const FileFrame&, const FileUnits&, const std::optional<BoxOf<2>>&);
template void checkParticles(const FileFrame&, const FileUnits&, const std::optional<BoxOf<3>>&);

LastDigit lastDigitOf(const std::vector<double>& numbers) {
  constexpr std::size_t most = 1000;
  constexpr int clear = 10;
  int digits = 1;
  double place = INFINITY;
  for (std::size_t k = 0; k < std::min(most, numbers.size()); ++k) {
    if (numbers[k] == 0.0) continue;
    const int own = std::min(digitsOf(numbers[k]), clear);
    digits = std::max(digits, own);
    place = std::min(place, std::pow(10.0, std::floor(std::log10(std::abs(numbers[k]))) + 1 - own));
  }
  return {std::pow(10.0, 1 - digits), std::isfinite(place) ? place : 0.0};
}

namespace {

/// Of those, as many as tell.
std::vector<double> sampleOf(const std::vector<Vec3>& position, const FileUnits& units) {
  constexpr std::size_t most = 1000;
  const std::size_t stride = std::max<std::size_t>(1, position.size() / most);
  std::vector<double> sample;
  for (std::size_t k = 0; k < position.size(); k += stride)
    for (int axis = 0; axis < units.dimension; ++axis)
      sample.push_back(position[k][units.axes[axis]]);
  return sample;
}

}  // namespace

double roundingOf(const std::vector<Vec3>& position, const FileUnits& units) {
  std::array<std::size_t, 20> count{};
  std::size_t all = 0;
  for (const double x : sampleOf(position, units))
    if (x != 0.0) {
      ++count[static_cast<std::size_t>(std::min(digitsOf(x), 19))];
      ++all;
    }
  std::size_t digits = count.size() - 1;
  while (digits > 0 && count[digits] == 0) --digits;
  if (digits < 5 || digits > 8 || 2 * (count[digits] + count[digits - 1]) < all) return 1e-6;
  return 2.0 * std::pow(10.0, 1.0 - static_cast<double>(digits));
}

std::optional<ShownPlaces> shownPlacesOf(const FileParticles& particles, const FileUnits& units) {
  if (particles.scaled) return std::nullopt;
  constexpr double single = 0x1p-23;
  const std::vector<double> places = sampleOf(particles.position, units);
  ShownPlaces shown;
  shown.unit = units.length;
  shown.position = lastDigitOf(places);
  const auto isSingle = [&](double x) {
    const double place =
        shown.position.relative * std::pow(10.0, std::floor(std::log10(std::abs(x))));
    return x == 0.0 || std::abs(x - static_cast<double>(static_cast<float>(x))) <= 0.5 * place;
  };
  if (std::ranges::all_of(places, isSingle)) shown.binary = single;
  // Of one radius or a few the last digits may be noughts: then they have those of the places.
  // Radii may be half of diameters, whose last place is twice as much.
  constexpr std::size_t several = 8;
  const std::set<double> different(
      particles.radius.begin(),
      particles.radius.begin() +
          static_cast<std::ptrdiff_t>(std::min<std::size_t>(1000, particles.radius.size())));
  std::vector<double> radii(different.begin(), different.end());
  shown.radius = {shown.position.relative, 0.0};
  if (radii.size() >= several) {
    const LastDigit own = lastDigitOf(radii);
    for (double& radius : radii) radius *= 2.0;
    const LastDigit twice = lastDigitOf(radii);
    shown.radius = {std::max(own.relative, twice.relative), std::max(own.place, 0.5 * twice.place)};
  }
  return shown;
}

}  // namespace crossgrain::files
