#pragma once

#include <map>
#include <string>
#include <vector>

#include "cases/case.hpp"

namespace crossgrain::inline cases {

/// Every key of a case's merged document, "law.mu", with its value as TOML prints it: what
/// distinguishes two cases. A key that is left to its default is missing.
using CaseKeys = std::map<std::string, std::string>;

/// @param toml  Case::resolvedToml
CaseKeys caseKeys(const std::string& toml);

/// Whether a key stands in a section, "averaging.margins", or is that key itself.
bool isIn(const std::string& section, const std::string& key);

/// Who says a key, for messages: "--set law.kn=1", or the case file.
std::string whereSaid(const Case& setup, const std::string& key);

/// One line per key that differs, "law.mu: 0.44 → 0.5"; "none" stands for a key that is missing.
std::vector<std::string> changes(const CaseKeys& before, const CaseKeys& now);

/// "law.mu: 0.44 → 0.5; law.kn: … and 3 more": the first few changes, long values shortened.
std::string changesInWords(const std::vector<std::string>& changes);

}  // namespace crossgrain::inline cases
