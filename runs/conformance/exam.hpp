#pragma once

#include <fmt/format.h>

#include <concepts>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "adapters/registry.hpp"
#include "runs/conformance/conformance_scenes.hpp"
#include "runs/conformance/declared.hpp"
#include "runs/conformance/tolerance.hpp"

namespace crossgrain::conformance {

/// What an engine does not declare, or this scene cannot ask of it: no fault.
struct Skipped {
  std::string reason;
};

/// A fault after which a check makes no sense.
struct GivenUp {};

/// Words and values as one text.
template <typename... Parts>
std::string said(const Parts&... parts) {
  std::ostringstream text;
  ((text << parts), ...);
  return text.str();
}

/// One check of one engine: the engine, what was loaded last, and the faults found so far.
class Exam {
 public:
  /// @param start  starts another worker of any engine; both outlive it
  using Start = std::function<std::unique_ptr<Engine>(const EngineEntry&)>;
  Exam(Engine& engine, const EngineEntry& examined, const Start& start)
      : entry(examined), can(engine.capabilities()), engine_(engine), start_(start) {}

  const EngineEntry& entry;
  Capabilities can;
  Scene scene;        ///< what was loaded last
  Realised realised;  ///< what the engine made of it

  Engine& engine() { return engine_; }
  std::unique_ptr<Engine> another(const EngineEntry& of) const { return start_(of); }

  /// The law with the engine's own conventions where it lacks the thesis' ones.
  ContactLaw law() const;
  /// Rigid disks have no duration of contact, and no oracle of the soft law applies to them.
  bool rigid() const { return law().normal == NormalLaw::rigid; }
  /// The scene without effects that the engine does not have, for checks that need something to
  /// happen and do not care what.
  Scene simplified(const Scene& scene) const;
  /// What snapshots can hold of contacts; none if the engine shows none.
  ContactReport contactReport() const;
  Tolerance byPrecision(double ifDouble, double ifFloat, const char* why) const;

  /// Has the engine load a scene with these settings, the others as its file has them.
  /// @returns why it cannot
  [[nodiscard]] std::optional<std::string> refused(const Scene& scene,
                                                   const Settings& settings = {});
  /// The same; a refusal is a skip. @throws Skipped
  void load(const Scene& scene, const Settings& settings = {});
  /// The same for what limits can declare (adapters/scene_limits.hpp): an engine that refuses the
  /// scene all by itself is at fault. @throws Skipped, GivenUp
  void loadWithinLimits(const Scene& scene);
  Snapshot at(double t);  ///< advances to t and looks, contacts included
  /// Looks after every step from 0 to t; the first snapshot is the start.
  std::vector<Snapshot> watch(double t);

  [[noreturn]] void skip(std::string reason) const { throw Skipped{std::move(reason)}; }

  /// A skip unless the engine declares it (declared.hpp). @throws Skipped
  void needs(const std::string& capability) const;

  /// A fault unless it holds. @param otherwise  what is wrong then
  void expect(bool holds, const std::string& otherwise);
  /// @param what  was compared
  void expect(const Comparison& comparison, const std::string& what);
  /// The same, and the end of the check. @throws GivenUp
  void require(bool holds, const std::string& otherwise);

  void equal(const auto& found, const auto& wanted, const std::string& what) {
    if (!(found == wanted)) fault(said(what, ": ", found, ", not ", wanted));
  }
  void requireEqual(const auto& found, const auto& wanted, const std::string& what) {
    equal(found, wanted, what);
    if (!(found == wanted)) throw GivenUp{};
  }
  void unequal(const auto& found, const auto& unwanted, const std::string& what) {
    if (found == unwanted) fault(what);
  }
  void above(const auto& found, const auto& limit, const std::string& what) {
    if (!(found > limit)) fault(said(what, ": ", found, ", not above ", limit));
  }
  void atLeast(const auto& found, const auto& limit, const std::string& what) {
    if (!(found >= limit)) fault(said(what, ": ", found, ", below ", limit));
  }
  void below(const auto& found, const auto& limit, const std::string& what) {
    if (!(found < limit)) fault(said(what, ": ", found, ", not below ", limit));
  }
  void atMost(const auto& found, const auto& limit, const std::string& what) {
    if (!(found <= limit)) fault(said(what, ": ", found, ", above ", limit));
  }
  void requireAtLeast(const auto& found, const auto& limit, const std::string& what) {
    atLeast(found, limit, what);
    if (!(found >= limit)) throw GivenUp{};
  }

  /// Faults in the order in which they were found; a loop may find one many times.
  const std::vector<std::string>& faults() const { return faults_; }
  void fault(std::string what) { faults_.push_back(std::move(what)); }

  /// The check asks for this of what the engine declares (declared.hpp), and would find a fault in
  /// it.
  void examined(const std::string& capability) { examined_.insert(capability); }
  void examinedOption(const std::string& option, const std::string& value) {
    examined(option + " = " + value);
  }
  const std::set<std::string>& examined() const { return examined_; }
  /// Why it could not be asked for.
  void refusedToo(const std::string& capability, const std::string& why) {
    refused_.try_emplace(capability, why);
  }
  const std::map<std::string, std::string>& refusedToo() const { return refused_; }

  /// What explains the faults found, sign and size; the first counts. Empty: nothing that was tried
  /// does.
  void suspect(std::string cause) {
    if (!cause_) cause_ = std::move(cause);
  }
  bool soughtCause() const { return cause_.has_value(); }
  std::string cause() const { return cause_.value_or(""); }

 private:
  Engine& engine_;
  const Start& start_;
  std::vector<std::string> faults_;
  std::set<std::string> examined_;
  std::map<std::string, std::string> refused_;
  std::optional<std::string> cause_;
};

/// The law with each option that the engine lacks set to one that it has.
ContactLaw followed(const Capabilities& can, ContactLaw law);

/// Whether two snapshots hold the same, bit for bit.
Comparison sameBits(const Snapshot& a, const Snapshot& b);

/// The spins of a snapshot; where it has none, those that the scene started with.
std::vector<double> spinsOf(const Scene& scene, const Snapshot& snapshot);

/// e_n that the law gives in a head-on collision of this reduced mass [kg].
double restitutionOf(const ContactLaw& law, double reducedMass);

}  // namespace crossgrain::conformance
