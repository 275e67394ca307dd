#include <algorithm>
#include <array>
#include <deque>
#include <string>

#include "averaging/fields.hpp"

namespace crossgrain::inline averaging {

namespace {

struct Replacement {
  std::string_view from, to;
};

/// In names, which end in directions.
constexpr std::array endings = {Replacement{"_rr", "_xx"}, Replacement{"_pp", "_yy"},
                                Replacement{"_rp", "_xy"}, Replacement{"_pr", "_yx"},
                                Replacement{"_zr", "_zx"}, Replacement{"_zp", "_zy"}};

/// In symbols, words and definitions; longer ones first, as each leaves less of the text.
constexpr std::array inText = {Replacement{"V_ring", "V_bin"},
                               Replacement{"from r towards φ", "from x towards y"},
                               Replacement{"azimuthal velocity", "velocity along y"},
                               Replacement{"radial velocity", "velocity along x"},
                               Replacement{"radial stress", "stress"},
                               Replacement{"hoop stress", "stress"},
                               Replacement{"_rφ", "_xy"},
                               Replacement{"_φr", "_yx"},
                               Replacement{"_rr", "_xx"},
                               Replacement{"_φφ", "_yy"},
                               Replacement{"_zr", "_zx"},
                               Replacement{"_zφ", "_zy"},
                               Replacement{"_r", "_x"},
                               Replacement{"_φ", "_y"}};

/// ∂/∂r and v/r have no like in the plane (grid.hpp).
constexpr std::array<std::string_view, 4> ofRings = {"velocity_gradient", "shear_rate",
                                                     "continuum_rotation", "excess_rotation"};

std::string cartesianText(std::string_view text) {
  std::string result(text);
  for (const auto& [from, to] : inText)
    for (auto at = result.find(from); at != std::string::npos;
         at = result.find(from, at + to.size()))
      result.replace(at, from.size(), to);
  return result;
}

std::string cartesianName(std::string_view name) {
  if (name == "azimuthal_velocity") return "velocity_y";
  if (name == "radial_velocity") return "velocity_x";
  for (const auto& [from, to] : endings)
    if (name.ends_with(from))
      return std::string(name.substr(0, name.size() - from.size())) + std::string(to);
  return std::string(name);
}

std::vector<FieldSpec> makeCartesianTable() {
  static std::deque<std::string> texts;  // that the table's views are of
  const auto kept = [](std::string text) -> std::string_view {
    return texts.emplace_back(std::move(text));
  };
  std::vector<FieldSpec> table;
  for (FieldSpec field : fieldTable()) {
    if (std::ranges::find(ofRings, field.name) != ofRings.end()) continue;
    field.name = kept(cartesianName(field.name));
    field.words = kept(cartesianText(field.words));
    field.symbol = kept(cartesianText(field.symbol));
    field.definition = kept(cartesianText(field.definition));
    table.push_back(field);
  }
  return table;
}

}  // namespace

std::span<const FieldSpec> cartesianFieldTable() {
  static const std::vector<FieldSpec> table = makeCartesianTable();
  return table;
}

}  // namespace crossgrain::inline averaging
