#include "studies/regression/diff.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <set>

#include "adapters/worker/arrays.hpp"
#include "studies/flow/endpoint_table.hpp"
#include "studies/flow/endpoint_values.hpp"
#include "studies/lockstep/rules.hpp"
#include "support/bad_input.hpp"
#include "support/json_text.hpp"

namespace crossgrain::inline studies {
namespace {

using nlohmann::json;

CollisionChange changeOf(const KeptCollisions& sweep, const std::string& quantity,
                         const std::vector<double>& before, const std::vector<double>& now) {
  const NumbersDifference found = differenceOf(before, now);
  CollisionChange change{sweep.name, sweep.variant, quantity};
  change.changed = found.differ;
  change.points = found.of;
  if (found.differ == 0) return change;
  change.largest = found.change;
  change.relative = found.relative;
  change.psi = sweep.psi[found.at];
  change.vn = sweep.vn[found.at];
  return change;
}

/// Of one sweep, those that changed most first.
std::vector<CollisionChange> changesOf(const KeptCollisions& before, const KeptCollisions& now) {
  const std::vector<double> none(before.psi.size(), NAN);
  std::vector<CollisionChange> changes;
  for (const auto& [quantity, was] : before.values) {
    const auto found = now.values.find(quantity);
    changes.push_back(
        changeOf(before, quantity, was, found == now.values.end() ? none : found->second));
  }
  for (const auto& [quantity, is] : now.values)
    if (!before.values.contains(quantity)) changes.push_back(changeOf(before, quantity, none, is));
  std::erase_if(changes, [](const CollisionChange& change) { return change.changed == 0; });
  std::ranges::stable_sort(changes, std::ranges::greater(), &CollisionChange::relative);
  return changes;
}

using Declared = std::map<std::string, std::string>;  ///< declared values, by name

Declared declaredBy(const Declaration& engine, bool withAbilities) {
  Declared all;
  if (withAbilities) {
    all["version"] = engine.can.version;
    for (const auto& [option, values] : engine.can.lawOptions)
      all["can do " + option] = fmt::format("{}", fmt::join(values, " | "));
  }
  if (!engine.ran) return all;
  const EffectiveParameters& ran = *engine.ran;
  all["dt"] = fmt::format("{} s", ran.dt);
  all["precision"] = ran.precision;
  all["integrator"] = ran.integrator;
  for (const Effect effect : ran.effects) all["simulates " + toString(effect)] = "yes";
  for (const PairCoefficients& pair : ran.pairs) {
    const std::pair<const char*, double> constants[] = {
        {"kn", pair.kn}, {"gn", pair.gn},    {"kt", pair.kt},   {"gt", pair.gt},
        {"mu", pair.mu}, {"en", pair.en},    {"et0", pair.et0}, {"kr", pair.kr},
        {"gr", pair.gr}, {"mu_r", pair.muR}, {"kc", pair.kc},   {"w", pair.w}};
    for (const auto& [name, value] : constants)
      if (value != 0.0) all[fmt::format("{} of {}", name, pair.pair)] = fmt::format("{}", value);
  }
  for (const Deviation& deviation : ran.deviations)
    all["deviation " + deviation.name] = deviation.note;
  return all;
}

/// The arrays of one answer, contacts in the order of their ids.
struct Arrays {
  std::vector<std::string> names;  ///< in the answer's order
  std::map<std::string, std::vector<double>> values;
  std::vector<std::pair<double, double>> contacts;  ///< ids
};

void sortContacts(Arrays& arrays) {
  const auto i = arrays.values.find("contacts.i"), j = arrays.values.find("contacts.j");
  if (i == arrays.values.end() || j == arrays.values.end()) return;
  const std::size_t count = i->second.size();
  if (j->second.size() != count) return;
  for (std::size_t k = 0; k < count; ++k) arrays.contacts.emplace_back(i->second[k], j->second[k]);
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return arrays.contacts[k]; });
  std::ranges::sort(arrays.contacts);
  for (auto& [name, values] : arrays.values) {
    if (!name.starts_with("contacts.") || count == 0 || values.size() % count != 0) continue;
    const std::size_t width = values.size() / count;
    std::vector<double> sorted;
    for (const std::size_t k : order)
      for (std::size_t c = 0; c < width; ++c) sorted.push_back(values[k * width + c]);
    values = std::move(sorted);
  }
}

/// @throws std::exception where list and bytes do not fit
Arrays arraysOf(const Exchange& exchange) {
  Arrays arrays;
  const auto list = exchange.answer.find("arrays");
  if (list == exchange.answer.end()) return arrays;
  const ArrayReader reader(exchange.received, "its array file", *list);
  for (const json& entry : *list) {
    arrays.names.push_back(entry.at("name"));
    arrays.values[arrays.names.back()] = reader.numbers(arrays.names.back());
  }
  sortContacts(arrays);
  return arrays;
}

/// "[17]", or " of 3 with 4" of a contact.
std::string placeOf(const std::string& name, std::size_t index, const Arrays& arrays) {
  const std::size_t count = arrays.contacts.size();
  if (!name.starts_with("contacts.") || count == 0) return fmt::format("[{}]", index);
  const auto& [i, j] = arrays.contacts[index / (arrays.values.at(name).size() / count)];
  return fmt::format(" of {} with {}", i, j);
}

void addArrayDifferences(const Exchange& then, const Exchange& now, double tolerance,
                         std::vector<AnswerDifference>& differences) {
  if (then.received == now.received &&
      then.answer.value("arrays", json()) == now.answer.value("arrays", json()))
    return;
  const Arrays before = arraysOf(then), after = arraysOf(now);
  for (const std::string& name : before.names) {
    const std::vector<double>& a = before.values.at(name);
    const auto found = after.values.find(name);
    if (found == after.values.end()) {
      differences.push_back({name, "", "there", "not there"});
      continue;
    }
    const std::vector<double>& b = found->second;
    if (a.size() != b.size()) {
      differences.push_back(
          {name, "", fmt::format("{} elements", a.size()), fmt::format("{}", b.size())});
      continue;
    }
    const NumbersDifference most = differenceOf(a, b, tolerance);
    if (most.differ > 0)
      differences.push_back({name, placeOf(name, most.at, before), fmt::format("{}", a[most.at]),
                             fmt::format("{}", b[most.at]), std::abs(most.change), most.differ,
                             most.of});
  }
  for (const std::string& name : after.names)
    if (!before.values.contains(name)) differences.push_back({name, "", "not there", "there"});
}

/// Whether a field says what the engine did, not which one it is or how long it took.
bool isCompared(const std::string& pointer) {
  return !pointer.starts_with("/arrays/") && !pointer.ends_with("seconds") &&
         pointer != "/capabilities/version" && pointer != "/realised/version" &&
         pointer != "/realised/engine";
}

bool alike(const json& a, const json& b, double tolerance) {
  if (a == b) return true;
  if (!a.is_number() || !b.is_number()) return false;
  const double x = a.get<double>(), y = b.get<double>();
  return std::abs(x - y) <= tolerance * std::max(std::abs(x), std::abs(y));
}

std::string shown(const json& value) {
  return asOneLine(value.dump(-1, ' ', false, json::error_handler_t::replace), 100);
}

void addFieldDifferences(const json& then, const json& now, double tolerance,
                         std::vector<AnswerDifference>& differences) {
  const json a = then.flatten(), b = now.flatten();
  std::set<std::string> pointers;
  for (const json* each : {&a, &b})
    for (const auto& [pointer, value] : each->items())
      if (isCompared(pointer)) pointers.insert(pointer);
  for (const std::string& pointer : pointers) {
    const auto before = a.find(pointer), after = b.find(pointer);
    const bool both = before != a.end() && after != b.end();
    if (both && alike(*before, *after, tolerance)) continue;
    AnswerDifference found;
    found.field = pointer.substr(std::min<std::size_t>(1, pointer.size()));
    std::ranges::replace(found.field, '/', '.');
    found.then = before == a.end() ? "not there" : shown(*before);
    found.now = after == b.end() ? "not there" : shown(*after);
    if (both && before->is_number() && after->is_number())
      found.off = std::abs(after->get<double>() - before->get<double>());
    differences.push_back(std::move(found));
  }
}

}  // namespace

NumbersDifference differenceOf(const std::vector<double>& before, const std::vector<double>& now,
                               double tolerance) {
  double largest = 0.0;
  for (const double value : before)
    if (std::abs(value) > largest) largest = std::abs(value);
  NumbersDifference found;
  found.of = before.size();
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (std::isnan(before[k]) && std::isnan(now[k])) continue;
    const double change = now[k] - before[k];
    if (std::abs(change) <= tolerance * largest) continue;
    const double relative =
        std::isnan(change) ? 1.0 : std::abs(change) / (largest > 0.0 ? largest : 1.0);
    if (found.differ++ > 0 && relative <= found.relative) continue;
    found.at = k;
    found.change = change;
    found.relative = relative;
  }
  return found;
}

CollisionChanges collisionChanges(const std::vector<KeptCollisions>& before,
                                  const std::vector<KeptCollisions>& now) {
  if (now.size() != before.size())
    throw BadInput(fmt::format("the baseline has {} sweeps of collisions, the case now {}",
                               before.size(), now.size()));
  CollisionChanges all;
  for (std::size_t k = 0; k < now.size(); ++k) {
    const KeptCollisions &kept = before[k], &is = now[k];
    if (!is.refusal.empty() || !kept.refusal.empty()) continue;
    if (std::tie(kept.name, kept.variant, kept.psi, kept.vn) !=
        std::tie(is.name, is.variant, is.psi, is.vn))
      throw BadInput(fmt::format("collisions of {} are other ones than the baseline has", is.name));
    ++all.sweeps;
    std::ranges::move(changesOf(kept, is), std::back_inserter(all.changes));
  }
  return all;
}

Equivalence equivalenceOf(const std::vector<CollisionChange>& changes) {
  double largest = 0.0;
  for (const CollisionChange& change : changes) largest = std::max(largest, change.relative);
  if (changes.empty()) return Equivalence::sameBits;
  if (largest < lockstepRounding) return Equivalence::sameToRounding;
  return largest < lockstepSameLaw ? Equivalence::sameLaw : Equivalence::differs;
}

std::vector<DeclaredChange> declaredChanges(const Declaration& before, const Declaration& now) {
  const bool sameEngine = before.engine == now.engine;
  Declared was = declaredBy(before, sameEngine), is = declaredBy(now, sameEngine);
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

std::vector<EndpointRow> endpointChanges(const Case& setup, const KeptEndpoints& before,
                                         const KeptEndpoints& now,
                                         const std::pair<std::string, std::string>& names) {
  std::vector<EndpointValues> family;
  for (const Endpoint& endpoint : endpointTable()) {
    const std::string name(endpoint.name);
    if (before.contains(name) && now.contains(name) && setup.averaging.endpoints.contains(name))
      family.push_back({name, before.at(name), now.at(name)});
  }
  if (family.empty()) return {};
  const int starts = static_cast<int>(family.front().reference.size());
  return endpointRows(setup, family, names,
                      interimPlanAt(starts, 1, 1.0 - setup.averaging.confidence));
}

std::vector<AnswerDifference> answerDifferences(const Exchange& before, const Exchange& now,
                                                double tolerance) {
  // Both failed: the ends of their logs need not be the same words.
  if (before.answer.is_null() && now.answer.is_null()) return {};
  if (before.answer.is_null()) return {{"failure", "", before.failure, "an answer"}};
  if (now.answer.is_null()) return {{"failure", "", "an answer", now.failure}};
  std::vector<AnswerDifference> differences;
  try {
    addArrayDifferences(before, now, tolerance, differences);
  } catch (const std::exception& error) {
    differences = {{"arrays", "", "", error.what()}};
  }
  addFieldDifferences(before.answer, now.answer, tolerance, differences);
  return differences;
}

}  // namespace crossgrain::inline studies
