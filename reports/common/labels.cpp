#include "reports/common/labels.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <kainjow/mustache.hpp>

namespace crossgrain::reports {

namespace {

struct Label {
  std::string_view name, words, symbol;
};

constexpr std::array fieldLabels = {
    Label{"volume_fraction", "volume fraction", "ν"},
    Label{"azimuthal_velocity", "azimuthal velocity", "v<sub>φ</sub>"},
    Label{"radial_velocity", "radial velocity", "v<sub>r</sub>"},
    Label{"spin", "spin", "S"},
    Label{"stress_rr", "radial stress", "σ<sub>rr</sub>"},
    Label{"stress_pp", "hoop stress", "σ<sub>φφ</sub>"},
    Label{"stress_rp", "shear stress", "σ<sub>rφ</sub>"},
    Label{"stress_pr", "shear stress", "σ<sub>φr</sub>"},
    Label{"dynamic_stress_rr", "dynamic stress", "σ<sup>dyn</sup><sub>rr</sub>"},
    Label{"dynamic_stress_pp", "dynamic stress", "σ<sup>dyn</sup><sub>φφ</sub>"},
    Label{"dynamic_stress_rp", "dynamic stress", "σ<sup>dyn</sup><sub>rφ</sub>"},
    Label{"fabric_trace", "fabric", "tr F"},
    Label{"fabric_deviator", "fabric", "dev F"},
    Label{"coordination", "contacts per disk", "C"},
    Label{"density", "density", "ρ"},
};

constexpr std::array headLabels = {
    Label{"inertial_number", "inertial number", "I"},
    Label{"kn_over_p", "stiffness over pressure", "k<sub>n</sub>/p"},
    Label{"mean_overlap_over_d", "mean overlap / d", ""},
    Label{"max_overlap_over_d", "largest overlap / d", ""},
    Label{"sliding_fraction", "sliding fraction of contacts", ""},
    Label{"stress_ratio_wheel", "stress ratio at the wheel", "σ<sub>rφ</sub>/σ<sub>rr</sub>"},
    Label{"wheel_contacts", "contacts of the wheel", ""},
    Label{"wheel_slip", "slip at the wheel, share of Ω", ""},
    Label{"shear_share", "shear among the disks, share of Ω", ""},
    Label{"dt_over_tc", "time step / contact time", "dt/t<sub>c</sub>"},
    Label{"coordination", "contacts per disk", "C"},
};

std::string escaped(std::string_view name) {
  return kainjow::mustache::html_escape(spaced(name));
}

template <class Table>
const Label* find(const Table& table, std::string_view name) {
  const auto found = std::ranges::find(table, name, &Label::name);
  return found == table.end() ? nullptr : &*found;
}

template <class Table>
std::string wordsAndSymbol(const Table& table, std::string_view name) {
  const Label* label = find(table, name);
  if (!label) return escaped(name);
  std::string result(label->words);
  return label->symbol.empty() ? result : result + " " + std::string(label->symbol);
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

}  // namespace

std::string mathHtml(std::string_view words) {
  const std::string plain = kainjow::mustache::html_escape(std::string(words));
  std::string html;
  for (std::size_t k = 0; k < plain.size(); ++k) {
    const bool mark = (plain[k] == '_' || plain[k] == '^') && k > 0 && plain[k - 1] != ' ';
    const std::size_t length = mark ? indexLength(std::string_view(plain).substr(k + 1)) : 0;
    if (length == 0) {
      html += plain[k];
      continue;
    }
    const char* tag = plain[k] == '_' ? "sub" : "sup";
    html += std::string("<") + tag + ">" + plain.substr(k + 1, length) + "</" + tag + ">";
    k += length;
  }
  return html;
}

std::string spaced(std::string_view name) {
  std::string result(name);
  std::ranges::replace(result, '_', ' ');
  return result;
}

std::string fieldLabel(std::string_view field) {
  return wordsAndSymbol(fieldLabels, field);
}

std::string fieldSymbol(std::string_view field) {
  const Label* label = find(fieldLabels, field);
  return label ? std::string(label->symbol) : escaped(field);
}

std::string headLabel(std::string_view name) {
  return wordsAndSymbol(headLabels, name);
}

}  // namespace crossgrain::reports
