#pragma once

#include <vector>

#include "engines/grain/space_views.hpp"

namespace grain {

/// Which records a law's contacts have, besides those that all have.
struct SpaceRecords {
  bool slide = false, spring = false, rolling = false, angle = false, bond = false;

  SpaceRecords() = default;
  explicit SpaceRecords(const GeneralLaw<double>& law)
      : slide(law.tangential != TangentialLaw::none),
        spring(hasSprings(law)),
        rolling(law.rolling != RollingLaw::none),
        angle(law.rolling == RollingLaw::spring),
        bond(remembers(law)) {}
};

/// Records of contacts, of the kinds that their law has.
class SpaceContacts {
 public:
  explicit SpaceContacts(const SpaceRecords& has) : has_(has) {}

  std::size_t size() const { return touch_.size(); }
  void resize(std::size_t count) {
    forRecords([count](auto& list) { list.resize(count); });
  }
  SpaceContactView view() {
    const auto at = [](auto& list, bool has) { return has ? list.data() : nullptr; };
    return {
        touch_.data(), at(spring_, has_.spring), at(angle_, has_.angle),    at(bond_, has_.bond),
        force_.data(), at(slide_, has_.slide),   at(rolling_, has_.rolling)};
  }
  /// Calls visit(list) for each kind there is.
  void forRecords(auto&& visit) {
    visit(touch_);
    if (has_.spring) visit(spring_);
    if (has_.angle) visit(angle_);
    if (has_.bond) visit(bond_);
    visit(force_);
    if (has_.slide) visit(slide_);
    if (has_.rolling) visit(rolling_);
  }

 private:
  SpaceRecords has_;
  Array<Quad> touch_, spring_, angle_, slide_, rolling_;
  std::vector<SpaceBond> bond_;
  std::vector<double> force_;
};

}  // namespace grain
