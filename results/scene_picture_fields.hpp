#pragma once

#include "results/json_fields.hpp"
#include "results/scene_picture.hpp"

namespace crossgrain::inline results {

void fields(auto& io, ScenePicture& picture) {
  io("radius", picture.radius);
  io("x", picture.x);
  io("y", picture.y);
  io("start_r", picture.startR);
  io("start_phi", picture.startPhi);
  io("wall_x", picture.wallX);
  io("wall_y", picture.wallY);
  io("wall_radius", picture.wallRadius);
  io.present("contact_i", picture.contactI);
  io.present("contact_j", picture.contactJ);
  io.present("contact_force", picture.contactForce);
  io.present("planes", picture.planes);
  io("time_s", picture.time);
  io("rotation", picture.rotation);
}

}  // namespace crossgrain::inline results
