// The list of keys (cases/README.md, `crossgrain list keys`) against what the loader asks for: the
// loader names all keys that it knows when it meets one that is like none of them.
#include "cases/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "averaging/fields.hpp"
#include "files.hpp"
#include "oracle/collision_quantities.hpp"

namespace crossgrain::test {
namespace {

using Names = std::set<std::string>;

const std::string noKey = "zzzzzzzzzzzzzzzzzzzz";

Names split(const std::string& list) {
  Names names;
  for (std::size_t from = 0, comma = 0; comma != std::string::npos; from = comma + 2) {
    comma = list.find(", ", from);
    names.insert(list.substr(from, comma - from));
  }
  return names;
}

/// The keys that the loader asks for in the table that `line` puts an unknown key into.
Names asked(const std::string& document, const std::string& line) {
  std::ofstream("case.toml") << document << line << '\n';
  try {
    loadCase("case.toml");
  } catch (const BadInput& error) {
    const std::string message = error.what(), marker = "(there are: ";
    const auto at = message.find(marker);
    EXPECT_NE(message.find("unknown key"), std::string::npos) << message;
    if (at == std::string::npos) return {message};
    const auto from = at + marker.size();
    return split(message.substr(from, message.find(')', from) - from));
  }
  return {"nothing was refused"};
}

/// In a section: `[path]` with nothing but the unknown key.
Names askedIn(const std::string& document, const std::string& path) {
  return asked(document, fmt::format("[{}]\n{} = 1", path, noKey));
}

/// In a section that the document has already, as its last one.
Names askedAtEnd(const std::string& document) {
  return asked(document, noKey + " = 1");
}

/// The first word below `section` of all keys documented there; of sections of it, too.
Names documented(const std::string& section, const std::string& below = "") {
  Names names;
  const std::string prefix = section.empty() ? "" : section + ".";
  for (const CaseKey& key : caseKeys()) {
    const std::string path = key.section + "." + key.key;
    const std::string start = prefix + below;
    if (!path.starts_with(start)) continue;
    names.insert(path.substr(start.size(), path.find('.', start.size()) - start.size()));
  }
  return names;
}

Names without(Names names, const std::string& name) {
  EXPECT_EQ(names.erase(name), 1) << name;
  return names;
}

Names united(Names one, const Names& other) {
  one.insert(other.begin(), other.end());
  return one;
}

template <typename Specs>
Names namesOf(const Specs& specs) {
  Names names;
  for (const auto& spec : specs) names.emplace(spec.name);
  return names;
}

using Keys = InFolder;

TEST_F(Keys, AreThoseThatTheLoaderAsksFor) {
  // The document reader takes `variants` and `case.extends` away before the loader sees them.
  EXPECT_EQ(asked(fmt::format("{} = 1\n", noKey), soundCase), without(documented(""), "variants"));
  EXPECT_EQ(askedIn(soundCase.substr(soundCase.find("[law]")), "case"),
            without(documented("case"), "extends"));
  EXPECT_EQ(asked("", withLine(soundCase, 3, "[law]\n" + noKey + " = 1")), documented("law"));
  EXPECT_EQ(asked("", withLine(soundCase, 10, "[cell]\n" + noKey + " = 1")), documented("cell"));
  EXPECT_EQ(askedAtEnd(soundCase), documented("particles"));
  for (const char* section : {"bottom", "preparation", "averaging", "run", "cost", "stability"})
    EXPECT_EQ(askedIn(soundCase, section), documented(section)) << section;
}

TEST_F(Keys, OfCollisions) {
  std::string otherwise = withLine(soundCollision, 9, "angle = 45");
  otherwise = withLine(otherwise, 10, "speed = 0.01");
  EXPECT_EQ(united(askedAtEnd(soundCollision), askedAtEnd(otherwise)), documented("collision"));
}

TEST_F(Keys, OfAssemblies) {
  EXPECT_EQ(asked("", withLine(soundAssembly, 7, "[assembly]\n" + noKey + " = 1")),
            documented("assembly"));
  EXPECT_EQ(askedAtEnd(soundAssembly), documented("assembly.disks"));
  EXPECT_EQ(askedIn(soundAssembly, "[assembly.walls]"), documented("assembly.walls"));
  EXPECT_EQ(asked("", withLine(soundAssembly, 7, "[assembly.start]\n" + noKey + " = 1")),
            documented("assembly.start"));
}

TEST_F(Keys, OfMargins) {
  EXPECT_EQ(askedIn(soundCase, "averaging.margins"), namesOf(fieldTable()));
  EXPECT_EQ(askedIn(soundCollision, "collision.margins"), namesOf(scoredQuantities()));
  EXPECT_EQ(documented("averaging.margins"), Names{"FIELD"});
  EXPECT_EQ(documented("collision.margins"), Names{"QUANTITY"});
  EXPECT_EQ(askedIn(soundCase, "averaging.margins.spin"),
            documented("averaging.margins", "FIELD."));
  EXPECT_EQ(askedIn(soundCollision, "collision.margins.psi_f"),
            documented("collision.margins", "QUANTITY."));
}

TEST_F(Keys, OfInlineTablesStandInTheirMeaning) {
  const auto meaning = [](const std::string& section, const std::string& key) {
    const auto found = std::ranges::find_if(caseKeys(), [&](const CaseKey& each) {
      return each.section == section && each.key == key;
    });
    return found == caseKeys().end() ? "" : found->meaning;
  };
  const std::string psi = withLine(soundCollision, 9, "psi = { " + noKey + " = 1 }");
  for (const std::string& name : asked(psi, ""))
    EXPECT_NE(meaning("collision", "psi").find(name), std::string::npos) << name;
  for (const char* places : {"grid", "stack", "chain", "heap", "line"})
    for (const std::string& name :
         asked(soundAssembly, fmt::format("{} = {{ {} = 1 }}", places, noKey)))
      EXPECT_NE(meaning("assembly.disks", places).find(name), std::string::npos)
          << places << ' ' << name;
}

TEST_F(Keys, AreDescribed) {
  for (const CaseKey& key : caseKeys()) {
    EXPECT_FALSE(key.usual.empty()) << key.section << ' ' << key.key;
    EXPECT_EQ(key.key.find(' '), std::string::npos) << key.key;
  }
}

}  // namespace
}  // namespace crossgrain::test
