#include "adapters/worker/json.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "support/json_text.hpp"

namespace crossgrain {
namespace {

/// For each disk or wall that contacts can be of. Disks that do not overlap much have three in the
/// mean, since lines that join neighbours do not cross; more than this is no packing, and is not
/// read.
constexpr std::size_t mostContacts = 100;

}  // namespace

void fields(auto& io, ContactLaw& law) {
  for (const LawConstant& constant : lawConstants())
    if (constant.part == LawPart::contact)
      io.required(constant.name.data(), law.*constant.value);
    else
      io.when(hasPart(law, constant.part), constant.name.data(), law.*constant.value);
  for (const LawOption& option : lawOptions()) {
    std::string value = lawOptionValue(law, option.name);
    if (option.part == LawPart::contact)
      io.required(option.name.data(), value);
    else
      io.when(hasPart(law, option.part), option.name.data(), value);
    if (io.reading) setLawOption(law, option.name, value);
  }
}

void fields(auto& io, Motion& motion) {
  io.required("kind", motion.kind);
  io.required("angular_velocity", motion.angularVelocity);
  io.required("velocity", motion.velocity);
  io.required("amplitude", motion.amplitude);
  io.required("frequency", motion.frequency);
  io.required("radial_velocity", motion.radialVelocity);
  io.required("radial_end", motion.radialEnd);
}

void fields(auto& io, BottomPlate& plate) {
  io.required("mu", plate.mu);
  io.required("kb", plate.kb);
  io.required("gb", plate.gb);
  io.required("tau_m", plate.tauM);
  io.required("gravity", plate.gravity);
  io.required("spin", plate.spin);
}

void fields(auto& io, Plane& plane) {
  io.required("point", plane.point);
  io.required("normal", plane.normal);
}

void fields(auto& io, WallBody& body) {
  io.required("name", body.name);
  io.required("centre", body.centre);
  io.required("planes", body.planes);
  io.required("motion", body.motion);
}

void fields(auto& io, Materials& materials) {
  io.required("names", materials.names);
  io.required("of_body", materials.ofBody);
  io.required("laws", materials.laws);
}

void fields(auto& io, Scene& scene) {
  io.required("name", scene.name);
  io.required("bodies", scene.bodies);
  io.required("law", scene.law);
  io.present("materials", scene.materials);
  io.present("bottom", scene.bottom);
  io.required("gravity", scene.gravity);
  io.required("rotation", scene.rotation);
  io.required("precision", scene.precision);
  io.required("dt", scene.dt);
  io("energy_ledger", scene.energyLedger);
}

void fields(auto& io, BodySnapshot& body) {
  io.required("centre", body.centre);
  io.required("angle", body.angle);
  io.required("velocity", body.velocity);
  io.required("angular_velocity", body.angularVelocity);
  io.present("force", body.force);
  io.present("torque", body.torque);
}

void fields(auto& io, Energies& energies) {
  io.required("kinetic", energies.kinetic);
  io.required("elastic", energies.elastic);
}

void fields(auto& io, EnergyLedger& ledger) {
  for (std::size_t k = 0; k < ledgerTerms.size(); ++k) {
    const auto& [name, value, sign] = ledgerTerms[k];
    if (k < commonLedgerTerms)
      io.required(name.data(), ledger.*value);
    else
      io.when(ledger.*value != 0.0, name.data(), ledger.*value);
  }
}

void fields(auto& io, Snapshot& snapshot) {
  io.required("position_time", snapshot.positionTime);
  io.required("velocity_time", snapshot.velocityTime);
  io.required("contact_time", snapshot.contactTime);
  io.required("contact_interval", snapshot.contactInterval);
  io.required("bodies", snapshot.bodies);
  io.present("energies", snapshot.energies);
  io.present("energy_ledger", snapshot.ledger);
}

namespace {

/// Lists go to an array file …
struct ListWriter {
  ArrayWriter& arrays;
  void operator()(const std::string& name, const auto& list, std::size_t) const {
    arrays.add(name, list);
  }
  template <typename List>
  void present(const std::string& name, const std::optional<List>& list, std::size_t) const {
    if (list) arrays.add(name, *list);
  }
};

/// … and come from it, with so many elements.
struct ListReader {
  const ArrayReader& arrays;
  void operator()(const std::string& name, std::vector<double>& list, std::size_t count) const {
    list = arrays.f64(name, count);
  }
  void operator()(const std::string& name, std::vector<Vec2>& list, std::size_t count) const {
    list = arrays.vec2(name, count);
  }
  void operator()(const std::string& name, std::vector<std::int32_t>& list,
                  std::size_t count) const {
    list = arrays.i32(name, count);
  }
  template <typename List>
  void present(const std::string& name, std::optional<List>& list, std::size_t count) const {
    if (arrays.has(name)) (*this)(name, list.emplace(), count);
  }
};

void lists(const auto& io, auto& disks, std::size_t count) {
  io("disks.radius", disks.radius, count);
  io("disks.mass", disks.mass, count);
  io("disks.inertia", disks.inertia, count);
  io("disks.position", disks.position, count);
  io("disks.velocity", disks.velocity, count);
  io("disks.spin", disks.spin, count);
}

void bodyLists(const auto& io, auto& body, std::size_t index, std::size_t count) {
  io(fmt::format("bodies.{}.disk_position", index), body.diskPosition, count);
  io(fmt::format("bodies.{}.disk_radius", index), body.diskRadius, count);
}

void snapshotLists(const auto& io, auto& snapshot, std::size_t disks, std::size_t wallDisks) {
  io("position", snapshot.position, disks);
  io("velocity", snapshot.velocity, disks);
  io.present("spin", snapshot.spin, disks);
  io("wall_position", snapshot.wallPosition, wallDisks);
}

void contactLists(const auto& io, auto& contacts, std::size_t count) {
  io("contacts.i", contacts.i, count);
  io("contacts.j", contacts.j, count);
  io("contacts.normal", contacts.normal, count);
  io("contacts.overlap", contacts.overlap, count);
  io("contacts.normal_force", contacts.normalForce, count);
  io("contacts.tangential_force", contacts.tangentialForce, count);
}

/// Lists of contacts that an engine need not have: empty without.
void optionalContactLists(const auto& visit) {
  visit("contacts.rolling_torque", &Contacts::rollingTorque);
  visit("contacts.dissipation", &Contacts::dissipation);
}

/// @throws std::runtime_error unless every body is of one of the materials, every two of which have
///         a law
void checkMaterials(const Materials& materials, std::size_t bodies) {
  const std::size_t count = materials.names.size();
  const auto among = [&](std::int32_t one) {
    return one >= 0 && static_cast<std::size_t>(one) < count;
  };
  if (materials.ofBody.size() != bodies || materials.laws.size() != count * count ||
      !std::ranges::all_of(materials.ofBody, among) ||
      !std::ranges::all_of(materials.ofDisk, among))
    throw std::runtime_error(
        fmt::format("materials: are not {0} with a law for each two of them and a material of each "
                    "body",
                    count));
}

Contacts contactsFrom(const ArrayReader& arrays, std::size_t ids) {
  const std::size_t count = arrays.count("contacts.i"), most = mostContacts * ids;
  if (count > most)
    throw std::runtime_error(
        fmt::format("it lists {} contacts, more than {} of {} bodies", count, most, ids));
  Contacts contacts;
  contactLists(ListReader{arrays}, contacts, count);
  if (arrays.has("contacts.sliding")) contacts.sliding = arrays.u8("contacts.sliding", count);
  optionalContactLists([&](const char* name, auto list) {
    if (arrays.has(name)) contacts.*list = arrays.f64(name, count);
  });
  for (std::size_t k = 0; k < count; ++k)
    if (contacts.i[k] < 0 || contacts.i[k] >= contacts.j[k] ||
        static_cast<std::size_t>(contacts.j[k]) >= ids)
      throw std::runtime_error(fmt::format("contact {} is of {} and {}, not of 0 ≤ i < j < {}", k,
                                           contacts.i[k], contacts.j[k], ids));
  return contacts;
}

/// A count: converted as it is −1 would be 2⁶⁴ − 1, in silence.
std::uint64_t countFrom(const Json& in, const char* key) {
  constexpr double most = 9007199254740992.0;  // 2⁵³: beyond it numbers of JSON have gaps
  const Json& value = in.at(key);
  const double number = value.is_number() ? value.get<double>() : -1.0;
  if (!(number >= 0.0 && number <= most && number == std::floor(number)))
    throw FieldError(fmt::format("{} is {}, not a whole number ≥ 0", key, value.dump()));
  return static_cast<std::uint64_t>(number);
}

/// @throws std::exception naming a time that no clock shows
double secondsFrom(const Json& in, const char* key) {
  const auto seconds = member<double>(in, key);
  if (!(seconds >= 0.0)) throw FieldError(fmt::format("{} is {} s", key, seconds));
  return seconds;
}

}  // namespace

Json toJson(const Scene& scene, ArrayWriter& arrays) {
  Json out = jsonOf(scene);
  const ListWriter writer{arrays};
  lists(writer, scene.disks, 0);
  if (scene.materials) writer("disks.material", scene.materials->ofDisk, 0);
  out["disks"] = scene.disks.size();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    bodyLists(writer, scene.bodies[b], b, 0);
    out["bodies"][b]["disks"] = scene.bodies[b].diskRadius.size();
  }
  return out;
}

Scene sceneFromJson(const Json& in, const ArrayReader& arrays) {
  auto scene = readAs<Scene>(in);
  const ListReader reader{arrays};
  const auto disks = member<std::size_t>(in, "disks");
  lists(reader, scene.disks, disks);
  if (auto& materials = scene.materials) {
    reader("disks.material", materials->ofDisk, disks);
    checkMaterials(*materials, scene.bodies.size());
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    bodyLists(reader, scene.bodies[b], b, member<std::size_t>(in.at("bodies")[b], "disks"));
  return scene;
}

Json toJson(const Snapshot& snapshot, ArrayWriter& arrays) {
  const ListWriter writer{arrays};
  snapshotLists(writer, snapshot, 0, 0);
  if (const auto& contacts = snapshot.contacts) {
    contactLists(writer, *contacts, 0);
    if (!contacts->sliding.empty()) arrays.add("contacts.sliding", contacts->sliding);
    optionalContactLists([&](const char* name, auto list) {
      if (const auto& values = *contacts.*list; !values.empty()) arrays.add(name, values);
    });
  }
  return jsonOf(snapshot);
}

Snapshot snapshotFromJson(const Json& in, const ArrayReader& arrays, const Scene& scene) {
  auto snapshot = readAs<Snapshot>(in);
  const std::size_t disks = scene.disks.size(), wallDisks = scene.wallDiskCount();
  snapshotLists(ListReader{arrays}, snapshot, disks, wallDisks);
  if (snapshot.bodies.size() != scene.bodies.size())
    throw std::runtime_error(fmt::format("it has {} wall bodies, the scene {}",
                                         snapshot.bodies.size(), scene.bodies.size()));
  if (arrays.has("contacts.i"))
    snapshot.contacts = contactsFrom(arrays, disks + wallDisks + scene.planeCount());
  return snapshot;
}

void checkLawOptions(const Capabilities& can) {
  ContactLaw law;
  for (const auto& [name, values] : can.lawOptions) {
    if (values.empty()) throw FieldError(fmt::format("law_options: {} has no value", name));
    for (const std::string& value : values) {
      try {
        setLawOption(law, name, value);
      } catch (const std::invalid_argument& error) {
        throw FieldError(fmt::format("law_options: {}", error.what()));
      }
    }
  }
}

// Results write and read the times of a clock under other names.
Json toJson(const Stats& stats) {
  return {{"steps", stats.steps},
          {"contact_evaluations", stats.contactEvaluations},
          {"wall_seconds", stats.wallSeconds},
          {"cpu_seconds", stats.cpuSeconds},
          {"counters", stats.counters}};
}

Stats statsFromJson(const Json& in) {
  return {countFrom(in, "steps"), countFrom(in, "contact_evaluations"),
          secondsFrom(in, "wall_seconds"), secondsFrom(in, "cpu_seconds"),
          member<decltype(Stats::counters)>(in, "counters")};
}

}  // namespace crossgrain
