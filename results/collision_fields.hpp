#pragma once

#include "results/collision.hpp"
#include "results/engine_fields.hpp"
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

/// Kept by itself, with the others of its engine and variant, as soon as it is there.
void fields(auto& io, CollisionCurve& curve) {
  io("engine", curve.engine);
  io("dt", curve.dt);
  io("steps_per_contact", curve.stepsPerContact);
  io("status", curve.status);
  io("reason", curve.reason);
  io("realised", curve.realised);
  io.present("stats", curve.stats);
  io("points", curve.points);
  io("score", curve.score);
}

}  // namespace crossgrain::inline results
