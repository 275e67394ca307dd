#pragma once

#include <optional>
#include <string>

#include "results/cost.hpp"

/// How a study of cost is told.
namespace crossgrain::reports {

/// "precision float", "friction off"
std::string settingWords(const std::string& knob, const std::string& setting);
std::string settingWords(const CostPoint& point);
/// With spaces in names of several words; "t_c" keeps its mark: "velocity verlet, t_c/50".
std::string plainSetting(const std::string& knob, const std::string& setting);
std::string settingWords(const Advice& advice);

/// HTML: "Ψ<sub>f</sub>"; gnuplot's enhanced text; plain words.
std::string measureHtml(const std::string& measure);
std::string measureEnhanced(const std::string& measure);
std::string measureWords(const std::string& measure);

/// Of a heading: "collisions", "trajectory", "averages".
std::string kindWords(CostKind kind);

/// What one unit of an error kind's time is: "one sweep of collisions".
std::string timeUnit(CostKind kind);

/// What a point's status is called where people read: "undecided" is a verdict, a point that the
/// budget did not allow was not measured.
std::string statusText(CostStatus status);

/// A fraction as people say it: 3.2 %, 0.0041 %, 2.1×10⁻⁷.
std::string percentText(std::optional<double> fraction);
/// A point's error, or why it has none: "0.31 % ± 3 %".
std::string errorText(const CostPoint& point);
/// What a point's error lies between, or below: "3.2 % (1.4 % to 5.1 %)", "at most 0.4 % (bound)".
std::string intervalText(const CostPoint& point);
/// An accuracy that is wanted: 10 %, 0.1 %, 10⁻⁶.
std::string targetText(double target);
/// "1.2 s for one rotation"
std::string costText(const Advice& advice);

}  // namespace crossgrain::reports
