#pragma once

#include "support/json_fields.hpp"
#include "support/verdict.hpp"

/// Meanings of texts in results; support/json_fields.hpp has how structs become JSON.
namespace crossgrain::inline results {

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
