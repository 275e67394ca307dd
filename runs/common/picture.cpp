#include "runs/common/picture.hpp"

#include <cmath>

namespace crossgrain::inline runs {

ScenePicture scenePicture(const Scene& scene, const Snapshot& now, double rotation) {
  ScenePicture picture;
  picture.radius = scene.disks.radius;
  for (std::size_t i = 0; i < scene.disks.size(); ++i) {
    picture.x.push_back(now.position[i].x());
    picture.y.push_back(now.position[i].y());
    const Vec2& start = scene.disks.position[i];
    picture.startR.push_back(start.norm());
    picture.startPhi.push_back(std::atan2(start.y(), start.x()));
  }
  for (const Vec2& position : now.wallPosition) {
    picture.wallX.push_back(position.x());
    picture.wallY.push_back(position.y());
  }
  for (const WallBody& body : scene.bodies)
    picture.wallRadius.insert(picture.wallRadius.end(), body.diskRadius.begin(),
                              body.diskRadius.end());
  picture.time = now.positionTime;
  picture.rotation = rotation;
  if (now.contacts) {
    picture.contactI.emplace(now.contacts->i.begin(), now.contacts->i.end());
    picture.contactJ.emplace(now.contacts->j.begin(), now.contacts->j.end());
    picture.contactForce = now.contacts->normalForce;
  }
  return picture;
}

}  // namespace crossgrain::inline runs
