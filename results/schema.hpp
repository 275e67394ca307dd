#pragma once

#include "support/json_fields.hpp"
#include "support/verdict.hpp"

/// results.json as text: its version, reading and printing it. Its layout is in docs/results.md.
/// Meanings of texts in it; support/json_fields.hpp has how structs become JSON.
namespace crossgrain::inline results {

inline constexpr std::string_view schemaVersion = "crossgrain-results-1";
inline constexpr std::string_view kindCompare = "compare";
inline constexpr std::string_view kindCollide = "collide";
inline constexpr std::string_view kindConformance = "conformance";
inline constexpr std::string_view kindDiff = "diff";  ///< printed, no report is made of it
inline constexpr std::string_view kindEffects = "effects";
inline constexpr std::string_view kindLockstep = "lockstep";
inline constexpr std::string_view kindCost = "cost";
inline constexpr std::string_view kindAverage = "average";
inline constexpr std::string_view kindRev = "rev";
inline constexpr std::string_view kindStability = "stability";

/// @throws BadInput, beginning with where, unless schema and kind are ones that are known here
void checkSchema(const nlohmann::json& results, const std::string& where);

/// One line of JSON. What is not finite is null; bytes that are not UTF-8 are replaced.
std::string toText(const nlohmann::json& results);

/// @throws BadInput naming the file
nlohmann::json readResultsFile(const std::filesystem::path& file);

using support::Json;
using support::nameOf;
using support::Status;
using support::Verdict;

/// Results of a kind, or one run of them, as a document, and from one: documents.cpp lists them.
template <typename Results>
Json toJson(const Results& results);
/// @throws FieldError
template <typename Results>
Results fromJson(const Json& json);

/// Of engines, cases, variants, methods, quantities, …; empty where there is none.
bool isName(std::string_view text);
inline constexpr Words aName{isName, "a name of letters, digits and . _ - +"};

/// Of a field: a name, and a unit, as averaging/fields.hpp has them.
bool isField(std::string_view text);
inline constexpr Words aField{isField, "a field (crossgrain list fields has them)"};

/// "N/m²", "Ω D/d", "1"; empty where there is none.
bool isUnit(std::string_view text);
inline constexpr Words aUnit{isUnit, "a unit"};

/// Names in files of an agreement within a margin; a field that nothing is asked of has none.
inline constexpr support::EnumNames<Verdict, 4> agreementNames{{{Verdict::pass, "agree"},
                                                                {Verdict::fail, "disagree"},
                                                                {Verdict::undecided, "undecided"},
                                                                {Verdict::notApplicable, ""}}};

}  // namespace crossgrain::inline results
