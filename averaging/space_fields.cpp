#include <fmt/format.h>

#include <array>
#include <deque>
#include <string>
#include <utility>

#include "averaging/fields.hpp"

namespace crossgrain::inline averaging {

namespace {

namespace space {

using Bin = const BinView&;
using Formula = Linear (*)(Bin);
using enum SpaceMoment;

/// Of a vector's or tensor's components, Σ w Q / V each.
template <SpaceMoment First, int... K>
constexpr auto perVolumes(std::integer_sequence<int, K...>) {
  return std::array<Formula, sizeof...(K)>{[](Bin b) { return b.perVolume(First + K); }...};
}
template <SpaceMoment First, int Count>
constexpr auto perVolumes() {
  return perVolumes<First>(std::make_integer_sequence<int, Count>());
}

/// Of a vector's components, Σ w m Q / Σ w m each.
template <SpaceMoment First>
constexpr std::array<Formula, 3> perMass() {
  return {[](Bin b) { return b[First] / b[mass]; }, [](Bin b) { return b[First + 1] / b[mass]; },
          [](Bin b) { return b[First + 2] / b[mass]; }};
}

/// Σ w m (v_α − u_α)(v_β − u_β), u = Σ w m v/Σ w m the bin's mean velocity [N m]
template <int Q>
Linear fluctuation(Bin b) {
  constexpr auto pair = symmetricComponents[Q];
  return b[dynamic + Q] - b[momentum + pair[0]] * b[momentum + pair[1]] / b[mass];
}

template <int... Q>
constexpr auto fluctuations(std::integer_sequence<int, Q...>) {
  return std::array<Formula, sizeof...(Q)>{[](Bin b) { return fluctuation<Q>(b) / b.volume(); }...};
}

Linear fluctuationTrace(Bin b) {
  return fluctuation<0>(b) + fluctuation<1>(b) + fluctuation<2>(b);
}

Linear trace(Bin b, SpaceMoment first, int step) {
  return b.perVolume(first) + b.perVolume(first + step) + b.perVolume(first + 2 * step);
}

/// The three directions, in names and in symbols.
struct Directions {
  std::array<const char*, 3> name, symbol;
};
constexpr Directions cartesian = {{"x", "y", "z"}, {"x", "y", "z"}};
constexpr Directions ofRings = {{"r", "p", "z"}, {"r", "φ", "z"}};

/// Fields of one table, whose texts it keeps.
class Table {
 public:
  explicit Table(const Directions& directions) : directions_(directions) {}

  void add(std::string name, const char* words, std::string symbol, const char* unit,
           std::string definition, Needs needs, Formula formula) {
    FieldSpec field{kept(std::move(name)),
                    words,
                    kept(std::move(symbol)),
                    unit,
                    kept(std::move(definition)),
                    needs,
                    formula};
    field.perVolume = growsWithContent(field, 3);
    fields_.push_back(field);
  }

  /// @param definition  with {} for the component's index
  void addVector(const char* name, const char* words, const char* symbol, const char* unit,
                 const char* definition, Needs needs, const std::array<Formula, 3>& formulas) {
    for (std::size_t k = 0; k < 3; ++k)
      add(fmt::format("{}_{}", name, directions_.name[k]), words,
          fmt::format("{}_{}", symbol, directions_.symbol[k]), unit,
          fmt::format(fmt::runtime(definition), directions_.symbol[k]), needs, formulas[k]);
  }

  /// @param definition  with {0} and {1} for the component's indices
  template <std::size_t Count>
  void addTensor(const char* name, const char* words, const char* symbol, const char* unit,
                 const char* definition, Needs needs,
                 const std::array<std::array<int, 2>, Count>& components,
                 const std::array<Formula, Count>& formulas) {
    for (std::size_t q = 0; q < Count; ++q) {
      const auto first = static_cast<std::size_t>(components[q][0]);
      const auto second = static_cast<std::size_t>(components[q][1]);
      add(fmt::format("{}_{}{}", name, directions_.name[first], directions_.name[second]), words,
          fmt::format("{}_{}{}", symbol, directions_.symbol[first], directions_.symbol[second]),
          unit,
          fmt::format(fmt::runtime(definition), directions_.symbol[first],
                      directions_.symbol[second]),
          needs, formulas[q]);
    }
  }

  const std::vector<FieldSpec>& fields() const { return fields_; }

 private:
  std::string_view kept(std::string text) { return texts_.emplace_back(std::move(text)); }

  const Directions& directions_;
  std::deque<std::string> texts_;
  std::vector<FieldSpec> fields_;
};

constexpr std::array<std::array<int, 2>, 9> allComponents = {
    {{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, 2}, {2, 0}, {2, 1}, {2, 2}}};

Table makeTable(bool rings) {
  const auto kinematics = Needs::kinematics, contacts = Needs::contacts;
  constexpr auto six = std::make_integer_sequence<int, 6>();
  Table table(rings ? ofRings : cartesian);
  // clang-format off
  table.add("volume_fraction", "volume fraction", "ν", "1", "Σ w V / V_bin", kinematics, [](Bin b) { return b.perVolume(volume); });
  if (rings) {
    const auto velocity = perMass<momentum>();
    table.add("azimuthal_velocity", "azimuthal velocity", "v_φ", "m/s", "Σ w m v_φ / Σ w m", kinematics, velocity[1]);
    table.add("radial_velocity", "radial velocity", "v_r", "m/s", "Σ w m v_r / Σ w m", kinematics, velocity[0]);
    table.add("velocity_z", "velocity", "v_z", "m/s", "Σ w m v_z / Σ w m", kinematics, velocity[2]);
  } else {
    table.addVector("velocity", "velocity", "v", "m/s", "Σ w m v_{} / Σ w m", kinematics, perMass<momentum>());
  }
  table.addVector("spin", "spin", "ω", "rad/s", "Σ w m ω_{} / Σ w m", Needs::spin, perMass<SpaceMoment::spin>());
  table.addTensor("stress", "stress", "σ", "N/m²", "Σ_c w f_{0} l_{1} / V_bin", contacts, allComponents, perVolumes<stress, 9>());
  table.add("stress_trace", "", "", "N/m²", "tr σ of contacts", contacts, [](Bin b) { return trace(b, stress, 4); });
  table.addTensor("dynamic_stress", "dynamic stress", "σ^dyn", "N/m²", "Σ w m v_{0} v_{1} / V_bin", kinematics, symmetricComponents, perVolumes<dynamic, 6>());
  table.addTensor("fluctuation_stress", "", "", "N/m²", "Σ w m (v_{0} − u_{0})(v_{1} − u_{1}) / V_bin", kinematics, symmetricComponents, fluctuations(six));
  table.add("granular_temperature", "granular temperature", "T", "m²/s²", "Σ w m |v − u|² / 3 Σ w m", kinematics, [](Bin b) { return fluctuationTrace(b) / (3.0 * b[mass]); });
  table.add("pressure", "pressure", "p", "N/m²", "⅓ tr of stress and fluctuation stress", contacts, [](Bin b) { return (trace(b, stress, 4) + fluctuationTrace(b) / b.volume()) / 3.0; });
  table.add("fabric_trace", "fabric", "tr F", "1", "Σ w V C / V_bin", contacts, [](Bin b) { return trace(b, fabric, 1); });
  table.addTensor("fabric", "", "", "1", "Σ w V Σ_c n_{0} n_{1} / V_bin", contacts, symmetricComponents, perVolumes<fabric, 6>());
  table.add("coordination", "contacts per sphere", "C", "1", "Σ w V C / Σ w V", contacts, [](Bin b) { return b[SpaceMoment::contacts] / b[volume]; });
  table.add("coordination_without_rattlers", "contacts per sphere that is held", "C*", "1", "Σ w V C / Σ w V over spheres with C ≥ 4", contacts, [](Bin b) { return b[heldContacts] / b[heldVolume]; });
  table.add("contact_density", "", "", "1/m³", "Σ_c w / V_bin", contacts, [](Bin b) { return b.perVolume(branches); });
  table.add("density", "density", "ρ", "kg/m³", "Σ w m / V_bin", kinematics, [](Bin b) { return b.perVolume(mass); });
  table.addVector("wall_force_density", "", "", "N/m³", "Σ_c w f_{} / V_bin over contacts with walls, f on the sphere", contacts, perVolumes<wallForce, 3>());
  table.add("dissipation", "dissipation", "", "W/m³", "Σ w Σ_c P_c / V_bin, P_c the power that a contact turns into heat, to each of two spheres half", Needs::dissipation, [](Bin b) { return b.perVolume(heat); });
  // clang-format on
  return table;
}

}  // namespace space

}  // namespace

std::span<const FieldSpec> spaceFieldTable(bool rings) {
  static const space::Table ofCells = space::makeTable(false), aboutAxis = space::makeTable(true);
  return (rings ? aboutAxis : ofCells).fields();
}

}  // namespace crossgrain::inline averaging
