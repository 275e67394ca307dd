#include "runs/baseline/baseline_file.hpp"

#include <cmath>
#include <cstdint>

#include "runs/baseline/baseline_heads.hpp"
#include "support/hdf5_file.hpp"

namespace crossgrain::inline runs {
namespace {

void append(std::vector<double>& numbers, const std::vector<Vec2>& vectors) {
  for (const Vec2& each : vectors) {
    numbers.push_back(each.x());
    numbers.push_back(each.y());
  }
}

std::vector<double> flat(const std::vector<Vec2>& vectors) {
  std::vector<double> numbers;
  append(numbers, vectors);
  return numbers;
}

void writeStart(Hdf5File& out, const std::string& group, const Disks& disks) {
  out.write(group + "radius", disks.radius);
  out.write(group + "mass", disks.mass);
  out.write(group + "inertia", disks.inertia);
  out.write(group + "position", flat(disks.position).data(), disks.size(), 2);
  out.write(group + "velocity", flat(disks.velocity).data(), disks.size(), 2);
  out.write(group + "spin", disks.spin);
}

/// Frames one after the other. What is absent of a wall is NaN there.
void writeWindow(Hdf5File& out, const std::string& group, const BaselineWindow& window) {
  std::vector<double> time, position, spin, normal, tangential, walls, responses;
  std::vector<std::int32_t> count, i, j, sliding;
  for (const LockstepFrame& frame : window.frames) {
    time.insert(time.end(), {frame.time, frame.velocityTime, frame.contactTime});
    append(position, frame.position);
    spin.insert(spin.end(), frame.spin.begin(), frame.spin.end());
    for (const BodySnapshot& body : frame.bodies) {
      const Vec2 force = body.force.value_or(Vec2(NAN, NAN));
      walls.insert(walls.end(), {force.x(), force.y(), body.torque.value_or(NAN)});
    }
    count.push_back(frame.contacts ? static_cast<std::int32_t>(frame.contacts->size()) : -1);
    if (!frame.contacts) continue;
    const Contacts& contacts = *frame.contacts;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      i.push_back(contacts.i[k]);
      j.push_back(contacts.j[k]);
      normal.push_back(contacts.normalForce[k]);
      tangential.push_back(contacts.tangentialForce[k]);
      sliding.push_back(contacts.sliding.empty() ? 0 : contacts.sliding[k]);
    }
  }
  for (const std::vector<double>& changes : window.responses)
    responses.insert(responses.end(), changes.begin(), changes.end());
  out.write(group + "time", time);
  out.write(group + "position", position);
  out.write(group + "spin", spin);
  out.write(group + "contacts", count);
  out.write(group + "i", i);
  out.write(group + "j", j);
  out.write(group + "normal_force", normal);
  out.write(group + "tangential_force", tangential);
  out.write(group + "sliding", sliding);
  out.write(group + "walls", walls);
  out.write(group + "yardstick", responses);
}

/// A value that is absent is NaN there.
SweepHead writeSweep(Hdf5File& out, const std::string& group, const KeptCollisions& kept) {
  SweepHead head{kept.name, kept.variant, kept.refusal, kept.dt, {}};
  out.write(group + "psi", kept.psi);
  out.write(group + "vn", kept.vn);
  for (const auto& [quantity, values] : kept.values) {
    std::vector<double> numbers;
    for (const auto& value : values) numbers.push_back(value.value_or(NAN));
    out.write(group + quantity, numbers);
    head.quantities.push_back(quantity);
  }
  return head;
}

}  // namespace

void writeBaseline(const Baseline& baseline, const std::filesystem::path& file) {
  BaselineHead head{baseline.version, baseline.setup, {}, {}, baseline.engines.size()};
  Hdf5File out = Hdf5File::create(file);
  for (std::size_t s = 0; s < baseline.starts.size(); ++s) {
    head.starts.push_back(baseline.starts[s].start);
    head.hashes.push_back(contentHash(baseline.starts[s].packing));
    writeStart(out, startGroup(s), baseline.starts[s].packing.disks);
  }
  out.writeAttribute("schema", baselineSchema);
  out.writeAttribute("head", jsonOf(head).dump());
  for (std::size_t e = 0; e < baseline.engines.size(); ++e) {
    const BaselineEngine& engine = baseline.engines[e];
    BaselineEngineHead own{engine.name, engine.version,  engine.can, engine.realised,
                           {},          engine.endpoints};
    for (std::size_t k = 0; k < engine.collisions.size(); ++k)
      own.sweeps.push_back(writeSweep(out, sweepGroup(e, k), engine.collisions[k]));
    out.writeAttribute(engineAttribute(e), jsonOf(own).dump());
    for (std::size_t s = 0; s < engine.windows.size(); ++s)
      writeWindow(out, windowGroup(e, s), engine.windows[s]);
  }
  out.writeChecksum();
  out.save();
}

}  // namespace crossgrain::inline runs
