#include "averaging/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "averaging/rings.hpp"

namespace crossgrain::inline averaging {

template <int D>
SpringConstants springConstants(const SceneOf<D>& scene) {
  const ContactLaw& law = scene.law;
  SpringConstants springs;
  if (law.normal != NormalLaw::linear) return springs;
  const bool spring =
      law.tangential == TangentialLaw::spring || law.tangential == TangentialLaw::springDashpot;
  const auto common = [&](double ContactLaw::*constant) {
    const auto same = [&](const ContactLaw& own) { return own.*constant == law.*constant; };
    return law.*constant > 0.0 &&
           (!scene.materials || std::ranges::all_of(scene.materials->laws, same));
  };
  if (common(&ContactLaw::kn)) springs.kn = law.kn;
  if (spring && common(&ContactLaw::kt)) springs.kt = law.kt;
  return springs;
}
template SpringConstants springConstants(const Scene&);
template SpringConstants springConstants(const SpaceScene&);

Linear BinView::moment(std::size_t which) const {
  const std::size_t index = slot_ * perSlot_ + which;
  Linear moment(means_[index]);
  moment.slopes = {{index, 1.0}};
  return moment;
}

Linear BinView::slope(Linear (*field)(const BinView&)) const {
  const auto slope = bins_.slope(slot_);
  if (!slope) return std::numeric_limits<double>::quiet_NaN();
  Linear sum;
  for (const auto& [slot, factor] : slope->terms)
    sum = sum + factor * field(BinView(bins_, means_, perSlot_, slot, springs_));
  return sum;
}

Linear BinView::overRadius(const Linear& x) const {
  const auto slope = bins_.slope(slot_);
  return x / (slope ? slope->radius : std::numeric_limits<double>::quiet_NaN());
}

namespace {

using Bin = const BinView&;

/// Those of the thesis that take more than a line of the table: tensors of one bin [N/m², but for
/// fabric: 1].
namespace formulas {

using enum Moment;

/// Of the moving disks alone
LinearTensor movingStress(Bin bin) {
  return {bin.perVolume(stressRR), bin.perVolume(stressRP), bin.perVolume(stressPR),
          bin.perVolume(stressPP)};
}

/// With the wall disks' part
LinearTensor stress(Bin bin) {
  const LinearTensor moving = movingStress(bin);
  return {moving.rr + bin.perVolume(wallStressRR), moving.rp + bin.perVolume(wallStressRP),
          moving.pr + bin.perVolume(wallStressPR), moving.pp + bin.perVolume(wallStressPP)};
}

LinearTensor dynamicStress(Bin bin) {
  const Linear mixed = bin.perVolume(dynamicRP);
  return {bin.perVolume(dynamicRR), mixed, mixed, bin.perVolume(dynamicPP)};
}

LinearTensor fabric(Bin bin) {
  const Linear mixed = bin.perVolume(fabricRP);
  return {bin.perVolume(fabricRR), mixed, mixed, bin.perVolume(fabricPP)};
}

/// σ_fluct = Σ w m (v − u)⊗(v − u)/V with u = Σ w m v/Σ w m the bin's mean velocity, which is the
/// dynamic stress less ρ u⊗u.
LinearTensor fluctuationStress(Bin bin) {
  const LinearTensor whole = dynamicStress(bin);
  const Linear density = bin.perVolume(mass);
  const Linear r = bin.perVolume(momentumR);
  const Linear p = bin.perVolume(momentumP);
  const Linear mixed = whole.rp - r * p / density;
  return {whole.rr - r * r / density, mixed, mixed, whole.pp - p * p / density};
}

/// The micro-mechanical stress with the terms in ω̇ and ω² (Lätzel 2003, section 7.3, derived anew:
/// README.md): sym σ + the dynamic stress.
LinearTensor fullStress(Bin bin) {
  const LinearTensor still = stress(bin);
  const LinearTensor moved = dynamicStress(bin);
  const Linear mixed = 0.5 * (still.rp + still.pr) + moved.rp;
  return {still.rr + moved.rr, mixed, mixed, still.pp + moved.pp};
}

/// ε = (πh/V) Σ w Σ_c Δ⊗l · F⁻¹, Δ = δ n^c (Lätzel 2003, Eq. 7.88 with prefactor 1, such that equal
/// overlaps δ of equal disks give (δ/a) I).
LinearTensor strain(Bin bin) {
  const double factor = std::numbers::pi * bin.height();
  const Linear mixed = factor * bin.perVolume(overlapRP);
  const LinearTensor overlaps = {factor * bin.perVolume(overlapRR), mixed, mixed,
                                 factor * bin.perVolume(overlapPP)};
  return overlaps * inverse(fabric(bin));
}

/// E = tr σ/tr ε, of the moving disks
Linear bulkModulus(Bin bin) {
  return trace(movingStress(bin)) / trace(strain(bin));
}

/// G = dev σ/dev ε, of the moving disks
Linear shearModulus(Bin bin) {
  return deviator(movingStress(bin)) / deviator(strain(bin));
}

/// k_n tr F/2πh, what E would be in mean field.
Linear meanFieldModulus(Bin bin) {
  return bin.kn() / (2.0 * std::numbers::pi * bin.height()) * trace(fabric(bin));
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
  const Linear ofFabric = axis(fabric(bin));
  Linear ofStrain = axis(deformation);
  ofStrain.value -= pi * std::round((ofStrain.value - ofFabric.value) / pi);
  const Linear twice = ofStrain + ofFabric;
  const Linear along = pressure * anisotropy * cos(twice);
  const Linear mixed = pressure * anisotropy * sin(twice);
  return {pressure + along, mixed, mixed, pressure - along};
}

/// (κ_zr, κ_zφ) = (πh/V) Σ w Σ_c (l × Δ)_z l · F⁻¹ (Lätzel 2003, section 8.2), Δ = δ n^c + ξ s with
/// ξ = −f_t/k_t: the spring that holds f_t alone.
std::pair<Linear, Linear> curvature(Bin bin) {
  const double factor = std::numbers::pi * bin.height() / bin.kt();
  const LinearTensor perFabric = inverse(fabric(bin));
  const Linear r = factor * bin.perVolume(coupleR);
  const Linear p = factor * bin.perVolume(coupleP);
  return {r * perFabric.rr + p * perFabric.pr, r * perFabric.rp + p * perFabric.pp};
}

Linear azimuthalVelocity(Bin bin) {
  return bin[velocityP] / bin[volume];
}

}  // namespace formulas

/// Fourier coefficient k of the outward normals' density p(α) = (1 + Σ a_k cos kα + b_k sin kα)/2π:
/// twice the mean of cos kα or sin kα over contacts, weighted with the disk's volume.
Linear cos2(Bin b) {
  return 2.0 * (b[Moment::fabricRR] - b[Moment::fabricPP]) / b[Moment::contacts];
}
Linear sin2(Bin b) {
  return 4.0 * b[Moment::fabricRP] / b[Moment::contacts];
}

Linear twiceMean(Bin b, Moment harmonic) {
  return 2.0 * b[harmonic] / b[Moment::contacts];
}

std::vector<FieldSpec> makeTable() {
  using enum Moment;
  using namespace formulas;
  const auto kinematics = Needs::kinematics;
  const auto normalSpring = Needs::normalSpring;
  const auto tangentialSpring = Needs::tangentialSpring;
  return {
      // clang-format off
      {"volume_fraction", "volume fraction", "ν", "1", "Σ w V / V_ring", kinematics, [](Bin b) { return b.perVolume(volume) + b.perVolume(wallVolume); }},
      {"azimuthal_velocity", "azimuthal velocity", "v_φ", "m/s", "Σ w V v_φ / Σ w V", kinematics, azimuthalVelocity},
      {"radial_velocity", "radial velocity", "v_r", "m/s", "Σ w V v_r / Σ w V", kinematics, [](Bin b) { return b[velocityR] / b[volume]; }},
      {"spin", "spin", "S", "rad/s", "Σ w V ω / Σ w V", Needs::spin, [](Bin b) { return b[Moment::spin] / b[volume]; }},
      {"stress_rr", "radial stress", "σ_rr", "N/m²", "−Σ w Σ_c f_r l_r / V_ring", Needs::contacts, [](Bin b) { return stress(b).rr; }},
      {"stress_pp", "hoop stress", "σ_φφ", "N/m²", "−Σ w Σ_c f_φ l_φ / V_ring", Needs::contacts, [](Bin b) { return stress(b).pp; }},
      {"stress_rp", "shear stress", "σ_rφ", "N/m²", "−Σ w Σ_c f_r l_φ / V_ring", Needs::contacts, [](Bin b) { return stress(b).rp; }},
      {"stress_pr", "shear stress", "σ_φr", "N/m²", "−Σ w Σ_c f_φ l_r / V_ring", Needs::contacts, [](Bin b) { return stress(b).pr; }},
      {"dynamic_stress_rr", "dynamic stress", "σ^dyn_rr", "N/m²", "Σ w m v_r v_r / V_ring", kinematics, [](Bin b) { return dynamicStress(b).rr; }},
      {"dynamic_stress_pp", "dynamic stress", "σ^dyn_φφ", "N/m²", "Σ w m v_φ v_φ / V_ring", kinematics, [](Bin b) { return dynamicStress(b).pp; }},
      {"dynamic_stress_rp", "dynamic stress", "σ^dyn_rφ", "N/m²", "Σ w m v_r v_φ / V_ring", kinematics, [](Bin b) { return dynamicStress(b).rp; }},
      {"fabric_trace", "fabric", "tr F", "1", "Σ w V C / V_ring", Needs::contacts, [](Bin b) { return trace(fabric(b)); }},
      {"fabric_deviator", "fabric", "dev F", "1", "F_max − F_min of F = Σ w V Σ_c n⊗n / V_ring", Needs::contacts, [](Bin b) { return deviator(fabric(b)); }},
      {"fabric_rr", "", "", "1", "Σ w V Σ_c n_r n_r / V_ring", Needs::contacts, [](Bin b) { return fabric(b).rr; }},
      {"fabric_pp", "", "", "1", "Σ w V Σ_c n_φ n_φ / V_ring", Needs::contacts, [](Bin b) { return fabric(b).pp; }},
      {"fabric_rp", "", "", "1", "Σ w V Σ_c n_r n_φ / V_ring", Needs::contacts, [](Bin b) { return fabric(b).rp; }},
      {"coordination", "contacts per disk", "C", "1", "Σ w V C / Σ w V", Needs::contacts, [](Bin b) { return b[Moment::contacts] / b[volume]; }},
      {"density", "density", "ρ", "kg/m³", "Σ w m / V_ring", kinematics, [](Bin b) { return b.perVolume(mass); }},
      {"fabric_angle", "", "", "rad", "major axis of F, from r towards φ", Needs::contacts, [](Bin b) { return axis(fabric(b)); }},
      {"stress_trace", "", "", "N/m²", "σ_rr + σ_φφ", Needs::contacts, [](Bin b) { return trace(stress(b)); }},
      {"stress_deviator", "", "", "N/m²", "σ_max − σ_min of sym σ", Needs::contacts, [](Bin b) { return deviator(stress(b)); }},
      {"stress_angle", "", "", "rad", "major axis of sym σ, from r towards φ", Needs::contacts, [](Bin b) { return axis(stress(b)); }},
      {"stress_antisymmetric", "", "", "N/m²", "(σ_φr − σ_rφ)/2, −Σ w J ω̇ / 2V_ring where nothing else turns the disks", Needs::contacts, [](Bin b) { return 0.5 * (stress(b).pr - stress(b).rp); }},
      {"fluctuation_stress_rr", "", "", "N/m²", "Σ w m (v_r − u_r)² / V_ring", kinematics, [](Bin b) { return fluctuationStress(b).rr; }},
      {"fluctuation_stress_pp", "", "", "N/m²", "Σ w m (v_φ − u_φ)² / V_ring", kinematics, [](Bin b) { return fluctuationStress(b).pp; }},
      {"fluctuation_stress_rp", "", "", "N/m²", "Σ w m (v_r − u_r)(v_φ − u_φ) / V_ring", kinematics, [](Bin b) { return fluctuationStress(b).rp; }},
      {"rotational_stress", "", "", "N/m²", "Σ w J ω² / 2V_ring, isotropic", Needs::spin, [](Bin b) { return b.perVolume(spinEnergy); }},
      {"full_stress_rr", "", "", "N/m²", "σ_rr + dynamic", Needs::contacts, [](Bin b) { return fullStress(b).rr; }},
      {"full_stress_pp", "", "", "N/m²", "σ_φφ + dynamic", Needs::contacts, [](Bin b) { return fullStress(b).pp; }},
      {"full_stress_rp", "", "", "N/m²", "(σ_rφ + σ_φr)/2 + dynamic", Needs::contacts, [](Bin b) { return fullStress(b).rp; }},
      {"strain_rr", "", "", "1", "ε_rr of ε = (πh/V_ring) Σ w Σ_c δ n⊗l · F⁻¹", Needs::contacts, [](Bin b) { return strain(b).rr; }},
      {"strain_pp", "", "", "1", "ε_φφ", Needs::contacts, [](Bin b) { return strain(b).pp; }},
      {"strain_rp", "", "", "1", "ε_rφ", Needs::contacts, [](Bin b) { return strain(b).rp; }},
      {"strain_pr", "", "", "1", "ε_φr", Needs::contacts, [](Bin b) { return strain(b).pr; }},
      {"strain_trace", "", "", "1", "ε_rr + ε_φφ", Needs::contacts, [](Bin b) { return trace(strain(b)); }},
      {"strain_deviator", "", "", "1", "ε_max − ε_min of sym ε", Needs::contacts, [](Bin b) { return deviator(strain(b)); }},
      {"strain_angle", "", "", "rad", "major axis of sym ε, from r towards φ", Needs::contacts, [](Bin b) { return axis(strain(b)); }},
      {"bulk_modulus", "", "", "N/m²", "E = tr σ / tr ε of the moving disks", Needs::contacts, bulkModulus},
      {"shear_modulus", "", "", "N/m²", "G = dev σ / dev ε of the moving disks", Needs::contacts, shearModulus},
      {"modulus_ratio", "", "", "1", "G* = G / E", Needs::contacts, [](Bin b) { return shearModulus(b) / bulkModulus(b); }},
      {"mean_field_modulus", "", "", "N/m²", "k_n tr F / 2πh", normalSpring, meanFieldModulus},
      {"predicted_stress_rr", "", "", "N/m²", "ε₀E[1 + G* ε₁ cos 2φ]", normalSpring, [](Bin b) { return predictedStress(b).rr; }},
      {"predicted_stress_pp", "", "", "N/m²", "ε₀E[1 − G* ε₁ cos 2φ]", normalSpring, [](Bin b) { return predictedStress(b).pp; }},
      {"predicted_stress_rp", "", "", "N/m²", "ε₀E G* ε₁ sin 2φ", normalSpring, [](Bin b) { return predictedStress(b).rp; }},
      {"couple_stress_zr", "", "", "N/m", "−Σ w Σ_c (l × f)_z l_r / V_ring", Needs::contacts, [](Bin b) { return b.perVolume(coupleR) + b.perVolume(wallCoupleR); }},
      {"couple_stress_zp", "", "", "N/m", "−Σ w Σ_c (l × f)_z l_φ / V_ring", Needs::contacts, [](Bin b) { return b.perVolume(coupleP) + b.perVolume(wallCoupleP); }},
      {"curvature_zr", "", "", "m", "κ_zr of κ = (πh/V_ring) Σ w Σ_c (l × Δ)⊗l · F⁻¹", tangentialSpring, [](Bin b) { return curvature(b).first; }},
      {"curvature_zp", "", "", "m", "κ_zφ", tangentialSpring, [](Bin b) { return curvature(b).second; }},
      {"torque_resistance", "", "", "N/m²", "M_zr / κ_zr of the moving disks", tangentialSpring, [](Bin b) { return b.perVolume(coupleR) / curvature(b).first; }},
      {"velocity_gradient", "", "", "1/s", "∂v_φ/∂r", kinematics, [](Bin b) { return b.slope(azimuthalVelocity); }},
      {"shear_rate", "", "", "1/s", "∂v_φ/∂r − v_φ/r", kinematics, [](Bin b) { return b.slope(azimuthalVelocity) - b.overRadius(azimuthalVelocity(b)); }},
      {"continuum_rotation", "", "", "rad/s", "½(∂v_φ/∂r + v_φ/r)", kinematics, [](Bin b) { return 0.5 * (b.slope(azimuthalVelocity) + b.overRadius(azimuthalVelocity(b))); }},
      {"excess_rotation", "", "", "rad/s", "spin − ½(∂v_φ/∂r + v_φ/r)", Needs::spin, [](Bin b) { return b[Moment::spin] / b[volume] - 0.5 * (b.slope(azimuthalVelocity) + b.overRadius(azimuthalVelocity(b))); }},
      {"contact_cos_2", "", "", "1", "2 Σ w V Σ_c cos 2α / Σ w V C", Needs::contacts, cos2},
      {"contact_sin_2", "", "", "1", "2 Σ w V Σ_c sin 2α / Σ w V C", Needs::contacts, sin2},
      {"contact_cos_4", "", "", "1", "2 Σ w V Σ_c cos 4α / Σ w V C", Needs::contacts, [](Bin b) { return twiceMean(b, cos4); }},
      {"contact_sin_4", "", "", "1", "2 Σ w V Σ_c sin 4α / Σ w V C", Needs::contacts, [](Bin b) { return twiceMean(b, sin4); }},
      {"contact_cos_6", "", "", "1", "2 Σ w V Σ_c cos 6α / Σ w V C", Needs::contacts, [](Bin b) { return twiceMean(b, cos6); }},
      {"contact_sin_6", "", "", "1", "2 Σ w V Σ_c sin 6α / Σ w V C", Needs::contacts, [](Bin b) { return twiceMean(b, sin6); }},
      {"contact_amplitude_2", "", "", "1", "length of (cos, sin) of order 2", Needs::contacts, [](Bin b) { return length(cos2(b), sin2(b)); }},
      {"contact_amplitude_4", "", "", "1", "length of (cos, sin) of order 4", Needs::contacts, [](Bin b) { return length(twiceMean(b, cos4), twiceMean(b, sin4)); }},
      {"contact_amplitude_6", "", "", "1", "length of (cos, sin) of order 6", Needs::contacts, [](Bin b) { return length(twiceMean(b, cos6), twiceMean(b, sin6)); }},
      {"contact_axis_4", "", "", "rad", "angle of (cos, sin) of order 4, over 4", Needs::contacts, [](Bin b) { return direction(twiceMean(b, cos4), twiceMean(b, sin4)) / 4.0; }},
      {"contact_axis_6", "", "", "rad", "angle of (cos, sin) of order 6, over 6", Needs::contacts, [](Bin b) { return direction(twiceMean(b, cos6), twiceMean(b, sin6)) / 6.0; }},
      {"dissipation", "dissipation", "", "W/m³", "Σ w Σ_c P_c / V_ring, P_c the power that a contact turns into heat, to each of two disks half", Needs::dissipation, [](Bin b) { return b.perVolume(heat); }},
      // clang-format on
  };
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

std::span<const FieldSpec> fieldTable() {
  static const std::vector<FieldSpec> table = [] {
    std::vector<FieldSpec> fields = makeTable();
    for (FieldSpec& field : fields) field.perVolume = growsWithContent(field, 2);
    return fields;
  }();
  return table;
}

std::span<const FieldSpec> fieldsIn(int dimension, bool rings) {
  if (dimension == 3) return spaceFieldTable(rings);
  return rings ? fieldTable() : cartesianFieldTable();
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
