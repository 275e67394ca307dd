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

template <int D>
void fields(auto& io, MotionOf<D>& motion) {
  REQUIRED_FIELDS(io, motion.kind, motion.angularVelocity, motion.velocity, motion.amplitude,
                  motion.frequency, motion.radialVelocity, motion.radialEnd);
}

void fields(auto& io, BottomPlate& plate) {
  REQUIRED_FIELDS(io, plate.mu, plate.kb, plate.gb, plate.tauM, plate.gravity, plate.spin);
}

template <int D>
void fields(auto& io, PlaneOf<D>& plane) {
  REQUIRED_FIELDS(io, plane.point, plane.normal);
}

void fields(auto& io, Cylinder& cylinder) {
  REQUIRED_FIELDS(io, cylinder.point, cylinder.axis, cylinder.radius);
}

template <int D>
void fields(auto& io, ShapeOf<D>& shape) {
  REQUIRED_FIELDS(io, shape.kind, shape.vertices, shape.rounding);
}

template <int D>
void fields(auto& io, WallBodyOf<D>& body) {
  REQUIRED_FIELDS(io, body.name, body.centre, body.planes);
  io.when(!body.cylinders.empty(), "cylinders", body.cylinders);
  io.required("motion", body.motion);
}

template <int D>
void fields(auto& io, BoxOf<D>& box) {
  REQUIRED_FIELDS(io, box.low, box.high, box.periodic);
}

void fields(auto& io, Materials& materials) {
  REQUIRED_FIELDS(io, materials.names, materials.ofBody, materials.laws);
}

template <int D>
void fields(auto& io, SceneOf<D>& scene) {
  int dimension = D;
  io.when(D == 3, "dimension", dimension);
  io.required("name", scene.name);
  io.when(!scene.shapes.empty(), "shapes", scene.shapes);
  REQUIRED_FIELDS(io, scene.bodies, scene.law);
  PRESENT_FIELDS(io, scene.materials, scene.bottom, scene.box);
  REQUIRED_FIELDS(io, scene.gravity, scene.rotation, scene.precision, scene.dt);
  io("energy_ledger", scene.energyLedger);
}

template <int D>
void fields(auto& io, BodySnapshotOf<D>& body) {
  REQUIRED_FIELDS(io, body.centre, body.angle, body.velocity, body.angularVelocity);
  PRESENT_FIELDS(io, body.force, body.torque);
}

void fields(auto& io, Energies& energies) {
  REQUIRED_FIELDS(io, energies.kinetic, energies.elastic);
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

template <int D>
void fields(auto& io, SnapshotOf<D>& snapshot) {
  REQUIRED_FIELDS(io, snapshot.positionTime, snapshot.velocityTime, snapshot.contactTime,
                  snapshot.contactInterval, snapshot.bodies);
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
  template <int N>
  void operator()(const std::string& name, std::vector<VecOf<N>>& list, std::size_t count) const {
    list = arrays.vectors<N>(name, count);
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

/// Of scenes with convex bodies.
template <int D>
void shapeLists(const auto& io, auto& disks, std::size_t count) {
  io("disks.shape", disks.shape, count);
  io("disks.turn", disks.turn, count);
  if constexpr (D == 3) io("disks.moments", disks.moments, count);
}

void bodyLists(const auto& io, auto& body, std::size_t index, std::size_t count) {
  io(fmt::format("bodies.{}.disk_position", index), body.diskPosition, count);
  io(fmt::format("bodies.{}.disk_radius", index), body.diskRadius, count);
}

void snapshotLists(const auto& io, auto& snapshot, std::size_t disks, std::size_t wallDisks) {
  io("position", snapshot.position, disks);
  io("velocity", snapshot.velocity, disks);
  io.present("spin", snapshot.spin, disks);
  io.present("turn", snapshot.turn, disks);
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
template <int D>
void optionalContactLists(const auto& visit) {
  visit("contacts.rolling_torque", &ContactsOf<D>::rollingTorque);
  visit("contacts.dissipation", &ContactsOf<D>::dissipation);
  visit("contacts.point", &ContactsOf<D>::point);
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

template <int D>
ContactsOf<D> contactsFrom(const ArrayReader& arrays, std::size_t ids) {
  const std::size_t count = arrays.count("contacts.i"), most = mostContacts * ids;
  if (count > most)
    throw std::runtime_error(
        fmt::format("it lists {} contacts, more than {} of {} bodies", count, most, ids));
  ContactsOf<D> contacts;
  const ListReader reader{arrays};
  contactLists(reader, contacts, count);
  if (arrays.has("contacts.sliding")) contacts.sliding = arrays.u8("contacts.sliding", count);
  optionalContactLists<D>([&](const char* name, auto list) {
    if (arrays.has(name)) reader(name, contacts.*list, count);
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

template <int D>
Json toJson(const SceneOf<D>& scene, ArrayWriter& arrays) {
  Json out = jsonOf(scene);
  const ListWriter writer{arrays};
  lists(writer, scene.disks, 0);
  if (!scene.disks.areRound()) shapeLists<D>(writer, scene.disks, 0);
  if (scene.materials) writer("disks.material", scene.materials->ofDisk, 0);
  out["disks"] = scene.disks.size();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    bodyLists(writer, scene.bodies[b], b, 0);
    out["bodies"][b]["disks"] = scene.bodies[b].diskRadius.size();
  }
  return out;
}

template Json toJson<2>(const Scene&, ArrayWriter&);
template Json toJson<3>(const SpaceScene&, ArrayWriter&);

int dimensionOf(const Json& in) {
  const int dimension = in.contains("dimension") ? member<int>(in, "dimension") : 2;
  if (dimension != 2 && dimension != 3)
    throw FieldError(fmt::format("dimension is {}, not 2 or 3", dimension));
  return dimension;
}

template <int D>
SceneOf<D> sceneFromJson(const Json& in, const ArrayReader& arrays) {
  auto scene = readAs<SceneOf<D>>(in);
  changeLaws(scene, [](ContactLaw& law) { law.dimension = D; });
  const ListReader reader{arrays};
  const auto disks = member<std::size_t>(in, "disks");
  lists(reader, scene.disks, disks);
  if (!scene.shapes.empty()) {
    shapeLists<D>(reader, scene.disks, disks);
    const auto count = static_cast<std::int32_t>(scene.shapes.size());
    if (!std::ranges::all_of(scene.disks.shape, [&](auto k) { return k >= -1 && k < count; }))
      throw std::runtime_error("disks.shape: is of a shape that the scene does not have");
  }
  if (auto& materials = scene.materials) {
    reader("disks.material", materials->ofDisk, disks);
    checkMaterials(*materials, scene.bodies.size());
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    bodyLists(reader, scene.bodies[b], b, member<std::size_t>(in.at("bodies")[b], "disks"));
  return scene;
}

template Scene sceneFromJson<2>(const Json&, const ArrayReader&);
template SpaceScene sceneFromJson<3>(const Json&, const ArrayReader&);

template <int D>
Json toJson(const SnapshotOf<D>& snapshot, ArrayWriter& arrays) {
  const ListWriter writer{arrays};
  snapshotLists(writer, snapshot, 0, 0);
  if (const auto& contacts = snapshot.contacts) {
    contactLists(writer, *contacts, 0);
    if (!contacts->sliding.empty()) arrays.add("contacts.sliding", contacts->sliding);
    optionalContactLists<D>([&](const char* name, auto list) {
      if (const auto& values = *contacts.*list; !values.empty()) arrays.add(name, values);
    });
  }
  return jsonOf(snapshot);
}

template Json toJson<2>(const Snapshot&, ArrayWriter&);
template Json toJson<3>(const SpaceSnapshot&, ArrayWriter&);

template <int D>
SnapshotOf<D> snapshotFromJson(const Json& in, const ArrayReader& arrays, const SceneOf<D>& scene) {
  auto snapshot = readAs<SnapshotOf<D>>(in);
  const std::size_t disks = scene.disks.size(), wallDisks = scene.wallDiskCount();
  snapshotLists(ListReader{arrays}, snapshot, disks, wallDisks);
  if (snapshot.bodies.size() != scene.bodies.size())
    throw std::runtime_error(fmt::format("it has {} wall bodies, the scene {}",
                                         snapshot.bodies.size(), scene.bodies.size()));
  if (arrays.has("contacts.i")) snapshot.contacts = contactsFrom<D>(arrays, scene.idCount());
  return snapshot;
}

template Snapshot snapshotFromJson<2>(const Json&, const ArrayReader&, const Scene&);
template SpaceSnapshot snapshotFromJson<3>(const Json&, const ArrayReader&, const SpaceScene&);

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
