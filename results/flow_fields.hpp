#pragma once

#include "results/compare.hpp"
#include "results/engine_fields.hpp"
#include "results/head.hpp"
#include "results/scene_picture.hpp"
#include "results/schema.hpp"

/// Members of what results of Couette cases are made of (results/json_fields.hpp).
namespace crossgrain::inline results {

void fields(auto& io, Profile& profile) {
  io("method", profile.method, aName);
  io("field", profile.field, aField);
  io("unit", profile.unit, aUnit);
  io("mean", profile.mean);
  io("stderr", profile.standardError);
  io("n_eff", profile.nEff);
  io("dof", profile.dof);
}

void fields(auto& io, Bins& axis) {
  io("low", axis.low);
  io("width", axis.width);
  io("count", axis.count);
}

void fields(auto& io, Distribution& distribution) {
  io("quantity", distribution.quantity, aName);
  io("ring", distribution.ring);
  io("axes", distribution.axes);
  io("density", distribution.density);
  io("stderr", distribution.standardError);
  io("outside", distribution.outside);
  io("samples", distribution.samples);
}

}  // namespace crossgrain::inline results
