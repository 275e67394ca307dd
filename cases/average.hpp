#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "adapters/vec2.hpp"

/// What is averaged of an assembly: where, when, and which numbers carry verdicts.
namespace crossgrain::inline cases {

/// How the averaged part of the plane is divided into bins.
enum class BinKind { rings, slabs, grid, whole };
inline constexpr std::array<std::string_view, 4> binKindNames = {"rings", "slabs", "grid", "whole"};

/// The part of the plane that is averaged, and the time of it. Rings lie about the origin; all
/// others divide the box between two corners. It stays where it is while walls move.
struct Region {
  BinKind bins = BinKind::whole;
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();  ///< corners of the box [m]
  double innerRadius = 0.0, outerRadius = 0.0;   ///< of rings [m]
  int axis = 1;                                  ///< slabs lie one after the other along 0: x, 1: y
  int count = 1;                                 ///< of rings or slabs
  int columns = 1, rows = 1;                     ///< of a grid
  double height = 1.0;  ///< h of the disks, normal to the plane: with 1 m a stress in N/m² is the
                        ///< force per length in N/m [m]
  double from = 0.0;    ///< what comes before is not averaged [s]
  int snapshots = 100;  ///< evenly from there to the end

  bool hasRings() const { return bins == BinKind::rings; }
  int columnCount() const { return bins == BinKind::slabs && axis == 0 ? count : columns; }
  int rowCount() const { return bins == BinKind::slabs && axis == 1 ? count : rows; }
};

/// What is made of a quantity to get one number of a run. A mean or slope over bins weighs them
/// with their volumes where the field is per volume, else with what they hold.
enum class Reduction {
  mean,     ///< of a field over all bins; of a series over time
  bin,      ///< a field in one bin
  slope,    ///< of a field along its slabs or rings, by least squares [per m]
  end,      ///< the last value of a series
  rate,     ///< of a series over time, by least squares [per s]
  maximum,  ///< of a series: the parabola through the largest value and its two neighbours
  minimum,  ///< likewise
  time,     ///< a series at one time
  reaches   ///< when a series first is at a value [s]
};

/// An endpoint (endpoints.hpp) that the case file makes up itself.
struct OwnEndpoint {
  std::string name;
  std::string words;        ///< the name with blanks
  std::string quantity;     ///< a field of profiles.csv or a number of regionNumbers()
  std::optional<int> disk;  ///< from 0: then a number of diskNumbers()
  std::string per;          ///< divided by another one, reduced likewise; empty: not
  Reduction reduction = Reduction::mean;
  int bin = 0;         ///< of Reduction::bin, from 0
  double level = 0.0;  ///< of Reduction::time [s], of Reduction::reaches [unit of the quantity]
  std::optional<std::pair<double, double>> between;  ///< the part of a series that counts [s]
  /// By a closed form: then engines are judged by it too, on one start that is run twice [unit].
  std::optional<double> expected;
  std::string unit;
  std::string definition;  ///< in words
  bool byRatio = false;    ///< EndpointSpec::byRatio: where the margin is relative

  /// The quantity's column of series.csv: "disks", "disk_0_y".
  std::string series() const;
};

/// A number of a run over time, besides its fields: a column of series.csv.
struct RegionNumber {
  std::string_view name, unit, definition;
  bool ofContacts = false;  ///< absent without a contact, which is no gap in what was seen
};

/// Of disks with their centres in the averaged part, or, of contacts, of the whole scene.
std::span<const RegionNumber> regionNumbers();

/// Of one disk, wherever it is.
std::span<const RegionNumber> diskNumbers();

struct Average {
  Region region;
  std::vector<OwnEndpoint> endpoints;  ///< all of them have an expected value, or none

  bool hasClosedForms() const { return !endpoints.empty() && endpoints.front().expected; }
};

}  // namespace crossgrain::inline cases
