#include "averaging/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "averaging/rings.hpp"

namespace crossgrain::inline averaging {

template <int D>
SpringConstants springConstants(const SceneOf<D>& scene) {
  const ContactLaw& law = scene.law;
  SpringConstants springs;
  if (law.normal != NormalLaw::linear) return springs;
  const auto common = [&](double ContactLaw::*constant) {
    const auto same = [&](const ContactLaw& own) { return own.*constant == law.*constant; };
    return law.*constant > 0.0 &&
           (!scene.materials || std::ranges::all_of(scene.materials->laws, same));
  };
  if (common(&ContactLaw::kn)) springs.kn = law.kn;
  if (law.springs() && common(&ContactLaw::kt)) springs.kt = law.kt;
  return springs;
}
template SpringConstants springConstants(const Scene&);
template SpringConstants springConstants(const SpaceScene&);

Linear BinView::sum(Moment which, int k) const {
  const MomentPlaces& places = dimension() == 2 ? momentPlaces<2> : momentPlaces<3>;
  const auto m = static_cast<std::size_t>(which);
  if (places[m] == places[m + 1]) return 0.0;
  const std::size_t index = slot_ * places.back() + places[m] + static_cast<std::size_t>(k);
  Linear moment(means_[index]);
  moment.slopes = {{index, 1.0}};
  return moment;
}

Linear BinView::slope(Linear (*field)(const BinView&)) const {
  const auto slope = bins_.slope(slot_);
  if (!slope) return std::numeric_limits<double>::quiet_NaN();
  Linear sum;
  for (const auto& [slot, factor] : slope->terms)
    sum = sum + factor * field(BinView(bins_, means_, slot, springs_));
  return sum;
}

Linear BinView::overRadius(const Linear& x) const {
  const auto slope = bins_.slope(slot_);
  return x / (slope ? slope->radius : std::numeric_limits<double>::quiet_NaN());
}

namespace {

using Bin = const BinView&;

/// Fields that take more than a line of the table: vectors and tensors of one bin [N/m², but for
/// fabric and strain: 1].
namespace formulas {

using enum Moment;
using Components = std::array<Linear, 3>;

/// Σ w Q / V of a tensor that is symmetric, or not.
template <int D>
LinearTensor perVolumeIn(Bin bin, Moment which) {
  LinearTensor tensor{D, {}};
  if (numbersOf(which, D) == D * D)
    for (std::size_t q = 0; q < tensorIn<D>.size(); ++q)
      tensor(tensorIn<D>[q][0], tensorIn<D>[q][1]) = bin.perVolume(which, static_cast<int>(q));
  else
    for (std::size_t q = 0; numbersOf(which, D) > 0 && q < symmetricIn<D>.size(); ++q) {
      const auto [row, column] = symmetricIn<D>[q];
      tensor(row, column) = tensor(column, row) = bin.perVolume(which, static_cast<int>(q));
    }
  return tensor;
}
LinearTensor perVolume(Bin bin, Moment which) {
  return bin.dimension() == 2 ? perVolumeIn<2>(bin, which) : perVolumeIn<3>(bin, which);
}

/// Σ w m Q / Σ w m and Σ w V Q / Σ w V of a vector.
Components over(Bin bin, Moment vector, Moment weight) {
  Components result;
  for (int k = 0; k < bin.dimension(); ++k)
    result[static_cast<std::size_t>(k)] = bin.sum(vector, k) / bin.sum(weight);
  return result;
}
Components velocity(Bin bin) {
  return over(bin, momentum, mass);
}
Components velocityByVolume(Bin bin) {
  return over(bin, volumeVelocity, volume);
}

Components meanSpin(Bin bin) {
  if (bin.dimension() == 3) return over(bin, spin, volume);
  return {bin.sum(spin) / bin.sum(volume), 0.0, 0.0};
}

Components wallForceDensity(Bin bin) {
  return {bin.perVolume(wallForce, 0), bin.perVolume(wallForce, 1), bin.perVolume(wallForce, 2)};
}

/// Of the moving disks alone
LinearTensor movingStress(Bin bin) {
  return perVolume(bin, Moment::stress);
}

/// With the wall disks' part
LinearTensor stressTensor(Bin bin) {
  const LinearTensor moving = movingStress(bin);
  return bin.dimension() == 2 ? moving + perVolume(bin, wallStress) : moving;
}

LinearTensor dynamicStress(Bin bin) {
  return perVolume(bin, dynamic);
}

LinearTensor fabricTensor(Bin bin) {
  return perVolume(bin, Moment::fabric);
}

/// σ_fluct = Σ w m (v − u)⊗(v − u)/V with u = Σ w m v/Σ w m the bin's mean velocity, which is the
/// dynamic stress less ρ u⊗u.
LinearTensor fluctuationStress(Bin bin) {
  const LinearTensor whole = dynamicStress(bin);
  const Linear density = bin.perVolume(mass);
  return tensorOf(bin.dimension(), [&](int row, int column) {
    const auto [low, high] = std::minmax(row, column);
    return whole(row, column) -
           bin.perVolume(momentum, low) * bin.perVolume(momentum, high) / density;
  });
}

/// The micro-mechanical stress with the terms in ω̇ and ω² (Lätzel 2003, section 7.3, derived anew:
/// README.md): sym σ + the dynamic stress.
LinearTensor fullStress(Bin bin) {
  const LinearTensor still = stressTensor(bin);
  return tensorOf(bin.dimension(),
                  [&](int row, int column) {
                    const auto [low, high] = std::minmax(row, column);
                    return row == column ? still(row, row)
                                         : 0.5 * (still(low, high) + still(high, low));
                  }) +
         dynamicStress(bin);
}

/// ε = Σ w V Σ_c (δ/a) n⊗n · (Σ w V Σ_c n⊗n)⁻¹, so that equal overlaps δ of equal bodies give
/// (δ/a) I (Lätzel 2003, Eq. 7.88 with prefactor 1).
LinearTensor strain(Bin bin) {
  return perVolume(bin, overlap) * inverse(fabricTensor(bin));
}

/// E = tr σ/tr ε, of the moving bodies
Linear bulkModulus(Bin bin) {
  return trace(movingStress(bin)) / trace(strain(bin));
}

/// G = dev σ/dev ε, of the moving bodies
Linear shearModulus(Bin bin) {
  return deviator(movingStress(bin)) / deviator(strain(bin));
}

/// k_n tr F/2πh, what E would be of disks in mean field.
Linear meanFieldModulus(Bin bin) {
  return bin.kn() / (2.0 * std::numbers::pi * bin.height()) * trace(fabricTensor(bin));
}

/// σ = ε₀ E [I + G* ε₁ R(φ) diag(1, −1) Rᵀ(φ)] (Lätzel 2003, Eqs. 7.105–7.109) with ε₀ = tr ε/2,
/// ε₁ = dev ε/tr ε, G* = G/E, φ = (φ_ε + φ_F)/2 and E = k_n tr F/2πh.
LinearTensor predictedStress(Bin bin) {
  const double pi = std::numbers::pi;
  const LinearTensor deformation = strain(bin);
  const Linear pressure = 0.5 * trace(deformation) * meanFieldModulus(bin);
  const Linear anisotropy =
      shearModulus(bin) / bulkModulus(bin) * deviator(deformation) / trace(deformation);
  // Axes are directions without a sign: of φ_ε and φ_ε ± π the one nearest to φ_F.
  const Linear ofFabric = axis(fabricTensor(bin));
  Linear ofStrain = axis(deformation);
  ofStrain.value -= pi * std::round((ofStrain.value - ofFabric.value) / pi);
  const Linear twice = ofStrain + ofFabric;
  const Linear along = pressure * anisotropy * cos(twice);
  const Linear mixed = pressure * anisotropy * sin(twice);
  return tensorOf(2, [&](int row, int column) {
    return row != column ? mixed : row == 0 ? pressure + along : pressure - along;
  });
}

/// M_zα = −Σ w Σ_c (l × f)_z l_α/V, wall disks included
Components coupleStress(Bin bin) {
  return {bin.perVolume(couple, 0) + bin.perVolume(wallCouple, 0),
          bin.perVolume(couple, 1) + bin.perVolume(wallCouple, 1), 0.0};
}

/// κ_zα = (πh/V) Σ w Σ_c (l × Δ)_z l · F⁻¹ (Lätzel 2003, section 8.2), Δ = δ n^c + ξ s with
/// ξ = −f_t/k_t: the spring that holds f_t alone.
Components curvature(Bin bin) {
  const double factor = std::numbers::pi * bin.height() / bin.kt();
  const LinearTensor perFabric = inverse(fabricTensor(bin));
  const Linear r = factor * bin.perVolume(couple, 0);
  const Linear p = factor * bin.perVolume(couple, 1);
  return {r * perFabric(0, 0) + p * perFabric(1, 0), r * perFabric(0, 1) + p * perFabric(1, 1),
          0.0};
}

Linear azimuthalVelocity(Bin bin) {
  return bin.sum(momentum, 1) / bin.sum(mass);
}

/// ½(∂v_φ/∂r + v_φ/r)
Linear rotation(Bin bin) {
  return 0.5 * (bin.slope(azimuthalVelocity) + bin.overRadius(azimuthalVelocity(bin)));
}

/// Fourier coefficients of the outward normals' density p(α) = (1 + Σ a_k cos kα + b_k sin kα)/2π:
/// twice the mean of cos kα and sin kα over contacts, weighted with the disk's volume.
std::pair<Linear, Linear> fourier(Bin b, int order) {
  const Linear all = b.sum(Moment::contacts);
  if (order == 2)
    return {2.0 * (b.sum(Moment::fabric, 0) - b.sum(Moment::fabric, 1)) / all,
            4.0 * b.sum(Moment::fabric, 2) / all};
  const int first = order == 4 ? 0 : 2;
  return {2.0 * b.sum(harmonics, first) / all, 2.0 * b.sum(harmonics, first + 1) / all};
}

template <int Order>
Linear amplitude(Bin b) {
  const auto [cosine, sine] = fourier(b, Order);
  return length(cosine, sine);
}
template <int Order>
Linear harmonicAxis(Bin b) {
  const auto [cosine, sine] = fourier(b, Order);
  return direction(cosine, sine) / static_cast<double>(Order);
}

}  // namespace formulas

using Formula = Linear (*)(Bin);

template <auto Of, int K>
Linear component(Bin b) {
  return Of(b)[K];
}
template <auto Of, int Row, int Column>
Linear entry(Bin b) {
  return Of(b)(Row, Column);
}

/// Fields of one table, whose texts it keeps.
class Table {
 public:
  Table(int dimension, bool rings)
      : dimension_(dimension),
        names_(rings ? std::array{"r", "p", "z"} : std::array{"x", "y", "z"}),
        symbols_(rings ? std::array{"r", "φ", "z"} : std::array{"x", "y", "z"}) {}

  /// @param symbol, definition  with {0} and {1} for the symbols of the directions, or of the
  ///        component's indices
  void add(std::string name, const char* words, const char* symbol, const char* unit,
           const char* definition, Needs needs, Formula formula, int first = 0, int second = 1) {
    const auto text = [&](const char* form) {
      return kept(fmt::format(fmt::runtime(form), symbols_[static_cast<std::size_t>(first)],
                              symbols_[static_cast<std::size_t>(second)]));
    };
    FieldSpec field{kept(std::move(name)), words, text(symbol), unit,
                    text(definition),      needs, formula};
    field.perVolume = growsWithContent(field, dimension_);
    fields_.push_back(field);
  }

  template <auto Of>
  void addVector(const char* name, const char* words, const char* symbol, const char* unit,
                 const char* definition, Needs needs) {
    constexpr std::array<Formula, 3> formulas = {component<Of, 0>, component<Of, 1>,
                                                 component<Of, 2>};
    for (int k = 0; k < dimension_; ++k)
      add(fmt::format(fmt::runtime(name), names_[static_cast<std::size_t>(k)]), words, symbol, unit,
          definition, needs, formulas[static_cast<std::size_t>(k)], k);
  }

  /// @param words  of the component: of the diagonal's three, then of the others
  template <auto Of>
  void addTensor(const char* name, const std::array<const char*, 4>& words, const char* symbol,
                 const char* unit, const char* definition, Needs needs, bool symmetric = true) {
    constexpr std::array<Formula, 9> formulas = {entry<Of, 0, 0>, entry<Of, 0, 1>, entry<Of, 0, 2>,
                                                 entry<Of, 1, 0>, entry<Of, 1, 1>, entry<Of, 1, 2>,
                                                 entry<Of, 2, 0>, entry<Of, 2, 1>, entry<Of, 2, 2>};
    for (const auto& [row, column] : tensorIn<3>) {
      if (std::max(row, column) >= dimension_ || (symmetric && row > column)) continue;
      const auto r = static_cast<std::size_t>(row), c = static_cast<std::size_t>(column);
      add(fmt::format("{}_{}{}", name, names_[r], names_[c]), words[row == column ? r : 3], symbol,
          unit, definition, needs, formulas[3 * r + c], row, column);
    }
  }

  const std::vector<FieldSpec>& fields() const { return fields_; }

 private:
  std::string_view kept(std::string text) { return texts_.emplace_back(std::move(text)); }

  int dimension_;
  std::array<const char*, 3> names_, symbols_;
  std::deque<std::string> texts_;
  std::vector<FieldSpec> fields_;
};

/// Velocities of rings have names of their own.
template <auto Of>
void addVelocities(Table& table, bool rings, bool plane, const char* suffix,
                   const char* definition) {
  const auto name = [&](const char* stem) { return fmt::format("{}{}", stem, suffix); };
  const auto add = [&](const char* stem, const char* words, Formula formula, int k) {
    table.add(name(stem), words, "v_{0}", "m/s", definition, Needs::kinematics, formula, k);
  };
  if (rings) {
    add("azimuthal_velocity", "azimuthal velocity", component<Of, 1>, 1);
    add("radial_velocity", "radial velocity", component<Of, 0>, 0);
  } else {
    add("velocity_x", "velocity along x", component<Of, 0>, 0);
    add("velocity_y", "velocity along y", component<Of, 1>, 1);
  }
  if (!plane) add("velocity_z", "velocity along z", component<Of, 2>, 2);
}

Table makeTable(int dimension, bool rings) {
  using enum Needs;
  using namespace formulas;
  using Words = std::array<const char*, 4>;
  const bool plane = dimension == 2;
  const Words none = {"", "", "", ""}, dynamicWords = {"dynamic stress", "dynamic stress",
                                                       "dynamic stress", "dynamic stress"};
  const Words stressWords =
      rings ? Words{"radial stress", "hoop stress", "axial stress", "shear stress"}
            : Words{"stress", "stress", "stress", "shear stress"};
  Table t(dimension, rings);
  // clang-format off
  t.add("volume_fraction", "volume fraction", "ν", "1", "Σ w V / V_bin", kinematics, [](Bin b) { return b.perVolume(volume) + b.perVolume(wallVolume); });
  addVelocities<velocity>(t, rings, plane, "", "Σ w m v_{0} / Σ w m");
  if (plane) t.add("spin", "spin", "S", "rad/s", "Σ w V ω / Σ w V", Needs::spin, component<meanSpin, 0>);
  else t.addVector<meanSpin>("spin_{}", "spin", "ω_{0}", "rad/s", "Σ w V ω_{0} / Σ w V", Needs::spin);
  t.addTensor<stressTensor>("stress", stressWords, "σ_{0}{1}", "N/m²", "−Σ w Σ_c f_{0} l_{1} / V_bin", Needs::contacts, false);
  t.addTensor<dynamicStress>("dynamic_stress", dynamicWords, "σ^dyn_{0}{1}", "N/m²", "Σ w m v_{0} v_{1} / V_bin", kinematics);
  t.add("fabric_trace", "fabric", "tr F", "1", "Σ w V C / V_bin", Needs::contacts, [](Bin b) { return trace(fabricTensor(b)); });
  t.add("fabric_deviator", "fabric", "dev F", "1", "F_max − F_min of F = Σ w V Σ_c n⊗n / V_bin", Needs::contacts, [](Bin b) { return deviator(fabricTensor(b)); });
  t.addTensor<fabricTensor>("fabric", none, "", "1", "Σ w V Σ_c n_{0} n_{1} / V_bin", Needs::contacts);
  t.add("coordination", "contacts per particle", "C", "1", "Σ w V C / Σ w V", Needs::contacts, [](Bin b) { return b.sum(Moment::contacts) / b.sum(volume); });
  t.add("density", "density", "ρ", "kg/m³", "Σ w m / V_bin", kinematics, [](Bin b) { return b.perVolume(mass); });
  if (plane) t.add("fabric_angle", "", "", "rad", "major axis of F, from {0} towards {1}", Needs::contacts, [](Bin b) { return axis(fabricTensor(b)); });
  t.add("stress_trace", "", "", "N/m²", "tr σ of contacts", Needs::contacts, [](Bin b) { return trace(stressTensor(b)); });
  t.add("stress_deviator", "", "", "N/m²", "σ_max − σ_min of sym σ", Needs::contacts, [](Bin b) { return deviator(stressTensor(b)); });
  if (plane) {
    t.add("stress_angle", "", "", "rad", "major axis of sym σ, from {0} towards {1}", Needs::contacts, [](Bin b) { return axis(stressTensor(b)); });
    t.add("stress_antisymmetric", "", "", "N/m²", "(σ_{1}{0} − σ_{0}{1})/2, −Σ w J ω̇ / 2V_bin where nothing else turns the disks", Needs::contacts, [](Bin b) { const LinearTensor s = stressTensor(b); return 0.5 * (s(1, 0) - s(0, 1)); });
  }
  t.addTensor<fluctuationStress>("fluctuation_stress", none, "", "N/m²", "Σ w m (v_{0} − u_{0})(v_{1} − u_{1}) / V_bin", kinematics);
  if (plane) t.add("rotational_stress", "", "", "N/m²", "Σ w J ω² / 2V_bin, isotropic", Needs::spin, [](Bin b) { return b.perVolume(spinEnergy); });
  t.addTensor<fullStress>("full_stress", none, "", "N/m²", "(σ_{0}{1} + σ_{1}{0})/2 + dynamic", Needs::contacts);
  t.addTensor<strain>("strain", none, "", "1", "ε_{0}{1} of ε = Σ w V Σ_c (δ/a) n⊗n · (Σ w V Σ_c n⊗n)⁻¹", Needs::contacts, false);
  t.add("strain_trace", "", "", "1", "tr ε", Needs::contacts, [](Bin b) { return trace(strain(b)); });
  t.add("strain_deviator", "", "", "1", "ε_max − ε_min of sym ε", Needs::contacts, [](Bin b) { return deviator(strain(b)); });
  if (plane) t.add("strain_angle", "", "", "rad", "major axis of sym ε, from {0} towards {1}", Needs::contacts, [](Bin b) { return axis(strain(b)); });
  t.add("bulk_modulus", "", "", "N/m²", "E = tr σ / tr ε of the moving bodies", Needs::contacts, bulkModulus);
  t.add("shear_modulus", "", "", "N/m²", "G = dev σ / dev ε of the moving bodies", Needs::contacts, shearModulus);
  t.add("modulus_ratio", "", "", "1", "G* = G / E", Needs::contacts, [](Bin b) { return shearModulus(b) / bulkModulus(b); });
  if (plane) {
    t.add("mean_field_modulus", "", "", "N/m²", "k_n tr F / 2πh", normalSpring, meanFieldModulus);
    t.add(rings ? "predicted_stress_rr" : "predicted_stress_xx", "", "", "N/m²", "ε₀E[1 + G* ε₁ cos 2φ]", normalSpring, entry<predictedStress, 0, 0>);
    t.add(rings ? "predicted_stress_pp" : "predicted_stress_yy", "", "", "N/m²", "ε₀E[1 − G* ε₁ cos 2φ]", normalSpring, entry<predictedStress, 1, 1>);
    t.add(rings ? "predicted_stress_rp" : "predicted_stress_xy", "", "", "N/m²", "ε₀E G* ε₁ sin 2φ", normalSpring, entry<predictedStress, 0, 1>);
    t.addVector<coupleStress>("couple_stress_z{}", "", "", "N/m", "−Σ w Σ_c (l × f)_z l_{0} / V_bin", Needs::contacts);
    t.addVector<curvature>("curvature_z{}", "", "", "m", "κ_z{0} of κ = (πh/V_bin) Σ w Σ_c (l × Δ)⊗l · F⁻¹", tangentialSpring);
    t.add("torque_resistance", "", "", "N/m²", "M_z{0} / κ_z{0} of the moving disks", tangentialSpring, [](Bin b) { return b.perVolume(couple, 0) / curvature(b)[0]; });
    if (rings) {
      t.add("velocity_gradient", "", "", "1/s", "∂v_φ/∂r", kinematics, [](Bin b) { return b.slope(azimuthalVelocity); });
      t.add("shear_rate", "", "", "1/s", "∂v_φ/∂r − v_φ/r", kinematics, [](Bin b) { return b.slope(azimuthalVelocity) - b.overRadius(azimuthalVelocity(b)); });
      t.add("continuum_rotation", "", "", "rad/s", "½(∂v_φ/∂r + v_φ/r)", kinematics, rotation);
      t.add("excess_rotation", "", "", "rad/s", "spin − ½(∂v_φ/∂r + v_φ/r)", Needs::spin, [](Bin b) { return meanSpin(b)[0] - rotation(b); });
    }
    t.add("contact_cos_2", "", "", "1", "2 Σ w V Σ_c cos 2α / Σ w V C", Needs::contacts, [](Bin b) { return fourier(b, 2).first; });
    t.add("contact_sin_2", "", "", "1", "2 Σ w V Σ_c sin 2α / Σ w V C", Needs::contacts, [](Bin b) { return fourier(b, 2).second; });
    t.add("contact_cos_4", "", "", "1", "2 Σ w V Σ_c cos 4α / Σ w V C", Needs::contacts, [](Bin b) { return fourier(b, 4).first; });
    t.add("contact_sin_4", "", "", "1", "2 Σ w V Σ_c sin 4α / Σ w V C", Needs::contacts, [](Bin b) { return fourier(b, 4).second; });
    t.add("contact_cos_6", "", "", "1", "2 Σ w V Σ_c cos 6α / Σ w V C", Needs::contacts, [](Bin b) { return fourier(b, 6).first; });
    t.add("contact_sin_6", "", "", "1", "2 Σ w V Σ_c sin 6α / Σ w V C", Needs::contacts, [](Bin b) { return fourier(b, 6).second; });
    t.add("contact_amplitude_2", "", "", "1", "length of (cos, sin) of order 2", Needs::contacts, amplitude<2>);
    t.add("contact_amplitude_4", "", "", "1", "length of (cos, sin) of order 4", Needs::contacts, amplitude<4>);
    t.add("contact_amplitude_6", "", "", "1", "length of (cos, sin) of order 6", Needs::contacts, amplitude<6>);
    t.add("contact_axis_4", "", "", "rad", "angle of (cos, sin) of order 4, over 4", Needs::contacts, harmonicAxis<4>);
    t.add("contact_axis_6", "", "", "rad", "angle of (cos, sin) of order 6, over 6", Needs::contacts, harmonicAxis<6>);
  }
  t.add("dissipation", "dissipation", "", "W/m³", "Σ w Σ_c P_c / V_bin, P_c the power that a contact turns into heat, to each of two bodies half", Needs::dissipation, [](Bin b) { return b.perVolume(heat); });
  t.add("granular_temperature", "granular temperature", "T", "m²/s²", "Σ w m |v − u|² / D Σ w m in D dimensions", kinematics, [](Bin b) { return trace(fluctuationStress(b)) / (b.dimension() * b.perVolume(mass)); });
  t.add("pressure", "pressure", "p", "N/m²", "tr of stress and fluctuation stress, over D", Needs::contacts, [](Bin b) { return trace(stressTensor(b) + fluctuationStress(b)) / static_cast<double>(b.dimension()); });
  t.add("coordination_without_rattlers", "contacts per particle that is held", "C*", "1", "Σ w V C / Σ w V over bodies with C > D", Needs::contacts, [](Bin b) { return b.sum(heldContacts) / b.sum(heldVolume); });
  addVelocities<velocityByVolume>(t, rings, plane, "_by_volume", "Σ w V v_{0} / Σ w V");
  if (!plane) {
    t.add("contact_density", "", "", "1/m³", "Σ_c w / V_bin", Needs::contacts, [](Bin b) { return b.perVolume(branches); });
    t.addVector<wallForceDensity>("wall_force_density_{}", "", "", "N/m³", "Σ_c w f_{0} / V_bin over contacts with walls, f on the sphere", Needs::contacts);
  }
  // clang-format on
  return t;
}

bool measuresFilling(const FieldSpec& field) {
  return field.name == "volume_fraction" || field.name == "density";
}

}  // namespace

bool growsWithContent(const FieldSpec& field, int dimension) {
  const Rings rings(1.0, 4.0, 3, 1.0, 1.0);
  const Cells cells(Vec3::Zero(), Vec3::Ones(), {2, 1, 1}, {});
  const auto valueAt = [&](double scale) {
    const auto filled = [&](auto moments) {
      for (std::size_t slot = 0; slot < moments.size(); ++slot)
        for (std::size_t q = 0; q < moments[slot].size(); ++q)
          moments[slot][q] =
              scale *
              (1.0 + std::fmod(static_cast<double>(slot * moments[slot].size() + q) * 0.618, 1.0));
      return moments;
    };
    if (dimension == 3) {
      const auto moments = filled(std::vector<SpaceMoments>(cells.slots()));
      return field.formula(BinView(cells, moments, 1)).value;
    }
    const auto moments = filled(std::vector<Moments>(rings.slots()));
    return field.formula(BinView(rings, moments, rings.slot(1), {1.0, 1.0})).value;
  };
  const double once = valueAt(1.0);
  return std::abs(valueAt(2.0) - 2.0 * once) < 1e-9 * std::abs(once);
}

std::span<const FieldSpec> fieldsIn(int dimension, bool rings) {
  static const Table tables[] = {makeTable(2, false), makeTable(2, true), makeTable(3, false),
                                 makeTable(3, true)};
  return tables[2 * (dimension - 2) + (rings ? 1 : 0)].fields();
}

std::span<const FieldSpec> fieldsOf(const BinSet& bins) {
  return fieldsIn(bins.dimension(), !bins.isCartesian());
}

const FieldSpec* findField(std::string_view name) {
  for (const int dimension : {2, 3})
    for (const bool rings : {true, false}) {
      const auto table = fieldsIn(dimension, rings);
      if (const auto found = std::ranges::find(table, name, &FieldSpec::name); found != table.end())
        return &*found;
    }
  return nullptr;
}

const FieldSpec& fieldSpec(std::string_view name) {
  if (const FieldSpec* const found = findField(name)) return *found;
  throw std::invalid_argument(fmt::format("averaging: there is no field \"{}\"", name));
}

std::optional<Linear> evaluate(const FieldSpec& field, const BinView& bin) {
  // In space branches lie where no centre need be, and stress is there all the same.
  const bool besideDisks = bin.dimension() == 3 && field.perVolume;
  if (bin.isEmpty() && !measuresFilling(field) && !besideDisks) return std::nullopt;
  Linear result = field.formula(bin);
  if (!std::isfinite(result.value)) return std::nullopt;
  return result;
}

template <int D>
bool available(const FieldSpec& field, const SnapshotOf<D>& snapshot,
               const SpringConstants& springs) {
  switch (field.needs) {
    case Needs::kinematics:
      return true;
    case Needs::spin:
      return snapshot.spin.has_value();
    case Needs::contacts:
      return snapshot.contacts.has_value();
    case Needs::normalSpring:
      return snapshot.contacts && springs.kn;
    case Needs::tangentialSpring:
      return snapshot.contacts && springs.kt;
    case Needs::dissipation:
      return snapshot.contacts &&
             snapshot.contacts->dissipation.size() == snapshot.contacts->size();
  }
  throw std::invalid_argument("averaging: not a need");
}
template bool available(const FieldSpec&, const Snapshot&, const SpringConstants&);
template bool available(const FieldSpec&, const SpaceSnapshot&, const SpringConstants&);

}  // namespace crossgrain::inline averaging
