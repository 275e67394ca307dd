#include "runs/common/records.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "results/schema.hpp"
#include "runs/common/version.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

json toJson(const std::optional<double>& value) {
  return value ? json(*value) : json(nullptr);
}

json toJson(const std::vector<std::optional<double>>& values) {
  json list = json::array();
  for (const auto& value : values) list.push_back(toJson(value));
  return list;
}

json profileJson(const std::string& method, const std::string& field, const std::string& unit,
                 const std::vector<std::optional<double>>& mean,
                 const std::vector<std::optional<double>>& standardError,
                 const std::vector<std::optional<double>>& nEff) {
  return {{"method", method},
          {"field", field},
          {"unit", unit},
          {"mean", toJson(mean)},
          {"stderr", toJson(standardError)},
          {"n_eff", toJson(nEff)}};
}

json toJson(const Profile& profile) {
  json result = profileJson(profile.method, profile.field, profile.unit, profile.mean,
                            profile.standardError, profile.nEff);
  result["dof"] = toJson(profile.dof);
  return result;
}

json toJson(const std::vector<Distribution>& distributions) {
  json list = json::array();
  for (const Distribution& d : distributions) {
    json axes = json::array();
    for (const Bins& axis : d.axes)
      axes.push_back({{"low", axis.low}, {"width", axis.width}, {"count", axis.count}});
    list.push_back({{"quantity", d.quantity},
                    {"ring", d.ring ? json(*d.ring) : json(nullptr)},
                    {"axes", axes},
                    {"density", d.density},
                    {"stderr", d.standardError},
                    {"outside", d.outside},
                    {"samples", d.samples}});
  }
  return list;
}

json statsJson(const Stats& stats) {
  return {{"steps", stats.steps},
          {"contact_evaluations", stats.contactEvaluations},
          {"wall_s", stats.wallSeconds},
          {"cpu_s", stats.cpuSeconds},
          {"counters", stats.counters}};
}

std::optional<double> optionalNumber(const json& value) {
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

std::vector<std::optional<double>> optionalNumbers(const json& list) {
  std::vector<std::optional<double>> values;
  for (const json& value : list) values.push_back(optionalNumber(value));
  return values;
}

std::vector<double> presentNumbers(const json& list) {
  std::vector<double> values;
  for (const json& value : list)
    if (value.is_number()) values.push_back(value.get<double>());
  return values;
}

json fitJson(const Fit& fit, const std::string& parameter, const std::string& name,
             const std::string& label, const std::string& unit, std::optional<double> expected) {
  json row = {{"name", name},         {"label", label},
              {"unit", unit},         {"value", nullptr},
              {"stderr", nullptr},    {"chi2_per_dof", nullptr},
              {"reason", fit.reason}, {"expected", toJson(expected)}};
  if (!fit.converged) return row;
  const auto found = std::ranges::find(fit.parameters, parameter, &FitParameter::name);
  if (found == fit.parameters.end()) throw std::logic_error("no fit parameter " + parameter);
  row["value"] = found->value;
  if (found->period > 0.0) row["period"] = found->period;
  row["stderr"] = toJson(found->standardError);
  if (fit.weighted) row["chi2_per_dof"] = fit.chi2 / fit.dof;
  return row;
}

namespace {

std::string cpuName() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string operatingSystem() {
  std::ifstream release("/etc/os-release");
  for (std::string line; std::getline(release, line);)
    if (line.starts_with("PRETTY_NAME=")) return line.substr(13, line.size() - 14);
  utsname names{};
  ::uname(&names);
  return names.sysname;
}

}  // namespace

json resultsHead(const std::string& kind, const Case& setup, const std::string& command) {
  const std::time_t now = std::time(nullptr);
  return {{"schema", schemaVersion},
          {"kind", kind},
          {"version", programVersion},
          {"command", command},
          {"started", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now))},
          {"machine",
           {{"cpu", cpuName()},
            {"cores", std::thread::hardware_concurrency()},
            {"os", operatingSystem()}}},
          {"case",
           {{"name", setup.name},
            {"variant", setup.variant},
            {"file", setup.file.string()},
            {"toml", setup.resolvedToml}}}};
}

}  // namespace crossgrain::inline runs
