#include "cases/thesis_claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <stdexcept>

#include "cases/loader_document.hpp"
#include "cases/loader_reader.hpp"
#include "support/files.hpp"

namespace crossgrain::inline cases {
namespace {

/// What judging a claim asks its rule for. Figures in the order of reports.
struct ClaimNeeds {
  std::string_view id;
  std::vector<std::string> numbers;
  std::vector<std::string> figures;
};

const std::vector<std::string>& commonNeeds() {
  static const std::vector<std::string> names{
      "confidence",     "fewest_for_trend", "flow_from", "flow_to",   "blocked_from", "same_label",
      "wheel_contacts", "first_layer_to",   "band_to",   "bulk_from", "bulk_to"};
  return names;
}

const std::vector<ClaimNeeds>& claimNeeds() {
  // clang-format off
  static const std::vector<ClaimNeeds> needs{
      {"C1", {"sliding_from"}, {"spring", "coulomb", "viscous", "spring_dashpot", "sliding_coulomb", "sliding_viscous", "sliding_spring"}},
      {"C2", {"steps_per_contact"}, {"restitution", "duration"}},
      {"C3", {"label", "fewest_fine"}, {"meeting", "centre_peak", "slicing_peak", "noise"}},
      {"C4", {"label", "steady_from", "steady_to", "late"}, {"inner_change", "early_less_late", "outer_change", "inner_late", "pressure_late"}},
      {"C5", {}, {"width", "dilation", "nu0", "b", "reach"}},
      {"C6", {"thesis_rotation", "label_spread"}, {"critical", "blocked_above", "blocked_below", "critical_1", "critical_2", "critical_5", "critical_10", "critical_20", "carry_1", "carry_2", "carry_5", "carry_10", "carry_20"}},
      {"C7", {"fit_to"}, {"length", "roughness", "slip", "with_density"}},
      {"C8", {"label", "period_within", "fewest_fine"}, {"first_layer", "second_layer", "period", "amplitude", "decay", "phase"}},
      {"C9", {"independent_to"}, {"exponent", "velocity", "length", "exponent_fast"}},
      {"C10", {"inner", "outer"}, {"widths", "inner_mean", "outer_mean", "width_with_density"}},
      {"C11", {"rest_velocity", "rest_spin", "ridge_half_width", "ridge_off"}, {"ridge", "rest", "rest_with_density", "second_peak", "peak_at_one"}},
      {"C12", {}, {"band", "outermost", "with_density", "identity"}},
      {"C13", {}, {"axis", "with_density", "with_distance"}},
      {"C14", {"label", "window"}, {"tangential", "shear_side", "other_side", "homogeneous", "outer_lattice", "outer_symmetry"}},
      {"C15", {}, {"exponent_rp", "exponent_pr", "diagonal", "constant", "symmetry", "balance"}},
      {"C16", {}, {"orders", "pp_over_rr", "rr_over_rp"}},
      {"C17", {"label"}, {"rr_with_density", "rp_with_density", "dev_with_density", "dev_with_distance", "rr"}},
      {"C18", {"low_to", "change_from", "change_to"}, {"band", "flatter", "deviator", "fabric"}},
      {"C19", {}, {"fabric_stress", "stress_strain"}},
      {"C20", {"least_trace"}, {"mean_field", "collapse", "stiffness", "frictionless", "identity"}},
      {"C21", {}, {"exponent", "divergence"}},
      {"C22", {"layers_to"}, {"follows", "oscillates"}},
      {"C23", {}, {"wheel", "with_distance", "with_density", "identity"}},
      {"C24", {"fit_to", "particle_diameter", "length_ratio", "shape"}, {"velocity", "spin", "asymmetry", "model_couple", "couple", "couple_size"}},
      {"C25", {"days", "omega"}, {"speed_up", "hours"}},
      {"C26", {"label"}, {"overlap", "trace", "mean_overlap", "overlap_804"}},
      {"C27", {"factor"}, {"with_density", "slope", "trace"}},
  };
  // clang-format on
  return needs;
}

constexpr std::string_view reasonWanted = "must give the reason";

/// Those named, in the order named; another one is an unknown key, a missing one is missing.
std::vector<ClaimNumber> readNumbers(Reader in, const std::vector<std::string>& names) {
  std::vector<ClaimNumber> numbers;
  for (const std::string& name : names) {
    if (!in.has(name)) in.failMissing(name, "the judgement needs it");
    Reader each = in.section(name);
    ClaimNumber& number = numbers.emplace_back();
    number.name = name;
    each.require("value", number.value, Range{});
    each.requireText("why", number.why, reasonWanted);
    each.finish();
  }
  in.finish();
  return numbers;
}

void readEdge(Reader& in, const char* key, std::optional<double>& edge) {
  if (in.has(key)) in.read(key, edge.emplace(), Range{});
}

ClaimBand readBand(Reader in, const std::string& name) {
  ClaimBand band;
  band.name = name;
  in.requireText("label", band.label, "must say what it is");
  in.read("unit", band.unit);
  in.take("low");  // known, whether or not it is there
  in.take("high");
  readEdge(in, "low", band.low);
  readEdge(in, "high", band.high);
  in.requireText("why", band.why, reasonWanted);
  in.finish();
  if (band.low && band.high && !(*band.low < *band.high))
    in.fail("high", fmt::format("must be above low = {}", *band.low));
  return band;
}

std::vector<ClaimBand> readBands(Reader in, const std::vector<std::string>& names) {
  std::vector<ClaimBand> bands;
  for (const std::string& name : names) {
    if (!in.has(name)) in.failMissing(name, "the judgement gives this figure");
    bands.push_back(readBand(in.section(name), name));
  }
  in.finish();
  if (std::ranges::none_of(bands, &ClaimBand::judged))
    in.failMissing(names.front() + ".low", "or high: a claim has a figure with a band");
  return bands;
}

ClaimRule readRule(Reader in) {
  static const std::vector<std::string> ids = [] {
    std::vector<std::string> all;
    for (const ClaimNeeds& needs : claimNeeds()) all.emplace_back(needs.id);
    return all;
  }();
  static const std::vector<std::string> readings{"spacing", "mass", "radius", "tension"};
  ClaimRule rule;
  if (!in.has("id")) in.failMissing("id", "one of C1 … C27");
  in.read("id", rule.id, ids);
  const ClaimNeeds& needs = *std::ranges::find(claimNeeds(), rule.id, &ClaimNeeds::id);
  in.requireText("claim", rule.claim, "must say what is claimed");
  in.requireText("rule", rule.rule, "must say what is measured, and what it means");
  in.require("figure", rule.figure);
  in.read("readings", rule.readings, readings);
  rule.numbers = readNumbers(in.section("numbers"), needs.numbers);
  rule.figures = readBands(in.section("figures"), needs.figures);
  in.finish();
  return rule;
}

/// The one of that name. @param of  whose, for the message
template <typename Named>
const Named& named(const std::vector<Named>& list, std::string_view name, std::string_view of) {
  const auto found = std::ranges::find(list, name, &Named::name);
  if (found == list.end()) throw std::logic_error(fmt::format("rules: {} has no {}", of, name));
  return *found;
}

ClaimRules rulesOf(const CaseDocument& document, const std::string& name, std::string text) {
  Reader in(&document.root, "", name);
  ClaimRules rules;
  rules.text = std::move(text);
  if (!in.has("common")) in.failMissing("common", "numbers of all rules");
  rules.common = readNumbers(in.section("common"), commonNeeds());
  std::set<std::string> seen;
  for (Reader& each : in.sections("claims")) {
    rules.claims.push_back(readRule(each));
    if (!seen.insert(rules.claims.back().id).second) each.fail("id", "is there twice");
  }
  in.finish();
  for (const ClaimNeeds& needs : claimNeeds())
    if (!seen.contains(std::string(needs.id)))
      in.failMissing("claims", fmt::format("there is no rule of {}", needs.id));
  std::ranges::sort(rules.claims, {},
                    [](const ClaimRule& rule) { return std::stoi(rule.id.substr(1)); });
  return rules;
}

}  // namespace

double ClaimRule::number(std::string_view name) const {
  return named(numbers, name, id).value;
}

const ClaimBand& ClaimRule::band(std::string_view name) const {
  return named(figures, name, id);
}

bool ClaimRule::judgedUnder(std::string_view reading) const {
  return std::ranges::find(readings, reading) != readings.end();
}

int ClaimRule::judgedFigures() const {
  return static_cast<int>(std::ranges::count_if(figures, &ClaimBand::judged));
}

double ClaimRules::number(std::string_view name) const {
  return named(common, name, "common").value;
}

const ClaimRule& ClaimRules::of(std::string_view id) const {
  const auto found = std::ranges::find(claims, id, &ClaimRule::id);
  if (found == claims.end()) throw std::logic_error(fmt::format("rules: there is no {}", id));
  return *found;
}

ClaimRules loadClaimRules(const std::filesystem::path& file) {
  return rulesOf(readBaseDocument(file), file.string(), readFile(file).value_or(""));
}

ClaimRules claimRulesOf(const std::string& text) {
  return rulesOf(documentOf(text, "", ""), "the claims' rules", text);
}

LegChoices legChoices(const std::string& caseToml) {
  const CaseDocument document = documentOf(caseToml, "", "");
  return {document.root.at_path("particles.large_mass").value<double>(),
          document.root.at_path("law.kt").value<double>()};
}
}  // namespace crossgrain::inline cases
