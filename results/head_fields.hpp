#pragma once

#include "results/head.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::inline results {

void fields(auto& io, Machine& machine) {
  io("cpu", machine.cpu);
  io("os", machine.os);
  io("cores", machine.cores);
}

void fields(auto& io, CaseHead& setup) {
  io("name", setup.name);
  io("variant", setup.variant);
  io("file", setup.file);
  io("toml", setup.toml);
}

/// Its members stand beside those of the results themselves, not in an object of their own.
void fields(auto& io, ResultsHead& head) {
  io("schema", head.schema);
  io("kind", head.kind);
  io("version", head.version);
  io.when(!head.build.empty(), "build", head.build);
  io("command", head.command);
  io("started", head.started);
  io("machine", head.machine);
  io("case", head.setup);
}

}  // namespace crossgrain::inline results
