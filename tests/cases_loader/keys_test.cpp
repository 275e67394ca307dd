// The list of keys: docs/cases.md against the tables that the loader reads by, and keys of inline
// tables, which only a meaning names, against what the loader asks for.
#include <algorithm>
#include <sstream>

#include "cases/keys.hpp"
#include "files.hpp"

namespace crossgrain::test {
namespace {

using Keys = InFolder;

const KeyInfo& info(const std::string& section, const std::string& key) {
  const auto& keys = std::ranges::find(caseSections(), section, &SectionInfo::name)->keys;
  return *std::ranges::find(keys, key, &KeyInfo::name);
}

TEST_F(Keys, Page_IsWhatListKeysPrints) {
  std::ostringstream page;
  page << std::ifstream(std::filesystem::path(CROSSGRAIN_CASES) / "../docs/cases.md").rdbuf();
  const std::string text = page.str();
  EXPECT_EQ(text.substr(text.find("## Keys")), keysInMarkdown());
}

TEST_F(Keys, Page_NamesEveryKeyInItsSection) {
  const std::string page = keysInMarkdown();
  for (const SectionInfo& section : caseSections()) {
    const auto from = page.find((section.isList ? "\n### `[[" : "\n### `[") + section.name + "]");
    ASSERT_NE(from, std::string::npos) << section.name;
    const std::string table = page.substr(from, page.find("\n### ", from + 1) - from);
    for (const KeyInfo& key : section.keys)
      EXPECT_NE(table.find("`" + key.name + "`"), std::string::npos)
          << section.name << ' ' << key.name;
  }
}

TEST_F(Keys, EveryKey_IsListedOnceWithADefault) {
  std::set<std::string> seen;
  for (const SectionInfo& section : caseSections())
    for (const KeyInfo& key : section.keys) {
      EXPECT_FALSE(key.standard.empty()) << section.name << ' ' << key.name;
      EXPECT_TRUE(seen.insert(section.name + "." + key.name).second) << key.name;
    }
  EXPECT_GE(seen.size(), 210u);
}

TEST_F(Keys, Defaults_AreThoseOfTheTypes) {
  EXPECT_EQ(info("averaging", "settle_rotations").standard, "0.25");
  EXPECT_EQ(info("averaging", "method").standard, "\"slicing\"");
  EXPECT_EQ(info("run", "mirrors").standard, "true");
  EXPECT_EQ(info("assembly", "offset").standard, "[0, 0]");
  EXPECT_EQ(info("collision", "approach").standard, "\"spin\"");
  EXPECT_EQ(info("cell", "omega").standard, "required");
  EXPECT_EQ(info("law", "k2").unit, "N/m²");
  EXPECT_EQ(info("averaging", "confidence").values, "(0, 1)");
}

TEST_F(Keys, InlineTables_AreInTheMeaning) {
  const auto asked = [](const std::string& text) {
    std::ofstream("case.toml") << text;
    const std::string message = messageOf("case.toml"), marker = "(there are: ";
    const auto from = message.find(marker) + marker.size();
    std::istringstream list(message.substr(from, message.find(')', from) - from));
    std::vector<std::string> names;
    for (std::string name; list >> name;) {
      std::erase(name, ',');
      names.push_back(name);
    }
    EXPECT_NE(message.find("unknown key"), std::string::npos) << message;
    return names;
  };
  const std::string noKey = "{ zzzzzzzzzzzzzzzzzzzz = 1 }\n";
  for (const std::string& name : asked(withLine(soundCollision, 9, "psi = " + noKey)))
    EXPECT_NE(info("collision", "psi").meaning.find(name), std::string::npos) << name;
  for (const char* places : {"grid", "stack", "chain", "heap", "line"})
    for (const std::string& name : asked(soundAssembly + places + " = " + noKey))
      EXPECT_NE(info("assembly.disks", places).meaning.find(name), std::string::npos)
          << places << ' ' << name;
}

TEST_F(Keys, Use_IsThatOfTheLongestNameThatHoldsTheKey) {
  const auto& uses = keyUses();
  const auto find = [&](const char* name) { return *std::ranges::find(uses, name, &KeyUse::name); };
  EXPECT_TRUE(find("run").by("cost"));
  EXPECT_FALSE(find("run.mirrors").by("cost"));
  EXPECT_TRUE(find("engines").by("cost"));
  EXPECT_FALSE(find("averaging.margins").by("average"));
  EXPECT_FALSE(find("run.mirrors").by("compar"));  // a whole word
}

}  // namespace
}  // namespace crossgrain::test
