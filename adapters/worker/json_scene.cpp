#include "adapters/worker/json.hpp"

#include <stdexcept>

#include "adapters/law_options.hpp"
#include "adapters/worker/json_names.hpp"

namespace crossgrain {
namespace {

using nlohmann::json;

json pairOf(const Vec2& v) {
  return json::array({v.x(), v.y()});
}

Vec2 vec2From(const json& pair) {
  if (pair.size() != 2) throw std::runtime_error(fmt::format("{} is not [x, y]", pair.dump()));
  return {pair.at(0).get<double>(), pair.at(1).get<double>()};
}

json toJson(const ContactLaw& law) {
  json out;
  for (const LawConstant& constant : lawConstants())
    out[std::string(constant.name)] = law.*constant.value;
  for (const LawOption& option : lawOptions())
    out[std::string(option.name)] = lawOptionValue(law, option.name);
  return out;
}

ContactLaw lawFromJson(const json& in) {
  ContactLaw law;
  for (const LawConstant& constant : lawConstants())
    law.*constant.value = in.at(std::string(constant.name));
  for (const LawOption& option : lawOptions())
    setLawOption(law, option.name, in.at(std::string(option.name)).get<std::string>());
  return law;
}

json toJson(const Motion& motion) {
  return {{"kind", nameOf(motion.kind, motionNames)},
          {"angular_velocity", motion.angularVelocity},
          {"velocity", pairOf(motion.velocity)},
          {"amplitude", pairOf(motion.amplitude)},
          {"frequency", motion.frequency},
          {"radial_velocity", motion.radialVelocity},
          {"radial_end", motion.radialEnd}};
}

Motion motionFromJson(const json& in) {
  Motion motion;
  motion.kind = valueOf<Motion::Kind>(in.at("kind"), motionNames);
  motion.angularVelocity = in.at("angular_velocity");
  motion.velocity = vec2From(in.at("velocity"));
  motion.amplitude = vec2From(in.at("amplitude"));
  motion.frequency = in.at("frequency");
  motion.radialVelocity = in.at("radial_velocity");
  motion.radialEnd = in.at("radial_end");
  return motion;
}

json toJson(const BottomPlate& plate) {
  return {{"mu", plate.mu},      {"kb", plate.kb},           {"gb", plate.gb},
          {"tau_m", plate.tauM}, {"gravity", plate.gravity}, {"spin", plate.spin}};
}

BottomPlate bottomFromJson(const json& in) {
  return {in.at("mu"), in.at("kb"), in.at("gb"), in.at("tau_m"), in.at("gravity"), in.at("spin")};
}

std::string bodyArray(std::size_t body, const char* what) {
  return fmt::format("bodies.{}.{}", body, what);
}

/// For each disk or wall that contacts can be of. Disks that do not overlap much have three in the
/// mean, since lines that join neighbours do not cross; more than this is no packing, and is not
/// read.
constexpr std::size_t mostContacts = 100;

Contacts contactsFrom(const ArrayReader& arrays, std::size_t ids) {
  const std::size_t count = arrays.count("contacts.i"), most = mostContacts * ids;
  if (count > most)
    throw std::runtime_error(
        fmt::format("it lists {} contacts, more than {} of {} bodies", count, most, ids));
  Contacts contacts;
  contacts.i = arrays.i32("contacts.i", count);
  contacts.j = arrays.i32("contacts.j", count);
  contacts.normal = arrays.vec2("contacts.normal", count);
  contacts.overlap = arrays.f64("contacts.overlap", count);
  contacts.normalForce = arrays.f64("contacts.normal_force", count);
  contacts.tangentialForce = arrays.f64("contacts.tangential_force", count);
  if (arrays.has("contacts.sliding")) contacts.sliding = arrays.u8("contacts.sliding", count);
  for (std::size_t k = 0; k < count; ++k)
    if (contacts.i[k] < 0 || contacts.i[k] >= contacts.j[k] ||
        static_cast<std::size_t>(contacts.j[k]) >= ids)
      throw std::runtime_error(fmt::format("contact {} is of {} and {}, not of 0 ≤ i < j < {}", k,
                                           contacts.i[k], contacts.j[k], ids));
  return contacts;
}

BodySnapshot bodySnapshotFrom(const json& in) {
  BodySnapshot body;
  body.centre = vec2From(in.at("centre"));
  body.angle = in.at("angle");
  body.velocity = vec2From(in.at("velocity"));
  body.angularVelocity = in.at("angular_velocity");
  if (in.contains("force")) body.force = vec2From(in.at("force"));
  if (in.contains("torque")) body.torque = in.at("torque").get<double>();
  return body;
}

EnergyLedger ledgerFrom(const json& in) {
  EnergyLedger ledger;
  for (const LedgerTerm& term : ledgerTerms) ledger.*term.value = in.at(std::string(term.name));
  return ledger;
}

}  // namespace

json toJson(const Scene& scene, ArrayWriter& arrays) {
  arrays.add("disks.radius", scene.disks.radius);
  arrays.add("disks.mass", scene.disks.mass);
  arrays.add("disks.inertia", scene.disks.inertia);
  arrays.add("disks.position", scene.disks.position);
  arrays.add("disks.velocity", scene.disks.velocity);
  arrays.add("disks.spin", scene.disks.spin);

  json bodies = json::array();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const WallBody& body = scene.bodies[b];
    arrays.add(bodyArray(b, "disk_position"), body.diskPosition);
    arrays.add(bodyArray(b, "disk_radius"), body.diskRadius);
    json planes = json::array();
    for (const Plane& plane : body.planes)
      planes.push_back({{"point", pairOf(plane.point)}, {"normal", pairOf(plane.normal)}});
    bodies.push_back({{"name", body.name},
                      {"centre", pairOf(body.centre)},
                      {"disks", body.diskRadius.size()},
                      {"planes", planes},
                      {"motion", toJson(body.motion)}});
  }

  json out = {{"name", scene.name},
              {"disks", scene.disks.size()},
              {"bodies", bodies},
              {"law", toJson(scene.law)},
              {"gravity", pairOf(scene.gravity)},
              {"rotation", scene.rotation},
              {"precision", toString(scene.precision)},
              {"dt", scene.dt},
              {"energy_ledger", scene.energyLedger}};
  if (scene.bottom) out["bottom"] = toJson(*scene.bottom);
  return out;
}

Scene sceneFromJson(const json& in, const ArrayReader& arrays) {
  Scene scene;
  scene.name = in.at("name");
  const std::size_t count = in.at("disks");
  scene.disks.radius = arrays.f64("disks.radius", count);
  scene.disks.mass = arrays.f64("disks.mass", count);
  scene.disks.inertia = arrays.f64("disks.inertia", count);
  scene.disks.position = arrays.vec2("disks.position", count);
  scene.disks.velocity = arrays.vec2("disks.velocity", count);
  scene.disks.spin = arrays.f64("disks.spin", count);

  for (const json& item : in.at("bodies")) {
    const std::size_t b = scene.bodies.size();
    WallBody& body = scene.bodies.emplace_back();
    body.name = item.at("name");
    body.centre = vec2From(item.at("centre"));
    body.diskPosition = arrays.vec2(bodyArray(b, "disk_position"), item.at("disks"));
    body.diskRadius = arrays.f64(bodyArray(b, "disk_radius"), item.at("disks"));
    for (const json& plane : item.at("planes"))
      body.planes.push_back({vec2From(plane.at("point")), vec2From(plane.at("normal"))});
    body.motion = motionFromJson(item.at("motion"));
  }

  scene.law = lawFromJson(in.at("law"));
  if (in.contains("bottom")) scene.bottom = bottomFromJson(in.at("bottom"));
  scene.gravity = vec2From(in.at("gravity"));
  scene.rotation = in.at("rotation");
  scene.precision = valueOf<Precision>(in.at("precision"), precisionNames);
  scene.dt = in.at("dt");
  scene.energyLedger = in.value("energy_ledger", false);
  return scene;
}

json toJson(const Snapshot& snapshot, ArrayWriter& arrays) {
  json out = {{"position_time", snapshot.positionTime},
              {"velocity_time", snapshot.velocityTime},
              {"contact_time", snapshot.contactTime},
              {"contact_interval", snapshot.contactInterval},
              {"bodies", json::array()}};
  arrays.add("position", snapshot.position);
  arrays.add("velocity", snapshot.velocity);
  if (snapshot.spin) arrays.add("spin", *snapshot.spin);
  arrays.add("wall_position", snapshot.wallPosition);

  for (const BodySnapshot& body : snapshot.bodies) {
    json item = {{"centre", pairOf(body.centre)},
                 {"angle", body.angle},
                 {"velocity", pairOf(body.velocity)},
                 {"angular_velocity", body.angularVelocity}};
    if (body.force) item["force"] = pairOf(*body.force);
    if (body.torque) item["torque"] = *body.torque;
    out["bodies"].push_back(item);
  }

  if (const auto& contacts = snapshot.contacts) {
    arrays.add("contacts.i", contacts->i);
    arrays.add("contacts.j", contacts->j);
    arrays.add("contacts.normal", contacts->normal);
    arrays.add("contacts.overlap", contacts->overlap);
    arrays.add("contacts.normal_force", contacts->normalForce);
    arrays.add("contacts.tangential_force", contacts->tangentialForce);
    if (!contacts->sliding.empty()) arrays.add("contacts.sliding", contacts->sliding);
  }
  if (snapshot.energies)
    out["energies"] = {{"kinetic", snapshot.energies->kinetic},
                       {"elastic", snapshot.energies->elastic}};
  if (snapshot.ledger)
    for (const LedgerTerm& term : ledgerTerms)
      out["energy_ledger"][std::string(term.name)] = *snapshot.ledger.*term.value;
  return out;
}

Snapshot snapshotFromJson(const json& in, const ArrayReader& arrays, const Scene& scene) {
  Snapshot snapshot;
  snapshot.positionTime = in.at("position_time");
  snapshot.velocityTime = in.at("velocity_time");
  snapshot.contactTime = in.at("contact_time");
  snapshot.contactInterval = in.at("contact_interval");

  const std::size_t disks = scene.disks.size();
  const std::size_t wallDisks = scene.wallDiskCount();
  snapshot.position = arrays.vec2("position", disks);
  snapshot.velocity = arrays.vec2("velocity", disks);
  if (arrays.has("spin")) snapshot.spin = arrays.f64("spin", disks);
  snapshot.wallPosition = arrays.vec2("wall_position", wallDisks);

  for (const json& body : in.at("bodies")) snapshot.bodies.push_back(bodySnapshotFrom(body));
  if (snapshot.bodies.size() != scene.bodies.size())
    throw std::runtime_error(fmt::format("it has {} wall bodies, the scene {}",
                                         snapshot.bodies.size(), scene.bodies.size()));

  if (arrays.has("contacts.i"))
    snapshot.contacts = contactsFrom(arrays, disks + wallDisks + scene.planeCount());
  if (in.contains("energies"))
    snapshot.energies = {in.at("energies").at("kinetic"), in.at("energies").at("elastic")};
  if (in.contains("energy_ledger")) snapshot.ledger = ledgerFrom(in.at("energy_ledger"));
  return snapshot;
}

}  // namespace crossgrain
