#pragma once

#include <string>
#include <string_view>

/// Names in results.json as people write them, in plain text: a name that is not known here is
/// shown as it is, its underscores as spaces. And how such text becomes HTML or gnuplot's.
namespace crossgrain::reports {

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

}  // namespace crossgrain::reports
