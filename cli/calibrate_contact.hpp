#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace crossgrain::inline cli {

/// An option's value. @throws BadInput naming it and why it is needed
double need(std::optional<double> value, const char* option, const char* why);

/// A line of a [law] table.
std::string constant(const char* key, double value, const char* unit);

/// Request for rolling resistance and cohesion: wanted values or constants, of a
/// disk on a plane, or of a pair. SI units.
class ContactRequest {
 public:
  void addOptions(CLI::App& app);
  /// Whether any of it is asked.
  bool given() const;
  struct Bodies {
    std::optional<double> radius, radius2, mass, mass2, inertiaFactor;
  };
  /// Constants as lines of a [law] table, and what they mean, as comments.
  /// @throws BadInput
  std::string answer(const Bodies& bodies) const;

 private:
  struct Number;
  static const std::vector<Number>& numbers();
  std::string rolling(const Bodies& bodies) const;
  std::string cohesion(const Bodies& bodies) const;

  std::optional<double> frequency_, decay_, restAngle_, pullOff_;  // wanted
  std::optional<double> kr_, gr_, muR_, w_;                        // constants
  std::optional<std::string> length_, stiffness_, damper_, cohesion_;
};

}  // namespace crossgrain::inline cli
