#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "law/contact_law.hpp"

/// The keys of case files as a list: `crossgrain list keys`, and the second part of docs/cases.md.
/// The tables behind it are those that the loader reads by (schema.hpp).
namespace crossgrain::inline cases {

/// The numbers that a key allows.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool lowOpen = false, highOpen = false;  ///< whether the end itself is excluded
  std::string unit = {};
  std::string reason = {};  ///< appended to the message, with its comma or colon
  bool mayBeInfinite = false;
  bool notZero = false;

  bool contains(double value) const;
  std::string text() const;      ///< "> 0 m", ">= 1", "in (0, 1)", for messages
  std::string interval() const;  ///< the same without unit, for tables; empty: any number
};

/// Largest seed: the random number generator takes 32 bits and would drop the others silently.
inline constexpr std::uint64_t mostSeed = 0xffffffff;

Range anyNumber(std::string unit = {});
Range positive(std::string unit = {}, std::string reason = {});
Range above(double low, std::string unit = {});
Range atLeast(double low, std::string unit = {});
Range between(double low, double high, std::string unit = {});  ///< ends included
Range inside(double low, double high, std::string unit = {});   ///< ends excluded
Range aboveZeroTo(double high);                                 ///< (0, high]

/// The conventions of a case that does not say its own: option by option what closed forms and
/// experiments support and most engines of soft spheres share. docs/cases.md has the reason of
/// each; LawConventions itself begins with the thesis', which cases/laws/thesis-conventions.toml
/// names.
LawConventions usualConventions();

/// A key as it is listed.
struct KeyInfo {
  std::string name;           ///< "kn"; words in capitals stand for names: "FIELD.relative"
  std::string unit = {};      ///< "–" of a number without a dimension; empty: not a number
  std::string standard = {};  ///< the value where the key is left out, "required", or "–" for none
  std::string values = {};    ///< "> 0", "disk, wall"; empty: any
  std::string meaning = {};
  std::string commands = {};  ///< that use it; empty: those that use its section
};

struct SectionInfo {
  std::string name;           ///< "law", "averaging.margins"; [name], or [[name]] for a list
  std::string kinds = {};     ///< of cases that may have it, separated by ", "; empty: all
  std::string commands = {};  ///< that use it, separated by blanks; empty: those of the section
                              ///< above it, or all
  std::string note = {};      ///< Markdown above its table
  bool isList = false;
  std::vector<KeyInfo> keys = {};
};

/// All sections, in the order of the page.
const std::vector<SectionInfo>& caseSections();

/// The tables of all keys in Markdown, the second part of docs/cases.md.
std::string keysInMarkdown();

/// The names below which commands differ in what they use, "run.mirrors" or "averaging", with the
/// commands that use them. What none of these names holds is used by all commands.
struct KeyUse {
  std::string name, commands;

  bool by(std::string_view command) const;
};
const std::vector<KeyUse>& keyUses();

}  // namespace crossgrain::inline cases
