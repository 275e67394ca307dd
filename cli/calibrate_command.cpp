#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "cases/collision_scene.hpp"
#include "cases/keys.hpp"
#include "cases/loader.hpp"
#include "cli/calibrate_contact.hpp"
#include "cli/calibrate_text.hpp"
#include "cli/option_groups.hpp"
#include "law/law_options.hpp"
#include "oracle/calibration.hpp"
#include "studies/core/study_cases.hpp"
#include "support/bad_input.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cli {
namespace {

/// Request of calibrate: wanted values, or constants, or a case file (CommandLine::inputs), and the
/// pair that they are for. SI units.
struct Request {
  std::optional<double> en, et0, contactTime;
  std::optional<double> kn, gn, kt, gt;
  std::optional<double> mass, mass2, radius, radius2, inertiaFactor;
  std::optional<double> mu, vn;
  std::optional<std::string> tension, tangential;
  ContactRequest contact;
};

enum class Part { wanted, constant, body, further };

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
  };
  return all;
}

const Number* firstGiven(const Request& request, Part part) {
  for (const Number& number : numbers())
    if (number.part == part && request.*number.member) return &number;
  return nullptr;
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
void refuseContradictions(const Request& request) {
  const bool en = request.en.has_value(), et = request.et0.has_value();
  const bool kn = request.kn.has_value(), time = request.contactTime.has_value();
  const std::tuple<const char*, const char*, bool, const char*> pairs[] = {
      {"--tc", "--kn", time && kn, "with e_n each gives the other"},
      {"--en", "--gn", en && request.gn, "e_n gives gn"},
      {"--et", "--kt", et && request.kt, "e_t0 gives kt and gt"},
      {"--et", "--gt", et && request.gt, "e_t0 gives kt and gt"}};
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

int calibrate(const CommandLine& line, const Request& request) {
  for (const Number& number : numbers())
    if (const auto value = request.*number.member; value && !number.range.contains(*value))
      throw BadInput(
          fmt::format("{} = {}: must be {}", number.option, *value, number.range.text()));
  if (request.contact.given()) {
    for (const Number& number : numbers())
      if (request.*number.member && number.part != Part::body)
        throw BadInput(fmt::format("{}: rolling resistance and cohesion are a call of their own",
                                   number.option));
    if (!line.inputs.empty() || request.tension || request.tangential)
      throw BadInput("rolling resistance and cohesion are a call of their own");
    fmt::print("{}", request.contact.answer({request.radius, request.radius2, request.mass,
                                             request.mass2, request.inertiaFactor}));
    return exitPassed;
  }
  refuseContradictions(request);
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
  fmt::print("{}", ofCase   ? fromCase(line, request)
                   : wanted ? fromWanted(request)
                            : fromConstants(request));
  return exitPassed;
}

Action declareCalibrate(CLI::App& app, CommandLine& line) {
  const auto request = std::make_shared<Request>();
  addInputs(app, line, "case", "case file: what its law means for each pair", 0, 1);
  addOverrides(app, line);
  for (const Number& number : numbers())
    addNumber(app, number.option, (*request).*number.member, number.what);
  addText(app, "--tension", request->tension, "whether contacts pull (default: allow)",
          "allow|cut");
  addText(app, "--tangential", request->tangential,
          "tangential law wanted (default: spring_dashpot)", "spring|spring_dashpot");
  request->contact.addOptions(app);
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
