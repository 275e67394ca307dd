#pragma once

#include <string>
#include <string_view>

/// Names in results.json as people write them, in HTML. A name that is not known here is shown as
/// it is, its underscores as spaces, escaped.
namespace crossgrain::reports {

/// Of a field: "stress_rp" → "shear stress σ<sub>rφ</sub>".
std::string fieldLabel(std::string_view field);

/// The symbol alone: "σ<sub>rφ</sub>".
std::string fieldSymbol(std::string_view field);

/// Its words alone, plain text: "shear stress".
std::string fieldWords(std::string_view field);

/// Its symbol in gnuplot's enhanced text, and as an axis has it: "shear stress σ_{rφ} [N/m^{2}]".
std::string fieldPlotSymbol(std::string_view field);
std::string fieldAxis(std::string_view field);

/// Of a number of the report's head: "kn_over_p" → "k<sub>n</sub>/p".
std::string headLabel(std::string_view name);

/// Escaped text in which "σ_rφ" has a subscript and "r^p" a superscript: ASCII letters and digits,
/// minus signs and Greek letters after a mark that follows a symbol; "spring_dashpot" is none.
std::string mathHtml(std::string_view words);

/// Escaped text in which only symbols of one letter, "k_n" and "t_c", have what is below the line:
/// for sentences, in which names that people gave may have such marks too.
std::string symbolsHtml(const std::string& words);

/// A page in whose text such symbols are written so; what is in tags, <pre> and <code> stays.
std::string pageWithSymbols(const std::string& html);

/// mathHtml() in gnuplot's enhanced text: "σ_{rφ}".
std::string mathGnuplot(std::string_view words);

/// Underscores as spaces.
std::string spaced(std::string_view name);

}  // namespace crossgrain::reports
