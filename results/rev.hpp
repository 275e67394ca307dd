#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/flow_frame.hpp"
#include "results/flow_numbers.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::inline results {

/// One field under one weight about one place, against the width of a bin.
struct RevCurve {
  std::string method, field, unit;
  double r = 0.0;             ///< of rings; of slabs and boxes along their axis, or height [m]
  std::vector<double> width;  ///< [d]
  Numbers mean, standardError;

  void fields(auto& io) {
    io("method", method, aName);
    io("field", field, aField);
    io("unit", unit, aUnit);
    FIELDS(io, r, width, mean);
    io("stderr", standardError);
  }
};

/// Where, next to a width, a method comes closest to slicing.
struct RevMeeting {
  std::string method, field;
  double near = 0.0, width = 0.0;  ///< [d]
  double difference = 0.0;         ///< root mean square over the places, in units of slicing's

  void fields(auto& io) {
    io("method", method, aName);
    io("field", field, aField);
    FIELDS(io, near, width, difference);
  }
};

/// How far a method is from slicing in bins of that width [d]: √⟨(m − slicing)²⟩/√⟨slicing²⟩ over
/// the places that have room for such a bin; absent without one.
std::optional<double> differenceFromSlicing(const std::vector<RevCurve>& curves,
                                            std::string_view field, std::string_view method,
                                            double width);

/// How large a representative element must be.
struct RevResults : FlowFrame {
  std::string engine;  ///< whose snapshots
  std::vector<RevCurve> curves;
  std::vector<RevMeeting> meetings;

  void fields(auto& io) {
    FlowFrame::fields(io);
    io("engine", engine, aName);
    FIELDS(io, curves, meetings);
  }
};

}  // namespace crossgrain::inline results
