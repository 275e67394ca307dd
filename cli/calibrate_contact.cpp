#include "cli/calibrate_contact.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "cases/keys.hpp"
#include "cli/option_groups.hpp"
#include "law/cohesion.hpp"
#include "law/law_options.hpp"
#include "oracle/calibration.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cli {

double need(std::optional<double> value, const char* option, const char* why) {
  if (!value) throw BadInput(fmt::format("{} is missing: {}", option, why));
  return *value;
}

std::string constant(const char* key, double value, const char* unit) {
  return fmt::format("{:<46} # {}\n", fmt::format("{} = {}", key, value), unit);
}

namespace {

constexpr double degree = std::numbers::pi / 180.0;

std::string option(const ContactLaw& law, const char* name) {
  return fmt::format("{} = \"{}\"\n", name, lawOptionValue(law, name));
}

std::string note(const std::string& label, double value, const char* unit) {
  return fmt::format("#   {:<50} {:.6g} {}\n", label, value, unit);
}

void set(ContactLaw& law, const char* name, const std::optional<std::string>& value) {
  if (!value) return;
  try {
    setLawOption(law, name, *value);
  } catch (const std::invalid_argument& error) {
    throw BadInput(error.what());
  }
}

/// A plane unless the second body has a finite mass.
CollidingPair pairOf(const ContactRequest::Bodies& bodies, bool massMatters) {
  const double radius = need(bodies.radius, "--radius", "of the disk [m]");
  const double mass = massMatters ? need(bodies.mass, "--mass", "what oscillates has one [kg]")
                                  : bodies.mass.value_or(1.0);
  const double factor = bodies.inertiaFactor.value_or(0.5);
  const double mass2 = bodies.mass2.value_or(mass), radius2 = bodies.radius2.value_or(radius);
  if (!std::isfinite(mass2)) return diskOnWall(radius, mass, factor * mass * radius * radius);
  return {{radius, radius2},
          {mass, mass2},
          {factor * mass * radius * radius, factor * mass2 * radius2 * radius2}};
}

}  // namespace

struct ContactRequest::Number {
  const char* option;
  std::optional<double> ContactRequest::*member;
  const char* what;
  Range range;
};

const std::vector<ContactRequest::Number>& ContactRequest::numbers() {
  static const std::vector<Number> all = {
      {"--rolling-frequency", &ContactRequest::frequency_,
       "wanted: frequency of the rolling spring [Hz], of a disk that rolls on a plane (--mass2 "
       "inf), "
       "or of a pair about held centres",
       positive("Hz")},
      {"--rolling-decay", &ContactRequest::decay_,
       "wanted with it: rate at which its amplitude falls, e^(-t*rate) [1/s] (default: 0)",
       atLeast(0.0, "1/s")},
      {"--rest-angle", &ContactRequest::restAngle_,
       "wanted: steepest incline that a disk rests on [degrees]", inside(0.0, 90.0, "degrees")},
      {"--pull-off", &ContactRequest::pullOff_, "wanted: largest pull of a contact [N]",
       positive("N")},
      {"--kr", &ContactRequest::kr_, "given: rolling stiffness, as --rolling-stiffness says",
       positive("N/m")},
      {"--gr", &ContactRequest::gr_, "given: rolling damping, as --rolling-damper says",
       atLeast(0.0)},
      {"--mu-r", &ContactRequest::muR_, "given: coefficient of rolling resistance", positive()},
      {"--w", &ContactRequest::w_, "given: work of adhesion, 2 gamma [J/m^2]", positive("J/m^2")},
  };
  return all;
}

void ContactRequest::addOptions(CLI::App& app) {
  for (const Number& number : numbers())
    addNumber(app, number.option, this->*number.member, number.what);
  addText(app, "--rolling-length", length_, "length of rolling resistance (default: effective)",
          "effective|twice_effective|smaller_radius|mean_radius");
  addText(app, "--rolling-stiffness", stiffness_, "what kr is times (default: length_square)",
          "length_square|radii|constant");
  addText(app, "--rolling-damper", damper_, "what gr is (default: constant)", "constant|critical");
  addText(app, "--cohesion", cohesion_, "law of the pull", "dmt|jkr");
}

bool ContactRequest::given() const {
  for (const Number& number : numbers())
    if (this->*number.member) return true;
  return length_ || stiffness_ || damper_ || cohesion_;
}

std::string ContactRequest::rolling(const Bodies& bodies) const {
  ContactLaw law;
  law.rolling = RollingLaw::spring;
  set(law, "rolling_length", length_);
  set(law, "rolling_stiffness", stiffness_);
  set(law, "rolling_damper", damper_);
  const bool spring = frequency_ || kr_;
  const auto pair = spring ? std::optional(pairOf(bodies, true)) : std::nullopt;
  law.muR = restAngle_ ? rollingCoefficientOf(law, *restAngle_ * degree) : muR_.value_or(0.0);
  if (frequency_) {
    calibrateRolling(law, *pair, *frequency_, decay_.value_or(0.0));
  } else {
    law.kr = kr_.value_or(0.0);
    law.gr = gr_.value_or(0.0);
  }
  std::string text, meaning;
  if (spring) {
    const bool constantK = law.conventions.rollingStiffness == RollingStiffness::constant;
    const bool critical = law.conventions.rollingDamper == RollingDamper::critical;
    text +=
        option(law, "rolling") + option(law, "rolling_stiffness") + option(law, "rolling_damper");
    text += constant("kr", law.kr, constantK ? "N m" : "N/m");
    text += constant("gr", law.gr, critical ? "-, the damping ratio" : "kg/s");
    try {
      const ImpliedRolling is = impliedRolling(law, *pair);
      meaning += note(pair->plane ? "frequency on a plane, without slip"
                                  : "frequency of the pair, centres held",
                      is.frequency, "Hz");
      meaning += note("decay of its amplitude", is.decay, "1/s");
    } catch (const std::invalid_argument& error) {
      throw BadInput(fmt::format("--gr = {}: {}", law.gr, error.what()));
    }
  }
  text += option(law, "rolling_length");
  if (law.muR > 0.0) {
    text += constant("mu_r", law.muR, "-");
    meaning += note("a disk rests on inclines up to", restAngle(law) / degree, "degrees");
  } else {
    text += "# mu_r = …   a case needs it; not given\n";
  }
  return text + meaning;
}

std::string ContactRequest::cohesion(const Bodies& bodies) const {
  ContactLaw law;
  if (!cohesion_) throw BadInput("--cohesion is missing: dmt or jkr, whose pulls differ");
  set(law, "cohesion", cohesion_);
  if (law.cohesion != CohesionLaw::dmt && law.cohesion != CohesionLaw::jkr)
    throw BadInput(fmt::format("--cohesion = {}: dmt and jkr have a work of adhesion", *cohesion_));
  const double radius = pairOf(bodies, false).reducedRadius();
  law.w = pullOff_ ? workOfAdhesion(law, *pullOff_, radius)
                   : need(w_, "--w", "the work of adhesion [J/m^2]; or --pull-off");
  return option(law, "cohesion") + constant("w", law.w, "J/m^2") +
         fmt::format("# gamma = {}   in place of w, with gamma_is = \"half_of_w\"\n", 0.5 * law.w) +
         note("reduced radius R12", radius, "m") + note("largest pull", pullOff(law, radius), "N");
}

std::string ContactRequest::answer(const Bodies& bodies) const {
  for (const Number& number : numbers())
    if (const auto value = this->*number.member; value && !number.range.contains(*value))
      throw BadInput(
          fmt::format("{} = {}: must be {}", number.option, *value, number.range.text()));
  const std::tuple<const char*, const char*, bool> either[] = {
      {"--rolling-frequency", "--kr", frequency_ && kr_},
      {"--rolling-frequency", "--gr", frequency_ && gr_},
      {"--rest-angle", "--mu-r", restAngle_ && muR_},
      {"--pull-off", "--w", pullOff_ && w_}};
  for (const auto& [wanted, constant, both] : either)
    if (both)
      throw BadInput(
          fmt::format("{} and {}: one gives the other; leave one out", wanted, constant));
  if (decay_ && !frequency_)
    throw BadInput("--rolling-frequency is missing: a decay is that of an oscillation");
  if (gr_ && !kr_) throw BadInput("--kr is missing: --gr is the dashpot beside it");
  const bool rolls = frequency_ || restAngle_ || kr_ || muR_ || length_ || stiffness_ || damper_;
  std::string text = "[law]\n";
  if (rolls) text += rolling(bodies);
  if (pullOff_ || w_ || cohesion_) text += cohesion(bodies);
  return text;
}

}  // namespace crossgrain::inline cli
