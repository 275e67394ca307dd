#include "results/thesis.hpp"

#include "results/thesis_fields.hpp"

namespace crossgrain::inline results {

void fields(auto& io, ThesisResults& results) {
  fields(io, results.head);
  io.present("elapsed_s", results.elapsed);
  io("engines", results.engines);
  io("carriers", results.carriers);
  io("rules", results.rules);
  io("reasons", results.reasons);
  io.present("collisions", results.collisions);
  io("legs", results.legs);
  io("runs", results.runs);
  io("claims", results.claims);
  io("notes", results.notes);
}

Json toJson(const ThesisResults& results) {
  return jsonOf(results);
}

ThesisResults thesisFromJson(const Json& json) {
  return readAs<ThesisResults>(json);
}

}  // namespace crossgrain::inline results
