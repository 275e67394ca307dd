#pragma once

#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>

#include "crossgrain_worker.hpp"

namespace crossgrain::planted {

/// NAME=VALUE each, as on the command line; names that no fault reads are refused.
class Words {
 public:
  Words(int count, char** word) {
    for (int k = 0; k < count; ++k) {
      const std::string text = word[k];
      const std::size_t sign = text.find('=');
      std::size_t read = 0;
      if (sign != text.npos)
        values_[text.substr(0, sign)] = std::stod(text.substr(sign + 1), &read);
      if (sign == text.npos || sign + 1 + read != text.size())
        throw std::invalid_argument(text + " is not NAME=VALUE of a fault");
    }
  }

  /// The number of that name, which is known from now on.
  double operator()(const char* name, double neutral) {
    const auto found = values_.extract(name);
    return found ? found.mapped() : neutral;
  }
  /// @throws std::invalid_argument if there is a name that no fault reads
  void requireAllKnown() const {
    if (!values_.empty())
      throw std::invalid_argument("there is no fault " + values_.begin()->first);
  }

 private:
  std::map<std::string, double> values_;
};

/// A worker's main(): an engine with the faults of the command line.
template <class Engine, class Faults>
int servePlanted(const char* name, int argc, char** argv) {
  try {
    const Faults faults{{argc - 1, argv + 1}};
    faults.given.requireAllKnown();
    return crossgrain_worker::serve(Engine(faults));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 2;
  }
}

/// Faults of the engine: numbers, each neutral by default. All of them neutral make the right
/// engine; a planted fault is one or two of them changed by its name (../faults.toml).
struct Faults {
  Words given;

  /// 1: conventions, integrator and precision that are changed below are those that it declares, so
  /// that it is right, and steps otherwise (../other_engines.toml).
  double declares = given("declares", 0.0);

  // Factors of the scene's values.
  double kn = given("kn", 1.0), gn = given("gn", 1.0), kt = given("kt", 1.0), gt = given("gt", 1.0),
         mu = given("mu", 1.0);
  double inertia =
      given("inertia", 1.0);  ///< of all disks; 0.8: 2/5 m a², a sphere's, in place of m a²/2
  double massLarge = given("mass_large", 1.0);      ///< of disks of the largest mass
  double radiusSmall = given("radius_small", 1.0);  ///< of disks of the smallest radius
  double radiusWall = given("radius_wall", 1.0);    ///< of wall disks
  double gravity = given("gravity", 1.0);
  double plateMu = given("plate_mu", 1.0);      ///< friction with the plate
  double plateSpin = given("plate_spin", 1.0);  ///< its torque; −1: it spins disks up
  double wallGn = given("wall_gn", 1.0), wallMu = given("wall_mu", 1.0);
  double wallVelocity = given("wall_velocity", 1.0),
         wallSpin = given("wall_spin", 1.0);  ///< that contacts see; places are right
  double planeSpin =
      given("plane_spin", 1.0);  ///< of the disk's spin in the slip at planes; −1: the wrong sign
  double planeTorque = given("plane_torque", 1.0);  ///< of contacts with planes
  double planeBelt =
      given("plane_belt", 1.0);          ///< of planes' velocity along themselves that contacts see
  double torque = given("torque", 1.0);  ///< of all contacts
  double torqueOfSecond = given("torque_of_second", 1.0),
         forceOnSecond = given("force_on_second", 1.0);  ///< of the partner with the higher id
  double listReach =
      given("list_reach", 1.0);  ///< how far disks go before the list of neighbours is made anew

  // Faults within a step: 0 is right.
  double stride = given("stride", 0.0);           ///< n: one step of n dt in place of n steps
  double cutTension = given("cut_tension", 0.0);  ///< f_n := max(f_n, 0)
  double keepSpring = given("keep_spring", 0.0);  ///< a spring grows on while its contact slips
  double keepOpenSpring =
      given("keep_open_spring", 0.0);  ///< a contact that opens keeps its spring
  double historyLostEvery =
      given("history_lost_every", 0.0);  ///< n: all springs are 0 after every n-th list
  double springBefore = given("spring_before", 0.0);      ///< spring_update = before
  double springOnly = given("spring_only", 0.0);          ///< spring_reset = spring_only
  double dashpotOutside = given("dashpot_outside", 0.0);  ///< dashpot = outside
  double lagged = given("lagged", 0.0);                   ///< damping_velocity = lagged
  double leverMiddle = given("lever_middle", 0.0);  ///< lever_arm = overlap_middle, as velocity_arm
  double dropEvery = given("drop_every", 0.0);  ///< n: every n-th contact evaluated has no force
  double healEvery =
      given("heal_every", 0.0);  ///< n: every n-th step a velocity that is no number becomes 0
  double floatState = given("float_state", 0.0);  ///< positions are rounded to float32 after every
                                                  ///< step; 2: velocities, spins and springs too
  double integrator = given("integrator", 0.0);   ///< 1: velocity Verlet; 2: semi-implicit Euler
  double flippedWalls =
      given("flipped_walls", 0.0);  ///< n: disk n−1 sees walls with their normals turned round
  double driftAfterTurn =
      given("drift_after_turn", 0.0);  ///< [m/s] along x, of all disks once a wall turned by 2π
  double leastOverlap = given("least_overlap", 0.0);  ///< [m] contacts below it have no force
  double mostOverlap =
      given("most_overlap", 0.0);  ///< part of the smallest radius; the spring bears no more
  double mostSpeed = given("most_speed", 0.0);        ///< [m/s] faster disks are slowed to it
  double mostContacts = given("most_contacts", 0.0);  ///< n: a disk's further ones have no force

  // Rolling resistance and cohesion: factors of the scene's values, then faults within a step.
  double kr = given("kr", 1.0), gr = given("gr", 1.0), muR = given("mu_r", 1.0);
  double rollLength = given("roll_length", 1.0);  ///< of L; 2: MercuryDPM's
  double rollOnSecond = given("roll_on_second", 1.0),
         rollAtWalls = given("roll_at_walls", 1.0);  ///< of the torque
  double pull = given("pull", 1.0),
         pullAtWalls = given("pull_at_walls", 1.0);  ///< of k_c and w; 0: no cohesion
  double rollDashpotOutside = given("roll_dashpot_outside", 0.0),
         rollSpringOnly = given("roll_spring_only", 0.0);  ///< rolling_dashpot, rolling_reset
  double rollTurnedByList =
      given("roll_turned_by_list", 0.0);  ///< θ changes its sign with every list of neighbours
  double keepOpenAngle = given("keep_open_angle", 0.0);  ///< a contact that opens keeps its θ
  double letsGo = given("lets_go", 0.0);  ///< JKR's contacts end where surfaces just touch
  double forgetDeepest = given("forget_deepest", 0.0);  ///< plastic contacts forget δ_max
  double lagDeepest = given("lag_deepest", 0.0);        ///< their k₂ is of the step before

  // Right in one telling of a scene and wrong in another.
  double gravityX = given("gravity_x", 1.0);  ///< factor of gravity's x component
  double wallVelocityY =
      given("wall_velocity_y", 1.0);    ///< of the y component of walls' velocity that contacts see
  double muOdd = given("mu_odd", 1.0);  ///< of contacts of disks with odd numbers
  double muAnticlockwise = given("mu_anticlockwise", 1.0);  ///< of contacts with positive slip

  // Right here and soon; late is more than 1 s after load, or so many steps.
  double lateSteps = given("late_steps", 0.0);
  double muFar = given("mu_far", 1.0);    ///< of contacts of disks farther than 1 m from the origin
  double muLate = given("mu_late", 1.0);  ///< of contacts later than 1 s after load
  double gravityLate = given("gravity_late", 1.0);
  double wallVelocityLate = given("wall_velocity_late", 1.0);  ///< and spin, that contacts see
  double plateMuLate = given("plate_mu_late", 1.0);
  double rollLate = given("roll_late", 1.0);                 ///< of the torque against rolling
  double historyLostLate = given("history_lost_late", 0.0);  ///< at every list
  double farGrid =
      given("far_grid", 0.0);  ///< [m] nothing touches beyond it, along x or y from the origin

  // Right of one and wrong of another, of a kind that few scenes have.
  double gravityLarge = given("gravity_large", 1.0);  ///< of disks of the largest mass
  double wheelAboutOrigin =
      given("wheel_about_origin", 0.0);  ///< contacts see ω × x of walls, not ω × (x − centre)
  double planeEnds = given("plane_ends", 0.0);  ///< [m] from their point
  double cornerMu = given("corner_mu", 1.0);    ///< at the second plane that a disk touches
  double hertzPlaneRadius = given("hertz_plane_radius", 1.0);  ///< of R₁₂ at planes in Hertz' law
  double pullForgets =
      given("pull_forgets", 0.0);  ///< plastic contacts that pull forget their largest overlap
  double mostDamped = given("most_damped", 0.0);  ///< [m/s] what the normal dashpot sees at most
  double listLookEvery =
      given("list_look_every", 0.0);  ///< n: whether lists still hold is asked every n-th step
  double inertiaAssumed = given("inertia_assumed", 0.0);  ///< J = m a²/2, whatever is read
  double plateColumn = given("plate_column", 0.0);        ///< τ_m of the plate is read as its µ_b

  // Faults of several bodies at once, of walls under way and of the plate (../audit.toml).
  double listOfDisks = given("list_of_disks", 0.0);  ///< lists hold on while walls alone move
  double stoppedWallMoves =
      given("stopped_wall_moves", 0.0);  ///< contacts see the velocity that it had last
  double planeAtCentre =
      given("plane_at_centre", 0.0);  ///< contacts see a plane's velocity at the disk's centre
  double onePlane = given("one_plane", 0.0);             ///< a disk touches the first plane alone
  double oneSpring = given("one_spring", 0.0);           ///< all planes share a disk's spring
  double massScaled = given("mass_scaled", 0.0);         ///< x: masses are k_n dt²/x at least
  double plateMeanMass = given("plate_mean_mass", 0.0);  ///< presses all disks on the plate
  double plateWinds = given("plate_winds", 0.0);         ///< its springs grow on while disks slip
  double plateForgets = given("plate_forgets", 0.0);     ///< they are lost with each list
  double plateTorqueBounded =
      given("plate_torque_bounded", 0.0);  ///< τ_m is of the force that acts, not of the trial
  double asleep = given("asleep", 0.0);    ///< [m/s] what touches and is slower stops
  double mostSprings = given("most_springs", 0.0);  ///< n: disks of higher number have none
  double startsBox =
      given("starts_box", 0.0);  ///< outside the box of the start, and a diameter, nothing touches
  double meanCells =
      given("mean_cells", 0.0);  ///< [mean diameters] pairs of a longer distance are not found

  // Of a third audit and a second: README.md.
  double wallClockWraps = given("wall_clock_wraps", 0.0);    ///< walls move by t mod 1 s
  double oneWallSpring = given("one_wall_spring", 0.0);      ///< of a disk at all disks of a body
  double planePointStays = given("plane_point_stays", 0.0);  ///< of planes the normal alone turns
  double wallSpinSize =
      given("wall_spin_size", 0.0);  ///< contacts see a wall's spin without its sign
  double wallRadiusOfFirst =
      given("wall_radius_of_first", 0.0);  ///< all disks of a wall are as large as its first
  double inertiaOfFirst = given("inertia_of_first", 0.0);  ///< J = q m a² of all with q of disk 0
  double plateSkips = given("plate_skips", 0.0);  ///< the plate does not act on what touches a disk
  double plateKnowsGravity = given("plate_knows_gravity", 0.0);  ///< its g is 9.81 m/s²
  double springAge = given("spring_age", 0.0);  ///< n: a spring is emptied after n steps
  double flagsStay =
      given("flags_stay", 0.0);  ///< a contact that has slid is shown to go on sliding
  double showPlanesFirst =
      given("show_planes_first", 0.0);  ///< numbers of planes, then of wall disks
  double loadKeeps =
      given("load_keeps", 0.0);  ///< the law stays that of the first scene of as many disks
  double mostSteps = given("most_steps", 0.0);  ///< n: an advance takes no more, and does not say

  // Faults that hard cases find: ../../studies/stability_test.cpp.
  double planesMostSpeed = given("planes_most_speed", 0.0);  ///< [m/s] faster disks meet no plane
  double springsEmptiedEvery = given("springs_emptied_every", 0.0);  ///< n: all, every n-th step
  double touchingDrag = given("touching_drag", 0.0);  ///< [1/s] of the velocity of disks that touch
  double unevenKn = given("uneven_kn", 1.0);  ///< where one mass is 50 times the other, or more

  double threads = given("threads", 0.0);  ///< 1: a setting, which changes nothing; 2: with more
                                           ///< than one forces are summed the other way round

  // Faults of answers; the motion is right.
  double showFloat = given("show_float", 0.0);  ///< positions rounded to float32
  double showLate = given("show_late", 0.0);    ///< contacts and loads on walls of the step before
  double showSwappedPlaces =
      given("show_swapped_places", 0.0);  ///< places of disks 0 and 1 swapped, nothing else
  double showRenumbered =
      given("show_renumbered", 0.0);  ///< disks of one kind in the opposite order, consistently
  double showElastic = given("show_elastic", 0.0);  ///< f_n without its dashpot
  double showFlippedWalls =
      given("show_flipped_walls", 0.0);  ///< n: normals of disk n−1 with walls
  double showSlidingAsSticking = given("show_sliding_as_sticking", 0.0);
  double showDropEvery = given("show_drop_every", 0.0);  ///< n: every n-th contact is left out
  double showEarlier =
      given("show_earlier", 0.0);             ///< [s] positions of that much earlier than said
  double showSpin = given("show_spin", 1.0);  ///< factor of spins
  double showWallForce = given("show_wall_force", 1.0);    ///< factor of forces on walls
  double showWallTorque = given("show_wall_torque", 1.0);  ///< of torques on walls
  double showTorqueAboutOrigin =
      given("show_torque_about_origin", 0.0);  ///< of walls, not about their centres

  // How requests are served.
  double lookForgets = given("look_forgets", 0.0);  ///< a snapshot empties all springs
  double loadRemembers =
      given("load_remembers", 0.0);  ///< springs of the scene before are there in the next
  double restoreWithoutPlate =
      given("restore_without_plate", 0.0);  ///< a restored state has no springs of the plate
  double restoreList =
      given("restore_list", 0.0);  ///< a list that is restored holds as long as one made anew
  double loadGrows =
      given("load_grows", 0.0);  ///< no friction of disks that the scene before did not have
  double shortAdvanceEvery = given(
      "short_advance_every", 0.0);  ///< n: every n-th advance lacks its last step, and does not say
};

/// Whether something that happens every n-th time happens the count-th time; n = 0: never.
inline bool everyNth(double n, unsigned long long count) {
  return n > 0.0 && count % static_cast<unsigned long long>(n) == 0;
}

}  // namespace crossgrain::planted
