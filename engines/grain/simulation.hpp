#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "engines/grain/ledger.hpp"
#include "engines/grain/setup.hpp"

namespace grain {

template <class Real>
class Core;

/// Disks that touch softly, in two dimensions.
///
///   kick: v += a dt   drift: x += v dt   move walls   forces: a(x, v)
///
/// Positions and forces belong to the same time t = steps·dt after each step. Only the effects that
/// the setup calls for are simulated: without friction no spin, torque or spring exists.
/// The same setup gives the same bits in every run, on any number of threads, with any skin and
/// any instruction set.
class Simulation {
 public:
  /// @throws std::invalid_argument for a step that is not > 0
  explicit Simulation(Setup setup);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// @throws std::runtime_error naming the first disk whose position is not finite
  void step() { advance(1); }
  void advance(std::uint64_t steps);

  /// Begins as a run does that has come here, with the velocities of the setup, and goes on to the
  /// bits of its rounding: springs are stretched so that contacts have these tangential forces,
  /// those of other contacts are relaxed, and dashpots of this instant see the velocities of half a
  /// step before. (Where damping is predicted, those of the instant.) A force that the law's bound
  /// does not allow slips at it.
  /// @pre no step is done, and no ledger is kept
  /// @param forces  i < j, the tangential force and whether it slides; nothing else is read
  void beginUnderWay(const std::vector<Contact>& forces);

  /// Lists the neighbours anew, as the step does by itself where needed. The contacts of the last
  /// step are no longer known then.
  void findNeighbours();

  std::uint64_t steps() const;
  double time() const;
  double dt() const;
  std::size_t movingCount() const;
  std::size_t diskCount() const;  ///< with those of walls

  /// Of moving disks, then of wall disks [m].
  double x(std::size_t disk) const;
  double y(std::size_t disk) const;
  /// Of the moving disks at time() [second order for both Verlet schemes].
  double velocityX(std::size_t disk) const;
  double velocityY(std::size_t disk) const;
  double spin(std::size_t disk) const;  ///< 0 where nothing spins
  bool rotates() const;

  /// Contacts of the last force evaluation, that is at time(), by ascending i, j.
  const std::vector<Contact>& contacts() const;
  std::uint64_t contactEvaluations() const;
  /// Steps after which rigid disks still approached each other (impacts.hpp).
  std::uint64_t unfinishedImpacts() const;

  WallState wallState(std::size_t wall) const;
  WallLoad wallLoad(std::size_t wall) const;

  /// ½ m v² + ½ J ω² of the moving disks at time() [J].
  double kineticEnergy() const;
  /// ½ k_n δ² + ½ k_t ξ² over the contacts [J].
  double elasticEnergy() const;

  /// Where the energy is and went, kept step by step where Setup::ledger asks for it, else nullptr.
  const EnergyLedger* energyLedger() const;

  /// Power that each of contacts() turned into heat, by dashpots, sliding, rolling and yield, in
  /// the step that led to time(); at t = 0 in the half kick from there. Empty without a ledger [W].
  std::vector<double> contactLosses() const;

  /// How the neighbour lists fare; differs from run to run where the skin is tuned.
  struct Neighbours {
    std::size_t rebuilds, refreshes, nearPairs, farPairs;
    double skin;     ///< [m]
    double horizon;  ///< of the near pairs [steps]
  };
  Neighbours neighbours() const;
  std::string instructions() const;  ///< the instruction set that the kernels are compiled for

  /// Everything that the future depends on, in this machine's byte order, and back into a
  /// simulation of the same setup, which goes on to the bit as if it had never stopped.
  /// @throws std::runtime_error for a checkpoint of another setup, or one cut short
  void save(std::ostream& out) const;
  void restore(std::istream& in);

 private:
  std::variant<std::unique_ptr<Core<double>>, std::unique_ptr<Core<float>>> core_;
};

}  // namespace grain
