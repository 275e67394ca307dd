#include "averaging/fields.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace crossgrain {

namespace {

std::vector<FieldSpec> makeTable() {
  using enum Moment;
  using enum FieldForm;
  const auto kinematics = Needs::kinematics;
  const auto contact = Needs::contacts;
  return {
      {"volume_fraction", "1", "Σ w V / V_ring", kinematics, perVolume, {volume, wallVolume}},
      {"azimuthal_velocity", "m/s", "Σ w V v_φ / Σ w V", kinematics, ratio, {velocityP, volume}},
      {"radial_velocity", "m/s", "Σ w V v_r / Σ w V", kinematics, ratio, {velocityR, volume}},
      {"spin", "rad/s", "Σ w V ω / Σ w V", Needs::spin, ratio, {Moment::spin, volume}},
      {"stress_rr", "N/m²", "−Σ w Σ_c f_r l_r / V_ring", contact, perVolume, {stressRR}},
      {"stress_pp", "N/m²", "−Σ w Σ_c f_φ l_φ / V_ring", contact, perVolume, {stressPP}},
      {"stress_rp", "N/m²", "−Σ w Σ_c f_r l_φ / V_ring", contact, perVolume, {stressRP}},
      {"stress_pr", "N/m²", "−Σ w Σ_c f_φ l_r / V_ring", contact, perVolume, {stressPR}},
      {"dynamic_stress_rr", "N/m²", "Σ w m v_r v_r / V_ring", kinematics, perVolume, {dynamicRR}},
      {"dynamic_stress_pp", "N/m²", "Σ w m v_φ v_φ / V_ring", kinematics, perVolume, {dynamicPP}},
      {"dynamic_stress_rp", "N/m²", "Σ w m v_r v_φ / V_ring", kinematics, perVolume, {dynamicRP}},
      {"fabric_trace", "1", "Σ w V C / V_ring", contact, perVolume, {fabricRR, fabricPP}},
      {"fabric_deviator",
       "1",
       "F_max − F_min of F = Σ w V Σ_c n⊗n / V_ring",
       contact,
       deviator,
       {fabricRR, fabricPP, fabricRP}},
      {"fabric_rr", "1", "Σ w V Σ_c n_r n_r / V_ring", contact, perVolume, {fabricRR}},
      {"fabric_pp", "1", "Σ w V Σ_c n_φ n_φ / V_ring", contact, perVolume, {fabricPP}},
      {"fabric_rp", "1", "Σ w V Σ_c n_r n_φ / V_ring", contact, perVolume, {fabricRP}},
      {"coordination", "1", "Σ w V C / Σ w V", contact, ratio, {contacts, volume}},
      {"density", "kg/m³", "Σ w m / V_ring", kinematics, perVolume, {mass}},
  };
}

FieldValue perVolume(const FieldSpec& field, const Moments& moments, double volume) {
  FieldValue result;
  for (const Moment moment : field.moments) {
    result.value += at(moments, moment) / volume;
    at(result.gradient, moment) = 1.0 / volume;
  }
  return result;
}

FieldValue ratio(const FieldSpec& field, const Moments& moments) {
  const double denominator = at(moments, field.moments[1]);
  FieldValue result;
  result.value = at(moments, field.moments[0]) / denominator;
  at(result.gradient, field.moments[0]) = 1.0 / denominator;
  at(result.gradient, field.moments[1]) = -result.value / denominator;
  return result;
}

/// √((F_rr − F_φφ)² + 4 F_rφ²), the difference of the eigenvalues. Where it is 0 it has a kink and
/// the gradient is left 0.
FieldValue deviator(const FieldSpec& field, const Moments& moments, double volume) {
  const double difference = at(moments, field.moments[0]) - at(moments, field.moments[1]);
  const double mixed = 2.0 * at(moments, field.moments[2]);
  const double length = std::hypot(difference, mixed);
  FieldValue result;
  result.value = length / volume;
  if (length == 0.0) return result;
  at(result.gradient, field.moments[0]) = difference / length / volume;
  at(result.gradient, field.moments[1]) = -difference / length / volume;
  at(result.gradient, field.moments[2]) = 2.0 * mixed / length / volume;
  return result;
}

bool measuresFilling(const FieldSpec& field) {
  return field.moments[0] == Moment::volume || field.moments[0] == Moment::mass;
}

}  // namespace

std::span<const FieldSpec> fieldTable() {
  static const std::vector<FieldSpec> table = makeTable();
  return table;
}

const FieldSpec& fieldSpec(std::string_view name) {
  for (const FieldSpec& field : fieldTable())
    if (field.name == name) return field;
  throw std::invalid_argument(fmt::format("averaging: there is no field \"{}\"", name));
}

std::optional<FieldValue> evaluate(const FieldSpec& field, const Moments& moments, double volume) {
  const bool empty = !(at(moments, Moment::volume) > 0.0);
  if (empty && !measuresFilling(field)) return std::nullopt;
  switch (field.form) {
    case FieldForm::perVolume:
      return perVolume(field, moments, volume);
    case FieldForm::ratio:
      return ratio(field, moments);
    case FieldForm::deviator:
      return deviator(field, moments, volume);
  }
  throw std::invalid_argument("averaging: not a form of field");
}

bool available(const FieldSpec& field, const Snapshot& snapshot) {
  switch (field.needs) {
    case Needs::kinematics:
      return true;
    case Needs::spin:
      return snapshot.spin.has_value();
    case Needs::contacts:
      return snapshot.contacts.has_value();
  }
  throw std::invalid_argument("averaging: not a need");
}

}  // namespace crossgrain
