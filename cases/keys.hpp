#pragma once

#include <string>
#include <vector>

namespace crossgrain::inline cases {

/// A key of case files, as the tables of cases/README.md have it. Names in capitals stand for
/// names: FIELD, SETTING.
struct CaseKey {
  std::string section;  ///< "law", "averaging.margins"; "assembly.disks" for [[assembly.disks]]
  std::string key;      ///< below it: "kn", "FIELD.relative"
  std::string unit;     ///< "" for what has none to have, "–" for a number without a dimension
  std::string usual;    ///< the value where the key is left out, "required", or "–" for none
  std::string meaning;
};

/// All of them, in the order of cases/README.md, which is built into the program. Tests hold it to
/// what the loader asks for.
const std::vector<CaseKey>& caseKeys();

}  // namespace crossgrain::inline cases
