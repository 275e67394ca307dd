// Causes of differences in collisions, where they are known: the in-house engine under another law.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "adapters/grain.hpp"
#include "cases/loader.hpp"
#include "cases/time_step.hpp"
#include "studies/causes/closest_law.hpp"
#include "studies/collide/causes.hpp"

namespace {

using namespace crossgrain;

/// A sweep of a case, and the in-house engine on it.
class Sweep {
 public:
  Sweep(const std::string& file, const std::string& variant, std::vector<double> psi,
        const std::vector<std::string>& changes = {}) {
    for (Case& one : loadCase(CROSSGRAIN_CASES "/collision/" + file, changes))
      if (one.variant == variant) setup_ = std::move(one);
    collisionIn(setup_).psi = std::move(psi);
    starts_ = collisionStarts(setup_);
    scene_ = sweepScene<2>(setup_, starts_, collisionTimeSteps(setup_).front());
    own_ = outcomes(scene_);
    score_ = scoreSweep(setup_, starts_, own_, own_);
  }

  const Scene& scene() const { return scene_; }
  const std::vector<CollisionStart>& starts() const { return starts_; }
  Outcomes outcomes(const Scene& scene) const {
    return inHouseOutcomes<2>(setup_, scene, starts_, /*watch=*/true);
  }
  std::optional<CollisionCauses> causes(const Scene& declared, const Outcomes& found) const {
    return causesOfSweep<2>(setup_, starts_, scene_, declared, found, score_);
  }
  /// In units of errors, over all quantities of the state after.
  double apart(const Outcomes& one, const Outcomes& other) const {
    const CurveScore between = scoreSweep(setup_, starts_, one, other, &score_);
    double most = 0.0;
    for (const QuantityId id : {QuantityId::psiF, QuantityId::en, QuantityId::spinI,
                                QuantityId::spinJ, QuantityId::duration})
      if (between.of[id]) most = std::max(most, between.of[id]->max);
    return most;
  }
  bool moves(const MirrorChange& change) const { return apart(as(change), own_) > 1e-6; }
  Scene with(const MirrorChange& change, Scene scene) const {
    change.apply(scene, amount);
    return scene;
  }
  Outcomes as(const MirrorChange& change) const { return outcomes(with(change, scene_)); }
  const Outcomes& own() const { return own_; }

  static constexpr double amount = 0.05;  // of a constant

 private:
  Case setup_;
  std::vector<CollisionStart> starts_;
  Scene scene_;
  Outcomes own_;
  CurveScore score_;
};

std::string optionOf(const MirrorChange& change) {
  return change.name.substr(0, change.name.find(" = "));
}

/// Conventions and constants of the law that a sweep shows.
std::vector<MirrorChange> plantable(const Sweep& sweep) {
  std::vector<MirrorChange> found = changesOf<2>(sweep.scene(), makeGrain()->capabilities());
  std::erase_if(found, [&](const MirrorChange& change) {
    constexpr std::array constants = {"kn", "gn", "kt", "gt", "mu"};
    const bool ofLaw = change.isConstant
                           ? std::ranges::find(constants, change.name) != constants.end()
                           : change.name.find(" = ") != std::string::npos;
    return !ofLaw || !sweep.moves(change);
  });
  return found;
}

/// Largest part of each difference, by the largest of the whole, over all quantities.
std::vector<double> sharesOf(const CollisionCauses& causes) {
  std::vector<double> shares(causes.differences.size(), 0.0);
  for (const CollisionQuantity& quantity : scoredQuantities()) {
    if (!causes.of[quantity.id]) continue;
    const QuantityCauses& own = *causes.of[quantity.id];
    const auto largest = [](const Numbers& numbers) {
      double most = 0.0;
      for (const auto& value : numbers) most = std::max(most, std::abs(value.value_or(0.0)));
      return most;
    };
    const double whole = largest(own.whole);
    for (std::size_t k = 0; whole > 1e-6 && k < shares.size(); ++k)
      shares[k] = std::max(shares[k], largest(own.parts[k]) / whole);
  }
  return shares;
}

/// Whether a difference is that change: of what moves together the first is named by the option.
bool names(const CauseName& cause, const MirrorChange& change) {
  return ("+" + cause.name + "+").find("+" + optionOf(change) + "+") != std::string::npos;
}

struct Count {
  int right = 0, alike = 0, all = 0;
  std::vector<std::string> missed;
  double share() const { return all > 0 ? static_cast<double>(right + alike) / all : 1.0; }
};

std::string listedIn(const CollisionCauses& causes) {
  std::vector<std::string> words;
  for (const CauseName& one : causes.differences)
    words.push_back(fmt::format("{} {} → {}", one.name, one.from, one.to));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// What does in this sweep to rounding what another change does cannot be told from it.
bool isAlike(const Sweep& sweep, const CollisionCauses& causes, const Outcomes& found) {
  Scene as = sweep.scene();
  for (const MirrorChange& change : changesOf<2>(sweep.scene(), makeGrain()->capabilities()))
    for (const CauseName& one : causes.undeclared)
      if (change.name == one.name + " = " + one.to) change.apply(as, 0.0);
  return sweep.apart(sweep.outcomes(as), found) < 1e-9;
}

void countSingle(const Sweep& sweep, const MirrorChange& change, bool declared, Count& count) {
  const Outcomes found = sweep.as(change);
  const Scene scene = sweep.scene();
  const auto causes = sweep.causes(declared ? sweep.with(change, scene) : scene, found);
  ++count.all;
  if (causes && !causes->differences.empty()) {
    const std::vector<double> shares = sharesOf(*causes);
    const auto largest = std::ranges::max_element(shares) - shares.begin();
    const CauseName& named = causes->differences[static_cast<std::size_t>(largest)];
    if (names(named, change) && named.declared == declared)
      ++count.right;
    else if (isAlike(sweep, *causes, found))
      ++count.alike;
    else
      count.missed.push_back(change.name + ": " + listedIn(*causes));
  } else {
    count.missed.push_back(change.name + ": nothing");
  }
}

void countPair(const Sweep& sweep, const MirrorChange& one, const MirrorChange& other,
               Count& declaredCount, Count& count) {
  const Scene truth = sweep.with(other, sweep.with(one, sweep.scene()));
  const Outcomes found = sweep.outcomes(truth);
  const auto namesBoth = [&](const CollisionCauses& causes) {
    const std::vector<double> shares = sharesOf(causes);
    const auto isNamed = [&](const MirrorChange& change) {
      for (std::size_t k = 0; k < shares.size(); ++k)
        if (names(causes.differences[k], change) && shares[k] >= 0.01) return true;
      return false;
    };
    return isNamed(one) && isNamed(other);
  };
  // One may hide the other.
  const double least = 0.01 * sweep.apart(found, sweep.own());
  if (std::min(sweep.apart(found, sweep.as(one)), sweep.apart(found, sweep.as(other))) < least)
    return;
  const auto told = sweep.causes(truth, found);
  ++declaredCount.all;
  if (told && namesBoth(*told))
    ++declaredCount.right;
  else
    declaredCount.missed.push_back(one.name + " & " + other.name + ": " +
                                   (told ? listedIn(*told) : "nothing"));
  const auto causes = sweep.causes(sweep.scene(), found);
  ++count.all;
  if (causes && namesBoth(*causes))
    ++count.right;
  else if (causes && isAlike(sweep, *causes, found))
    ++count.alike;
  else
    count.missed.push_back(one.name + " & " + other.name + ": " +
                           (causes ? listedIn(*causes) : "nothing"));
}

struct Planted {
  const char *name, *file, *variant;
  std::vector<double> psi;
  std::vector<std::string> changes;
};

std::ostream& operator<<(std::ostream& out, const Planted& planted) {
  return out << planted.name;
}

class CausesPlanted : public testing::TestWithParam<Planted> {};

TEST_P(CausesPlanted, AreNamed) {
  const Planted& planted = GetParam();
  const Sweep sweep(planted.file, planted.variant, planted.psi, planted.changes);
  const std::vector<MirrorChange> all = plantable(sweep);
  Count single[2], pairs[2];
  for (const MirrorChange& change : all)
    for (const bool declared : {true, false})
      countSingle(sweep, change, declared, single[declared ? 0 : 1]);
  const std::size_t every = std::getenv("CROSSGRAIN_AT_NIGHT") ? 1 : 5;
  std::size_t pair = 0;
  for (std::size_t b = 1; b < all.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
      if (!all[a].isConstant && !all[b].isConstant && optionOf(all[a]) != optionOf(all[b]) &&
          pair++ % every == 0)
        countPair(sweep, all[a], all[b], pairs[0], pairs[1]);
  const char* const words[] = {"declared", "in truth alone"};
  for (int k = 0; k < 2; ++k)
    for (const auto& [kind, count] : {std::pair("single", &single[k]), {"pairs", &pairs[k]}}) {
      fmt::print("{}, {}, {}: {} named and {} that are alike of {}\n", planted.name, kind, words[k],
                 count->right, count->alike, count->all);
      for (const std::string& missed : count->missed) fmt::print("  {}\n", missed);
    }
  EXPECT_GT(single[0].all, 5);
  for (const Count& count : single) EXPECT_GE(count.share(), 0.95);
  for (const Count& count : pairs) EXPECT_GE(count.share(), 0.90);
}

/// Neither of the engine as it is nor where rounding alone moves it, whatever it declares.
TEST_P(CausesPlanted, EngineAsItIs_HasNone) {
  const Planted& planted = GetParam();
  const Sweep sweep(planted.file, planted.variant, planted.psi, planted.changes);
  EXPECT_FALSE(sweep.causes(sweep.scene(), sweep.own()));
  Scene rounded = sweep.scene();
  rounded.law.kn *= 1.0 + 1e-13;
  rounded.law.mu *= 1.0 - 1e-13;
  const auto causes = sweep.causes(sweep.scene(), sweep.outcomes(rounded));
  EXPECT_TRUE(!causes || causes->undeclared.empty()) << listedIn(*causes);
  for (const MirrorChange& change : plantable(sweep)) {
    if (!change.isConstant) continue;
    const Scene declared = sweep.with(change, rounded);
    const auto told = sweep.causes(sweep.with(change, sweep.scene()), sweep.outcomes(declared));
    EXPECT_TRUE(told && told->undeclared.empty()) << change.name;
  }
}

const std::vector<double> fewSlides = {0.1, 0.4, 0.7, 1.0, 1.4, 1.8, 2.5};

INSTANTIATE_TEST_SUITE_P(
    Laws, CausesPlanted,
    testing::Values(
        Planted{"SpringDashpot",
                "figure-4-3.toml",
                "spring_dashpot-tension",
                {0.1, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0},
                {}},
        Planted{"Undamped", "wall-linear.toml", "", fewSlides, {}},
        Planted{"Hertz",
                "chung-ooi-5.toml",
                "steel",
                {0.1, 0.4, 0.7, 1.0, 1.4, 1.8, 2.5},
                {"law.gn=0.1"}},
        Planted{"Rolling", "rolling.toml", "c-dashpot", {-1.5, -0.5, 0.2, 0.6, 1.2, 2.0}, {}},
        Planted{"Cohesive", "cohesion.toml", "jkr-friction", {2.5, 3.5}, {}}),
    [](const auto& param) { return std::string(param.param.name); });

/// Disks that slide throughout: Ψ_f = Ψ_i − 3 (1 + e_n) µ.
TEST(CausesOfFriction, SlidingBranch_HasTheClosedForm) {
  const Sweep sweep("figure-4-3.toml", "coulomb-cut", {3.0, 3.5, 4.0});
  Scene peer = sweep.scene();
  peer.law.mu *= 1.05;
  const Outcomes found = sweep.outcomes(peer);
  const auto causes = sweep.causes(peer, found);
  ASSERT_TRUE(causes);
  ASSERT_EQ(causes->differences.size(), 1u);
  EXPECT_EQ(causes->differences.front().name, "mu");
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double expected = -3.0 * (1.0 + found[k]->end.en) * (peer.law.mu - sweep.scene().law.mu);
    EXPECT_NEAR(*causes->of[QuantityId::psiF]->parts[0][k] / expected, 1.0, 0.01);
  }
}

}  // namespace
