#include "cli/calibrate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "adapters/law_options.hpp"
#include "cases/collision_scene.hpp"
#include "cases/loader.hpp"
#include "cli/option_groups.hpp"
#include "runs/common/study_cases.hpp"
#include "support/bad_input.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cli {
namespace {

/// An option of one number, and what it may be.
struct Number {
  const char* option;
  std::optional<double> CalibrationRequest::*member;
  const char* what;
  const char* range;
  bool (*allowed)(double);
};

bool isPositive(double x) {
  return x > 0.0 && std::isfinite(x);
}
bool isNotNegative(double x) {
  return x >= 0.0 && std::isfinite(x);
}

using Request = CalibrationRequest;
const std::vector<Number> wantedValues = {
    {"--en", &Request::en, "wanted: normal restitution e_n", "> 0 and <= 1",
     [](double x) { return x > 0.0 && x <= 1.0; }},
    {"--et", &Request::et0, "wanted: tangential restitution e_t0 of a contact that never slips",
     "> -1 and <= 1", [](double x) { return x > -1.0 && x <= 1.0; }},
    {"--tc", &Request::contactTime, "wanted: contact time [s]; or --kn", "> 0 s", isPositive},
};
const std::vector<Number> constants = {
    {"--kn", &Request::kn, "normal stiffness [N/m]: wanted, with --en instead of --tc; or given",
     "> 0 N/m", isPositive},
    {"--gn", &Request::gn, "given: normal damping [kg/s]", ">= 0 kg/s", isNotNegative},
    {"--kt", &Request::kt, "given: tangential stiffness [N/m]", ">= 0 N/m", isNotNegative},
    {"--gt", &Request::gt, "given: tangential damping [kg/s]", ">= 0 kg/s", isNotNegative},
};
const std::vector<Number> bodies = {
    {"--mass", &Request::mass, "mass of the first body [kg]", "> 0 kg and finite", isPositive},
    {"--mass2", &Request::mass2, "of the second [kg]; inf: a wall (default: as the first)",
     "> 0 kg, or inf for a wall", [](double x) { return x > 0.0; }},
    {"--radius", &Request::radius, "radius of the first body [m]", "> 0 m", isPositive},
    {"--radius2", &Request::radius2, "of the second [m] (default: as the first)", "> 0 m",
     isPositive},
    {"--inertia-factor", &Request::inertiaFactor, "q in J = q m a^2 (default: 0.5, a disk)",
     "> 0 and <= 1", [](double x) { return x > 0.0 && x <= 1.0; }},
};
const std::vector<Number> furtherNumbers = {
    {"--mu", &Request::mu, "Coulomb's coefficient", "> 0", isPositive},
    {"--vn", &Request::vn, "speed of an impact, for its overlap [m/s]", "> 0 m/s", isPositive},
};

const Number* firstGiven(const Request& request, const std::vector<Number>& numbers) {
  const auto found = std::ranges::find_if(
      numbers, [&](const Number& number) { return (request.*number.member).has_value(); });
  return found == numbers.end() ? nullptr : &*found;
}

void checkRanges(const Request& request) {
  for (const auto* numbers : {&wantedValues, &constants, &bodies, &furtherNumbers})
    for (const Number& number : *numbers)
      if (const auto value = request.*number.member; value && !number.allowed(*value))
        throw BadInput(fmt::format("{} = {}: must be {}", number.option, *value, number.range));
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
  struct Pair {
    const char* wanted;
    bool isWanted;
    const char* constant;
    bool isGiven;
    const char* why;
  };
  const Pair pairs[] = {
      {"--tc", request.contactTime.has_value(), "--kn", request.kn.has_value(),
       "with e_n each gives the other"},
      {"--en", request.en.has_value(), "--gn", request.gn.has_value(), "e_n gives gn"},
      {"--et", request.et0.has_value(), "--kt", request.kt.has_value(), "e_t0 gives kt and gt"},
      {"--et", request.et0.has_value(), "--gt", request.gt.has_value(), "e_t0 gives kt and gt"}};
  for (const Pair& pair : pairs)
    if (pair.isWanted && pair.isGiven)
      throw BadInput(fmt::format("{} and {}: {}; leave one of them out", pair.wanted, pair.constant,
                                 pair.why));
}

int fromWanted(const Request& request) {
  const CollidingPair pair = askedPair(request);
  const double en = need(request.en, "--en", "the normal restitution wanted");
  ContactLaw law = startOfLaw(request);
  setOption(law, "tangential", request.tangential.value_or("spring_dashpot"),
            {"spring", "spring_dashpot"});
  const ReducedPair two = reduced(pair);
  std::string asked = fmt::format("e_n = {}, {}", en, setNormal(law, request, en, two.mass));
  if (request.et0) {
    calibrateTangential(law, *request.et0, two);
    // What slips at first touch is to stick again; see ImpliedImpact::firstTouchSticksToPsi.
    law.conventions.springReset = SpringReset::springOnly;
    law.conventions.springUpdate = SpringUpdate::before;
    asked += fmt::format(", e_t0 = {}", *request.et0);
  } else {
    if (request.mu || request.tangential)
      throw BadInput("--et is missing: a law with friction has a tangential restitution");
    law.tangential = TangentialLaw::none;
  }
  printLaw(law, fmt::format("{}; {}", asked, describe(pair, request)));
  printImpact(law, pair, request.vn);
  return exitHeld;
}

TangentialLaw tangentialLaw(const ContactLaw& law) {
  if (law.kt > 0.0) return law.gt > 0.0 ? TangentialLaw::springDashpot : TangentialLaw::spring;
  if (law.gt > 0.0) return TangentialLaw::viscous;
  return law.mu > 0.0 ? TangentialLaw::coulomb : TangentialLaw::none;
}

int fromConstants(const Request& request) {
  if (request.tangential) throw BadInput("--tangential: --kt and --gt already say which law it is");
  const CollidingPair pair = askedPair(request);
  ContactLaw law = startOfLaw(request);
  law.kn = need(request.kn, "--kn", "the normal stiffness [N/m]");
  law.gn = need(request.gn, "--gn", "an undamped law says 0 [kg/s]; or --en, if kn is wanted");
  law.kt = request.kt.value_or(0.0);
  law.gt = request.gt.value_or(0.0);
  law.tangential = tangentialLaw(law);
  const double critical = 2.0 * std::sqrt(law.kn * reduced(pair).mass);
  if (!(law.gn < critical))
    throw BadInput(
        fmt::format("--gn = {}: must be < {:.6g} kg/s, critical for this pair", law.gn, critical));
  printLaw(law, fmt::format("these constants; {}", describe(pair, request)));
  printImpact(law, pair, request.vn);
  return exitHeld;
}

CollidingPair disksOf(const Case& setup, double radiusI, double massI, double radiusJ,
                      double massJ) {
  const double q = setup.particles.inertiaFactor;
  return {{radiusI, radiusJ},
          {massI, massJ},
          {q * massI * radiusI * radiusI, q * massJ * radiusJ * radiusJ}};
}

std::vector<NamedPair> pairsOf(const Case& setup) {
  if (setup.kind == CaseKind::collision) {
    return {{"i-j", collidingPair(setup)}};
  }
  const Particles& p = setup.particles;
  struct Kind {
    const char* name;
    double radius, mass;
  };
  std::vector<Kind> kinds;
  if (p.small > 0 || p.file) kinds.push_back({"small", p.smallRadius, p.smallMass});
  if (p.large > 0 || p.file) kinds.push_back({"large", p.largeRadius, p.largeMass});
  const std::size_t disks = kinds.size();
  kinds.push_back({"wall", setup.cell.wallRadius, std::numeric_limits<double>::infinity()});
  std::vector<NamedPair> pairs;
  for (std::size_t i = 0; i < disks; ++i)
    for (std::size_t j = i; j < kinds.size(); ++j)
      pairs.push_back(
          {fmt::format("{}-{}", kinds[i].name, kinds[j].name),
           disksOf(setup, kinds[i].radius, kinds[i].mass, kinds[j].radius, kinds[j].mass)});
  return pairs;
}

/// Of an impact under a law that stiffens [m/s].
double speedOf(const Case& setup, const Request& request) {
  if (request.vn) return *request.vn;
  return setup.kind == CaseKind::collision ? setup.collision.vn.front()
                                           : std::abs(setup.cell.omega) * setup.cell.innerRadius;
}

int fromCase(const CommandLine& line, const Request& request) {
  for (const auto* numbers : {&bodies, &furtherNumbers})
    if (const Number* given = firstGiven(request, *numbers); given && given->member != &Request::vn)
      throw BadInput(fmt::format("{}: the case file says it", given->option));
  if (request.tension || request.tangential)
    throw BadInput("--tension and --tangential: the case file says it; --set changes it");
  const auto& file = line.inputs.front();
  const std::vector<Case> cases = loadCase(file, line.overrides);
  if (cases.front().kind == CaseKind::assembly)
    throw BadInput(fmt::format("{}: an assembly has no kinds of disks: give the law's constants",
                               file.string()));
  for (const Case& setup : cases)
    if (setup.law.normal == NormalLaw::rigid)
      throw BadInput(fmt::format("{}: its law is rigid, which is given by e_n and e_t0 themselves",
                                 file.string()));
  // All that may fail comes before what is printed.
  std::vector<std::vector<CollisionEnd>> impacts;
  if (const auto keys = keysWithoutUse(cases.front(), "calibrate"); !keys.empty())
    fmt::print("# not used: {}\n", fmt::join(keys, ", "));
  for (const Case& setup : cases) {
    impacts.emplace_back();
    if (setup.law.stiffens())
      impacts.back() = headOnImpacts(setup.law, pairsOf(setup), speedOf(setup, request));
    else
      for (const NamedPair& pair : pairsOf(setup)) impliedImpact(setup.law, pair.bodies);
  }
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const Case& setup = cases[k];
    if (cases.size() > 1) fmt::print("# variant {}\n", setup.variant);
    printLaw(setup.law, file.filename().string());
    if (setup.law.stiffens())
      printStiffeningPairs(pairsOf(setup), impacts[k], speedOf(setup, request));
    else
      printPairs(setup.law, pairsOf(setup), request.vn);
    if (k + 1 < cases.size()) fmt::print("\n");
  }
  return exitHeld;
}

void addOptions(CLI::App& command, CommandLine& line, Request& request) {
  addInputs(command, line, "case", "case file: what its law means for each pair", 0, 1);
  addOverrides(command, line);
  for (const auto* numbers : {&wantedValues, &constants, &bodies, &furtherNumbers})
    for (const Number& number : *numbers)
      addNumber(command, number.option, request.*number.member, number.what);
  addText(command, "--tension", request.tension, "whether contacts pull (default: allow)",
          "allow|cut");
  addText(command, "--tangential", request.tangential,
          "tangential law wanted (default: spring_dashpot)", "spring|spring_dashpot");
}

int calibrate(const CommandLine& line, const Request& request) {
  checkRanges(request);
  refuseContradictions(request);
  const Number* wanted = firstGiven(request, wantedValues);
  // A stiffness may be wanted, too.
  const bool constant = request.gn || request.kt || request.gt || (request.kn && !wanted);
  const bool ofCase = !line.inputs.empty();
  if ((wanted != nullptr) + constant + ofCase != 1)
    throw BadInput(
        "calibrate takes one of: wanted values (--en, --et, --tc or --kn), constants (--kn, --gn, "
        "--kt, --gt), a case file; see crossgrain calibrate --help");
  if (ofCase) return fromCase(line, request);
  if (!line.overrides.empty()) throw BadInput("--set changes a case file, and there is none");
  return wanted ? fromWanted(request) : fromConstants(request);
}

Action declareCalibrate(CLI::App& app, CommandLine& line) {
  const auto request = std::make_shared<Request>();
  addOptions(app, line, *request);
  return [&line, request] { return calibrate(line, *request); };
}

}  // namespace

extern const Command calibrateCommand = {
    "calibrate", "law constants from wanted restitution and contact time, and back",
    "crossgrain calibrate --en 0.9 --et 0.5 --tc 1e-3 --mass 1e-3 --radius 5e-3 --mu 0.4\n"
    "crossgrain calibrate --en 0.9 --kn 1e4 --mass 1e-3 --radius 5e-3\n"
    "crossgrain calibrate --kn 352.1 --gn 0.19 --kt 267.1 --gt 0.15 --mu 0.44 --mass 0.275e-3 "
    "--radius 3.7e-3\n"
    "crossgrain calibrate cases/couette/quick.toml",
    declareCalibrate};

}  // namespace crossgrain::inline cli
