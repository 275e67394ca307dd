#include "studies/regression/baseline.hpp"

#include <fmt/format.h>

#include "adapters/worker/arrays.hpp"
#include "adapters/worker/json.hpp"
#include "cases/case_keys.hpp"
#include "cases/loader.hpp"
#include "results/head.hpp"
#include "results/lockstep_findings.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/regression/recording.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline studies {

void fields(auto& io, KeptCollisions& kept) {
  FIELDS(io, kept.name, kept.variant, kept.refusal, kept.psi, kept.vn, kept.values);
  io("dt_s", kept.dt);
}

/// Without windows, which are records of their own.
void fields(auto& io, BaselineEngine& engine) {
  FIELDS(io, engine.name, engine.version, engine.endpoints);
  io("capabilities", engine.can);
  io("realised", engine.effective);
  io("sweeps", engine.collisions);
}

namespace {

struct BaselineHead {
  std::string version;
  CaseHead setup;
  int dimension = 2;
  std::size_t starts = 0, engines = 0;
};

void fields(auto& io, BaselineHead& head) {
  FIELDS(io, head.version, head.starts, head.engines);
  io("case", head.setup);
  io.when(head.dimension != 2, "dimension", head.dimension);
}

/// Of a frame, what is no array.
template <int D>
struct FrameHead {
  double time = 0.0, velocityTime = 0.0, contactTime = 0.0;
  std::vector<std::optional<VecOf<D>>> forces;  ///< on each wall body [N]
  std::vector<std::optional<SpinOf<D>>> torques;
};

template <int D>
void fields(auto& io, FrameHead<D>& head) {
  FIELDS(io, head.time, head.velocityTime, head.contactTime, head.forces, head.torques);
}

Record recordOf(Json line, const ArrayWriter& arrays) {
  line["arrays"] = arrays.list();
  return {std::move(line),
          {reinterpret_cast<const char*>(arrays.bytes().data()), arrays.bytes().size()}};
}

template <typename Value>
std::vector<Value> listOf(const ArrayReader& arrays, const std::string& name, std::size_t count) {
  if constexpr (std::is_same_v<Value, double>)
    return arrays.f64(name, count);
  else
    return arrays.vectors<Value::RowsAtCompileTime>(name, count);
}

template <int D>
Record recordOf(const FlowState& state) {
  const DisksOf<D>& disks = disksIn<D>(state.packing);
  ArrayWriter arrays;
  arrays.add("radius", disks.radius);
  arrays.add("mass", disks.mass);
  arrays.add("inertia", disks.inertia);
  arrays.add("position", disks.position);
  arrays.add("velocity", disks.velocity);
  arrays.add("spin", disks.spin);
  if (!disks.areRound()) {
    arrays.add("shape", disks.shape);
    arrays.add("turn", disks.turn);
    arrays.add("moments", disks.moments);
  }
  Json line = {{"start", jsonOf(state.start)}};
  if (state.packing.wallTime != 0.0) line["wall_time_s"] = state.packing.wallTime;
  return recordOf(std::move(line), arrays);
}

template <int D>
FlowState stateOf(const Record& record) {
  const ArrayReader arrays(record.bytes, "a start", record.line.at("arrays"));
  FlowState state;
  readFrom(record.line.at("start"), state.start);
  DisksOf<D>& disks = disksIn<D>(state.packing);
  const std::size_t count = arrays.count("radius");
  disks.radius = arrays.f64("radius", count);
  disks.mass = arrays.f64("mass", count);
  disks.inertia = arrays.f64("inertia", count);
  disks.position = listOf<VecOf<D>>(arrays, "position", count);
  disks.velocity = listOf<VecOf<D>>(arrays, "velocity", count);
  disks.spin = listOf<SpinOf<D>>(arrays, "spin", count);
  if (arrays.has("shape")) {
    disks.shape = arrays.i32("shape", count);
    disks.turn = listOf<TurnOf<D>>(arrays, "turn", count);
    if (D == 3) disks.moments = arrays.vectors<3>("moments", count);
  }
  state.packing.wheelAngle = state.start.wheelAngle;
  state.packing.wallTime = record.line.value("wall_time_s", 0.0);
  state.packing.hash = contentHash(state.packing);
  return state;
}

template <int D>
Record recordOf(const BaselineWindowOf<D>& window) {
  ArrayWriter arrays;
  std::vector<FrameHead<D>> heads;
  for (const LockstepFrameOf<D>& frame : window.frames) {
    FrameHead<D> head{frame.time, frame.velocityTime, frame.contactTime, {}, {}};
    for (const BodySnapshotOf<D>& body : frame.bodies) {
      head.forces.push_back(body.force);
      head.torques.push_back(body.torque);
    }
    const std::string at = fmt::format("{}.", heads.size());
    arrays.add(at + "position", frame.position);
    if (!frame.spin.empty()) arrays.add(at + "spin", frame.spin);
    if (const auto& contacts = frame.contacts) {
      arrays.add(at + "i", contacts->i);
      arrays.add(at + "j", contacts->j);
      arrays.add(at + "normal_force", contacts->normalForce);
      arrays.add(at + "tangential_force", contacts->tangentialForce);
      if (!contacts->sliding.empty()) arrays.add(at + "sliding", contacts->sliding);
      if (!contacts->rollingTorque.empty())
        arrays.add(at + "rolling_torque", contacts->rollingTorque);
    }
    heads.push_back(std::move(head));
  }
  for (std::size_t k = 0; k < window.responses.size(); ++k)
    arrays.add(fmt::format("response.{}", k), window.responses[k]);
  return recordOf({{"frames", jsonOf(heads)}}, arrays);
}

template <int D>
LockstepFrameOf<D> frameOf(const FrameHead<D>& head, const ArrayReader& arrays,
                           const std::string& at, std::size_t disks) {
  LockstepFrameOf<D> frame;
  frame.time = head.time;
  frame.velocityTime = head.velocityTime;
  frame.contactTime = head.contactTime;
  frame.position = listOf<VecOf<D>>(arrays, at + "position", disks);
  if (arrays.has(at + "spin")) frame.spin = listOf<SpinOf<D>>(arrays, at + "spin", disks);
  for (std::size_t b = 0; b < head.forces.size(); ++b) {
    BodySnapshotOf<D>& body = frame.bodies.emplace_back();
    body.force = head.forces[b];
    body.torque = head.torques.at(b);
  }
  if (!arrays.has(at + "i")) return frame;
  ContactsOf<D>& contacts = frame.contacts.emplace();
  const std::size_t count = arrays.count(at + "i");
  contacts.i = arrays.i32(at + "i", count);
  contacts.j = arrays.i32(at + "j", count);
  for (const auto* ids : {&contacts.i, &contacts.j})
    for (const std::int32_t id : *ids)
      if (id < 0) throw FieldError(fmt::format("{}contacts have the id {}", at, id));
  contacts.normalForce = arrays.f64(at + "normal_force", count);
  contacts.tangentialForce = listOf<SpinOf<D>>(arrays, at + "tangential_force", count);
  contacts.sliding.assign(count, 0);
  if (arrays.has(at + "sliding")) contacts.sliding = arrays.u8(at + "sliding", count);
  if (arrays.has(at + "rolling_torque"))
    contacts.rollingTorque = listOf<SpinOf<D>>(arrays, at + "rolling_torque", count);
  return frame;
}

template <int D>
BaselineWindowOf<D> windowOf(const Record& record, std::size_t disks) {
  const ArrayReader arrays(record.bytes, "a window", record.line.at("arrays"));
  const auto heads = readAs<std::vector<FrameHead<D>>>(record.line.at("frames"));
  if (heads.empty()) throw FieldError("a window has no frames");
  BaselineWindowOf<D> window;
  double before = 0.0;
  for (const FrameHead<D>& head : heads) {
    if (!(head.time > before && std::isfinite(head.velocityTime + head.contactTime)))
      throw FieldError("the times of a window do not increase");
    before = head.time;
    const std::string at = fmt::format("{}.", window.frames.size());
    window.frames.push_back(frameOf(head, arrays, at, disks));
  }
  for (std::size_t k = 0; k < lockstepTimes.size(); ++k)
    window.responses.push_back(
        arrays.f64(fmt::format("response.{}", k), referencePerturbations.size() * disks));
  return window;
}

template <int D>
Baseline readRecords(RecordReader& in, const BaselineHead& head) {
  Baseline baseline{head.version, head.setup, D, {}, {}};
  for (std::size_t s = 0; s < head.starts; ++s) baseline.starts.push_back(stateOf<D>(in.require()));
  for (std::size_t e = 0; e < head.engines; ++e) {
    baseline.engines.push_back(readAs<BaselineEngine>(in.require().line));
    for (const KeptCollisions& kept : baseline.engines.back().collisions)
      for (const auto& [quantity, values] : kept.values)
        if (kept.vn.size() != kept.psi.size() || values.size() != kept.psi.size())
          throw FieldError(fmt::format("{} of {} has {} values, not {}", quantity, kept.name,
                                       values.size(), kept.psi.size()));
    for (const FlowState& state : baseline.starts)
      windowsIn<D>(baseline.engines.back())
          .push_back(windowOf<D>(in.require(), disksIn<D>(state.packing).size()));
  }
  return baseline;
}

}  // namespace

void writeBaseline(const Baseline& baseline, const std::filesystem::path& file) {
  std::string text = headText(
      baselineFormat, jsonOf(BaselineHead{baseline.version, baseline.setup, baseline.dimension,
                                          baseline.starts.size(), baseline.engines.size()}));
  for (const FlowState& state : baseline.starts)
    text += textOf(baseline.dimension == 3 ? recordOf<3>(state) : recordOf<2>(state));
  for (const BaselineEngine& engine : baseline.engines) {
    text += textOf({jsonOf(engine), {}});
    for (const auto& window : engine.windows) text += textOf(recordOf(window));
    for (const auto& window : engine.spaceWindows) text += textOf(recordOf(window));
  }
  writeFile(file, text);
}

Baseline readBaseline(const std::filesystem::path& file) {
  RecordReader in(file, baselineFormat);
  try {
    const auto head = readAs<BaselineHead>(in.head());
    if (head.engines == 0) throw FieldError("it has no engine");
    if (head.dimension != 2 && head.dimension != 3)
      throw FieldError(fmt::format("its dimension is {}, not 2 or 3", head.dimension));
    return head.dimension == 3 ? readRecords<3>(in, head) : readRecords<2>(in, head);
  } catch (const BadInput&) {
    throw;
  } catch (const std::exception& error) {
    throw BadInput(fmt::format("{}: is damaged: record {}: {}", file.string(), in.count(),
                               asOneLine(withoutPrefix(error.what()), 200)));
  }
}

std::vector<Case> casesOf(const Baseline& baseline, const std::filesystem::path& file,
                          const std::vector<std::string>& overrides) {
  const ScratchFolder scratch;
  const std::filesystem::path document = scratch.path / "case.toml";
  writeFile(document, baseline.setup.toml);
  std::vector<std::string> all;
  // The packing that the flow began with need not be there any more: starts are kept.
  if (!baseline.starts.empty() && caseKeys(baseline.setup.toml).contains("particles.file")) {
    const std::filesystem::path packing = scratch.path / "packing.h5";
    writePacking(baseline.starts.front().packing, packing);
    all.push_back("particles.file=" + packing.string());
  }
  all.insert(all.end(), overrides.begin(), overrides.end());
  std::vector<Case> cases;
  try {
    cases = loadCase(document, all);
  } catch (const BadInput& error) {
    throw BadInput(fmt::format("{}: its case: {}", file.string(), error.what()));
  }
  for (Case& setup : cases) {
    setup.name = baseline.setup.name;
    setup.file = baseline.setup.file;
  }
  return cases;
}

}  // namespace crossgrain::inline studies
