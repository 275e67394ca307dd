// Faults in the harness itself: its averaging and its oracle, right but for numbers in the
// environment.
//
// The linker puts these functions between the callers and the real ones (-Wl,--wrap,
// ../CMakeLists.txt): they call the real one and change what goes in or comes out. Nothing of this
// is in the program that is shipped. Without a variable nothing is changed.

#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "averaging/moments.hpp"
#include "oracle/collision_oracle.hpp"

namespace crossgrain {
namespace {

/// The number after NAME, or what is neutral.
double planted(const char* name, double neutral) {
  const char* const text = std::getenv(name);
  return text == nullptr ? neutral : std::stod(text);
}

/// A private member's own key: an explicit instantiation may name it.
template <auto Member>
struct Key {
  friend const Coordinates& coordinatesOf(const MomentSums& sums) { return *(sums.*Member); }
};
template struct Key<&MomentSums::coordinates_>;
const Coordinates& coordinatesOf(const MomentSums& sums);

void plantInto(std::vector<Moments>& slots, const Coordinates& coordinates) {
  const std::size_t last = slots.size() - 2;  // the last ring; behind it the overflow
  if (planted("PLANTED_LAST_RING", 1.0) == 0.0) slots[last] = Moments{};
  const double branch = planted("PLANTED_BRANCH", 1.0);
  const bool swapped = planted("PLANTED_SWAPPED", 0.0) != 0.0;
  const bool wrongArea = planted("PLANTED_WRONG_AREA", 0.0) != 0.0;
  for (std::size_t slot = 0; slot < slots.size(); ++slot) {
    Moments& moments = slots[slot];
    for (int q = 0; q < 4; ++q) {
      at(moments, Moment::stress, q) *= branch;
      at(moments, Moment::wallStress, q) *= branch * planted("PLANTED_WALLS", 1.0);
    }
    for (int k = 0; k < 2; ++k) at(moments, Moment::wallCouple, k) *= planted("PLANTED_WALLS", 1.0);
    at(moments, Moment::spin) *= planted("PLANTED_SPIN", 1.0);
    if (swapped) {
      std::swap(at(moments, Moment::stress, 2), at(moments, Moment::stress, 3));
      std::swap(at(moments, Moment::wallStress, 2), at(moments, Moment::wallStress, 3));
    }
    // A sum over the area of the ring that follows, as if it were this ring's.
    if (wrongArea && slot > 0 && slot < last)
      for (double& moment : moments)
        moment *= coordinates.volume(slot) / coordinates.volume(slot + 1);
  }
}

}  // namespace
}  // namespace crossgrain

// Calls of the functions in question arrive at __wrap_NAME, those of __real_NAME at themselves.
// Both names are CMakeLists.txt's.
namespace crossgrain {

using SumsOfWeights = std::vector<std::vector<Moments>>;

void realCompute(MomentSums* self, const Snapshot& snapshot,
                 SumsOfWeights& sums) asm("__real_" MOMENT_SUMS);
void wrappedCompute(MomentSums* self, const Snapshot& snapshot,
                    SumsOfWeights& sums) asm("__wrap_" MOMENT_SUMS);
void wrappedCompute(MomentSums* self, const Snapshot& snapshot, SumsOfWeights& sums) {
  realCompute(self, snapshot, sums);
  for (std::vector<Moments>& slots : sums) plantInto(slots, coordinatesOf(*self));
}

CollisionEnd realOutcome(const ContactLaw& law, const CollidingPair& pair,
                         const CollisionStart& start) asm("__real_" ORACLE_OUTCOME);
CollisionEnd wrappedOutcome(const ContactLaw& law, const CollidingPair& pair,
                            const CollisionStart& start) asm("__wrap_" ORACLE_OUTCOME);
CollisionEnd wrappedOutcome(const ContactLaw& law, const CollidingPair& pair,
                            const CollisionStart& start) {
  ContactLaw other = law;
  other.gn *= planted("PLANTED_ORACLE_GN", 1.0);
  other.mu *= planted("PLANTED_ORACLE_MU", 1.0);
  if (planted("PLANTED_ORACLE_CUT", 0.0) != 0.0) other.conventions.tension = Tension::cut;
  CollidingPair bodies = pair;
  for (double& inertia : bodies.inertia) inertia *= planted("PLANTED_ORACLE_INERTIA", 1.0);
  CollisionEnd end = realOutcome(other, bodies, start);
  end.psi *= planted("PLANTED_ORACLE_PSI", 1.0);
  return end;
}

}  // namespace crossgrain
