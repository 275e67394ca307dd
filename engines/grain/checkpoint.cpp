#include <algorithm>
#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <type_traits>

#include "engines/grain/core.hpp"
#include "engines/grain/spheres.hpp"

namespace grain {
namespace {

constexpr std::uint64_t magic = 0x38'6e'69'61'72'67;       // "grain8"
constexpr std::uint64_t spaceMagic = 0x56'6e'69'61'72'67;  // "grainV"

template <class T>
void write(std::ostream& out, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Vector>
void writeAll(std::ostream& out, const Vector& values) {
  write(out, static_cast<std::uint64_t>(values.size()));
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof values[0]));
}

void require(bool good, const char* what) {
  if (!good) throw std::runtime_error(std::string("checkpoint: ") + what);
}

template <class T>
void read(std::istream& in, T& value) {
  in.read(reinterpret_cast<char*>(&value), sizeof value);
  require(in.good(), "cut short");
}

template <class Vector>
void readAll(std::istream& in, Vector& values) {
  in.read(reinterpret_cast<char*>(values.data()),
          static_cast<std::streamsize>(values.size() * sizeof values[0]));
  require(in.good(), "cut short");
}

/// @pre the vector has the size that it must have
template <class Vector>
void readSame(std::istream& in, Vector& values) {
  std::uint64_t size = 0;
  read(in, size);
  require(size == values.size(), "of another setup");
  readAll(in, values);
}

/// Of any size, up to what a scene of `most` could have.
template <class Vector>
void readAny(std::istream& in, Vector& values, std::uint64_t most) {
  std::uint64_t size = 0;
  read(in, size);
  require(size <= most, "damaged");
  values.resize(size);
  readAll(in, values);
}

}  // namespace

template <class Real>
void Core<Real>::save(std::ostream& out) const {
  write(out, magic);
  write(out, static_cast<std::uint64_t>(sizeof(Real)));
  write(out, fingerprint_);
  write(out, steps_);
  write(out, contactEvaluations_);
  write(out, unfinishedImpacts_);
  writeAll(out, idAtIndex_);
  const_cast<Core*>(this)->forDiskArrays([&](const auto& array) { writeAll(out, array); });
  writeAll(out, lists_.stretched());
  writeAll(out, recorded_ ? contacts() : std::vector<Contact>());
  write(out, recorded_);
  write(out, ledger_ != nullptr);
  if (!ledger_) return;
  const auto list = [&](const auto& all) { writeAll(out, all); };
  LedgerObserver<Real>::forState(
      *ledger_, [&](const auto& sums) { write(out, sums); }, list, list);
}

template <class Real>
void Core<Real>::restore(std::istream& in) {
  std::uint64_t number = 0;
  read(in, number);
  require(number == magic, "not one of this engine");
  read(in, number);
  require(number == sizeof(Real), "of another precision");
  read(in, number);
  require(number == fingerprint_, "of another setup");
  read(in, steps_);
  read(in, contactEvaluations_);
  read(in, unfinishedImpacts_);
  readSame(in, idAtIndex_);
  for (std::size_t place = 0; place < moving_; ++place) {
    const auto disk = static_cast<std::size_t>(idAtIndex_[place]);
    require(disk < moving_, "damaged");
    indexOfId_[disk] = static_cast<std::int32_t>(place);
  }
  forDiskArrays([&](auto& array) { readSame(in, array); });
  const std::uint64_t mostPairs = 64 * (position_.size() + placedPlanes_.size() * moving_);
  std::vector<KeptSpring> springs;
  readAny(in, springs, mostPairs);
  std::vector<Contact> contacts;
  readAny(in, contacts, mostPairs);
  read(in, recorded_);
  for (MovingWall& wall : walls_) {
    wall.moveTo(std::max(0.0, static_cast<double>(steps_) - 1.0) * dt_);
    wall.moveTo(time());
  }
  for (PlacedPlane& placed : placedPlanes_) placed.plane = walls_[placed.wall].plane(placed.member);
  placeWalls(Which::all);
  lists_.restoreSprings(std::move(springs), places(), travel(), team_);
  findReachedWallDisks();
  rememberChoice();
  known_.reset();
  if (recorded_) known_ = std::move(contacts);
  bool hasLedger = false;
  read(in, hasLedger);
  require(hasLedger == (ledger_ != nullptr),
          hasLedger ? "of a setup with a ledger" : "of a setup without a ledger");
  if (!ledger_) return;
  LedgerObserver<Real>::forState(
      *ledger_, [&](auto& sums) { read(in, sums); },
      [&](auto& all) { readAny(in, all, mostPairs); }, [&](auto& all) { readSame(in, all); });
  ledger_->placesRestored();
}

void Spheres::save(std::ostream& out) const {
  write(out, spaceMagic);
  write(out, fingerprint_);
  write(out, steps_);
  write(out, evaluations_);
  const_cast<Spheres*>(this)->forState([&](const auto& array) { writeAll(out, array); });
  writeAll(out, const_cast<Spheres*>(this)->lists_.touching());
}

void Spheres::restore(std::istream& in) {
  std::uint64_t number = 0;
  read(in, number);
  require(number == spaceMagic, "not one of this engine");
  read(in, number);
  require(number == fingerprint_, "of another setup");
  read(in, steps_);
  read(in, evaluations_);
  moveWalls();
  forState([&](auto& array) { readSame(in, array); });
  std::vector<std::int32_t> ids = idAtIndex_;
  std::ranges::sort(ids);
  for (std::size_t k = 0; k < ids.size(); ++k)
    require(ids[k] == static_cast<std::int32_t>(k), "damaged");
  std::fill(mark_.begin() + static_cast<std::ptrdiff_t>(size()), mark_.end(), std::uint8_t{2});
  followNumbers();
  if (!seenVelocity_.empty()) {  // of those that are pushed the next step predicts them
    seenVelocity_ = velocity_;
    seenSpin_ = spin_;
  }
  std::vector<SpaceLists::Kept> touching;
  readAny(in, touching, 64 * position_.size());
  list([&] { lists_.restore(std::move(touching), position_, travel_, *team_); });
}

}  // namespace grain
