#pragma once

#include <toml++/toml.h>

#include <string>

namespace crossgrain::inline cases {

/// One value as TOML on one line, numbers with the fewest digits that read back the same.
std::string printValue(const toml::node& node);

/// A document as TOML: every table under its full name, its own values first.
std::string printDocument(const toml::table& root);

/// A document as one of [[variants]]: everything in it is what that variant changes.
std::string printVariant(const toml::table& root, const std::string& name);

}  // namespace crossgrain::inline cases
