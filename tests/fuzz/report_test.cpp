/// `report` and `plan` merge folders of others: whatever a text in their results.json says, nothing
/// of it is run, nothing gets out of its quotes, and no file is written but the report's.
#include <gtest/gtest.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "adapters/worker/json.hpp"
#include "reports/render/gnuplot.hpp"
#include "reports/report.hpp"
#include "results/conformance.hpp"
#include "results/schema.hpp"
#include "support/files.hpp"
#include "support/input_file.hpp"
#include "tests/fuzz/reading.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace crossgrain;
namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Each ends what it may stand in, in gnuplot, a shell, HTML, XML, Markdown and a spreadsheet.
const std::string hostile[] = {
    "x' \" `touch pwned` $(touch pwned)\nsystem('touch pwned')\n!touch pwned\n@pwned\n# "
    "</script></title>--><img src=pwned>'\"> | [pwned](javascript:pwned) \\",
    "=cmd|' /C pwned'!A1", "../../pwned"};

/// Every kind, as its file has it.
std::vector<Json> documents() {
  ConformanceResults conformance;
  conformance.head = sample::lockstepResults().head;
  conformance.head.kind = kindConformance;
  conformance.engine.name = "mine";
  conformance.rows.push_back(
      {"suite", "HeadOnCollision", "two disks part", checkPassed, "e_n is 0.5"});
  return {toJson(sample::compareResults(4, 244)),
          toJson(sample::averageResults()),
          toJson(sample::revResults()),
          toJson(sample::collideResults()),
          toJson(sample::effectsResults(4)),
          toJson(sample::stabilityResults()),
          toJson(sample::lockstepResults()),
          toJson(sample::costResults()),
          toJson(conformance)};
}

/// A text of a document, or the key of a member, by where it is.
struct Place {
  Json::json_pointer at;
  bool isKey = false;
};

/// "/runs/3/engine" → "/runs/*/engine"
std::string kindOf(const std::string& pointer) {
  std::string kind;
  for (std::size_t k = 0; k < pointer.size(); ++k) {
    kind += pointer[k];
    if (pointer[k] != '/' || k + 1 == pointer.size() || !std::isdigit(pointer[k + 1])) continue;
    kind += '*';
    while (k + 1 < pointer.size() && std::isdigit(pointer[k + 1])) ++k;
  }
  return kind;
}

/// The first of each kind of place.
class Places {
 public:
  explicit Places(const Json& document) { visit(document, Json::json_pointer()); }
  std::vector<Place> all;

 private:
  void add(const Json::json_pointer& at, bool isKey) {
    if (seen_.insert(kindOf(at.to_string()) + (isKey ? " key" : "")).second)
      all.push_back({at, isKey});
  }
  void visit(const Json& json, const Json::json_pointer& at) {
    if (json.is_string()) add(at, false);
    if (json.is_array())
      for (std::size_t k = 0; k < json.size(); ++k) visit(json[k], at / k);
    if (json.is_object())
      for (const auto& [key, value] : json.items()) {
        add(at / key, true);
        visit(value, at / key);
      }
  }
  std::set<std::string> seen_;
};

Json edited(const Json& document, const Place& place, const std::string& text) {
  Json result = document;
  if (!place.isKey) {
    result[place.at] = text;
  } else {
    Json& object = result[place.at.parent_pointer()];
    Json value = object[place.at.back()];
    object.erase(place.at.back());
    object[text] = std::move(value);
  }
  return result;
}

/// Every word of a script that is in no quotes or comments; a line that ends within quotes appears
/// as "\n".
std::string outsideOfQuotes(const std::string& script) {
  std::string rest;
  char quote = 0;
  bool comment = false;
  for (const char c : script) {
    if (c == '\n') {
      if (quote) rest += "\\n within quotes";
      quote = 0;
      comment = false;
    }
    if (comment) continue;
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '\'' || c == '"') {
      quote = c;
    } else if (c == '#') {
      comment = true;
    } else {
      rest += c;
    }
  }
  return rest;
}

/// Whether a mark is there without the character that makes it harmless.
bool isThere(const std::string& text, const std::string& mark, char harmlessAfter = 0) {
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1))
    if (harmlessAfter == 0 || at == 0 || text[at - 1] != harmlessAfter) return true;
  return false;
}

bool hasFormula(const std::string& csv) {
  bool atStart = true, quoted = false;
  for (const char c : csv) {
    if (atStart && c != '"') {
      if (c == '=' || c == '@') return true;
      atStart = false;
    }
    if (c == '"') quoted = !quoted;
    if (!quoted && (c == ',' || c == '\n')) atStart = true;
  }
  return false;
}

void expectHarmless(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const fs::path& file = entry.path();
    const std::string name = file.filename().string(), kind = file.extension().string();
    EXPECT_TRUE(usableName(name)) << name;
    EXPECT_EQ(name.find("pwned"), std::string::npos) << name;
    if (!entry.is_regular_file()) continue;
    const std::string text = *readFile(file);
    if (kind == ".gp") {
      const std::string rest = outsideOfQuotes(text);
      EXPECT_FALSE(isThere(rest, "pwned") || isThere(rest, "within quotes") || isThere(rest, "`"))
          << name << ": " << text;
    }
    if (kind == ".html" || kind == ".xml" || kind == ".svg") {
      EXPECT_FALSE(isThere(text, "<img src=pwned")) << name;
      EXPECT_FALSE(isThere(text, "-->")) << name;
    }
    if (kind == ".md") {
      EXPECT_FALSE(isThere(text, "<img", '\\') || isThere(text, "[pwned", '\\') ||
                   isThere(text, "`touch", '\\'))
          << text;
    }
    if (kind == ".csv") {
      EXPECT_FALSE(hasFormula(text)) << name << ": " << text;
    }
  }
}

/// In gnuplot's place: a drawing and axes for every script, so that pages have all their figures.
class DrawnByNobody {
 public:
  DrawnByNobody() : before_(std::getenv("PATH")) {
    const fs::path program = folder_.path() / "gnuplot";
    writeFile(program,
              "#!/bin/sh\nshift\nexec awk 'FNR == 1 { b = FILENAME; sub(/.gp$/, \"\", b); print "
              "\"<svg width=\\\"640\\\" height=\\\"380\\\"></svg>\" > (b \".svg\") }\n"
              "/^  set title/ { print \"50 500 50 300 0 1 0 1\" > (b \".axes\") }' \"$@\"\n");
    fs::permissions(program, fs::perms::owner_all);
    ::setenv("PATH", (folder_.path().string() + ":" + before_).c_str(), 1);
  }
  ~DrawnByNobody() { ::setenv("PATH", before_.c_str(), 1); }

 private:
  TemporaryFolder folder_;
  std::string before_;
};

TEST(HostileResults, RunNothingAndStayWithinTheirQuotes) {
  const DrawnByNobody drawn;
  const TemporaryFolder folder;
  std::vector<std::pair<Json, Place>> inputs;
  for (const Json& document : documents()) {
    writeReport(document, folder.path() / "right");  // as it is, it is one
    for (const Place& place : Places(document).all) inputs.emplace_back(document, place);
  }
  // Every twelfth place unless asked for more; the others come next.
  constexpr std::uint64_t stride = 12;
  const auto read = [&](std::uint64_t k, test::Draw&) {
    const auto& [document, place] =
        inputs[(stride * k + stride * k / inputs.size()) % inputs.size()];
    const fs::path report = folder.path() / "report";
    fs::remove_all(report);
    SCOPED_TRACE(testing::Message() << "input " << k << ": " << document.at("kind") << " "
                                    << place.at.to_string() << (place.isKey ? ", its key" : ""));
    const auto examine = [&] {
      if (fs::exists(report)) expectHarmless(report);
    };
    try {
      writeReport(edited(document, place, hostile[(k + k / inputs.size()) % std::size(hostile)]),
                  report);
    } catch (const BadInput&) {
      examine();
      throw;
    }
    examine();
  };
  test::readAll(inputs.size() / stride, read, 0.1, 0.1);
}

/// A value of another type or size, elsewhere, or gone.
TEST(HostileResults, AreReportsOrRefusedInOneLine) {
  const DrawnByNobody drawn;
  const TemporaryFolder folder;
  const std::vector<Json> all = documents();
  const auto read = [&](std::uint64_t k, test::Draw& draw) {
    writeReport(test::damagedJson(all[k % all.size()], draw), folder.path());
  };
  test::readAll(500, read, 0.01, 0.01);
}

/// The real one, with all that a figure can say.
TEST(HostileFigures, AreDrawnByGnuplotAsTheyAre) {
  const TemporaryFolder folder;
  const std::string words = hostile[0];
  reports::Figure figure;
  figure.name = "figure";
  figure.keyAbove = true;
  for (int k = 0; k < 2; ++k) {
    reports::Panel& panel = figure.panels.emplace_back();
    panel.title = panel.xLabel = panel.yLabel = words;
    if (k == 1) {
      panel.name = words;
      panel.rows = {words, words};
    }
    panel.curves.push_back(
        {words, {}, reports::Draw::linesAndPoints, {{0.0, 0.0, 0.1, words}, {1.0, 1.0, {}}}});
  }
  reports::runGnuplot({reports::writeFigure(figure, folder.path())}, folder.path());
  EXPECT_TRUE(fs::exists(folder.path() / "figure.svg"));
  EXPECT_FALSE(fs::exists(folder.path() / "pwned"));
  figure.name = "x\nsystem('touch pwned')\n#";
  EXPECT_THROW(reports::writeFigure(figure, folder.path()), BadInput);
}

}  // namespace
