#include "averaging/field_formulas.hpp"

#include <cmath>
#include <numbers>

namespace crossgrain::inline averaging::formulas {

using enum Moment;

LinearTensor movingStress(const BinView& bin) {
  return {bin.perVolume(stressRR), bin.perVolume(stressRP), bin.perVolume(stressPR),
          bin.perVolume(stressPP)};
}

LinearTensor stress(const BinView& bin) {
  const LinearTensor moving = movingStress(bin);
  return {moving.rr + bin.perVolume(wallStressRR), moving.rp + bin.perVolume(wallStressRP),
          moving.pr + bin.perVolume(wallStressPR), moving.pp + bin.perVolume(wallStressPP)};
}

LinearTensor dynamicStress(const BinView& bin) {
  const Linear mixed = bin.perVolume(dynamicRP);
  return {bin.perVolume(dynamicRR), mixed, mixed, bin.perVolume(dynamicPP)};
}

LinearTensor fabric(const BinView& bin) {
  const Linear mixed = bin.perVolume(fabricRP);
  return {bin.perVolume(fabricRR), mixed, mixed, bin.perVolume(fabricPP)};
}

LinearTensor fluctuationStress(const BinView& bin) {
  const LinearTensor whole = dynamicStress(bin);
  const Linear density = bin.perVolume(mass);
  const Linear r = bin.perVolume(momentumR);
  const Linear p = bin.perVolume(momentumP);
  const Linear mixed = whole.rp - r * p / density;
  return {whole.rr - r * r / density, mixed, mixed, whole.pp - p * p / density};
}

LinearTensor fullStress(const BinView& bin) {
  const LinearTensor still = stress(bin);
  const LinearTensor moved = dynamicStress(bin);
  const Linear mixed = 0.5 * (still.rp + still.pr) + moved.rp;
  return {still.rr + moved.rr, mixed, mixed, still.pp + moved.pp};
}

LinearTensor strain(const BinView& bin) {
  const double factor = std::numbers::pi * bin.height();
  const Linear mixed = factor * bin.perVolume(overlapRP);
  const LinearTensor overlaps = {factor * bin.perVolume(overlapRR), mixed, mixed,
                                 factor * bin.perVolume(overlapPP)};
  return overlaps * inverse(fabric(bin));
}

Linear bulkModulus(const BinView& bin) {
  return trace(movingStress(bin)) / trace(strain(bin));
}

Linear shearModulus(const BinView& bin) {
  return deviator(movingStress(bin)) / deviator(strain(bin));
}

Linear meanFieldModulus(const BinView& bin) {
  return bin.kn() / (2.0 * std::numbers::pi * bin.height()) * trace(fabric(bin));
}

LinearTensor predictedStress(const BinView& bin) {
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

std::pair<Linear, Linear> curvature(const BinView& bin) {
  const double factor = std::numbers::pi * bin.height() / bin.kt();
  const LinearTensor perFabric = inverse(fabric(bin));
  const Linear r = factor * bin.perVolume(coupleR);
  const Linear p = factor * bin.perVolume(coupleP);
  return {r * perFabric.rr + p * perFabric.pr, r * perFabric.rp + p * perFabric.pp};
}

Linear azimuthalVelocity(const BinView& bin) {
  return bin[velocityP] / bin[volume];
}

}  // namespace crossgrain::inline averaging::formulas
