#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "law/contact_law.hpp"

namespace crossgrain {

/// The part of a law that options and constants belong to. Those of rolling, cohesion and space are
/// listed only where a law has that part.
enum class LawPart { contact, rolling, cohesion, space };

/// Whether the law has that part.
bool hasPart(const ContactLaw& law, LawPart part);

/// One option of the contact law under the name that case files use.
struct LawOption {
  std::string_view name;                              ///< e.g. "dashpot"
  std::string_view meaning;                           ///< for people, one line
  std::vector<std::string_view> values;               ///< e.g. "inside", "outside", in enum order
  std::function<std::size_t(const ContactLaw&)> get;  ///< index into values
  std::function<void(ContactLaw&, std::size_t)> set;
  LawPart part = LawPart::contact;
};

/// Every option of the law, those of its parts after those that all laws have.
std::span<const LawOption> lawOptions();

/// One constant of the law; case files and units: law/contact_law.hpp.
struct LawConstant {
  std::string_view name;  ///< as in the worker protocol
  double ContactLaw::*value;
  LawPart part = LawPart::contact;
};

/// All of them. A law that has no use for one leaves it as it is.
std::span<const LawConstant> lawConstants();

/// The value that a law has for an option, by name. @throws std::invalid_argument if unknown
std::string lawOptionValue(const ContactLaw& law, std::string_view name);

/// Sets an option by name. @throws std::invalid_argument saying which names or values there are
void setLawOption(ContactLaw& law, std::string_view name, std::string_view value);

/// Whether the option says how a law is worked out, not which law it is or what its constants mean:
/// engines that differ in it have the same law.
bool isConvention(std::string_view name);

/// Whether the option has any bearing on this law: a frictionless law has no lever arm.
bool mattersTo(const ContactLaw& law, std::string_view name);

}  // namespace crossgrain
