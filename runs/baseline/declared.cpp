#include "runs/baseline/declared.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <string>

namespace crossgrain::inline runs {
namespace {

using Declared = std::map<std::string, std::string>;  ///< what is said, by its name

void addConstants(Declared& all, const PairCoefficients& pair) {
  const std::pair<const char*, double> constants[] = {
      {"kn", pair.kn}, {"gn", pair.gn}, {"kt", pair.kt},  {"gt", pair.gt},
      {"mu", pair.mu}, {"en", pair.en}, {"et0", pair.et0}};
  for (const auto& [name, value] : constants)
    if (value != 0.0) all[fmt::format("{} of {}", name, pair.pair)] = fmt::format("{}", value);
}

void addAbilities(Declared& all, const Capabilities& can) {
  all["version"] = can.version;
  for (const auto& [option, values] : can.lawOptions)
    all["can do " + option] = fmt::format("{}", fmt::join(values, " | "));
}

void addRealised(Declared& all, const std::optional<Realised>& ran) {
  if (!ran) return;
  all["dt"] = fmt::format("{} s", ran->dt);
  all["precision"] = ran->precision;
  all["integrator"] = ran->integrator;
  for (const Effect effect : ran->effects) all["simulates " + toString(effect)] = "yes";
  for (const PairCoefficients& pair : ran->pairs) addConstants(all, pair);
  for (const Deviation& deviation : ran->deviations)
    all["deviation " + deviation.name] = deviation.note;
}

}  // namespace

std::vector<DeclaredChange> declaredChanges(const Declaration& before, const Declaration& now) {
  Declared was, is;
  if (before.engine == now.engine) {
    addAbilities(was, before.can);
    addAbilities(is, now.can);
  }
  addRealised(was, before.ran);
  addRealised(is, now.ran);
  std::vector<DeclaredChange> changes;
  for (const auto& [name, value] : was) {
    const auto found = is.find(name);
    const std::string other = found == is.end() ? "" : found->second;
    if (other != value) changes.push_back({name, value, other});
  }
  for (const auto& [name, value] : is)
    if (!was.contains(name)) changes.push_back({name, "", value});
  return changes;
}

}  // namespace crossgrain::inline runs
