#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "crossgrain_scene.hpp"
#include "faults.hpp"

namespace crossgrain::planted {

using crossgrain_worker::Arrays;
using crossgrain_worker::Json;
using Vec3 = Eigen::Vector3d;

/// Faults named by a factor: 1 is right.
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

  // Factors of the scene's values.
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
  double rollAtWalls = given("roll_at_walls", 1.0);  ///< of the torque against rolling
  double spinDrag = given("spin_drag", 0.0);         ///< [1/s] of all spins
  double pullParting = given("pull_parting", 1.0);   ///< of the pull between two that part
  double listReach = given("list_reach", 1.0);  ///< how far spheres go before lists are made anew
  double restoreWithoutSprings =
      given("restore_without_springs", 0.0);  ///< a restored state has no springs
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
    if (!radius_.empty()) skin_ = 0.3 * *std::ranges::min_element(radius_);
    position = vectors("disks.position");
    velocity_ = vectors("disks.velocity");
    spin_ = vectors("disks.spin");
    const Json& law = scene.at("law");
    kn_ = law.at("kn");
    gn_ = faults.gn * law.at("gn").get<double>();
    hertz_ = law.at("normal") == "hertz";
    pull_ =
        law.value("cohesion", "none") == "dmt" ? 2.0 * std::numbers::pi * law.value("w", 0.0) : 0.0;
    twist_ = law.value("spring_twist", "mean_spin") == "none" ? 0.0 : faults.springTwist;
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

  /// Everything that its future depends on, one after the other, given to `each`. Lists are made
  /// anew in each run.
  void parts(const auto& each) {
    each(steps_);
    each(time_);
    for (auto* list : {&position, &velocity_, &spin_, &force_, &torque_, &wallForce_, &wallTorque_})
      each(*list);
    each(contacts);
    std::vector<std::pair<Pair, Spring>> springs(springs_.begin(), springs_.end());
    each(springs);
    springs_ = {springs.begin(), springs.end()};
  }
  /// Parts are those of another run of the same scene.
  void restored() {
    for (auto& wall : walls_) wall.at(time_);
    if (faults_.restoreWithoutSprings != 0.0) springs_.clear();
  }
  long long steps() const { return steps_; }

 private:
  using Pair = std::pair<std::size_t, std::size_t>;

  void kick(double dt) {
    for (std::size_t i = 0; i < position.size(); ++i) {
      spin_[i] *= 1.0 - faults_.spinDrag * dt;
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
    if (!listHolds()) makeList();
    for (const auto& [i, j] : near_) meet(i, j);
    meetWalls();
    std::erase_if(springs_, [](const auto& one) { return !one.second.touches; });
  }

  bool listHolds() const {
    if (listedAt_.empty()) return false;
    const double most = 0.5 * skin_ * faults_.listReach;
    for (std::size_t i = 0; i < position.size(); ++i)
      if (!((position[i] - listedAt_[i]).squaredNorm() <= most * most)) return false;
    return true;
  }

  /// Pairs nearer than a skin to touching, in order of their numbers.
  void makeList() {
    near_.clear();
    listedAt_ = position;
    for (std::size_t i = 0; i < position.size(); ++i)
      for (std::size_t j = i + 1; j < position.size(); ++j) {
        const double reach = radius_[i] + radius_[j] + skin_;
        if (!(nearest(position[i] - position[j], faults_.images).squaredNorm() > reach * reach))
          near_.emplace_back(i, j);
      }
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
          meetWall(i, id, b, n, radius_[i], radius_[i] - distance,
                   position[i] - of(walls_[b].centre), of(walls_[b].velocity), faults_.planeTorque);
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
          meetWall(i, id, b, faults_.cylinderNormal * of(n), radius_[i],
                   radius_[i] - cylinder.radius + from, position[i] - of(walls_[b].centre),
                   of(walls_[b].velocity));
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
    meetWall(i, id, wall, line.normalized(), reduced(radius_[i], body.radius[k]),
             radius_[i] + body.radius[k] - line.norm(), centre + line,
             of(body.diskVelocity[k]) - of(body.spin).cross(centre));
  }

  static double reduced(double a, double b) { return a * b / (a + b); }

  /// @param wall        its number
  /// @param length      R₁₂; that of a plane, and of the plane that touches a cylinder: the
  /// sphere's
  /// @param fromCentre  the sphere's centre, from the wall's
  /// @param velocity    of the wall, at its centre
  void meetWall(std::size_t i, std::size_t id, std::size_t wall, const Vec3& n, double length,
                double overlap, const Vec3& fromCentre, const Vec3& velocity, double torque = 1.0) {
    const double arm = radius_[i] - 0.5 * overlap;
    if (!(overlap > 0.0)) return;
    const Vec3 place = fromCentre - arm * n;
    const Vec3 turning = faults_.cylinderTurns * of(walls_[wall].spin);
    const Vec3 relative = velocity_[i] - velocity - turning.cross(place);
    const Vec3 slip = relative - relative.dot(n) * n - rim(arm, spin_[i]).cross(n);
    const auto [force, rolling] =
        push(i, id, n, length, overlap, relative.dot(n), slip, spin_[i], turning);
    force_[i] += force;
    torque_[i] += rolling - torque * arm * couple(n, force);
    wallForce_[wall] -= force;
    wallTorque_[wall] -= place.cross(force) + rolling;
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
    Vec3 images = Vec3::Zero();  ///< boxes between the two
    bool touches = true;         ///< in this step
  };

  /// ξ or θ as n turned to the new one and the pair about it (docs/dimensions.md, section 4).
  void follow(Vec3& xi, const Vec3& before, const Vec3& n, const Vec3& meanSpin) const {
    if (before.isZero(0.0)) return;
    if (faults_.springShrinks != 0.0) {
      xi -= xi.dot(n) * n;
    } else {  // Rodrigues' formula
      const Vec3 w = before.cross(n), turned = w.cross(xi);
      xi += turned + w.cross(turned) / (1.0 + before.dot(n));
    }
    xi = Eigen::AngleAxisd(twist_ * dt_ * meanSpin.dot(n), n) * xi;
  }

  /// Reverses a rolling spring, as the fault has it, where one of its pair comes to another image.
  void crossBorder(Spring& spring, std::size_t i, std::size_t j) {
    Vec3 images = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      if (length_[k] > 0.0)
        images[k] = std::floor((position[i][k] - low_[k]) / length_[k]) -
                    std::floor((position[j][k] - low_[k]) / length_[k]);
    if (!spring.normal.isZero(0.0) && images != spring.images)
      spring.angle *= 1.0 - 2.0 * faults_.rollReversed;
    spring.images = images;
  }

  /// M on i: θ and dashpot within µ_r R₁₂ N.
  Vec3 rolling(Spring& spring, double length, const Vec3& relative, const Vec3& n, double load) {
    if (kr_ == 0.0) return Vec3::Zero();
    const Vec3 spin = relative - relative.dot(n) * n;
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
    crossBorder(springs_[{i, j}], i, j);
    const auto [force, rollingTorque] = push(i, j, n, reduced(radius_[i], radius_[j]), overlap,
                                             relative.dot(n), slip, spin_[i], spin_[j]);
    force_[i] += force;
    force_[j] -= force;
    torque_[i] += rollingTorque - armI * couple(n, force);
    torque_[j] -= rollingTorque + armJ * couple(n, force);
  }

  struct Push {
    Vec3 force, rolling;  ///< on i
  };

  /// Adds the contact. @returns its force and rolling torque on i
  /// @param length  R₁₂  @param approach  v_n  @param own, other  spins
  Push push(std::size_t i, std::size_t j, const Vec3& n, double length, double overlap,
            double approach, const Vec3& slip, const Vec3& own, const Vec3& other) {
    Spring& spring = springs_[{i, j}];
    spring.touches = true;
    const bool wall = j >= position.size();
    const Vec3 meanSpin = 0.5 * (own + other);
    if (faults_.springTurn != 0.0) follow(spring.stretch, spring.normal, n, meanSpin);
    if (faults_.rollTurn != 0.0) follow(spring.angle, spring.normal, n, meanSpin);
    const double root = hertz_ ? std::sqrt(length * overlap) : 1.0, kt = root * kt_;
    const double load = root * kn_ * overlap - gn_ * approach;  // without the pull
    const double normal = load - pull_ * length * (approach > 0.0 ? faults_.pullParting : 1.0);
    const Vec3 rollingTorque =
        (wall ? faults_.rollAtWalls : 1.0) * rolling(spring, length, own - other, n, load);
    spring.normal = n;
    spring.stretch += dt_ * slip;
    Vec3 tangential = -kt * spring.stretch - (wall ? faults_.wallGt : 1.0) * gt_ * slip;
    const double bound = (wall ? faults_.wallMu : 1.0) * (steps_ < 10000 ? 1.0 : faults_.muLate) *
                         mu_ * std::max(load, 0.0);
    if (!friction_) tangential = spring.stretch = Vec3::Zero();
    const bool sliding = tangential.norm() > bound;
    if (sliding && faults_.pyramid != 0.0) {
      const Vec3 p = n.unitOrthogonal(), q = n.cross(p);
      tangential = std::clamp(tangential.dot(p), -bound, bound) * p +
                   std::clamp(tangential.dot(q), -bound, bound) * q;
      spring.stretch = -tangential / kt;
    } else if (sliding) {
      tangential *= bound / tangential.norm();
      spring.stretch = -tangential / kt;
    }
    contacts.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), n, tangential,
                        rollingTorque, overlap, normal, sliding});
    return {normal * n + tangential, rollingTorque};
  }

  SpaceFaults faults_;
  double kn_, gn_, kt_, gt_, mu_, kr_, gr_, muR_, dt_, time_ = 0.0;
  double pull_;   ///< by R₁₂ [N/m]
  double twist_;  ///< part of the mean spin that springs turn by
  bool hertz_, friction_, turns_;
  long long steps_ = 0;
  Vec3 gravity_ = Vec3::Zero();
  Vec3 low_ = Vec3::Zero(), length_ = Vec3::Zero();  ///< of the box where it is periodic
  std::vector<double> radius_, mass_, inertia_;
  std::vector<Vec3> velocity_, spin_, force_, torque_;
  std::vector<crossgrain_worker::BodyOf<3>> walls_;
  std::vector<Vec3> wallForce_, wallTorque_;  ///< on each, about its centre
  std::map<Pair, Spring> springs_;
  std::vector<Pair> near_;
  std::vector<Vec3> listedAt_;  ///< where spheres were when the list was made
  double skin_ = 0.0;           ///< [m]
};

}  // namespace crossgrain::planted
