#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "runs/baseline/baseline_file.hpp"
#include "runs/baseline/baseline_heads.hpp"
#include "runs/lockstep/rules.hpp"
#include "support/bad_input.hpp"
#include "support/hdf5_file.hpp"
#include "support/hdf5_trial.hpp"

namespace crossgrain::inline runs {
namespace {

/// Arrays of one group, with what is amiss said of the file.
class Arrays {
 public:
  Arrays(const Hdf5File& in, std::string group) : in_(in), group_(std::move(group)) {}

  /// Where what is absent is NaN.
  std::vector<double> readSome(const std::string& name) const {
    auto values = in_.read(group_ + name);
    if (!values) throw FieldError(fmt::format("{}{} is missing", group_, name));
    return *std::move(values);
  }
  std::vector<double> readSome(const std::string& name, std::size_t length) const {
    return ofLength(readSome(name), name, length);
  }
  /// @throws FieldError if one is not finite
  std::vector<double> read(const std::string& name) const {
    std::vector<double> values = readSome(name);
    if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
      throw FieldError(fmt::format("{}{} has a value that is not finite", group_, name));
    return values;
  }
  /// @throws FieldError also if it has another length
  std::vector<double> read(const std::string& name, std::size_t length) const {
    return ofLength(read(name), name, length);
  }
  /// Whole numbers from `least` to `most`.
  std::vector<std::int32_t> whole(const std::string& name, std::int32_t least,
                                  std::int32_t most) const {
    std::vector<std::int32_t> numbers;
    for (const double value : read(name)) {
      if (!(value >= least && value <= most && value == std::floor(value)))
        throw FieldError(fmt::format("{}{} has {}, not a whole number from {} to {}", group_, name,
                                     value, least, most));
      numbers.push_back(static_cast<std::int32_t>(value));
    }
    return numbers;
  }
  std::vector<std::int32_t> ids(const std::string& name, std::size_t length) const {
    return ofLength(whole(name, 0, std::numeric_limits<std::int32_t>::max()), name, length);
  }
  std::vector<Vec2> vectors(const std::string& name, std::size_t count) const {
    const std::vector<double> values = read(name, 2 * count);
    std::vector<Vec2> vectors;
    for (std::size_t k = 0; k < count; ++k) vectors.emplace_back(values[2 * k], values[2 * k + 1]);
    return vectors;
  }

 private:
  template <typename Values>
  Values ofLength(Values values, const std::string& name, std::size_t length) const {
    if (values.size() != length)
      throw FieldError(
          fmt::format("{}{} has {} values, not {}", group_, name, values.size(), length));
    return values;
  }

  const Hdf5File& in_;
  std::string group_;
};

Disks readStart(const Arrays& in) {
  Disks disks;
  disks.radius = in.read("radius");
  const std::size_t count = disks.size();
  disks.mass = in.read("mass", count);
  disks.inertia = in.read("inertia", count);
  disks.position = in.vectors("position", count);
  disks.velocity = in.vectors("velocity", count);
  disks.spin = in.read("spin", count);
  return disks;
}

/// Contacts of all frames, handed out frame by frame.
class ContactArrays {
 public:
  ContactArrays(const Arrays& in, std::size_t all)
      : i_(in.ids("i", all)),
        j_(in.ids("j", all)),
        normal_(in.read("normal_force", all)),
        tangential_(in.read("tangential_force", all)),
        sliding_(in.read("sliding", all)) {}

  Contacts next(std::size_t count) {
    Contacts contacts;
    for (; count > 0; --count, ++at_) {
      contacts.i.push_back(i_[at_]);
      contacts.j.push_back(j_[at_]);
      contacts.normalForce.push_back(normal_[at_]);
      contacts.tangentialForce.push_back(tangential_[at_]);
      contacts.sliding.push_back(sliding_[at_] != 0.0);
    }
    return contacts;
  }

 private:
  std::vector<std::int32_t> i_, j_;
  std::vector<double> normal_, tangential_, sliding_;
  std::size_t at_ = 0;
};

BaselineWindow readWindow(const Arrays& in, std::size_t disks) {
  // Where there are none of an instant it says −1.
  const std::vector<std::int32_t> counts =
      in.whole("contacts", -1, std::numeric_limits<std::int32_t>::max());
  const std::size_t frames = counts.size();
  if (frames == 0) throw FieldError("a window has no frames");
  std::size_t all = 0;
  for (const std::int32_t count : counts) all += static_cast<std::size_t>(std::max(count, 0));
  ContactArrays contacts(in, all);
  const std::vector<double> time = in.read("time", 3 * frames);
  for (std::size_t k = 0; k < frames; ++k)
    if (!(time[3 * k] > (k == 0 ? 0.0 : time[3 * k - 3])))
      throw FieldError("the times of a window are no times one after the other");
  const std::vector<Vec2> position = in.vectors("position", frames * disks);
  const std::vector<double> spin = in.read("spin");
  if (!spin.empty() && spin.size() != frames * disks)
    throw FieldError(fmt::format("spin has {} values, not {}", spin.size(), frames * disks));
  const std::vector<double> walls = in.readSome("walls");
  if (walls.size() % (3 * frames) != 0)
    throw FieldError(
        fmt::format("walls has {} values, not 3 for each of {} frames", walls.size(), frames));
  const std::size_t bodies = walls.size() / (3 * frames);
  BaselineWindow window;
  for (std::size_t k = 0; k < frames; ++k) {
    LockstepFrame& frame = window.frames.emplace_back();
    frame.time = time[3 * k];
    frame.velocityTime = time[3 * k + 1];
    frame.contactTime = time[3 * k + 2];
    const auto from = static_cast<std::ptrdiff_t>(k * disks);
    const auto to = static_cast<std::ptrdiff_t>((k + 1) * disks);
    frame.position.assign(position.begin() + from, position.begin() + to);
    if (!spin.empty()) frame.spin.assign(spin.begin() + from, spin.begin() + to);
    if (counts[k] >= 0) frame.contacts = contacts.next(static_cast<std::size_t>(counts[k]));
    for (std::size_t b = k * bodies; b < (k + 1) * bodies; ++b) {
      BodySnapshot& body = frame.bodies.emplace_back();
      if (const Vec2 force(walls[3 * b], walls[3 * b + 1]); force.allFinite()) body.force = force;
      if (const double torque = walls[3 * b + 2]; std::isfinite(torque)) body.torque = torque;
    }
  }
  const std::size_t changes = yardstickChanges.size() * disks;
  const std::vector<double> responses = in.read("yardstick", lockstepTimes.size() * changes);
  for (std::size_t k = 0; k < lockstepTimes.size(); ++k) {
    const auto from = responses.begin() + static_cast<std::ptrdiff_t>(k * changes);
    window.responses.emplace_back(from, from + static_cast<std::ptrdiff_t>(changes));
  }
  return window;
}

KeptCollisions readSweep(const Arrays& in, const SweepHead& head) {
  KeptCollisions kept{head.name, head.variant, head.dt, head.refusal, in.read("psi"), {}, {}};
  kept.vn = in.read("vn", kept.psi.size());
  for (const std::string& quantity : head.quantities)
    for (const double value : in.readSome(quantity, kept.psi.size()))
      kept.values[quantity].push_back(std::isnan(value) ? std::nullopt : std::optional(value));
  return kept;
}

constexpr const char* makesOne = "; `crossgrain baseline CASE --out FILE` makes one";

template <typename Head>
Head readHead(const Hdf5File& in, const std::string& attribute) {
  const auto text = in.readTextAttribute(attribute);
  if (!text) throw FieldError(attribute + " is missing");
  try {
    return readAs<Head>(parseJson(*text));
  } catch (const NotJson& error) {
    throw FieldError(fmt::format("{} {}", attribute, error.what()));
  } catch (const FieldError& error) {
    throw FieldError(path(attribute, error));
  }
}

FlowState stateOf(const Hdf5File& in, const BaselineHead& head, std::size_t s) {
  FlowState state;
  state.start = head.starts[s];
  state.packing.disks = readStart({in, startGroup(s)});
  state.packing.wheelAngle = state.start.wheelAngle;
  state.packing.hash = contentHash(state.packing);
  if (state.packing.hash != head.hashes.at(s))
    throw FieldError(fmt::format("start {} is not what its hash says", s));
  return state;
}

Baseline readAll(const Hdf5File& in) {
  const auto head = readHead<BaselineHead>(in, "head");
  if (head.hashes.size() != head.starts.size())
    throw FieldError(
        fmt::format("head: {} hashes for {} starts", head.hashes.size(), head.starts.size()));
  Baseline baseline{head.version, head.setup, {}, {}};
  for (std::size_t s = 0; s < head.starts.size(); ++s)
    baseline.starts.push_back(stateOf(in, head, s));
  for (std::size_t e = 0; e < head.engines; ++e) {
    auto engine = readHead<BaselineEngineHead>(in, engineAttribute(e));
    std::vector<BaselineWindow> windows;
    for (std::size_t s = 0; s < head.starts.size(); ++s)
      windows.push_back(
          readWindow({in, windowGroup(e, s)}, baseline.starts[s].packing.disks.size()));
    std::vector<KeptCollisions> collisions;
    for (std::size_t k = 0; k < engine.sweeps.size(); ++k)
      collisions.push_back(readSweep({in, sweepGroup(e, k)}, engine.sweeps[k]));
    baseline.engines.push_back({std::move(engine.name), std::move(engine.version),
                                std::move(engine.can), std::move(engine.realised),
                                std::move(windows), std::move(collisions),
                                std::move(engine.endpoints)});
  }
  return baseline;
}

Baseline readBaselineFile(const std::filesystem::path& file) {
  const auto bad = [&](const std::string& what) {
    return BadInput(fmt::format("{}: {}", file.string(), what));
  };
  try {
    const Hdf5File in = Hdf5File::open(file);
    const auto schema = in.readTextAttribute("schema");
    if (!schema) throw bad(fmt::format("is no baseline{}", makesOne));
    if (*schema != baselineSchema)
      throw bad(
          fmt::format("has schema \"{}\", this crossgrain reads \"{}\"", *schema, baselineSchema));
    Baseline baseline = readAll(in);
    if (!in.isAsWritten()) throw FieldError("its content is not that of its checksum");
    return baseline;
  } catch (const FieldError& error) {
    throw bad(fmt::format("is damaged: {}", error.what()));
  } catch (const BadInput&) {
    throw;
  } catch (const std::exception& error) {  // what HDF5 makes of another file
    throw BadInput(error.what() + std::string(makesOne));
  }
}

}  // namespace

Baseline readBaseline(const std::filesystem::path& file) {
  tryReading(file, [&] { readBaselineFile(file); });
  return readBaselineFile(file);
}

}  // namespace crossgrain::inline runs
