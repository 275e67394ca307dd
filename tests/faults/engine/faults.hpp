#pragma once

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace crossgrain::planted {

/// What is wrong with the engine: numbers, each neutral as it stands. All of them neutral make the
/// right engine; a planted fault is one or two of them changed (../faults.toml).
struct Faults {
  // Factors of what the scene says.
  double kn = 1.0, gn = 1.0, kt = 1.0, gt = 1.0, mu = 1.0;
  double inertia = 1.0;      ///< of all disks; 0.8: 2/5 m a², a sphere's, in place of m a²/2
  double massLarge = 1.0;    ///< of disks of the largest mass
  double radiusSmall = 1.0;  ///< of disks of the smallest radius
  double radiusWall = 1.0;   ///< of wall disks
  double gravity = 1.0;
  double plateMu = 1.0;    ///< friction with the plate
  double plateSpin = 1.0;  ///< its torque; −1: it spins disks up
  double wallGn = 1.0, wallMu = 1.0;
  double wallVelocity = 1.0, wallSpin = 1.0;  ///< that contacts see; places are right
  double planeSpin = 1.0;    ///< of the disk's spin in the slip at planes; −1: the wrong sign
  double planeTorque = 1.0;  ///< of contacts with planes
  double planeBelt = 1.0;    ///< of planes' velocity along themselves that contacts see
  double torque = 1.0;       ///< of all contacts
  double torqueOfSecond = 1.0, forceOnSecond = 1.0;  ///< of the partner with the higher id
  double listReach = 1.0;  ///< how far disks go before the list of neighbours is made anew

  // What happens within a step: 0 is right.
  double stride = 0.0;            ///< n: one step of n dt in place of n steps
  double cutTension = 0.0;        ///< f_n := max(f_n, 0)
  double keepSpring = 0.0;        ///< a spring grows on while its contact slips
  double keepOpenSpring = 0.0;    ///< a contact that opens keeps its spring
  double historyLostEvery = 0.0;  ///< n: all springs are 0 after every n-th list
  double springBefore = 0.0;      ///< spring_update = before
  double springOnly = 0.0;        ///< spring_reset = spring_only
  double dashpotOutside = 0.0;    ///< dashpot = outside
  double lagged = 0.0;            ///< damping_velocity = lagged
  double leverMiddle = 0.0;       ///< lever_arm = overlap_middle, as velocity_arm
  double dropEvery = 0.0;         ///< n: every n-th contact evaluated has no force
  double healEvery = 0.0;         ///< n: every n-th step a velocity that is no number becomes 0
  double floatState = 0.0;        ///< positions are rounded to float32 after every step
  double flippedWalls = 0.0;      ///< n: disk n−1 sees walls with their normals turned round
  double driftAfterTurn = 0.0;    ///< [m/s] along x, of all disks once a wall turned by 2π
  double leastOverlap = 0.0;      ///< [m] contacts below it have no force
  double mostOverlap = 0.0;       ///< part of the smallest radius; the spring bears no more
  double mostSpeed = 0.0;         ///< [m/s] faster disks are slowed to it
  double mostContacts = 0.0;      ///< n: a disk's further ones have no force

  // Right in one telling of a scene and wrong in another.
  double gravityX = 1.0;         ///< factor of gravity's x component
  double wallVelocityY = 1.0;    ///< of the y component of walls' velocity that contacts see
  double muOdd = 1.0;            ///< of contacts of disks with odd numbers
  double muAnticlockwise = 1.0;  ///< of contacts with positive slip

  // Right here and soon.
  double muFar = 1.0;   ///< of contacts of disks farther than 1 m from the origin
  double muLate = 1.0;  ///< of contacts later than 1 s after load

  // What is answered; the motion is right.
  double showFloat = 0.0;          ///< positions rounded to float32
  double showLate = 0.0;           ///< contacts and loads on walls of the step before
  double showSwappedPlaces = 0.0;  ///< places of disks 0 and 1 swapped, nothing else
  double showRenumbered = 0.0;     ///< disks of one kind in the opposite order, consistently
  double showElastic = 0.0;        ///< f_n without its dashpot
  double showFlippedWalls = 0.0;   ///< n: normals of disk n−1 with walls
  double showSlidingAsSticking = 0.0;
  double showDropEvery = 0.0;          ///< n: every n-th contact is left out
  double showEarlier = 0.0;            ///< [s] positions of that much earlier than said
  double showSpin = 1.0;               ///< factor of spins
  double showWallForce = 1.0;          ///< factor of forces on walls
  double showTorqueAboutOrigin = 0.0;  ///< of walls, not about their centres

  // How requests are served.
  double lookForgets = 0.0;        ///< a snapshot empties all springs
  double loadRemembers = 0.0;      ///< springs of the scene before are there in the next
  double shortAdvanceEvery = 0.0;  ///< n: every n-th advance lacks its last step, and does not say
};

/// Their names in faults.toml and on the command line, NAME=VALUE.
inline constexpr auto faultNames = std::to_array<std::pair<std::string_view, double Faults::*>>(
    {{"kn", &Faults::kn},
     {"gn", &Faults::gn},
     {"kt", &Faults::kt},
     {"gt", &Faults::gt},
     {"mu", &Faults::mu},
     {"inertia", &Faults::inertia},
     {"mass_large", &Faults::massLarge},
     {"radius_small", &Faults::radiusSmall},
     {"radius_wall", &Faults::radiusWall},
     {"gravity", &Faults::gravity},
     {"plate_mu", &Faults::plateMu},
     {"plate_spin", &Faults::plateSpin},
     {"wall_gn", &Faults::wallGn},
     {"wall_mu", &Faults::wallMu},
     {"wall_velocity", &Faults::wallVelocity},
     {"wall_spin", &Faults::wallSpin},
     {"plane_spin", &Faults::planeSpin},
     {"plane_torque", &Faults::planeTorque},
     {"plane_belt", &Faults::planeBelt},
     {"torque", &Faults::torque},
     {"torque_of_second", &Faults::torqueOfSecond},
     {"force_on_second", &Faults::forceOnSecond},
     {"list_reach", &Faults::listReach},
     {"stride", &Faults::stride},
     {"cut_tension", &Faults::cutTension},
     {"keep_spring", &Faults::keepSpring},
     {"keep_open_spring", &Faults::keepOpenSpring},
     {"history_lost_every", &Faults::historyLostEvery},
     {"spring_before", &Faults::springBefore},
     {"spring_only", &Faults::springOnly},
     {"dashpot_outside", &Faults::dashpotOutside},
     {"lagged", &Faults::lagged},
     {"lever_middle", &Faults::leverMiddle},
     {"drop_every", &Faults::dropEvery},
     {"heal_every", &Faults::healEvery},
     {"float_state", &Faults::floatState},
     {"flipped_walls", &Faults::flippedWalls},
     {"drift_after_turn", &Faults::driftAfterTurn},
     {"least_overlap", &Faults::leastOverlap},
     {"most_overlap", &Faults::mostOverlap},
     {"most_speed", &Faults::mostSpeed},
     {"most_contacts", &Faults::mostContacts},
     {"gravity_x", &Faults::gravityX},
     {"wall_velocity_y", &Faults::wallVelocityY},
     {"mu_odd", &Faults::muOdd},
     {"mu_anticlockwise", &Faults::muAnticlockwise},
     {"mu_far", &Faults::muFar},
     {"mu_late", &Faults::muLate},
     {"show_float", &Faults::showFloat},
     {"show_late", &Faults::showLate},
     {"show_swapped_places", &Faults::showSwappedPlaces},
     {"show_renumbered", &Faults::showRenumbered},
     {"show_elastic", &Faults::showElastic},
     {"show_flipped_walls", &Faults::showFlippedWalls},
     {"show_sliding_as_sticking", &Faults::showSlidingAsSticking},
     {"show_drop_every", &Faults::showDropEvery},
     {"show_earlier", &Faults::showEarlier},
     {"show_spin", &Faults::showSpin},
     {"show_wall_force", &Faults::showWallForce},
     {"show_torque_about_origin", &Faults::showTorqueAboutOrigin},
     {"look_forgets", &Faults::lookForgets},
     {"load_remembers", &Faults::loadRemembers},
     {"short_advance_every", &Faults::shortAdvanceEvery}});

/// @param words  NAME=VALUE each
/// @throws std::invalid_argument for what is not one of them
inline Faults faultsOf(int words, char** word) {
  Faults faults;
  for (int k = 0; k < words; ++k) {
    const std::string_view text = word[k];
    const std::size_t sign = text.find('=');
    bool known = false;
    for (const auto& [name, member] : faultNames)
      if (text.substr(0, sign) == name && sign != text.npos) {
        char* end = nullptr;
        faults.*member = std::strtod(word[k] + sign + 1, &end);
        known = *end == '\0' && end != word[k] + sign + 1;
      }
    if (!known) throw std::invalid_argument(std::string(text) + " is not NAME=VALUE of a fault");
  }
  return faults;
}

/// Whether something that happens every n-th time happens the count-th time; n = 0: never.
inline bool everyNth(double n, unsigned long long count) {
  return n > 0.0 && count % static_cast<unsigned long long>(n) == 0;
}

}  // namespace crossgrain::planted
