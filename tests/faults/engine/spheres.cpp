// The same in space: a worker of soft spheres in a box, periodic where it is to be, and between
// walls of spheres, planes and cylinders, that is right but for what is planted. It knows no plane.
//
//     planted_spheres [NAME=VALUE …]      names: SpaceFaults

#include "spheres.hpp"

#include "checkpoint.hpp"

namespace crossgrain::planted {
namespace {

using crossgrain_worker::ArrayFile;
using crossgrain_worker::StepCount;

class PlantedSpheres {
 public:
  explicit PlantedSpheres(const SpaceFaults& faults) : faults_(faults) {}

  Json capabilities() const {
    Json effects;
    for (const char* name :
         {"normal_damping", "friction", "tangential_spring", "tangential_damping", "rotation",
          "gravity", "rolling_resistance", "moving_walls", "cohesion"})
      effects[name] = "optional";
    const auto only = [](const char* value) { return Json::array({value}); };
    Json settings = Json::array();
    if (faults_.stepSetting != 0.0)
      settings.push_back({{"name", "dt"},
                          {"default", 0.0},
                          {"unit", "s"},
                          {"doc", "time step; 0: the scene's own"},
                          {"choices", Json::array()}});
    return {{"version", "1"},
            {"dimensions", {3}},
            {"periodic", true},
            {"effects", effects},
            {"law_options",
             {{"normal", {"linear", "hertz"}},
              {"damper", only("constant")},
              {"tangential", {"none", "spring", "spring_dashpot"}},
              {"tension", only("allow")},
              {"coulomb_bound", only("compression")},
              {"dashpot", only("inside")},
              {"spring_reset", only("total")},
              {"spring_update", only("before")},
              {"lever_arm", only("overlap_middle")},
              {"velocity_arm", only("lever_arm")},
              {"plane_arm", only("middle")},
              {"damping_velocity", only("lagged")},
              {"integrator", only("position_verlet")},
              {"rolling", {"none", "spring"}},
              {"rolling_length", only("effective")},
              {"rolling_stiffness", only("length_square")},
              {"rolling_damper", only("constant")},
              {"rolling_load", only("compression")},
              {"rolling_dashpot", only("inside")},
              {"rolling_reset", only("total")},
              {"spring_turn", only("rotated")},
              {"spring_twist", {"mean_spin", "none"}},
              {"history", only("displacement")},
              {"cohesion", {"none", "dmt"}},
              {"cohesion_load", only("without_pull")}}},
            {"cylinders", true},
            {"precisions", only(precision())},
            {"instant_contacts", true},
            {"accumulated_contacts", false},
            {"warm_handover", false},
            {"checkpoints", true},
            {"sliding_flags", true},
            {"settings", settings}};
  }

  const char* precision() const { return faults_.floatState == 0.0 ? "double" : "float"; }

  Json load(const Json& scene, const Arrays& arrays, const Json& settings) {
    const std::string normal = scene.at("law").at("normal");
    if (normal != "linear" && normal != "hertz")
      throw crossgrain_worker::Unsupported("has only normal = linear | hertz");
    evaluations_ = 0;
    double dt = settings.value("dt", 0.0);
    if (dt == 0.0) dt = scene.at("dt");
    const double used = faults_.stepSetting < 0.0 ? scene.at("dt").get<double>() : dt;
    spheres_.assign(1, Spheres(scene, arrays, faults_, used));
    dt_ = dt;
    count_ = StepCount(dt);
    const Json& law = scene.at("law");
    Json effects = Json::array();
    const bool friction = law.at("tangential") != "none" && law.at("mu") > 0.0;
    const bool rolls = law.value("rolling", "none") != "none";
    if (friction) {
      effects.push_back("friction");
      effects.push_back("tangential_spring");
    }
    if (law.at("gn") > 0.0) effects.push_back("normal_damping");
    if (friction && law.at("tangential") == "spring_dashpot" && law.at("gt") > 0.0)
      effects.push_back("tangential_damping");
    if (scene.at("rotation") && (friction || rolls)) effects.push_back("rotation");
    if (rolls) effects.push_back("rolling_resistance");
    if (law.value("cohesion", "none") != "none") effects.push_back("cohesion");
    if (scene.at("gravity") != Json({0.0, 0.0, 0.0})) effects.push_back("gravity");
    for (const Json& body : scene.at("bodies"))
      if (body.at("motion").at("kind") != "fixed") {
        effects.push_back("moving_walls");
        break;
      }
    return {{"engine", "planted_spheres"},
            {"version", "1"},
            {"dt", dt},
            {"precision", precision()},
            {"effects", effects},
            {"integrator", "position_verlet"},
            {"pairs", Json::array()},
            {"deviations", Json::array()}};
  }

  double advance(double t) {
    return count_.advance(t, [&] {
      spheres_[0].step();
      evaluations_ += spheres_[0].contacts.size();
    });
  }

  Json snapshot(const std::string& contacts, ArrayFile& arrays) const {
    const Spheres& spheres = spheres_[0];
    std::vector<double> position, velocity, spin, walls;
    const auto add = [](std::vector<double>& to, const Vec3& v) {
      to.insert(to.end(), {v.x(), v.y(), v.z()});
    };
    for (std::size_t i = 0; i < spheres.position.size(); ++i) {
      add(position, spheres.position[i]);
      add(velocity, spheres.velocity(i));
      add(spin, spheres.spin(i));
    }
    arrays.add("position", position);
    arrays.add("velocity", velocity);
    arrays.add("spin", spin);
    for (const Vec3& place : spheres.wallPositions()) add(walls, place);
    arrays.add("wall_position", walls);
    if (contacts == "instant") addContacts(arrays, spheres);
    const double now = count_.now();
    return {{"position_time", now},
            {"velocity_time", now},
            {"contact_time", now},
            {"contact_interval", 0.0},
            {"bodies", spheres.bodies()}};
  }

  void checkpoint(const std::string& path) { writeParts(path, spheres_[0]); }

  void restore(const std::string& path) {
    readParts(path, spheres_[0]);
    spheres_[0].restored();
    count_ = StepCount(dt_, spheres_[0].steps());
  }

  Json stats() const { return count_.stats(evaluations_); }

 private:
  static void addContacts(ArrayFile& arrays, const Spheres& spheres) {
    std::vector<std::int32_t> i, j;
    std::vector<double> normal, overlap, force, tangential, rolling;
    std::vector<std::uint8_t> sliding;
    for (const Spheres::Contact& c : spheres.contacts) {
      i.push_back(c.i);
      j.push_back(c.j);
      for (const double x : c.normal) normal.push_back(x);
      overlap.push_back(c.overlap);
      force.push_back(c.force);
      for (const double x : c.tangential) tangential.push_back(x);
      for (const double x : c.rolling) rolling.push_back(x);
      sliding.push_back(c.sliding);
    }
    arrays.add("contacts.i", i);
    arrays.add("contacts.j", j);
    arrays.add("contacts.normal", normal);
    arrays.add("contacts.overlap", overlap);
    arrays.add("contacts.normal_force", force);
    arrays.add("contacts.tangential_force", tangential);
    arrays.add("contacts.sliding", sliding);
    if (spheres.rolls()) arrays.add("contacts.rolling_torque", rolling);
  }

  SpaceFaults faults_;
  std::vector<Spheres> spheres_;  ///< one, once a scene is loaded
  double dt_ = 0.0;
  StepCount count_;
  unsigned long long evaluations_ = 0;
};

}  // namespace
}  // namespace crossgrain::planted

int main(int argc, char** argv) {
  using namespace crossgrain::planted;
  return servePlanted<PlantedSpheres, SpaceFaults>("planted_spheres", argc, argv);
}
