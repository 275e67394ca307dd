#include <fmt/format.h>

#include <algorithm>

#include "averaging/fields.hpp"
#include "cases/endpoints.hpp"
#include "cases/loader_sections.hpp"
#include "cases/scales.hpp"
#include "oracle/collision_quantities.hpp"

namespace crossgrain::inline cases {
namespace {

/// Something that a margin can be for.
struct Judged {
  std::string name;
  std::string_view unit;
  std::optional<bool> byRatio = {};  ///< absent: as the margin is, relative or not
};

/// A share of one of the case's own scales, in the unit of the field.
void readFraction(Reader& in, const Judged& field, const Case& setup, Margin& margin) {
  double share = 0.0;
  in.read("share", share, positive());
  std::vector<std::string> names;
  for (const Scale& scale : scales()) names.emplace_back(scale.name);
  in.read("of", margin.scale, names);
  if (in.has("share") != in.has("of"))
    in.failMissing(in.has("of") ? "share" : "of", "a margin of a share says of what");
  if (!in.has("of")) return;
  const Scale& scale = *std::ranges::find(scales(), margin.scale, &Scale::name);
  if (scale.unit != field.unit)
    in.fail("of", fmt::format("is in {}, and {} in {}", scale.unit, field.name, field.unit));
  const double whole = scale.of(setup);
  if (!(whole > 0.0)) in.fail("of", "is zero in this case");
  margin.value = fractionOf(scale, share, setup);
  margin.why = fmt::format("{:g} of {} ({} = {:.4g} {}): ", share, scale.name, scale.meaning, whole,
                           scale.unit);
}

Margin readMargin(Reader& in, const Judged& field, const Case* setup) {
  Margin margin;
  margin.relative = in.has("relative");
  in.read("relative", margin.value, positive());
  in.read("absolute", margin.value, positive());
  if (setup) readFraction(in, field, *setup, margin);
  std::string why;
  in.requireText("why", why, "must give the reason");
  in.finish();
  const char* given = nullptr;
  for (const char* const way : {"relative", "absolute", "share"}) {
    if (!in.has(way)) continue;
    if (given) in.fail(way, fmt::format("{} is {} or {}, not both", field.name, given, way));
    given = way;
  }
  if (!given)
    in.failMissing("relative", setup ? "or absolute, or share and of: a margin has one of them"
                                     : "or absolute: a margin has one of them");
  if (field.byRatio && *field.byRatio != margin.relative)
    in.fail(given, fmt::format("{} is compared by its {}: give {}", field.name,
                               *field.byRatio ? "ratio" : "difference",
                               *field.byRatio ? "relative" : "absolute, or share and of"));
  margin.why += why;
  return margin;
}

/// Margins of what is listed; anything else is an unknown key.
std::map<std::string, Margin> readAll(Reader in, const std::vector<Judged>& list,
                                      const Case* setup) {
  std::map<std::string, Margin> margins;
  for (const Judged& field : list) {
    Reader margin = in.section(field.name);
    if (in.has(field.name)) margins[field.name] = readMargin(margin, field, setup);
  }
  in.finish();
  return margins;
}

}  // namespace

std::map<std::string, Margin> readFieldMargins(Reader in, const Case& setup) {
  std::vector<Judged> fields;
  for (const FieldSpec& field : fieldTable())
    fields.push_back({std::string(field.name), field.unit});
  return readAll(std::move(in), fields, &setup);
}

std::map<std::string, Margin> readBinMargins(Reader in, std::span<const FieldSpec> fields) {
  std::vector<Judged> judged;
  for (const FieldSpec& field : fields) judged.push_back({std::string(field.name), field.unit});
  return readAll(std::move(in), judged, nullptr);
}

Margin readOwnMargin(Reader& in, const std::string& endpoint) {
  return readMargin(in, {endpoint, ""}, nullptr);
}

std::map<std::string, Margin> readEndpointMargins(Reader in, const Case& setup) {
  std::vector<Judged> endpoints;
  for (const EndpointSpec& endpoint : endpointTable())
    endpoints.push_back({std::string(endpoint.name), endpoint.unit, endpoint.byRatio});
  return readAll(std::move(in), endpoints, &setup);
}

std::map<std::string, Margin> readCollisionMargins(Reader in) {
  std::vector<Judged> quantities;
  for (const CollisionQuantity& quantity : scoredQuantities())
    quantities.push_back({std::string(quantity.name), ""});
  return readAll(std::move(in), quantities, nullptr);
}

}  // namespace crossgrain::inline cases
