#include "engines/grain/simulation.hpp"

#include <utility>

#include "engines/grain/core.hpp"

namespace grain {
namespace {

template <class Cores, class Ask>
decltype(auto) with(Cores& cores, Ask&& ask) {
  return std::visit([&](auto& core) -> decltype(auto) { return ask(*core); }, cores);
}

}  // namespace

Simulation::Simulation(Setup setup) {
  if (setup.precision == Precision::float32)
    core_ = std::make_unique<Core<float>>(std::move(setup));
  else
    core_ = std::make_unique<Core<double>>(std::move(setup));
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::advance(std::uint64_t steps) {
  with(core_, [&](auto& core) {
    // A contact's loss over the last step began with the forces of the one before.
    for (std::uint64_t left = steps; left-- > 0;) core.advance(left == 0, left <= 1);
  });
}

void Simulation::beginUnderWay(const std::vector<Contact>& forces) {
  with(core_, [&](auto& core) { core.beginUnderWay(forces); });
}

void Simulation::findNeighbours() {
  with(core_, [](auto& core) { core.findNeighbours(); });
}

std::uint64_t Simulation::steps() const {
  return with(core_, [](const auto& core) { return core.steps(); });
}

double Simulation::time() const {
  return with(core_, [](const auto& core) { return core.time(); });
}

double Simulation::dt() const {
  return with(core_, [](const auto& core) { return core.dt(); });
}

std::size_t Simulation::movingCount() const {
  return with(core_, [](const auto& core) { return core.movingCount(); });
}

std::size_t Simulation::diskCount() const {
  return with(core_, [](const auto& core) { return core.diskCount(); });
}

double Simulation::x(std::size_t disk) const {
  return with(core_, [&](const auto& core) { return core.x(disk); });
}

double Simulation::y(std::size_t disk) const {
  return with(core_, [&](const auto& core) { return core.y(disk); });
}

double Simulation::velocityX(std::size_t disk) const {
  return with(core_, [&](const auto& core) { return core.velocityX(disk); });
}

double Simulation::velocityY(std::size_t disk) const {
  return with(core_, [&](const auto& core) { return core.velocityY(disk); });
}

double Simulation::spin(std::size_t disk) const {
  return with(core_, [&](const auto& core) { return core.rotates() ? core.spin(disk) : 0.0; });
}

bool Simulation::rotates() const {
  return with(core_, [](const auto& core) { return core.rotates(); });
}

const std::vector<Contact>& Simulation::contacts() const {
  return with(
      core_, [](const auto& core) -> const auto& { return core.contacts(); });
}

std::uint64_t Simulation::unfinishedImpacts() const {
  return with(core_, [](const auto& core) { return core.unfinishedImpacts(); });
}

std::uint64_t Simulation::contactEvaluations() const {
  return with(core_, [](const auto& core) { return core.contactEvaluations(); });
}

WallState Simulation::wallState(std::size_t wall) const {
  return with(core_, [&](const auto& core) { return core.wall(wall).state(); });
}

WallLoad Simulation::wallLoad(std::size_t wall) const {
  return with(core_, [&](const auto& core) { return core.wallLoad(wall); });
}

double Simulation::kineticEnergy() const {
  return with(core_, [](const auto& core) { return core.kineticEnergy(); });
}

double Simulation::elasticEnergy() const {
  return with(core_, [](const auto& core) { return core.elasticEnergy(); });
}

const EnergyLedger* Simulation::energyLedger() const {
  return with(core_, [](const auto& core) { return core.energyLedger(); });
}

std::vector<double> Simulation::contactLosses() const {
  return with(core_, [](const auto& core) { return core.contactLosses(); });
}

Simulation::Neighbours Simulation::neighbours() const {
  return with(core_, [](const auto& core) {
    const auto& lists = core.lists();
    const Skin& skin = lists.skin();
    const PairCounts counts = lists.counts();
    return Neighbours{skin.rebuilds(), skin.refreshes(), counts.near,
                      counts.far,      skin.skin(),      skin.horizon()};
  });
}

std::string Simulation::instructions() const {
  return with(core_, [](const auto& core) { return std::string(core.instructions()); });
}

void Simulation::save(std::ostream& out) const {
  with(core_, [&](const auto& core) { core.save(out); });
}

void Simulation::restore(std::istream& in) {
  with(core_, [&](auto& core) { core.restore(in); });
}

}  // namespace grain
