#pragma once

#include "crossgrain_worker.hpp"
#include "disks.hpp"

namespace crossgrain::planted {

using crossgrain_worker::ArrayFile;
using crossgrain_worker::Json;

/// Contacts and what they do to walls, at one instant.
struct Loads {
  std::vector<Contact> contacts;
  std::vector<Vector> force;   ///< on bodies [N]
  std::vector<double> torque;  ///< about their centres [N m]
};
Loads loadsOf(const Simulation& simulation);

/// Arrays of a snapshot, with those faults that begin with `show`.
void addDisks(ArrayFile& arrays, const Simulation& simulation, const Faults& faults);
void addContacts(ArrayFile& arrays, const Simulation& simulation, const Loads& loads,
                 const Faults& faults);
Json bodiesOf(const Simulation& simulation, const Loads& loads, const Faults& faults);

}  // namespace crossgrain::planted
