#include "results/collision.hpp"

#include "results/collision_fields.hpp"
#include "results/head_fields.hpp"

namespace crossgrain::inline results {

template <>
Json jsonOf(const LawValue& value) {
  return std::visit([](const auto& held) { return Json(held); }, value);
}
template <>
void readFrom(const Json& json, LawValue& value) {
  if (json.is_string())
    value = json.get<std::string>();
  else if (json.is_number())
    value = json.get<double>();
  else if (json.is_null())
    value = std::numeric_limits<double>::quiet_NaN();
  else
    detail::expected("a text or a number", json);
}

void fields(auto& io, NoLimitPoint& point) {
  io("psi_i", point.psi);
  io("v_n", point.vn);
  io("psi_f", point.psiAfter);
  io("reason", point.reason);
}

void fields(auto& io, StickingLimit& sticking) {
  io("e_t0", sticking.et0);
}

void fields(auto& io, CollisionVariant& variant) {
  io("case", variant.name);
  io("variant", variant.variant);
  io("law", variant.law);
  io.present("effects", variant.effects);
  io("e_n_closed", variant.closedEn);
  io("sticking", variant.sticking);
  io("sliding_constant", variant.slidingConstant);
  io("oracle", variant.oracle);
  io("oracle_reason", variant.oracleReason);
  io("reference", variant.reference);
  io("no_limit", variant.noLimit);
  io("curves", variant.curves);
}

void fields(auto& io, FittedOrder& fit) {
  io("order", fit.order);
  io("stderr", fit.standardError);
}

/// Ψ_f's stands there twice, so that it is found at once.
void fields(auto& io, ConvergenceOrder& order) {
  io("engine", order.engine);
  io("case", order.name);
  io("variant", order.variant);
  io("error_at", order.errorAt);
  io("quantities", order.of);
  std::optional<double> ofPsi, standardError;
  if (const auto& psi = order.of[QuantityId::psiF]) {
    ofPsi = psi->order;
    standardError = psi->standardError;
  }
  io("order", ofPsi);
  io("stderr", standardError);
}

void fields(auto& io, CollideResults& results) {
  fields(io, results.head);
  io.present("elapsed_s", results.elapsed);
  io("engines", results.engines);
  io("variants", results.variants);
  io("orders", results.orders);
}

Json toJson(const CollideResults& results) {
  return jsonOf(results);
}

CollideResults collideFromJson(const Json& json) {
  return readAs<CollideResults>(json);
}

}  // namespace crossgrain::inline results
