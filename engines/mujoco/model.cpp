#include "model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string>

#include "crossgrain_worker.hpp"

namespace crossgrain_worker::mujoco {
namespace {

/// Mass of a wall that moves, in disks' masses: contacts change its motion by less than rounding,
/// and its motion is prescribed anew in every step.
constexpr double HEAVY = 1e12;

/// Within this gap [units] pairs are looked at, and not taken as contacts: MuJoCo sorts bodies
/// along an axis in single precision, and missed overlaps of 1e-8 of a radius.
constexpr double MARGIN = 1e-3;

/// Of contacts' matrices [bytes]: MuJoCo 2.2 counts all that it keeps in 31 bits, and could not
/// make its data from 1.6e9 on.
constexpr double MOST_MEMORY = 1.2e9;

/// The power of two next to a number: units that change no bit.
double binary(double number) {
  return std::exp2(std::round(std::log2(number)));
}

/// MuJoCo would write MUJOCO_LOG.TXT where it was started, and wait for a key.
void endOnError(const char* message) {
  std::fprintf(stderr, "MuJoCo: %s\n", message);
  std::exit(3);
}
void passOnWarning(const char* message) {
  std::fprintf(stderr, "MuJoCo: %s\n", message);
}

mjModel* compile(const std::string& xml) {
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  const char* name = "scene.xml";
  mj_makeEmptyFileVFS(files.get(), name, static_cast<int>(xml.size()));
  std::memcpy(files->filedata[0], xml.data(), xml.size());
  char error[1000] = "";
  mjModel* model = mj_loadXML(name, files.get(), error, sizeof error);
  mj_deleteVFS(files.get());
  if (!model) throw std::runtime_error(std::string("MuJoCo does not take the scene: ") + error);
  return model;
}

/// MuJoCo 2.2 keeps room for dense matrices, rows × rows and twice rows × freedoms, and clears it.
void requireMemory(std::size_t rows, std::size_t freedoms) {
  const double bytes =
      8.0 * static_cast<double>(rows * rows) + 24.0 * static_cast<double>(rows * freedoms);
  if (bytes <= MOST_MEMORY) return;
  char why[120];
  std::snprintf(why, sizeof why,
                "keeps matrices of all contacts, %.1f GB for so many disks, and has at most %.1f",
                bytes / 1e9, MOST_MEMORY / 1e9);
  throw Unsupported(why);
}

Vector inPlane(const mjtNum* v) {
  return {v[0], v[1]};
}

}  // namespace

Model::Model(const std::vector<Disk>& disks, const std::vector<Body>& bodies, const PairLaw& law,
             const ModelOptions& options)
    : law_(law), options_(options), disks_(disks.size()), freedoms_(options.rotation ? 3 : 2) {
  mju_user_error = endOnError;
  mju_user_warning = passOnWarning;
  if (!disks.empty()) {
    const auto least = [&](double Disk::*member) {
      double value = disks.front().*member;
      for (const Disk& disk : disks) value = std::min(value, disk.*member);
      return binary(value);
    };
    length_ = least(&Disk::radius);
    mass_ = least(&Disk::mass);
  }
  for (const Disk& disk : disks) diskMass_.push_back(disk.mass);
  build(disks, bodies);
  setState(disks);
  placeWalls(bodies);
  findForces();
}

void Model::build(const std::vector<Disk>& disks, const std::vector<Body>& bodies) {
  std::ostringstream xml;
  xml.precision(17);
  std::size_t wallDisks = 0, planes = 0, moving = 0;
  for (const Body& body : bodies) {
    wallDisks += body.radius.size();
    planes += body.planes.size();
    moving += body.moves() ? 1 : 0;
  }
  // Disks that touch in a plane are a planar graph, of at most three edges a node; the rest is for
  // those that overlap so far that it is none.
  // Of convex bodies each of these may have as many points as two boxes have.
  const std::size_t contacts =
      (options_.convex ? 8 : 1) * (4 * disks.size() + 2 * wallDisks + 2 * planes) + 64;
  const std::size_t rows = contacts * (law_.mu > 0.0 ? 3 : 1), count = disks.size() + moving + 1;
  requireMemory(rows, 3 * count);
  xml << "<mujoco><compiler angle='radian' inertiafromgeom='false'/>"
      << "<size nconmax='" << contacts << "' njmax='" << rows << "' nstack='"
      << (options_.newton ? 30 : 1) * count * count + 400 * (contacts + 3 * count) + 100000 << "'/>"
      << "<option timestep='" << options_.dt << "' gravity='" << options_.gravity.x / length_ << ' '
      << options_.gravity.y / length_
      << " 0' integrator='Euler' cone='elliptic' jacobian='sparse' solver='"
      << (options_.newton ? "Newton" : "CG") << "' iterations='" << options_.iterations
      << "' tolerance='" << options_.tolerance << "' impratio='"
      << (law_.mu > 0.0 ? law_.gt / law_.gn : 1.0) << "'/>"
      << "<default><geom condim='" << (law_.mu > 0.0 ? 3 : 1)
      << "' contype='1' conaffinity='3' margin='" << MARGIN << "' gap='" << MARGIN
      << "'/></default>";
  if (options_.convex) writeMeshes(xml, disks);
  xml << "<worldbody>";
  const auto sphere = [&](Vector at, double radius, const char* more) {
    xml << "<geom type='sphere' size='" << radius / length_ << "' pos='" << at.x / length_ << ' '
        << at.y / length_ << " 0' " << more << "/>";
  };
  const auto free = [&](double mass, double inertia, bool turns) {
    xml << "<body><joint type='slide' axis='1 0 0'/><joint type='slide' axis='0 1 0'/>"
        << (turns ? "<joint type='hinge' axis='0 0 1'/>" : "") << "<inertial pos='0 0 0' mass='"
        << mass << "' diaginertia='" << inertia << ' ' << inertia << ' ' << inertia << "'/>";
  };
  constexpr const char* WALL = "contype='2' conaffinity='0'";  // meets disks alone
  // Geometries of the world come first in MuJoCo's order, then those of bodies as they are written.
  std::int32_t id = static_cast<std::int32_t>(disks_);
  std::vector<std::int32_t> ofMoving;
  for (const Body& body : bodies)
    for (std::size_t k = 0; k < body.radius.size(); ++k, ++id) {
      (body.moves() ? ofMoving : idOfGeom_).push_back(id);
      if (!body.moves()) sphere(body.position[k], body.radius[k], WALL);
    }
  for (const Body& body : bodies)
    for (const crossgrain_worker::Plane& plane : body.planes) {
      idOfGeom_.push_back(id++);
      xml << "<geom type='plane' size='1 1 1' pos='" << plane.point.x / length_ << ' '
          << plane.point.y / length_ << " 0' zaxis='" << plane.normal.x << ' ' << plane.normal.y
          << " 0' " << WALL << "/>";
    }
  for (const Disk& disk : disks) {
    idOfGeom_.push_back(static_cast<std::int32_t>(&disk - disks.data()));
    free(disk.mass / mass_, disk.inertia / (mass_ * length_ * length_), options_.rotation);
    if (disk.shape)
      writeShape(xml, disk, static_cast<std::size_t>(&disk - disks.data()));
    else
      sphere({}, disk.radius, "");
    xml << "</body>";
  }
  idOfGeom_.insert(idOfGeom_.end(), ofMoving.begin(), ofMoving.end());
  int freedom = freedoms_ * static_cast<int>(disks_);
  for (const Body& body : bodies) {
    movingBody_.push_back(body.moves() ? freedom : -1);
    if (!body.moves()) continue;
    freedom += 3;
    free(HEAVY, HEAVY * HEAVY, true);
    for (std::size_t k = 0; k < body.radius.size(); ++k)
      sphere(crossgrain_worker::turned(-body.angle, body.position[k] - body.centre), body.radius[k],
             WALL);
    xml << "</body>";
  }
  xml << "</worldbody></mujoco>";
  model_.reset(compile(xml.str()));
  // MuJoCo's estimate of what a contact weighs is a mean over three directions of the frame: in a
  // plane two thirds of 1/m. Set to 1/m, contacts are as soft as they are asked to be.
  for (int b = 1; b < model_->nbody; ++b)
    model_->body_invweight0[2 * b] =
        b <= static_cast<int>(disks_) ? 1.0 / model_->body_mass[b] : 0.0;
  // The scale of its solver's tolerance, which a wall's mass would spoil.
  model_->stat.meaninertia = 1.0;
  data_.reset(mj_makeData(model_.get()));
}

/// Polygons are prisms, which the plane cuts in the middle.
void Model::writeMeshes(std::ostream& xml, const std::vector<Disk>& disks) const {
  xml << "<asset>";
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const auto& shape = disks[i].shape;
    if (!shape || shape->kind == "capsule" || shape->isBox()) continue;
    xml << "<mesh name='" << i << "' vertex='";
    for (const Vector3& corner : shape->corners(disks[i].radius))
      xml << corner.x / length_ << ' ' << corner.y / length_ << ' ' << corner.z / length_ << ' ';
    xml << "'/>";
  }
  xml << "</asset>";
}

/// @param number  of the disk
void Model::writeShape(std::ostream& xml, const Disk& disk, std::size_t number) const {
  const ShapeOf<2>& shape = *disk.shape;
  const Vector half = (1.0 / length_) * shape.halfSides();
  if (shape.kind == "capsule")
    xml << "<geom type='capsule' size='" << shape.rounding / length_ << "' fromto='" << -half.x
        << " 0 0 " << half.x << " 0 0'/>";
  else if (shape.isBox())
    xml << "<geom type='box' size='" << half.x << ' ' << half.y << ' ' << disk.radius / length_
        << "'/>";
  else
    xml << "<geom type='mesh' mesh='" << number << "'/>";
}

void Model::setState(const std::vector<Disk>& disks) {
  for (std::size_t i = 0; i < disks_; ++i) {
    const std::size_t at = i * static_cast<std::size_t>(freedoms_);
    data_->qpos[at] = disks[i].position.x / length_;
    data_->qpos[at + 1] = disks[i].position.y / length_;
    data_->qvel[at] = disks[i].velocity.x / length_;
    data_->qvel[at + 1] = disks[i].velocity.y / length_;
    if (!options_.rotation) continue;
    data_->qpos[at + 2] = disks[i].turn;
    data_->qvel[at + 2] = disks[i].spin;
  }
}

void Model::placeWalls(const std::vector<Body>& bodies) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (movingBody_[b] < 0) continue;
    mjtNum* place = data_->qpos + movingBody_[b];
    mjtNum* motion = data_->qvel + movingBody_[b];
    place[0] = bodies[b].centre.x / length_;
    place[1] = bodies[b].centre.y / length_;
    place[2] = bodies[b].angle;
    motion[0] = bodies[b].velocity.x / length_;
    motion[1] = bodies[b].velocity.y / length_;
    motion[2] = bodies[b].spin;
  }
}

void Model::step(const std::vector<Body>& bodies) {
  mj_Euler(model_.get(), data_.get());
  placeWalls(bodies);
  findForces();
}

/// Does the work of mj_forward, but gives each contact its own constants after contacts are found
/// and before their forces are solved for.
void Model::findForces() {
  const mjModel* m = model_.get();
  mjData* d = data_.get();
  mj_kinematics(m, d);
  mj_comPos(m, d);
  mj_crb(m, d);
  mj_factorM(m, d);
  mj_collision(m, d);
  setContacts();
  mj_makeConstraint(m, d);
  mj_projectConstraint(m, d);
  mj_fwdVelocity(m, d);
  mj_fwdActuation(m, d);
  mj_fwdAcceleration(m, d);
  mj_fwdConstraint(m, d);
  // The solver's residual, some 1e-12 of a force, would be motion that no force accounts for.
  // Accelerations from the forces are nearer to the solution by d/(1 − d), where that is below 1.
  if (options_.impedance < 0.5) {
    mj_solveM(m, d, d->qacc, d->qfrc_constraint, 1);
    mju_addTo(d->qacc, d->qacc_smooth, m->nv);
  }
  iterations_ += d->solver_iter;
  requireRoom();
  readContacts();
}

double Model::inverseMass(std::int32_t id) const {
  return static_cast<std::size_t>(id) < disks_ ? 1.0 / diskMass_[static_cast<std::size_t>(id)]
                                               : 0.0;
}

/// In MuJoCo's direct form solref = (−k, −b) the acceleration that a contact strives for is k δ − b
/// δ̇: of an acceleration, so a force of k_n and γ_n takes k = k_n/m₁₂ and b = γ_n/m₁₂.
void Model::setContacts() {
  for (int c = 0; c < data_->ncon; ++c) {
    mjContact& contact = data_->contact[c];
    const double inverse = inverseMass(idOfGeom_[static_cast<std::size_t>(contact.geom1)]) +
                           inverseMass(idOfGeom_[static_cast<std::size_t>(contact.geom2)]);
    contact.solref[0] = -law_.kn * inverse;
    contact.solref[1] = -law_.gn * inverse;
    contact.solimp[0] = contact.solimp[1] = options_.impedance;
    if (law_.mu > 0.0) contact.friction[0] = contact.friction[1] = law_.mu;
  }
}

void Model::readContacts() {
  contacts_.clear();
  const double newton = mass_ * length_;
  for (int c = 0; c < data_->ncon; ++c) {
    const mjContact& contact = data_->contact[c];
    if (contact.exclude != 0) continue;
    mjtNum force[6];
    mj_contactForce(model_.get(), data_.get(), c, force);
    const std::int32_t a = idOfGeom_[static_cast<std::size_t>(contact.geom1)],
                       b = idOfGeom_[static_cast<std::size_t>(contact.geom2)];
    // The frame's rows: the normal from the first geometry to the second, two tangents. The force
    // acts on the second.
    Vector onSecond;
    for (int k = 0; k < 3; ++k) onSecond = onSecond + force[k] * inPlane(contact.frame + 3 * k);
    const double sense = a < b ? -1.0 : 1.0;
    contacts_.push_back({std::min(a, b), std::max(a, b), sense * inPlane(contact.frame),
                         -contact.dist * length_, sense * newton * onSecond,
                         length_ * inPlane(contact.pos)});
  }
  std::sort(contacts_.begin(), contacts_.end(),
            [](const ContactForce& one, const ContactForce& other) {
              return std::pair(one.i, one.j) < std::pair(other.i, other.j);
            });
}

void Model::requireRoom() const {
  for (const mjtWarning kind : {mjWARN_CONTACTFULL, mjWARN_CNSTRFULL})
    if (data_->warning[kind].number > 0)
      throw std::runtime_error("MuJoCo has no room for more contacts: " +
                               std::to_string(data_->ncon));
}

Vector Model::position(std::size_t disk) const {
  return length_ * inPlane(data_->qpos + disk * static_cast<std::size_t>(freedoms_));
}
Vector Model::velocity(std::size_t disk) const {
  return length_ * inPlane(data_->qvel + disk * static_cast<std::size_t>(freedoms_));
}
double Model::turn(std::size_t disk) const {
  return data_->qpos[disk * static_cast<std::size_t>(freedoms_) + 2];
}
double Model::spin(std::size_t disk) const {
  return options_.rotation ? data_->qvel[disk * static_cast<std::size_t>(freedoms_) + 2] : 0.0;
}

}  // namespace crossgrain_worker::mujoco
