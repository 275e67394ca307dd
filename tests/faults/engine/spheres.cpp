// The same in space: a worker of soft spheres in a box, periodic where it is to be, and between
// walls of spheres, planes and cylinders, that is right but for what is planted. It knows no plane.
//
//     planted_spheres [NAME=VALUE …]      names: SpaceFaults

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "crossgrain_scene.hpp"
#include "faults.hpp"

namespace crossgrain::planted {
namespace {

using crossgrain_worker::ArrayFile;
using crossgrain_worker::Arrays;
using crossgrain_worker::Json;
using crossgrain_worker::StepCount;
using Vec3 = Eigen::Vector3d;

/// 1 is right, of what is named by a factor.
struct SpaceFaults {
  Words given;

  double springTurn = given("spring_turn", 1.0);    ///< 0: ξ does not follow a normal that turns
  double springTwist = given("spring_twist", 1.0);  ///< part of the mean spin that ξ turns by
  double springShrinks = given("spring_shrinks", 0.0);  ///< 1: ξ loses its part along n alone
  double images = given("images", 1.0);                 ///< 0: no sphere meets another's image
  double wrongImage = given("wrong_image", 0.0);  ///< 1: n across a border is to the other one
  double torqueAxis = given("torque_axis", 0.0);  ///< 1: the torque is along f_t
  double inertia = given("inertia", 1.0);         ///< 1.25: J = m a²/2
  double rollTurn = given("roll_turn", 1.0);      ///< 0: θ does not follow a normal that turns
  /// 1: θ is reversed where one of its pair comes to another image; 0.5: lost
  double rollReversed = given("roll_reversed", 0.0);
  double boxFromOrigin = given("box_from_origin", 0.0);  ///< 1: the box begins at 0, not at `low`
  double imagesOfFirst = given("images_of_first", 0.0);  ///< 1: of the first direction alone
  double pyramid = given("pyramid", 0.0);  ///< 1: the bound is that of each of two axes
  double cylinderNormal = given("cylinder_normal", 1.0);  ///< −1: n of cylinders points outward
  /// 1: δ at a cylinder is of the distance from a plane through its axis
  double cylinderPlane = given("cylinder_plane", 0.0);
  double cylinderTurns = given("cylinder_turns", 1.0);  ///< 0: a cylinder's surface stands still

  // Factors, of what the scene says.
  double mu = given("mu", 1.0), gn = given("gn", 1.0);
  double gravityX = given("gravity_x", 1.0), gravityY = given("gravity_y", 1.0);  ///< components
  double wallMu = given("wall_mu", 1.0), wallGt = given("wall_gt", 1.0);  ///< at walls of any kind
  double muLate = given("mu_late", 1.0);            ///< from the 10 000th step on
  double planeTorque = given("plane_torque", 1.0);  ///< of contacts with planes
  double slipSpin = given("slip_spin", 1.0);        ///< of the spins' part of the slip; 0: a = 1 m

  double imagesAlongZ = given("images_z", 1.0);                ///< 0: no images along z
  double wallImages = given("wall_images", 1.0);               ///< 0: walls' spheres have none
  double gyroscopic = given("gyroscopic", 0.0);                ///< 1: J dω/dt = T + J ω × T dt
  double springsLostEvery = given("springs_lost_every", 0.0);  ///< n: springs are 0 every n-th step
  double stepSetting = given("step_setting", 0.0);  ///< 1: a setting dt; −1: that it does not use
  double firstStep = given("first_step", 1.0);      ///< of dt, that part is the first step
  /// 1: places, velocities, spins and springs in single precision, as declared
  double floatState = given("float_state", 0.0);
};

class Spheres {
 public:
  Spheres(const Json& scene, const Arrays& arrays, const SpaceFaults& faults, double dt)
      : faults_(faults) {
    const auto vectors = [&](const char* name) {
      const std::vector<double>& numbers = arrays.at(name);
      std::vector<Vec3> list;
      for (std::size_t k = 0; k + 2 < numbers.size(); k += 3)
        list.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
      return list;
    };
    radius_ = arrays.at("disks.radius");
    mass_ = arrays.at("disks.mass");
    inertia_ = arrays.at("disks.inertia");
    position = vectors("disks.position");
    velocity_ = vectors("disks.velocity");
    spin_ = vectors("disks.spin");
    const Json& law = scene.at("law");
    kn_ = law.at("kn");
    gn_ = faults.gn * law.at("gn").get<double>();
    friction_ = law.at("tangential") != "none" && law.at("mu") > 0.0;
    turns_ = (friction_ || law.value("rolling", "none") == "spring") && scene.at("rotation");
    kt_ = law.at("kt");
    gt_ = law.at("tangential") == "spring_dashpot" ? law.at("gt").get<double>() : 0.0;
    mu_ = faults.mu * law.at("mu").get<double>();
    kr_ = law.value("rolling", "none") == "spring" ? law.at("kr").get<double>() : 0.0;
    gr_ = kr_ > 0.0 ? law.at("gr").get<double>() : 0.0;
    muR_ = kr_ > 0.0 ? law.at("mu_r").get<double>() : 0.0;
    dt_ = dt;
    if (scene.contains("box"))
      for (int k = 0; k < 3; ++k)
        if (scene.at("box").at("periodic").at(k) && !(k > 0 && faults.imagesOfFirst != 0.0) &&
            !(k == 2 && faults.imagesAlongZ == 0.0)) {
          if (faults.boxFromOrigin == 0.0) low_[k] = scene.at("box").at("low").at(k);
          length_[k] = scene.at("box").at("high").at(k).get<double>() - low_[k];
        }
    for (int k = 0; k < 3; ++k) gravity_[k] = scene.at("gravity").at(k);
    gravity_.x() *= faults.gravityX;
    gravity_.y() *= faults.gravityY;
    walls_ = crossgrain_worker::bodiesOf<3>(scene, arrays);
    for (auto* sum : {&force_, &torque_}) sum->resize(position.size());
    addForces();
    kick(-0.5 * dt_);  // velocities live half a step before positions from here on
  }

  void step() {
    const double dt = steps_++ == 0 ? faults_.firstStep * dt_ : dt_;
    kick(dt_);
    for (std::size_t i = 0; i < position.size(); ++i) position[i] += dt * velocity_[i];
    time_ += dt_;
    for (auto& wall : walls_) wall.at(time_);
    if (faults_.springsLostEvery > 0.0 &&
        steps_ % static_cast<long long>(faults_.springsLostEvery) == 0)
      springs_.clear();
    addForces();
    if (faults_.floatState == 0.0) return;
    for (auto* list : {&position, &velocity_, &spin_})
      for (Vec3& vector : *list) vector = vector.cast<float>().cast<double>();
    for (auto& [pair, spring] : springs_)
      for (Vec3* vector : {&spring.stretch, &spring.angle})
        *vector = vector->cast<float>().cast<double>();
  }

  struct Contact {
    std::int32_t i, j;
    Vec3 normal, tangential, rolling;
    double overlap, force;
    std::uint8_t sliding;
  };

  std::vector<Vec3> position;
  std::vector<Contact> contacts;

  /// As a snapshot has them.
  Json bodies() const {
    Json list = Json::array();
    for (std::size_t b = 0; b < walls_.size(); ++b) {
      list.push_back(walls_[b].pose());
      for (const auto& [name, load] :
           {std::pair("force", wallForce_[b]), {"torque", wallTorque_[b]}})
        list.back()[name] = {load.x(), load.y(), load.z()};
    }
    return list;
  }

  std::vector<Vec3> wallPositions() const {
    std::vector<Vec3> all;
    for (const auto& wall : walls_)
      for (const auto& place : wall.position) all.push_back(of(place));
    return all;
  }

  bool rolls() const { return kr_ > 0.0; }
  Vec3 velocity(std::size_t i) const { return velocity_[i] + 0.5 * dt_ / mass_[i] * force_[i]; }
  Vec3 spin(std::size_t i) const {
    if (!turns_) return spin_[i];
    return spin_[i] + 0.5 * dt_ / (faults_.inertia * inertia_[i]) * torque_[i];
  }

 private:
  void kick(double dt) {
    for (std::size_t i = 0; i < position.size(); ++i) {
      velocity_[i] += dt / mass_[i] * force_[i];
      if (!turns_) continue;
      const Vec3 torque = torque_[i] + faults_.gyroscopic * dt * spin_[i].cross(torque_[i]);
      spin_[i] += dt / (faults_.inertia * inertia_[i]) * torque;
    }
  }

  /// @param images  0: as it is
  Vec3 nearest(Vec3 line, double images) const {
    for (int k = 0; k < 3; ++k)
      if (length_[k] > 0.0) line[k] -= images * length_[k] * std::round(line[k] / length_[k]);
    return line;
  }

  void addForces() {
    for (std::size_t i = 0; i < position.size(); ++i) force_[i] = mass_[i] * gravity_;
    for (Vec3& torque : torque_) torque.setZero();
    for (auto* sum : {&wallForce_, &wallTorque_}) sum->assign(walls_.size(), Vec3::Zero());
    contacts.clear();
    for (auto& [pair, spring] : springs_) spring.touches = false;
    for (std::size_t i = 0; i < position.size(); ++i)
      for (std::size_t j = i + 1; j < position.size(); ++j) meet(i, j);
    meetWalls();
    std::erase_if(springs_, [](const auto& one) { return !one.second.touches; });
  }

  void meetWalls() {
    std::size_t id = position.size();
    for (std::size_t b = 0; b < walls_.size(); ++b)
      for (std::size_t k = 0; k < walls_[b].radius.size(); ++k) {
        for (std::size_t i = 0; i < position.size(); ++i) meetWallSphere(i, id, b, k);
        ++id;
      }
    for (std::size_t b = 0; b < walls_.size(); ++b)
      for (const auto& plane : walls_[b].planes) {
        for (std::size_t i = 0; i < position.size(); ++i) {
          const Vec3 n = of(plane.normal);
          const double distance = (position[i] - of(plane.point)).dot(n);
          meetWall(i, id, b, n, radius_[i] - distance, position[i] - of(walls_[b].centre),
                   of(walls_[b].velocity), faults_.planeTorque);
        }
        ++id;
      }
    for (std::size_t b = 0; b < walls_.size(); ++b)
      for (const auto& cylinder : walls_[b].cylinders) {
        for (std::size_t i = 0; i < position.size(); ++i) {
          const auto [n, distance] =
              cylinder.facing({position[i].x(), position[i].y(), position[i].z()});
          const double apart = cylinder.radius - distance;
          const double from = faults_.cylinderPlane == 0.0
                                  ? apart
                                  : apart * std::abs(of(n).dot(of(cylinder.axis).unitOrthogonal()));
          meetWall(i, id, b, faults_.cylinderNormal * of(n), radius_[i] - cylinder.radius + from,
                   position[i] - of(walls_[b].centre), of(walls_[b].velocity));
        }
        ++id;
      }
  }

  static Vec3 of(const crossgrain_worker::Vector3& v) { return {v.x, v.y, v.z}; }

  void meetWallSphere(std::size_t i, std::size_t id, std::size_t wall, std::size_t k) {
    const auto& body = walls_[wall];
    const Vec3 place = of(body.position[k]);
    const Vec3 line = nearest(position[i] - place, faults_.images * faults_.wallImages);
    const Vec3 centre = place - of(body.centre);
    meetWall(i, id, wall, line.normalized(), radius_[i] + body.radius[k] - line.norm(),
             centre + line, of(body.diskVelocity[k]) - of(body.spin).cross(centre));
  }

  /// @param wall        its number
  /// @param fromCentre  the sphere's centre, from the wall's
  /// @param velocity    of the wall, at its centre
  void meetWall(std::size_t i, std::size_t id, std::size_t wall, const Vec3& n, double overlap,
                const Vec3& fromCentre, const Vec3& velocity, double torque = 1.0) {
    const double arm = radius_[i] - 0.5 * overlap;
    if (!(overlap > 0.0)) return;
    const Vec3 place = fromCentre - arm * n;
    const Vec3 turning = faults_.cylinderTurns * of(walls_[wall].spin);
    const Vec3 relative = velocity_[i] - velocity - turning.cross(place);
    const Vec3 slip = relative - relative.dot(n) * n - rim(arm, spin_[i]).cross(n);
    const Vec3 force = push(i, id, n, overlap, relative.dot(n), slip, 0.5 * (spin_[i] + turning),
                            [](Spring&, double) { return Vec3(Vec3::Zero()); });
    force_[i] += force;
    torque_[i] -= torque * arm * couple(n, force);
    wallForce_[wall] -= force;
    wallTorque_[wall] -= place.cross(force);
  }

  /// a ω, as the slip has it.
  Vec3 rim(double arm, const Vec3& spin) const {
    return faults_.slipSpin == 0.0 ? spin : Vec3(faults_.slipSpin * arm * spin);
  }

  /// n × f_t.
  Vec3 couple(const Vec3& n, const Vec3& force) const {
    const Vec3 tangential = force - force.dot(n) * n;
    return faults_.torqueAxis != 0.0 ? tangential : n.cross(tangential);
  }

  struct Spring {
    Vec3 stretch = Vec3::Zero(), angle = Vec3::Zero(), normal = Vec3::Zero();
    Eigen::Vector3d images = Eigen::Vector3d::Zero();  ///< boxes between the two
    bool touches = true;                               ///< in this step
  };

  /// ξ or θ as n turned to the new one and the pair about it (docs/dimensions.md, section 4).
  void follow(Vec3& xi, const Vec3& before, const Vec3& n, const Vec3& meanSpin) const {
    if (before.isZero(0.0)) return;
    if (faults_.springShrinks != 0.0)
      xi -= xi.dot(n) * n;
    else
      xi = Eigen::Quaterniond::FromTwoVectors(before, n) * xi;
    xi = Eigen::AngleAxisd(faults_.springTwist * dt_ * meanSpin.dot(n), n) * xi;
  }

  /// M on i: θ and dashpot within µ_r R₁₂ N.
  Vec3 rolling(Spring& spring, std::size_t i, std::size_t j, const Vec3& n, double load) {
    if (kr_ == 0.0) return Vec3::Zero();
    Eigen::Vector3d images = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
      if (length_[k] > 0.0)
        images[k] = std::floor((position[i][k] - low_[k]) / length_[k]) -
                    std::floor((position[j][k] - low_[k]) / length_[k]);
    if (!spring.normal.isZero(0.0) && images != spring.images)
      spring.angle *= 1.0 - 2.0 * faults_.rollReversed;
    spring.images = images;
    const double length = radius_[i] * radius_[j] / (radius_[i] + radius_[j]);
    const Vec3 relative = spin_[i] - spin_[j], spin = relative - relative.dot(n) * n;
    spring.angle += dt_ * spin;
    const double stiffness = kr_ * length * length, damping = gr_ * length * length;
    Vec3 torque = -stiffness * spring.angle - damping * spin;
    const double bound = muR_ * length * std::max(load, 0.0);
    if (torque.norm() > bound) {
      torque *= bound / torque.norm();
      spring.angle = -torque / stiffness;
    }
    return torque;
  }

  void meet(std::size_t i, std::size_t j) {
    const Vec3 line = nearest(position[i] - position[j], faults_.images);
    const double distance = line.norm(), overlap = radius_[i] + radius_[j] - distance;
    if (!(overlap > 0.0)) return;
    Vec3 n = line / distance;
    if (faults_.wrongImage != 0.0 && (position[i] - position[j]).dot(n) < 0.0) n = -n;
    const double armI = radius_[i] - 0.5 * overlap, armJ = radius_[j] - 0.5 * overlap;
    const Vec3 relative = velocity_[i] - velocity_[j];
    const Vec3 slip =
        relative - relative.dot(n) * n - (rim(armI, spin_[i]) + rim(armJ, spin_[j])).cross(n);
    Vec3 rollingTorque;
    const Vec3 force = push(i, j, n, overlap, relative.dot(n), slip, 0.5 * (spin_[i] + spin_[j]),
                            [&](Spring& spring, double load) {
                              return rollingTorque = rolling(spring, i, j, n, load);
                            });
    force_[i] += force;
    force_[j] -= force;
    torque_[i] += rollingTorque - armI * couple(n, force);
    torque_[j] -= rollingTorque + armJ * couple(n, force);
  }

  /// Force of a contact on i; adds the contact.
  /// @param approach  v_n  @param roll  (spring, normal force) → M on i
  template <typename Roll>
  Vec3 push(std::size_t i, std::size_t j, const Vec3& n, double overlap, double approach,
            const Vec3& slip, const Vec3& meanSpin, const Roll& roll) {
    Spring& spring = springs_[{i, j}];
    spring.touches = true;
    if (faults_.springTurn != 0.0) follow(spring.stretch, spring.normal, n, meanSpin);
    if (faults_.rollTurn != 0.0) follow(spring.angle, spring.normal, n, meanSpin);
    const double normal = kn_ * overlap - gn_ * approach;
    const Vec3 rollingTorque = roll(spring, normal);
    spring.normal = n;
    spring.stretch += dt_ * slip;
    const bool wall = j >= position.size();
    Vec3 tangential = -kt_ * spring.stretch - (wall ? faults_.wallGt : 1.0) * gt_ * slip;
    const double bound = (wall ? faults_.wallMu : 1.0) * (steps_ < 10000 ? 1.0 : faults_.muLate) *
                         mu_ * std::max(normal, 0.0);
    if (!friction_) tangential = spring.stretch = Vec3::Zero();
    const bool sliding = tangential.norm() > bound;
    if (sliding && faults_.pyramid != 0.0) {
      const Vec3 p = n.unitOrthogonal(), q = n.cross(p);
      tangential = std::clamp(tangential.dot(p), -bound, bound) * p +
                   std::clamp(tangential.dot(q), -bound, bound) * q;
      spring.stretch = -tangential / kt_;
    } else if (sliding) {
      tangential *= bound / tangential.norm();
      spring.stretch = -tangential / kt_;
    }
    contacts.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), n, tangential,
                        rollingTorque, overlap, normal, sliding});
    return normal * n + tangential;
  }

  SpaceFaults faults_;
  double kn_, gn_, kt_, gt_, mu_, kr_, gr_, muR_, dt_, time_ = 0.0;
  bool friction_, turns_;
  long long steps_ = 0;
  Vec3 gravity_ = Vec3::Zero();
  Vec3 low_ = Vec3::Zero(), length_ = Vec3::Zero();  ///< of the box where it is periodic
  std::vector<double> radius_, mass_, inertia_;
  std::vector<Vec3> velocity_, spin_, force_, torque_;
  std::vector<crossgrain_worker::BodyOf<3>> walls_;
  std::vector<Vec3> wallForce_, wallTorque_;  ///< on each, about its centre
  std::map<std::pair<std::size_t, std::size_t>, Spring> springs_;
};

class PlantedSpheres {
 public:
  explicit PlantedSpheres(const SpaceFaults& faults) : faults_(faults) {}

  Json capabilities() const {
    Json effects;
    for (const char* name :
         {"normal_damping", "friction", "tangential_spring", "tangential_damping", "rotation",
          "gravity", "rolling_resistance", "moving_walls"})
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
             {{"normal", only("linear")},
              {"damper", only("constant")},
              {"tangential", {"none", "spring", "spring_dashpot"}},
              {"tension", only("allow")},
              {"coulomb_bound", only("compression")},
              {"dashpot", only("inside")},
              {"spring_reset", only("total")},
              {"spring_update", only("before")},
              {"lever_arm", only("overlap_middle")},
              {"velocity_arm", only("lever_arm")},
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
              {"spring_twist", only("mean_spin")}}},
            {"cylinders", true},
            {"precisions", only(precision())},
            {"instant_contacts", true},
            {"accumulated_contacts", false},
            {"warm_handover", false},
            {"sliding_flags", true},
            {"settings", settings}};
  }

  const char* precision() const { return faults_.floatState == 0.0 ? "double" : "float"; }

  Json load(const Json& scene, const Arrays& arrays, const Json& settings) {
    double dt = settings.value("dt", 0.0);
    if (dt == 0.0) dt = scene.at("dt");
    const double used = faults_.stepSetting < 0.0 ? scene.at("dt").get<double>() : dt;
    spheres_.assign(1, Spheres(scene, arrays, faults_, used));
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
  StepCount count_;
  unsigned long long evaluations_ = 0;
};

}  // namespace
}  // namespace crossgrain::planted

int main(int argc, char** argv) {
  using namespace crossgrain::planted;
  return servePlanted<PlantedSpheres, SpaceFaults>("planted_spheres", argc, argv);
}
