#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "adapters/audit_geometry.hpp"

/// Forces of the law as audits work them out, and how far shown velocities may be from those that
/// dashpots see.
namespace crossgrain {

/// Elastic part of one contact's force, by law/contact_reference.hpp.
struct ElasticPart {
  double force;       ///< f_el(δ) [N]
  double stiffness;   ///< f_el′(δ) [N/m]
  double tangential;  ///< k_t(δ) [N/m]
};
ElasticPart elasticPart(const ContactLaw& law, const CollidingPair& pair, double overlap);

/// Range of forces, as a law's memory is in no snapshot.
struct Attraction {
  double least, most;    ///< that is added to f_el [N]
  double stiffness;      ///< |its derivative| [N/m]
  double pullOff = 0.0;  ///< F_po [N]
};
Attraction attraction(const ContactLaw& law, const CollidingPair& pair, double overlap);

/// The law of that pair with the options of `law`, as the engine runs them.
template <int D>
ContactLaw ownLaw(const AuditBasisOf<D>& basis, std::size_t i, std::size_t j,
                  const ContactLaw& law);

inline constexpr double stepsOfDoubt = 1.5;

/// How far the velocities of the law may be from those shown, by body [m/s]: of its centre, and of
/// its rim by its spin. Schemes show velocities of up to a step and a half from those that dashpots
/// see; forces change them by the sum on a disk meanwhile, and each force by a tenth, at 50 steps
/// in a contact, or by what the overlap changed, where a pull leaves little of a large force. But a
/// dashpot's force and a bond's begin and end with a jump: what began or ended meanwhile counts as
/// a whole. Walls move as prescribed.
template <int D>
class VelocityDoubt {
 public:
  std::vector<double> centre, rim;

  VelocityDoubt(const SnapshotOf<D>& snapshot, const AuditBasisOf<D>& basis,
                const ContactPlacesOf<D>& places, const ContactLaw& law);

 private:
  /// Whether two cover that way within the lapse, at the speed that they have or had before a force
  /// of that size changed it.
  bool isWithin(double way, double force, const ContactPlacesOf<D>& places,
                const AuditBasisOf<D>& basis, std::size_t i, std::size_t j) const;

  /// By how much the lapse changes an elastic force and a pull [N].
  double changeWithin(const ContactLaw& law, double overlap, const ContactPlacesOf<D>& places,
                      const AuditBasisOf<D>& basis, std::size_t i, std::size_t j) const;

  /// At most, of a contact of the two that ended within the lapse, 0 if none can have [N].
  double lastForce(const ContactLaw& law, const ContactPlacesOf<D>& places,
                   const AuditBasisOf<D>& basis, std::size_t i, std::size_t j) const;

  double lapse_;
};

}  // namespace crossgrain
