#include "reports/common/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "averaging/fields.hpp"

namespace crossgrain::reports {

namespace {

struct Label {
  std::string_view name, words, symbol;
};

constexpr std::array headLabels = {
    Label{"inertial_number", "inertial number", "I"},
    Label{"kn_over_p", "stiffness over pressure", "k_n/p"},
    Label{"mean_overlap_over_d", "mean overlap / d", ""},
    Label{"max_overlap_over_d", "largest overlap / d", ""},
    Label{"sliding_fraction", "sliding fraction of contacts", ""},
    Label{"stress_ratio_wheel", "stress ratio at the wheel", "σ_rφ/σ_rr"},
    Label{"wheel_contacts", "contacts of the wheel", ""},
    Label{"wheel_slip", "slip at the wheel, share of Ω", ""},
    Label{"shear_share", "shear among the disks, share of Ω", ""},
    Label{"dt_over_tc", "time step / contact time", "dt/t_c"},
    Label{"coordination", "contacts per particle", "C"},
};

/// null where there is no such field, or none that people write in another way
const FieldSpec* labelledField(std::string_view name) {
  const FieldSpec* const found = findField(name);
  return found && !found->words.empty() ? found : nullptr;
}

/// How many bytes from there on belong to an index: of ASCII letters, digits, − and Greek letters.
std::size_t indexLength(std::string_view words) {
  std::size_t length = 0;
  while (length < words.size()) {
    const auto byte = static_cast<unsigned char>(words[length]);
    if (std::isalnum(byte))
      length += 1;
    else if ((byte == 0xce || byte == 0xcf) && length + 1 < words.size())
      length += 2;
    else if (words.substr(length).starts_with("−"))
      length += 3;
    else
      break;
  }
  return length;
}

/// Whether a _ or ^ at k marks what follows it. Below the line stands what follows a symbol of one
/// letter, k_n or ΩR_i; words of several are names that people gave, spring_dashpot or b2_version.
bool isMark(std::string_view words, std::size_t k) {
  if ((words[k] != '_' && words[k] != '^') || k == 0 || words[k - 1] == ' ') return false;
  const auto before = [&](std::size_t back) {
    return k >= back ? static_cast<unsigned char>(words[k - back])
                     : static_cast<unsigned char>(' ');
  };
  const bool ofName = std::isalpha(before(1)) ? std::isalpha(before(2)) || before(2) == '_'
                                              : std::isdigit(before(1)) && std::isalpha(before(2));
  return words[k] == '^' || !ofName;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text)
    result += c == '&'    ? "&amp;"
              : c == '<'  ? "&lt;"
              : c == '>'  ? "&gt;"
              : c == '"'  ? "&quot;"
              : c == '\'' ? "&#39;"
                          : std::string(1, c);
  return result;
}

std::string mathHtml(std::string_view words) {
  std::string html;
  std::size_t from = 0;
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::size_t length = isMark(words, k) ? indexLength(words.substr(k + 1)) : 0;
    if (length == 0) continue;
    html +=
        escaped(words.substr(from, k - from)) +
        fmt::format("<{0}>{1}</{0}>", words[k] == '_' ? "sub" : "sup", words.substr(k + 1, length));
    k += length;
    from = k + 1;
  }
  return html + escaped(words.substr(from));
}

std::string spaced(std::string_view name) {
  std::string result(name);
  std::ranges::replace(result, '_', ' ');
  return result;
}

std::string mathGnuplot(std::string_view words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::size_t length = isMark(words, k) ? indexLength(words.substr(k + 1)) : 0;
    text += words[k];
    if (length == 0) continue;
    text += fmt::format("{{{}}}", words.substr(k + 1, length));
    k += length;
  }
  return text;
}

std::string fieldWords(std::string_view field) {
  const FieldSpec* spec = labelledField(field);
  return spec ? std::string(spec->words) : spaced(field);
}

std::string fieldLabel(std::string_view field) {
  const FieldSpec* spec = labelledField(field);
  return spec ? fmt::format("{} {}", spec->words, spec->symbol) : spaced(field);
}

std::string fieldPlotSymbol(std::string_view field) {
  const FieldSpec* spec = labelledField(field);
  return spec ? mathGnuplot(spec->symbol) : spaced(field);
}

std::string fieldAxis(std::string_view field) {
  const std::string unit(fieldSpec(field).unit), symbol = fieldPlotSymbol(field);
  const std::string words = fieldWords(field);
  const std::string name = symbol == words ? words : words + " " + symbol;
  if (unit == "1") return name;
  std::string raised;
  for (std::size_t k = 0; k < unit.size(); ++k) {
    const std::string_view rest = std::string_view(unit).substr(k);
    const bool square = rest.starts_with("²"), cube = rest.starts_with("³");
    raised += square ? "^{2}" : cube ? "^{3}" : std::string(1, unit[k]);
    if (square || cube) ++k;  // two bytes
  }
  return fmt::format("{} [{}]", name, raised);
}

std::string headLabel(std::string_view name) {
  const Label* const found = findBy(headLabels, name, &Label::name);
  if (!found) return spaced(name);
  const std::string words(found->words);
  return found->symbol.empty() ? words : words + " " + std::string(found->symbol);
}

std::string listed(const Names& names) {
  if (names.size() < 2) return fmt::format("{}", fmt::join(names, ""));
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

std::string allOf(std::size_t count, std::string_view noun) {
  if (count == 1) return fmt::format("the one {}", noun);
  return count == 2 ? fmt::format("both {}s", noun) : fmt::format("all {} {}s", count, noun);
}

std::string listedShortly(const Names& names, std::size_t most) {
  if (names.size() <= most) return listed(names);
  Names few(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(most));
  few.push_back(fmt::format("{} more", names.size() - most));
  return listed(few);
}

std::string capitalised(std::string text) {
  if (!text.empty())
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

std::string indicesText(const std::vector<int>& indices) {
  Names parts;
  for (std::size_t k = 0; k < indices.size();) {
    std::size_t end = k + 1;
    while (end < indices.size() && indices[end] == indices[end - 1] + 1) ++end;
    if (end - k < 3) end = k + 1;
    parts.push_back(end - k == 1 ? fmt::format("{}", indices[k])
                                 : fmt::format("{} to {}", indices[k], indices[end - 1]));
    k = end;
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

Names nonEmpty(Names texts) {
  std::erase(texts, std::string());
  return texts;
}

void SaidOf::add(const std::string& subject, const std::string& said) {
  const auto found = std::ranges::find(said_, said, [](const auto& one) { return one.first; });
  if (found == said_.end())
    said_.push_back({said, {subject}});
  else
    addOnce(found->second, subject);
}

std::string SaidOf::joined(std::string_view form) const {
  Names parts;
  for (const auto& [said, subjects] : said_)
    parts.push_back(fmt::format(fmt::runtime(form), listed(subjects), said));
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace crossgrain::reports
