#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "cases/collision_scene.hpp"
#include "cases/keys.hpp"
#include "cases/loader.hpp"
#include "cli/calibrate_text.hpp"
#include "cli/option_groups.hpp"
#include "law/law_options.hpp"
#include "oracle/calibration.hpp"
#include "studies/core/study.hpp"
#include "support/bad_input.hpp"
#include "support/nearest.hpp"
#include "support/terminal.hpp"

namespace crossgrain::inline cli {
namespace {

/// Request of calibrate: wanted values, or constants, or a case file (CommandLine::inputs), and the
/// pair that they are for; or wanted values and constants of rolling resistance and cohesion, of a
/// disk on a plane or of a pair. SI units, angles in degrees.
struct Request {
  std::optional<double> en, et0, contactTime;
  std::optional<double> kn, gn, kt, gt;
  std::optional<double> mass, mass2, radius, radius2, inertiaFactor;
  std::optional<double> mu, vn;
  std::optional<std::string> tension, tangential;
  std::optional<double> rollingFrequency, rollingDecay, restAngle, pullOff;
  std::optional<double> kr, gr, muR, w;
  std::optional<std::string> rollingLength, rollingStiffness, rollingDamper, cohesion;
};

enum class Part { wanted, constant, body, further, resistance };

/// An option of one number, and what it may be.
struct Number {
  Part part;
  const char* option;
  std::optional<double> Request::*member;
  const char* what;
  Range range;
};

const std::vector<Number>& numbers() {
  using enum Part;
  const Range massOrWall{.low = 0.0, .lowOpen = true, .unit = "kg", .mayBeInfinite = true};
  static const std::vector<Number> all = {
      {wanted, "--en", &Request::en, "wanted: normal restitution e_n", aboveZeroTo(1.0)},
      {wanted, "--et", &Request::et0,
       "wanted: tangential restitution e_t0 of a contact that never slips",
       Range{.low = -1.0, .high = 1.0, .lowOpen = true}},
      {wanted, "--tc", &Request::contactTime, "wanted: contact time [s]; or --kn", positive("s")},
      {constant, "--kn", &Request::kn,
       "normal stiffness [N/m]: wanted, with --en instead of --tc; or given", positive("N/m")},
      {constant, "--gn", &Request::gn, "given: normal damping [kg/s]", atLeast(0.0, "kg/s")},
      {constant, "--kt", &Request::kt, "given: tangential stiffness [N/m]", atLeast(0.0, "N/m")},
      {constant, "--gt", &Request::gt, "given: tangential damping [kg/s]", atLeast(0.0, "kg/s")},
      {body, "--mass", &Request::mass, "mass of the first body [kg]", positive("kg")},
      {body, "--mass2", &Request::mass2, "of the second [kg]; inf: a wall (default: as the first)",
       massOrWall},
      {body, "--radius", &Request::radius, "radius of the first body [m]", positive("m")},
      {body, "--radius2", &Request::radius2, "of the second [m] (default: as the first)",
       positive("m")},
      {body, "--inertia-factor", &Request::inertiaFactor, "q in J = q m a^2 (default: 0.5, a disk)",
       aboveZeroTo(1.0)},
      {further, "--mu", &Request::mu, "Coulomb's coefficient", positive()},
      {further, "--vn", &Request::vn, "speed of an impact, for its overlap [m/s]", positive("m/s")},
      {resistance, "--rolling-frequency", &Request::rollingFrequency,
       "wanted: frequency of the rolling spring [Hz], of a disk that rolls on a plane (--mass2 "
       "inf), or of a pair about held centres",
       positive("Hz")},
      {resistance, "--rolling-decay", &Request::rollingDecay,
       "wanted with it: rate at which its amplitude falls, e^(-t*rate) [1/s] (default: 0)",
       atLeast(0.0, "1/s")},
      {resistance, "--rest-angle", &Request::restAngle,
       "wanted: steepest incline that a disk rests on [degrees]", inside(0.0, 90.0, "degrees")},
      {resistance, "--pull-off", &Request::pullOff, "wanted: largest pull of a contact [N]",
       positive("N")},
      {resistance, "--kr", &Request::kr, "given: rolling stiffness, as --rolling-stiffness says",
       positive("N/m")},
      {resistance, "--gr", &Request::gr, "given: rolling damping, as --rolling-damper says",
       atLeast(0.0)},
      {resistance, "--mu-r", &Request::muR, "given: coefficient of rolling resistance", positive()},
      {resistance, "--w", &Request::w, "given: work of adhesion, 2 gamma [J/m^2]",
       positive("J/m^2")},
  };
  return all;
}

const Number* firstGiven(const Request& request, Part part) {
  for (const Number& number : numbers())
    if (number.part == part && request.*number.member) return &number;
  return nullptr;
}

double need(std::optional<double> value, const char* option, const char* why) {
  if (!value) throw BadInput(fmt::format("{} is missing: {}", option, why));
  return *value;
}

CollidingPair askedPair(const Request& request) {
  const double mass = need(request.mass, "--mass", "constants are for a pair of bodies [kg]");
  const double radius = need(request.radius, "--radius", "constants are for a pair of bodies [m]");
  CollidingPair pair{
      {radius, request.radius2.value_or(radius)}, {mass, request.mass2.value_or(mass)}, {}};
  for (const int k : {0, 1})
    pair.inertia[k] =
        request.inertiaFactor.value_or(0.5) * pair.mass[k] * pair.radius[k] * pair.radius[k];
  const ReducedPair two = reduced(pair);
  if (!std::isnormal(two.mass) || !std::isnormal(two.K))
    throw BadInput(fmt::format("--mass = {}, --radius = {}: too small or too large to compute with",
                               mass, radius));
  return pair;
}

std::string describe(const CollidingPair& pair, const Request& request) {
  return fmt::format("masses {} and {} kg, radii {} and {} m, J = {} m a²", pair.mass[0],
                     pair.mass[1], pair.radius[0], pair.radius[1],
                     request.inertiaFactor.value_or(0.5));
}

void setOption(ContactLaw& law, const char* option, const std::string& value,
               const std::vector<std::string>& values) {
  if (std::ranges::find(values, value) == values.end())
    throw BadInput(fmt::format("--{} = {}{}", option, value, suggestion(value, values)));
  setLawOption(law, option, value);
}

ContactLaw startOfLaw(const Request& request) {
  ContactLaw law;
  law.conventions = usualConventions();
  law.mu = request.mu.value_or(0.0);
  if (request.tension) setOption(law, "tension", *request.tension, {"allow", "cut"});
  return law;
}

/// From e_n with t_c or k_n. @returns which, for the head
std::string setNormal(ContactLaw& law, const Request& request, double en, double mass) {
  if (request.kn) {
    calibrateDamping(law, en, *request.kn, mass);
    return fmt::format("k_n = {} N/m", *request.kn);
  }
  const double time =
      need(request.contactTime, "--tc", "the contact time wanted [s]; or --kn, the stiffness");
  calibrateNormal(law, en, time, mass);
  if (!std::isnormal(law.kn)) throw BadInput(fmt::format("--tc = {}: no kn fits it", time));
  return fmt::format("t_c = {} s", time);
}

/// Two options that say the same thing may say different things.
void refuseContradictions(const Request& is) {
  const char *const damping = "e_n gives gn", *const tangent = "e_t0 gives kt and gt",
                    *const each = "one gives the other";
  const std::tuple<const char*, const char*, bool, const char*> pairs[] = {
      {"--tc", "--kn", is.contactTime && is.kn, "with e_n each gives the other"},
      {"--en", "--gn", is.en && is.gn, damping},
      {"--et", "--kt", is.et0 && is.kt, tangent},
      {"--et", "--gt", is.et0 && is.gt, tangent},
      {"--rolling-frequency", "--kr", is.rollingFrequency && is.kr, each},
      {"--rolling-frequency", "--gr", is.rollingFrequency && is.gr, each},
      {"--rest-angle", "--mu-r", is.restAngle && is.muR, each},
      {"--pull-off", "--w", is.pullOff && is.w, each}};
  for (const auto& [wanted, constant, both, why] : pairs)
    if (both)
      throw BadInput(fmt::format("{} and {}: {}; leave one of them out", wanted, constant, why));
}

std::string fromWanted(const Request& request) {
  const CollidingPair pair = askedPair(request);
  const double en = need(request.en, "--en", "the normal restitution wanted");
  ContactLaw law = startOfLaw(request);
  setOption(law, "tangential", request.tangential.value_or("spring_dashpot"),
            {"spring", "spring_dashpot"});
  const ReducedPair two = reduced(pair);
  std::string asked = fmt::format("e_n = {}, {}", en, setNormal(law, request, en, two.mass));
  if (request.et0) {
    // A contact that slips at first touch sticks again by the usual reset and update of springs;
    // see ImpliedImpact::firstTouchSticksToPsi.
    calibrateTangential(law, *request.et0, two);
    asked += fmt::format(", e_t0 = {}", *request.et0);
  } else {
    if (request.mu || request.tangential)
      throw BadInput("--et is missing: a law with friction has a tangential restitution");
    law.tangential = TangentialLaw::none;
  }
  return lawText(law, fmt::format("{}; {}", asked, describe(pair, request))) +
         impactText(law, pair, request.vn);
}

std::string fromConstants(const Request& request) {
  if (request.tangential) throw BadInput("--tangential: --kt and --gt already say which law it is");
  const CollidingPair pair = askedPair(request);
  ContactLaw law = startOfLaw(request);
  law.kn = need(request.kn, "--kn", "the normal stiffness [N/m]");
  law.gn = need(request.gn, "--gn", "an undamped law says 0 [kg/s]; or --en, if kn is wanted");
  law.kt = request.kt.value_or(0.0);
  law.gt = request.gt.value_or(0.0);
  law.tangential = tangentialLawOf(law);
  const double critical = 2.0 * std::sqrt(law.kn * reduced(pair).mass);
  if (!(law.gn < critical))
    throw BadInput(
        fmt::format("--gn = {}: must be < {:.6g} kg/s, critical for this pair", law.gn, critical));
  return lawText(law, fmt::format("these constants; {}", describe(pair, request))) +
         impactText(law, pair, request.vn);
}

/// Of an impact under a law that stiffens [m/s].
double speedOf(const Case& setup, const Request& request) {
  if (request.vn) return *request.vn;
  if (isAssembly(setup))
    throw BadInput(
        "--vn is missing: the speed of impacts, on which this law's restitution depends");
  return isCollision(setup) ? collisionIn(setup).vn.front() : couetteIn(setup).cell.rimSpeed();
}

std::string fromCase(const CommandLine& line, const Request& request) {
  for (const Number& number : numbers())
    if (number.part >= Part::body && request.*number.member && number.member != &Request::vn)
      throw BadInput(fmt::format("{}: the case file says it", number.option));
  if (request.tension || request.tangential)
    throw BadInput("--tension and --tangential: the case file says it; --set changes it");
  const auto& file = line.inputs.front();
  const std::vector<Case> cases = loadCase(file, line.overrides);
  if (isAssembly(cases.front()) &&
      withAssembly(cases.front(), [](const auto& assembly) { return assembly.disks.empty(); }))
    throw BadInput(
        fmt::format("{}: its disks are those of start files, of any radius: give the law's "
                    "constants and a pair's masses, as --kn, --gn and --mass",
                    file.string()));
  for (const Case& setup : cases)
    if (setup.law.normal == NormalLaw::rigid)
      throw BadInput(fmt::format("{}: its law is rigid, which is given by e_n and e_t0 themselves",
                                 file.string()));
  std::string text;
  if (const auto keys = keysWithoutUse(cases.front(), "calibrate"); !keys.empty())
    text = fmt::format("# not used: {}\n", fmt::join(keys, ", "));
  for (const Case& setup : cases) {
    if (&setup != &cases.front()) text += '\n';
    if (cases.size() > 1) text += fmt::format("# variant {}\n", setup.variant);
    text += lawText(setup.law, file.filename().string()) + materialsText(setup);
    text += setup.law.stiffens() ? stiffeningPairsText(pairsOf(setup), speedOf(setup, request))
                                 : pairsText(pairsOf(setup), request.vn);
  }
  return text;
}

/// A plane unless the second body has a finite mass; only its radius matters to cohesion.
CollidingPair restingPair(const Request& request, bool massMatters) {
  const double radius = need(request.radius, "--radius", "of the disk [m]");
  const double mass = massMatters ? need(request.mass, "--mass", "what oscillates has one [kg]")
                                  : request.mass.value_or(1.0);
  const double factor = request.inertiaFactor.value_or(0.5);
  const double mass2 = request.mass2.value_or(mass), radius2 = request.radius2.value_or(radius);
  if (!std::isfinite(mass2)) return diskOnWall(radius, mass, factor * mass * radius * radius);
  return {{radius, radius2},
          {mass, mass2},
          {factor * mass * radius * radius, factor * mass2 * radius2 * radius2}};
}

void setIfGiven(ContactLaw& law, const char* name, const std::optional<std::string>& value) {
  if (!value) return;
  try {
    setLawOption(law, name, *value);
  } catch (const std::invalid_argument& error) {
    throw BadInput(error.what());
  }
}

std::string rolling(const Request& request) {
  constexpr double degree = std::numbers::pi / 180.0;
  if (request.rollingDecay && !request.rollingFrequency)
    throw BadInput("--rolling-frequency is missing: a decay is that of an oscillation");
  if (request.gr && !request.kr) throw BadInput("--kr is missing: --gr is the dashpot beside it");
  ContactLaw law;
  law.rolling = RollingLaw::spring;
  setIfGiven(law, "rolling_length", request.rollingLength);
  setIfGiven(law, "rolling_stiffness", request.rollingStiffness);
  setIfGiven(law, "rolling_damper", request.rollingDamper);
  law.muR = request.restAngle ? rollingCoefficientOf(law, *request.restAngle * degree)
                              : request.muR.value_or(0.0);
  law.kr = request.kr.value_or(0.0);
  law.gr = request.gr.value_or(0.0);
  std::optional<CollidingPair> pair;
  if (request.rollingFrequency || request.kr) pair = restingPair(request, true);
  if (request.rollingFrequency)
    calibrateRolling(law, *pair, *request.rollingFrequency, request.rollingDecay.value_or(0.0));
  try {
    return rollingText(law, pair);
  } catch (const std::invalid_argument& error) {
    throw BadInput(fmt::format("--gr = {}: {}", law.gr, error.what()));
  }
}

std::string cohesion(const Request& request) {
  ContactLaw law;
  if (!request.cohesion) throw BadInput("--cohesion is missing: dmt or jkr, whose pulls differ");
  setIfGiven(law, "cohesion", request.cohesion);
  if (law.cohesion != CohesionLaw::dmt && law.cohesion != CohesionLaw::jkr)
    throw BadInput(
        fmt::format("--cohesion = {}: dmt and jkr have a work of adhesion", *request.cohesion));
  const double radius = restingPair(request, false).reducedRadius();
  law.w = request.pullOff ? workOfAdhesion(law, *request.pullOff, radius)
                          : need(request.w, "--w", "the work of adhesion [J/m^2]; or --pull-off");
  return cohesionText(law, radius);
}

/// Whether rolling resistance is asked, and cohesion.
std::pair<bool, bool> resistancesOf(const Request& is) {
  return {is.rollingFrequency || is.rollingDecay || is.restAngle || is.kr || is.gr || is.muR ||
              is.rollingLength || is.rollingStiffness || is.rollingDamper,
          is.pullOff || is.w || is.cohesion};
}

std::string fromResistances(const CommandLine& line, const Request& request) {
  const auto [rolls, coheres] = resistancesOf(request);
  for (const Number& number : numbers())
    if (request.*number.member && number.part != Part::body && number.part != Part::resistance)
      throw BadInput(fmt::format("{}: rolling resistance and cohesion are a call of their own",
                                 number.option));
  if (!line.inputs.empty() || request.tension || request.tangential)
    throw BadInput("rolling resistance and cohesion are a call of their own");
  return "[law]\n" + (rolls ? rolling(request) : "") + (coheres ? cohesion(request) : "");
}

int calibrate(const CommandLine& line, const Request& request) {
  for (const Number& number : numbers())
    if (const auto value = request.*number.member; value && !number.range.contains(*value))
      throw BadInput(
          fmt::format("{} = {}: must be {}", number.option, *value, number.range.text()));
  refuseContradictions(request);
  if (const auto [rolls, coheres] = resistancesOf(request); rolls || coheres) {
    printLines(stdout, fromResistances(line, request));
    return exitPassed;
  }
  const Number* wanted = firstGiven(request, Part::wanted);
  // A stiffness may be wanted, too.
  const bool constant = request.gn || request.kt || request.gt || (request.kn && !wanted);
  const bool ofCase = !line.inputs.empty();
  if ((wanted != nullptr) + constant + ofCase != 1)
    throw BadInput(
        "calibrate takes one of: wanted values (--en, --et, --tc or --kn), constants (--kn, --gn, "
        "--kt, --gt), a case file; see crossgrain calibrate --help");
  if (!ofCase && !line.overrides.empty())
    throw BadInput("--set changes a case file, and there is none");
  printLines(stdout, ofCase   ? fromCase(line, request)
                     : wanted ? fromWanted(request)
                              : fromConstants(request));
  return exitPassed;
}

Action declareCalibrate(CLI::App& app, CommandLine& line) {
  const auto request = std::make_shared<Request>();
  addInputs(app, line, "case", "case file: what its law means for each pair", 0, 1);
  addOverrides(app, line);
  const auto addNumbers = [&](bool ofResistance) {
    for (const Number& number : numbers())
      if ((number.part == Part::resistance) == ofResistance)
        addNumber(app, number.option, (*request).*number.member, number.what);
  };
  addNumbers(false);
  addText(app, "--tension", request->tension, "whether contacts pull (default: allow)",
          "allow|cut");
  addText(app, "--tangential", request->tangential,
          "tangential law wanted (default: spring_dashpot)", "spring|spring_dashpot");
  addNumbers(true);
  addText(app, "--rolling-length", request->rollingLength,
          "length of rolling resistance (default: effective)",
          "effective|twice_effective|smaller_radius|mean_radius");
  addText(app, "--rolling-stiffness", request->rollingStiffness,
          "what kr is times (default: length_square)", "length_square|radii|constant");
  addText(app, "--rolling-damper", request->rollingDamper, "what gr is (default: constant)",
          "constant|critical");
  addText(app, "--cohesion", request->cohesion, "law of the pull", "dmt|jkr");
  return [&line, request] { return calibrate(line, *request); };
}

}  // namespace

extern const Command calibrateCommand = {
    "calibrate", "compute law constants from restitution and contact time, and back",
    "crossgrain calibrate --en 0.9 --et 0.5 --tc 1e-3 --mass 1e-3 --radius 5e-3 --mu 0.4\n"
    "crossgrain calibrate --en 0.9 --kn 1e4 --mass 1e-3 --radius 5e-3\n"
    "crossgrain calibrate --kn 352.1 --gn 0.19 --kt 267.1 --gt 0.15 --mu 0.44 --mass 0.275e-3 "
    "--radius 3.7e-3\n"
    "crossgrain calibrate cases/couette/quick.toml\n"
    "crossgrain calibrate --rolling-frequency 20 --rolling-decay 5 --rest-angle 15 --mass 1e-3 "
    "--mass2 inf --radius 5e-3\n"
    "crossgrain calibrate --pull-off 1e-3 --cohesion jkr --radius 5e-3",
    declareCalibrate};

}  // namespace crossgrain::inline cli
