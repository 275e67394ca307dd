#include "engines/box2d/members.hpp"

#include <algorithm>

namespace box2d_granular {

Members::Members(const Model& model) : disks(model.disks.size()) {
  for (const Disk& disk : model.disks) {
    position.push_back(disk.position);
    velocity.push_back(disk.velocity);
    spin.push_back(disk.spin);
    radius.push_back(disk.radius);
    turn.push_back(disk.turn);
  }
  if (std::ranges::all_of(model.disks, [](const Disk& disk) { return disk.vertices.empty(); }))
    turn.clear();
  for (std::size_t w = 0; w < model.walls.size(); ++w) {
    const Wall& from = model.walls[w];
    Reference& reference = reference_.emplace_back();
    reference.centre = from.pose(0.0).centre;
    reference.firstDisk = position.size();
    for (const Vector& at : from.diskPosition) reference.disk.push_back(at - reference.centre);
    radius.insert(radius.end(), from.diskRadius.begin(), from.diskRadius.end());
    position.resize(radius.size());
    velocity.resize(radius.size());
    spin.resize(radius.size());
    wall.resize(radius.size() - disks, w);
  }
  for (std::size_t w = 0; w < model.walls.size(); ++w) {
    Reference& reference = reference_[w];
    reference.firstPlane = plane.size();
    for (const Plane& at : model.walls[w].planes)
      reference.planes.push_back({at.point - reference.centre, at.normal});
    plane.resize(plane.size() + reference.planes.size());
    wall.resize(position.size() - disks + plane.size(), w);
  }
  pose.resize(model.walls.size());
  for (std::size_t w = 0; w < model.walls.size(); ++w) place(w, model.walls[w].pose(0.0));
}

void Members::place(std::size_t w, const Pose& at) {
  const Reference& reference = reference_[w];
  pose[w] = at;
  for (std::size_t k = 0; k < reference.disk.size(); ++k) {
    const Vector arm = turned(at.angle, reference.disk[k]);
    position[reference.firstDisk + k] = at.centre + arm;
    velocity[reference.firstDisk + k] = at.velocity + at.spin * turned(arm);
    spin[reference.firstDisk + k] = at.spin;
  }
  for (std::size_t k = 0; k < reference.planes.size(); ++k)
    plane[reference.firstPlane + k] = {at.centre + turned(at.angle, reference.planes[k].point),
                                       turned(at.angle, reference.planes[k].normal)};
}

}  // namespace box2d_granular
