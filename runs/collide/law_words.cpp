#include "runs/collide/law_words.hpp"

#include "adapters/law_options.hpp"
#include "adapters/pair_table.hpp"

namespace crossgrain::inline runs {

LawWords lawInWords(const ContactLaw& law) {
  LawWords words;
  for (const LawOption& option : lawOptions())
    if (mattersTo(law, option.name))
      words[std::string(option.name)] = std::string(option.values[option.get(law)]);
  const PairCoefficients has = coefficientsOf(law);
  const std::pair<const char*, double> constants[] = {
      {"kn", has.kn}, {"gn", has.gn}, {"kt", has.kt}, {"gt", has.gt}, {"mu", has.mu}};
  for (const auto& [name, value] : constants)
    if (value > 0.0) words[name] = value;
  if (!law.soft()) words["e_n"] = law.en;
  if (!law.soft() && has.mu > 0.0) words["e_t0"] = law.et0;
  if (law.normal == NormalLaw::polynomial) words["kn3"] = law.kn3;
  return words;
}

LawWords lawDifference(const ContactLaw& law, const ContactLaw& from) {
  const LawWords before = lawInWords(from);
  LawWords difference = lawInWords(law);
  std::erase_if(difference, [&](const auto& word) {
    const auto found = before.find(word.first);
    return found != before.end() && found->second == word.second;
  });
  // Another normal law has constants of its own; where it is the same one, what is gone is 0.
  if (law.normal != from.normal) return difference;
  for (const auto& [name, value] : before)
    if (std::holds_alternative<double>(value) && !lawInWords(law).contains(name))
      difference[name] = 0.0;
  return difference;
}

}  // namespace crossgrain::inline runs
