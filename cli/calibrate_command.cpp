#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "adapters/law_options.hpp"
#include "cases/collision_scene.hpp"
#include "cases/keys.hpp"
#include "cases/loader.hpp"
#include "cli/calibrate_contact.hpp"
#include "cli/option_groups.hpp"
#include "oracle/calibration.hpp"
#include "studies/core/study_cases.hpp"
#include "support/bad_input.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cli {
namespace {

constexpr double stepsPerContact = 50.0;
constexpr double softOverlap = 0.01;  // of the smaller radius

std::string note(const std::string& label, const std::string& value) {
  return fmt::format("#   {:<50} {}\n", label, value);
}

std::string number(std::optional<double> value, const char* unit = "") {
  return value ? fmt::format("{:.6g}{}{}", *value, *unit ? " " : "", unit) : "-";
}

double smallerRadius(const CollidingPair& pair) {
  return std::min(pair.radius[0], pair.radius[1]);
}

std::string softWarning(double overlap) {
  if (overlap <= softOverlap) return {};
  return fmt::format(
      "# warning: soft: δ_max is {:.2g} of the radius; closed forms freeze the normal, and "
      "contacts of disks are meant to be < {}\n",
      overlap, softOverlap);
}

std::string stiffnessText(const ContactLaw& law) {
  if (law.normal == NormalLaw::hertz) {
    const HertzMaterial material = hertzMaterial(law);
    return constant("young", material.young, "Pa, of each of two equal bodies") +
           constant("poisson", material.poisson, "-");
  }
  if (law.normal == NormalLaw::polynomial)
    return constant("k2", law.kn, "N/m^2") + constant("k3", law.kn3, "N/m^3");
  return constant("kn", law.kn, "N/m");
}

/// Where e_t0 is not known, or not all there is to know.
std::string remarks(const ContactLaw& law, const ImpliedImpact& is) {
  std::string text;
  if (law.tangential != TangentialLaw::none && !is.et0)
    text = "# e_t0 and what follows from it are known for coulomb_bound = \"compression\" only\n";
  if (is.firstTouchSticksToPsi)
    text += fmt::format(
        "# e_t0 holds up to |Ψ_i| = µ γ_n/γ_t = {:.6g} only (spring_reset = \"total\")\n",
        *is.firstTouchSticksToPsi);
  return text;
}

/// Constants that go with rolling resistance and cohesion, as far as the law has them.
std::string resistanceText(const ContactLaw& law) {
  const bool torque = law.conventions.rollingStiffness == RollingStiffness::constant;
  const bool ratio =
      law.rolling == RollingLaw::spring && law.conventions.rollingDamper == RollingDamper::critical;
  const std::tuple<const char*, double, const char*> constants[] = {
      {"mu_r", law.muR, law.rolling == RollingLaw::viscousByLoad ? "s/m" : "-"},
      {"kr", law.kr, torque ? "N m" : "N/m"},
      {"gr", law.gr, ratio ? "-, the damping ratio" : "kg/s"},
      {"kc", law.kc, law.cohesion == CohesionLaw::area ? "Pa" : "N/m"},
      {"w", law.w, "J/m^2"},
      {"k_unload", law.kUnload, "N/m"},
      {"plastic_depth", law.plasticDepth, "-"}};
  std::string text;
  for (const auto& [key, value, unit] : constants)
    if (value != 0.0) text += constant(key, value, unit);
  return text;
}

std::string constantsText(const ContactLaw& law, bool ofMaterials = false) {
  const char* const damping = law.damper == Damper::constant       ? "kg/s"
                              : law.damper == Damper::viscoelastic ? "s"
                                                                   : "-";
  std::string text = stiffnessText(law) + constant("gn", law.gn, damping);
  if (law.tangential != TangentialLaw::none) {
    text += law.mu > 0.0 || ofMaterials ? constant("mu", law.mu, "-")
                                        : "# mu = …   a case needs it; not given\n";
    if (law.kt > 0.0 && law.normal != NormalLaw::hertz) text += constant("kt", law.kt, "N/m");
    if (law.gt > 0.0 || law.tangential == TangentialLaw::springDashpot)
      text += constant("gt", law.gt, damping);
  }
  return text + resistanceText(law);
}

/// The law as a [law] table that a case can take, every line that is not TOML a comment.
/// @param asked  what it was made from, for the head
std::string lawText(const ContactLaw& law, const std::string& asked) {
  constexpr std::array<std::string_view, 6> alwaysPrinted = {
      "normal", "tension", "tangential", "coulomb_bound", "spring_reset", "spring_update"};
  std::string text = fmt::format("# {}\n[law]\n", asked);
  for (const LawOption& option : lawOptions()) {
    const bool asLoaded = option.get(law) == option.get(ContactLaw{});
    const bool always = std::ranges::find(alwaysPrinted, option.name) != alwaysPrinted.end();
    if (mattersTo(law, option.name) && (always || !asLoaded))
      text += fmt::format("{} = \"{}\"\n", option.name, lawOptionValue(law, option.name));
  }
  return text + constantsText(law);
}

/// The laws of materials that differ from [law], as tables likewise.
std::string materialsText(const Case& setup) {
  if (!setup.materials) return {};
  const std::vector<std::string>& names = setup.materials->names;
  std::string text;
  for (std::size_t a = 0; a < names.size(); ++a)
    for (std::size_t b = a; b < names.size(); ++b) {
      const ContactLaw& law = setup.materials->laws[a * names.size() + b];
      if (law == setup.law) continue;
      text += fmt::format("[[law.pairs]]\nbetween = [\"{}\", \"{}\"]\n", names[a], names[b]) +
              constantsText(law, true);
    }
  return text;
}

/// What the law means for one pair, as comments. @param vn  of an impact, for its overlap [m/s]
std::string impactText(const ContactLaw& law, const CollidingPair& pair, std::optional<double> vn) {
  const ImpliedImpact is = impliedImpact(law, pair);
  const ReducedPair two = reduced(pair);
  const bool cut = law.conventions.tension == Tension::cut;
  std::string text = "\n# implied (normal frozen: slow impacts)\n";
  const auto add = [&](const std::string& label, const std::string& value) {
    text += note(label, value);
  };
  add("reduced mass m12, K = 1 + m12 Σ a²/J", number(two.mass, "kg") + ", " + number(two.K));
  add("e_n", fmt::format("{:.6g}, with tension {}: {:.6g}", cut ? is.enCut : is.enAllowed,
                         cut ? "allowed" : "cut", cut ? is.enAllowed : is.enCut));
  add("contact time t_c", number(is.contactTime, "s"));
  add("suggested dt = t_c/50", number(is.contactTime / stepsPerContact, "s"));
  if (cut) add("π/ω, which steps_per_contact counts from", number(is.halfPeriod, "s"));
  add("ω, γ_n over critical", number(is.omega, "rad/s") + ", " + number(is.dampingRatio));
  if (law.tangential != TangentialLaw::none) {
    add("e_t0 without slip", number(is.et0));
    if (law.kt > 0.0) {
      add("ω_t, γ_t over critical", number(is.omegaT, "rad/s") + ", " + number(is.dampingRatioT));
      add("kt/kn", number(law.kt / law.kn));
    }
    add("sliding: Ψ_i − Ψ_f = K (1 + e_cut) µ", number(is.slidingConstant));
    add("sticking ends at Ψ* = K (1 + e_cut) µ/(1 + e_t0)", number(is.stickingEndsAtPsi));
  }
  const double radius = smallerRadius(pair);
  add("δ_max reaches 1 % of the smaller radius at v_n",
      number(softOverlap * radius / is.overlapPerSpeed, "m/s"));
  text += remarks(law, is);
  if (!vn) return text;
  const double overlap = *vn * is.overlapPerSpeed;
  add(fmt::format("δ_max, δ_max/a at v_n = {} m/s", *vn),
      number(overlap, "m") + ", " + number(overlap / radius));
  return text + softWarning(overlap / radius);
}

/// As comments: the first column to the left, the others to the right.
/// @param rows  the names of the columns first; further cells than there are widths are left out
std::string table(const std::vector<int>& widths,
                  const std::vector<std::vector<std::string>>& rows) {
  std::string text;
  for (const auto& row : rows) {
    text += fmt::format("# {:<{}}", row[0], widths[0]);
    for (std::size_t k = 1; k < widths.size(); ++k)
      text += fmt::format(" {:>{}}", row[k], widths[k]);
    text += '\n';
  }
  return text;
}

std::string digits4(double value) {
  return fmt::format("{:.4g}", value);
}

std::string decimals4(std::optional<double> value) {
  return value ? fmt::format("{:.4f}", *value) : "-";
}

/// What a head-on impact does to each pair under a law that stiffens. @param speed  v_n [m/s]
/// @throws std::invalid_argument where the pair does not part
std::string stiffeningPairsText(const std::vector<NamedPair>& pairs, double speed) {
  double largest = 0.0;
  std::vector<std::vector<std::string>> rows = {
      {"pair", "m12 [kg]", "K", "e_n", "t_c [s]", "t_c/50 [s]", "δ_max/a"}};
  for (const auto& [name, bodies, law] : pairs) {
    ContactLaw normal = law;
    normal.tangential = TangentialLaw::none;
    const CollisionEnd end = oracleOutcome(normal, bodies, {0.0, speed});
    const ReducedPair two = reduced(bodies);
    const double overlap = *end.maxOverlap / smallerRadius(bodies);
    largest = std::max(largest, overlap);
    rows.push_back({name, digits4(two.mass), digits4(two.K), decimals4(end.en),
                    digits4(*end.duration), digits4(*end.duration / stepsPerContact),
                    fmt::format("{:.2g}", overlap)});
  }
  return fmt::format("\n# implied, at v_n = {:.6g} m/s\n", speed) +
         table({12, 11, 8, 9, 11, 11, 9}, rows) + softWarning(largest);
}

/// One row for each pair, of the linear law.
std::string pairsText(const std::vector<NamedPair>& pairs, std::optional<double> vn) {
  const ContactLaw& first = pairs.front().law;
  const bool alike = std::ranges::all_of(
      pairs, [&](const ContactLaw& law) { return law == first; }, &NamedPair::law);
  double largest = 0.0;
  std::vector<std::vector<std::string>> rows = {{"pair", "m12 [kg]", "K", "e_n allow", "e_n cut",
                                                 "t_c [s]", "e_t0", "sliding", "Ψ*", "t_c/50 [s]",
                                                 "δ_max/a"}};
  for (const auto& [name, bodies, law] : pairs) {
    const ImpliedImpact is = impliedImpact(law, bodies);
    const ReducedPair two = reduced(bodies);
    const double overlap = vn.value_or(0.0) * is.overlapPerSpeed / smallerRadius(bodies);
    largest = std::max(largest, overlap);
    rows.push_back({name, digits4(two.mass), digits4(two.K), decimals4(is.enAllowed),
                    decimals4(is.enCut), digits4(is.contactTime), decimals4(is.et0),
                    decimals4(is.slidingConstant), decimals4(is.stickingEndsAtPsi),
                    digits4(is.contactTime / stepsPerContact), fmt::format("{:.2g}", overlap)});
  }
  std::vector<int> widths = {12, 11, 8, 9, 9, 11, 9, 9, 9, 11};
  if (vn) widths.push_back(9);
  return fmt::format("\n# implied (normal frozen: slow impacts){}\n",
                     pairs.size() > 1 && alike && first.gn > 0.0 && first.damper != Damper::critical
                         ? "; the constants are the same for all pairs, so restitutions are not"
                         : "") +
         table(widths, rows) + remarks(first, impliedImpact(first, pairs.front().bodies)) +
         softWarning(largest);
}

/// What was asked: wanted values, or constants, or a case file (CommandLine::inputs), and the pair
/// that they are for. SI units.
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
  if (setup.kind == CaseKind::assembly)
    throw BadInput(
        "--vn is missing: the speed of impacts, on which this law's restitution depends");
  return setup.kind == CaseKind::collision ? setup.collision.vn.front()
                                           : std::abs(setup.cell.omega) * setup.cell.innerRadius;
}

std::string fromCase(const CommandLine& line, const Request& request) {
  for (const Number& number : numbers())
    if (number.part >= Part::body && request.*number.member && number.member != &Request::vn)
      throw BadInput(fmt::format("{}: the case file says it", number.option));
  if (request.tension || request.tangential)
    throw BadInput("--tension and --tangential: the case file says it; --set changes it");
  const auto& file = line.inputs.front();
  const std::vector<Case> cases = loadCase(file, line.overrides);
  if (cases.front().kind == CaseKind::assembly && cases.front().assembly.disks.empty())
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
