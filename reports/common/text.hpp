#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/numbers.hpp"

/// Names in results.json as people write them, in plain text, how such text becomes HTML or
/// gnuplot's, and sentences that are put together by rule. A name that is not known here is shown
/// as it is, its underscores as spaces.
namespace crossgrain::reports {

using Names = std::vector<std::string>;

/// Of a field: "stress_rp" → "shear stress σ_rφ", and its words alone: "shear stress".
std::string fieldLabel(std::string_view field);
std::string fieldWords(std::string_view field);

/// Its symbol in gnuplot's enhanced text, and as an axis has it: "shear stress σ_{rφ} [N/m^{2}]".
std::string fieldPlotSymbol(std::string_view field);
std::string fieldAxis(std::string_view field);

/// Of a number of the report's head: "kn_over_p" → "stiffness over pressure k_n/p".
std::string headLabel(std::string_view name);

/// Escaped for HTML: between tags, and within an attribute in quotes.
std::string escaped(std::string_view text);

/// Escaped text in which "σ_rφ" has a subscript and "r^p" a superscript: ASCII letters and digits,
/// minus signs and Greek letters after a mark that follows a symbol of one letter; names of several
/// stay: "spring_dashpot".
std::string mathHtml(std::string_view words);

/// The same in gnuplot's enhanced text: "σ_{rφ}".
std::string mathGnuplot(std::string_view words);

/// Underscores as spaces.
std::string spaced(std::string_view name);

/// "a, b and c"
std::string listed(const std::vector<std::string>& names);

/// The first few, and how many more: "a, b and 3 more".
std::string listedShortly(const std::vector<std::string>& names, std::size_t most);

/// "all 4 runs", "both runs", "the one run"
std::string allOf(std::size_t count, std::string_view noun);

using support::counted;

/// The first letter, of ASCII, as a capital one.
std::string capitalised(std::string text);

/// Indices that rise, runs of three or more by their ends: "0, 2 to 5, 7".
std::string indicesText(const std::vector<int>& indices);

/// Adds a value unless the list has it.
template <typename T>
void addOnce(std::vector<T>& list, const std::type_identity_t<T>& value) {
  if (std::ranges::find(list, value) == list.end()) list.push_back(value);
}

inline bool contains(const Names& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// The first element of which that is true; null without one.
auto findIf(const auto& list, const auto& isIt) -> decltype(&*list.begin()) {
  const auto found = std::ranges::find_if(list, isIt);
  return found == list.end() ? nullptr : &*found;
}

/// The first element whose member has that value; null without one.
auto findBy(const auto& list, const auto& value, auto member) -> decltype(&*list.begin()) {
  return findIf(list, [&](const auto& one) { return std::invoke(member, one) == value; });
}

/// Drops empty ones.
std::vector<std::string> nonEmpty(std::vector<std::string> texts);

/// "is" or "are", "differs" or "differ": by how many there are.
inline std::string_view verb(std::size_t count, std::string_view one, std::string_view many) {
  return count == 1 ? one : many;
}

/// Subjects by their predicate, in the order in which each predicate came first.
class SaidOf {
 public:
  void add(const std::string& subject, const std::string& said);
  const std::vector<std::pair<std::string, std::vector<std::string>>>& all() const { return said_; }
  /// "a and b in x; c in y", by the form "{} in {}".
  std::string joined(std::string_view form) const;

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> said_;
};

}  // namespace crossgrain::reports
