#include "tests/worker/hostile_messages.hpp"

#include <array>
#include <cctype>
#include <string_view>

#include "adapters/worker/json.hpp"
#include "adapters/worker/serve.hpp"
#include "tests/worker/toy_engine.hpp"

namespace crossgrain::test {
namespace {

using nlohmann::json;

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  /// 0 … count − 1; plain modulo, because the standard's distributions are not the same everywhere
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

 private:
  std::mt19937_64 random_;
};

/// What takes the place of a value.
constexpr std::array<std::string_view, 26> values = {
    "null",       "true",    "-1",         "0",        "1e308",
    "1e999",      "-1e999",  "5e-324",     "2.5",      "9223372036854775807",
    "1e18",       "NaN",     "\"\"",       "[]",       "{}",
    "\"x\"",      "[[]]",    "1000000000", "-0.0",     "18446744073709551615",
    "[1,2,3]",    "\"f64\"", "{\"a\":1}",  "Infinity", "4611686018427387904",
    "\"\\ud800\""};

constexpr std::array<std::string_view, 14> pieces = {"{",
                                                     "}",
                                                     "[",
                                                     "]",
                                                     "\"",
                                                     ",",
                                                     ":",
                                                     "\\",
                                                     "\xff",
                                                     "\xc3",
                                                     "\"ok\":true,",
                                                     "\"ok\":false,",
                                                     "\"time\":1,",
                                                     "\"contacts.i\""};

bool startsValue(const std::string& text, std::size_t at) {
  return at > 0 && (text[at - 1] == ':' || text[at - 1] == ',' || text[at - 1] == '[');
}

/// A number, word or text in the line becomes another value.
void replaceValue(std::string& line, Dice& dice) {
  std::size_t at = dice.below(line.size());
  while (at < line.size() && !startsValue(line, at)) ++at;
  if (at >= line.size()) return;
  std::size_t end = line[at] == '"' ? line.find('"', at + 1) : line.find_first_of(",}]", at);
  end = end == std::string::npos ? line.size() : end + (line[at] == '"' ? 1 : 0);
  line.replace(at, end - at, values[dice.below(values.size())]);
}

void changeLine(std::string& line, const std::vector<Message>& answers, Dice& dice) {
  const std::size_t at = dice.below(line.size() + 1), length = dice.below(40);
  switch (dice.below(20)) {
    case 0:
      if (at < line.size()) line[at] = static_cast<char>(dice.below(256));
      return;
    case 1:
      line.erase(at, length);
      return;
    case 2:
      line.insert(at, line.substr(dice.below(line.size() + 1), length));
      return;
    case 3:
      line.insert(at, pieces[dice.below(pieces.size())]);
      return;
    case 4:
      line.resize(at);
      return;
    case 5:  // nested
      line.insert(at, std::string(dice.below(3000), dice.below(2) ? '[' : '{'));
      return;
    case 6: {  // of another answer
      const std::string& other = answers[dice.below(answers.size())].line;
      line.insert(at, other.substr(dice.below(other.size()), dice.below(200)));
      return;
    }
    default:
      replaceValue(line, dice);
  }
}

void changeFile(std::string& file, Dice& dice) {
  const std::size_t at = dice.below(file.size() + 1);
  switch (dice.below(4)) {
    case 0:
      file.resize(at);
      return;
    case 1:
      if (at < file.size()) file[at] = static_cast<char>(dice.below(256));
      return;
    case 2:
      for (std::size_t k = at; k < file.size() && k < at + 8; ++k) file[k] = '\xff';  // a NaN
      return;
    default:
      file.insert(at, dice.below(100), '\0');
  }
}

}  // namespace

std::vector<Message> trueAnswers() {
  ToyEngine engine("");
  const json effective = jsonOf(engine.load(toyScene(), {}));
  engine.advance(0.1);
  ArrayWriter arrays;
  json snapshot = {{"ok", true},
                   {"snapshot", toJson(engine.snapshot(ContactReport::instant), arrays)}};
  snapshot["arrays"] = arrays.list();
  const json hello = {
      {"ok", true}, {"protocol", protocolVersion}, {"capabilities", jsonOf(engine.capabilities())}};
  return {{"hello", hello.dump(), {}},
          {"load", json{{"ok", true}, {"realised", effective}}.dump(), {}},
          {"advance", R"({"ok":true,"time":0.1})", {}},
          {"snapshot",
           snapshot.dump(),
           {reinterpret_cast<const char*>(arrays.bytes().data()), arrays.bytes().size()}},
          {"stats", json{{"ok", true}, {"stats", toJson(engine.stats())}}.dump(), {}},
          {"load", R"({"ok":false,"kind":"unsupported","what":"has no µ"})", {}}};
}

Message hostileMessage(const std::vector<Message>& answers, std::uint64_t k) {
  Dice dice(k);
  Message message = answers[dice.below(answers.size())];
  for (std::size_t wrong = 1 + dice.below(2) * dice.below(6); wrong > 0; --wrong)
    if (message.file.empty() || dice.below(3) > 0)
      changeLine(message.line, answers, dice);
    else
      changeFile(message.file, dice);
  return message;
}

}  // namespace crossgrain::test
