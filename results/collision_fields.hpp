#pragma once

#include "adapters/worker/json.hpp"
#include "results/collision.hpp"
#include "results/head.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::inline results {

template <typename T>
void fields(auto& io, PerQuantity<T>& values) {
  for (const CollisionQuantity& quantity : collisionQuantities())
    io.present(quantity.name.data(), values[quantity.id]);
}

namespace detail {

void presentUnlessEmpty(auto& io, const char* key, auto& list) {
  auto there = list.empty() ? std::nullopt : std::optional(list);
  io.present(key, there);
  if (there) list = std::move(*there);
}

}  // namespace detail

void fields(auto& io, CollisionTable& table) {
  detail::presentUnlessEmpty(io, "psi_i", table.psi);
  detail::presentUnlessEmpty(io, "v_n", table.vn);
  fields(io, table.columns);
  detail::presentUnlessEmpty(io, "limitless", table.noLimit);
}

void fields(auto& io, CollisionPoints& points) {
  fields(io, static_cast<CollisionTable&>(points));
  detail::presentUnlessEmpty(io, "status", points.status);
  detail::presentUnlessEmpty(io, "reason", points.reason);
}

void fields(auto& io, QuantityScore& score) {
  io("max", score.max);
  io("rms", score.rms);
  io("unit", score.unit);
  io("unit_is", score.unitIs);
  io("limit", score.limit);
  io("held", score.held);
  io.present("why", score.why);
}

/// The errors of Ψ_f, and e_n's in its own unit, stand there twice: so they are found at once.
void fields(auto& io, CurveScore& score) {
  fields(io, score.of);
  io("verdict", score.verdict);
  std::optional<double> max, rms, limit, enError;
  if (const auto& psi = score.of[QuantityId::psiF]) {
    max = psi->max;
    rms = psi->rms;
    limit = psi->limit;
  }
  if (const auto& en = score.of[QuantityId::en]) enError = en->max * en->unit;
  io("max_error", max);
  io("rms_error", rms);
  io("limit", limit);
  io("e_n_error", enError);
}

void fields(auto& io, DeclaredScore& declared) {
  io("law", declared.law);
  io("reference", declared.reference);
  io("score", declared.score);
  io("oracle_reason", declared.oracleReason);
}

void fields(auto& io, SchemeScore& own) {
  io("scheme", own.scheme);
  io("position", own.position);
  io("velocity", own.velocity);
  io("limit", own.limit);
  io("held", own.held);
  io("reason", own.reason);
}

/// Kept by itself, with the others of its engine and variant, as soon as it is there.
void fields(auto& io, CollisionCurve& curve) {
  io("engine", curve.engine, aName);
  io("dt", curve.dt);
  io("steps_per_contact", curve.stepsPerContact);
  io("status", curve.status);
  io("reason", curve.reason);
  io("realised", curve.effective);
  io.present("stats", curve.stats);
  io("points", curve.points);
  io("score", curve.score);
  io("declared", curve.declared);
  io.present("own_scheme", curve.ownScheme);
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
  io("case", variant.name, aName);
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
  io("engine", order.engine, aName);
  io("case", order.name, aName);
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
  results.head.fields(io);
  io.present("elapsed_s", results.elapsed);
  io("engines", results.engines);
  io("variants", results.variants);
  io("orders", results.orders);
}

}  // namespace crossgrain::inline results
