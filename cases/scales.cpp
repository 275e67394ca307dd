#include "cases/scales.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace crossgrain::inline cases {

namespace {

double diameter(const Case& c) {
  return 2.0 * c.particles.smallRadius;
}

double rimSpeed(const Case& c) {
  return std::abs(c.cell.omega) * c.cell.innerRadius;
}

double diskDensity(const Case& c) {
  const double area = std::numbers::pi * c.particles.smallRadius * c.particles.smallRadius;
  return c.particles.smallMass / (area * c.cell.height);
}

// d: diameter of a small disk; D = 2 R_i, as the thesis scales spins (Lätzel 2003, section 6.3).
constexpr std::array<Scale, 8> table = {{
    {"rim_speed", "m/s", "Ω R_i", rimSpeed},
    {"spin_scale", "rad/s", "Ω D/d, D = 2 R_i",
     [](const Case& c) { return 2.0 * rimSpeed(c) / diameter(c); }},
    {"wheel_rate", "rad/s", "Ω", [](const Case& c) { return std::abs(c.cell.omega); }},
    {"shear_rate", "1/s", "Ω R_i/d", [](const Case& c) { return rimSpeed(c) / diameter(c); }},
    {"diameter", "m", "d", diameter},
    {"rim_pressure", "N/m²", "ρ (Ω R_i)²",
     [](const Case& c) { return diskDensity(c) * rimSpeed(c) * rimSpeed(c); }},
    {"contact_pressure", "N/m²", "k_n/h", [](const Case& c) { return c.law.kn / c.cell.height; }},
    {"disk_density", "kg/m³", "ρ of a small disk", diskDensity},
}};

}  // namespace

std::span<const Scale> scales() {
  return table;
}

double fractionOf(const Scale& scale, double share, const Case& setup) {
  return std::strtod(fmt::format("{:.1e}", share * scale.of(setup)).c_str(), nullptr);
}

}  // namespace crossgrain::inline cases
