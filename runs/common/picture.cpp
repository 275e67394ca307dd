#include "runs/common/picture.hpp"

#include <cmath>

namespace crossgrain::inline runs {

nlohmann::json pictureOf(const Scene& scene, const Snapshot& now, double rotation) {
  std::vector<double> x, y, startR, startPhi, wallX, wallY, wallRadius;
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    x.push_back(now.position[i].x());
    y.push_back(now.position[i].y());
    const Vec2& start = scene.disks.position[i];
    startR.push_back(start.norm());
    startPhi.push_back(std::atan2(start.y(), start.x()));
  }
  for (const Vec2& position : now.wallPosition) {
    wallX.push_back(position.x());
    wallY.push_back(position.y());
  }
  for (const WallBody& body : scene.bodies)
    wallRadius.insert(wallRadius.end(), body.diskRadius.begin(), body.diskRadius.end());
  nlohmann::json picture = {{"radius", scene.disks.radius},
                            {"x", x},
                            {"y", y},
                            {"start_r", startR},
                            {"start_phi", startPhi},
                            {"wall_x", wallX},
                            {"wall_y", wallY},
                            {"wall_radius", wallRadius},
                            {"time_s", now.positionTime},
                            {"rotation", rotation}};
  if (now.contacts) {
    picture["contact_i"] = now.contacts->i;
    picture["contact_j"] = now.contacts->j;
    picture["contact_force"] = now.contacts->normalForce;
  }
  return picture;
}

}  // namespace crossgrain::inline runs
