#include "adapters/worker/json.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "adapters/law_options.hpp"
#include "adapters/worker/json_names.hpp"

namespace crossgrain {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 3> supportNames = {"optional", "always", "never"};
constexpr std::array<std::string_view, 2> planeNormalNames = {"any", "axis"};
constexpr std::array<std::string_view, 2> restitutionNames = {"pair", "body"};
constexpr std::array<std::string_view, 3> reportNames = {"none", "instant", "accumulated"};

Effect effectFromName(const std::string& name) {
  const auto found =
      std::ranges::find_if(allEffects, [&](Effect effect) { return toString(effect) == name; });
  if (found == allEffects.end()) throw std::runtime_error(fmt::format("no effect '{}'", name));
  return *found;
}

/// Whether a contact is carried by springs; else it rebounds with restitutions.
bool springs(const PairCoefficients& pair) {
  return pair.kn > 0.0;
}

/// A spring, dashpot or friction of strength 0 is none, which is told as absent. (A restitution of
/// 0 is one.)
json unlessNone(double constant) {
  return constant != 0.0 ? json(constant) : json(nullptr);
}

double orNone(const json& in, const char* key) {
  const auto found = in.find(key);
  return found == in.end() || found->is_null() ? 0.0 : found->get<double>();
}

/// A count: converted as it is −1 would be 2⁶⁴ − 1, in silence.
std::uint64_t countFrom(const json& in, const char* key) {
  constexpr double most = 9007199254740992.0;  // 2⁵³: beyond it numbers of JSON have gaps
  const json& value = in.at(key);
  const double number = value.is_number() ? value.get<double>() : -1.0;
  if (!(number >= 0.0 && number <= most && number == std::floor(number)))
    throw std::runtime_error(fmt::format("{} is {}, not a whole number ≥ 0", key, value.dump()));
  return static_cast<std::uint64_t>(number);
}

/// @throws std::exception naming a time that no clock shows
double secondsFrom(const json& in, const char* key) {
  const double seconds = in.at(key);
  if (!(seconds >= 0.0)) throw std::runtime_error(fmt::format("{} is {} s", key, seconds));
  return seconds;
}

/// @throws std::exception naming an option or a value that no law has
void checkLawOptions(const Capabilities& can) {
  ContactLaw law;
  for (const auto& [name, values] : can.lawOptions) {
    if (values.empty()) throw std::runtime_error(fmt::format("law_options: {} has no value", name));
    for (const std::string& value : values) setLawOption(law, name, value);
  }
}

json motionsJson(const std::vector<Motion::Kind>& kinds) {
  json names = json::array();
  for (const Motion::Kind kind : kinds) names.push_back(toString(kind));
  return names;
}

std::optional<std::vector<Motion::Kind>> motionsFrom(const json& in, const char* key) {
  if (!in.contains(key)) return std::nullopt;
  std::vector<Motion::Kind> kinds;
  for (const json& name : in.at(key)) kinds.push_back(valueOf<Motion::Kind>(name, motionNames));
  return kinds;
}

void addLimits(json& out, const SceneLimits& limits) {
  if (limits.inertia) out["inertia"] = *limits.inertia;
  if (limits.wallMotions) out["wall_motions"] = motionsJson(*limits.wallMotions);
  if (limits.planeMotions) out["plane_motions"] = motionsJson(*limits.planeMotions);
  if (limits.planesAlongAxes) out["plane_normals"] = std::string(planeNormalNames[1]);
  if (limits.restitutionPerBody) out["restitution"] = std::string(restitutionNames[1]);
}

/// @throws std::exception naming what is none
SceneLimits limitsFrom(const json& in) {
  SceneLimits limits;
  if (in.contains("inertia")) {
    limits.inertia = in.at("inertia").get<std::vector<double>>();
    if (limits.inertia->empty()) throw std::runtime_error("inertia has no value");
  }
  limits.wallMotions = motionsFrom(in, "wall_motions");
  limits.planeMotions = motionsFrom(in, "plane_motions");
  enum class PlaneNormals { any, axis };
  if (in.contains("plane_normals"))
    limits.planesAlongAxes =
        valueOf<PlaneNormals>(in.at("plane_normals"), planeNormalNames) == PlaneNormals::axis;
  enum class Restitution { pair, body };
  if (in.contains("restitution"))
    limits.restitutionPerBody =
        valueOf<Restitution>(in.at("restitution"), restitutionNames) == Restitution::body;
  return limits;
}

json toJson(const SettingValue& value) {
  return std::visit([](const auto& held) { return json(held); }, value);
}

SettingValue settingFromJson(const json& in) {
  if (in.is_boolean()) return in.get<bool>();
  if (in.is_number()) return in.get<double>();
  return in.get<std::string>();
}

}  // namespace

json toJson(const Capabilities& can) {
  json effects = json::object();
  for (const auto& [effect, support] : can.effects)
    effects[toString(effect)] = nameOf(support, supportNames);
  json precisions = json::array();
  for (const Precision precision : can.precisions) precisions.push_back(toString(precision));
  json settings = json::array();
  for (const SettingSpec& spec : can.settings) {
    settings.push_back({{"name", spec.name},
                        {"default", toJson(spec.defaultValue)},
                        {"unit", spec.unit},
                        {"doc", spec.doc},
                        {"choices", spec.choices},
                        {"least", spec.least},
                        {"whole", spec.whole}});
    if (std::isfinite(spec.most)) settings.back()["most"] = spec.most;
  }
  json out = {{"version", can.version},
              {"effects", effects},
              {"law_options", can.lawOptions},
              {"precisions", precisions},
              {"instant_contacts", can.instantContacts},
              {"accumulated_contacts", can.accumulatedContacts},
              {"warm_handover", can.warmHandover},
              {"checkpoints", can.checkpoints},
              {"sliding_flags", can.slidingFlags},
              {"energy_ledger", can.energyLedger},
              {"tangential_restitution", can.tangentialRestitution},
              {"settings", settings}};
  addLimits(out, can.limits);
  return out;
}

Capabilities capabilitiesFromJson(const json& in) {
  Capabilities can;
  can.version = in.at("version");
  for (const Effect effect : allEffects) can.effects[effect] = Support::never;  // if missing
  for (const auto& [name, support] : in.at("effects").items())
    can.effects[effectFromName(name)] = valueOf<Support>(support, supportNames);
  in.at("law_options").get_to(can.lawOptions);
  checkLawOptions(can);
  for (const json& name : in.at("precisions"))
    can.precisions.push_back(valueOf<Precision>(name, precisionNames));
  can.instantContacts = in.at("instant_contacts");
  can.accumulatedContacts = in.at("accumulated_contacts");
  can.warmHandover = in.at("warm_handover");
  can.checkpoints = in.value("checkpoints", false);
  can.slidingFlags = in.at("sliding_flags");
  can.energyLedger = in.value("energy_ledger", false);
  can.tangentialRestitution = in.value("tangential_restitution", true);
  for (const json& item : in.at("settings"))
    can.settings.push_back({item.at("name"), settingFromJson(item.at("default")), item.at("unit"),
                            item.at("doc"), item.at("choices"), item.value("least", 0.0),
                            item.value("most", std::numeric_limits<double>::infinity()),
                            item.value("whole", false)});
  can.limits = limitsFrom(in);
  return can;
}

json toJson(const Settings& settings) {
  json out = json::object();
  for (const auto& [name, value] : settings) out[name] = toJson(value);
  return out;
}

Settings settingsFromJson(const json& in) {
  Settings settings;
  for (const auto& [name, value] : in.items()) settings[name] = settingFromJson(value);
  return settings;
}

json toJson(const Realised& realised) {
  json effects = json::array();
  for (const Effect effect : realised.effects) effects.push_back(toString(effect));
  json pairs = json::array();
  for (const PairCoefficients& pair : realised.pairs)
    pairs.push_back({{"pair", pair.pair},
                     {"kn", unlessNone(pair.kn)},
                     {"gn", unlessNone(pair.gn)},
                     {"kt", unlessNone(pair.kt)},
                     {"gt", unlessNone(pair.gt)},
                     {"mu", unlessNone(pair.mu)},
                     {"en", springs(pair) ? json(nullptr) : json(pair.en)},
                     {"et0", springs(pair) || pair.mu == 0.0 ? json(nullptr) : json(pair.et0)}});
  json deviations = json::array();
  for (const Deviation& deviation : realised.deviations)
    deviations.push_back({{"name", deviation.name},
                          {"value", deviation.value},
                          {"unit", deviation.unit},
                          {"note", deviation.note}});
  return {{"engine", realised.engine},
          {"version", realised.version},
          {"dt", realised.dt},
          {"precision", realised.precision},
          {"integrator", realised.integrator},
          {"velocity_lag", realised.velocityLag},
          {"effects", effects},
          {"pairs", pairs},
          {"deviations", deviations}};
}

Realised realisedFromJson(const json& in) {
  Realised realised;
  realised.engine = in.at("engine");
  realised.version = in.at("version");
  realised.dt = in.at("dt");
  realised.precision = in.at("precision");
  realised.integrator = in.at("integrator");
  realised.velocityLag = orNone(in, "velocity_lag");
  for (const json& effect : in.at("effects")) realised.effects.insert(effectFromName(effect));
  for (const json& pair : in.at("pairs"))
    realised.pairs.push_back({pair.at("pair"), orNone(pair, "kn"), orNone(pair, "gn"),
                              orNone(pair, "kt"), orNone(pair, "gt"), orNone(pair, "mu"),
                              orNone(pair, "en"), orNone(pair, "et0")});
  for (const json& deviation : in.at("deviations"))
    realised.deviations.push_back(
        {deviation.at("name"), deviation.at("value"), deviation.at("unit"), deviation.at("note")});
  return realised;
}

json toJson(const Stats& stats) {
  return {{"steps", stats.steps},
          {"contact_evaluations", stats.contactEvaluations},
          {"wall_seconds", stats.wallSeconds},
          {"cpu_seconds", stats.cpuSeconds},
          {"counters", stats.counters}};
}

Stats statsFromJson(const json& in) {
  Stats stats;
  stats.steps = countFrom(in, "steps");
  stats.contactEvaluations = countFrom(in, "contact_evaluations");
  stats.wallSeconds = secondsFrom(in, "wall_seconds");
  stats.cpuSeconds = secondsFrom(in, "cpu_seconds");
  in.at("counters").get_to(stats.counters);
  return stats;
}

json toJson(ContactReport report) {
  return nameOf(report, reportNames);
}

ContactReport contactReportFromJson(const json& in) {
  return valueOf<ContactReport>(in, reportNames);
}

}  // namespace crossgrain
