#pragma once

#include <string>
#include <vector>

#include "results/endpoints.hpp"

/// Verdicts on endpoints, in words; for the page and the command line alike.
namespace crossgrain::reports {

/// How people call and write an endpoint (cases/endpoints.hpp); of one that a case made up, its
/// name with blanks.
std::string endpointWords(const std::string& name);
/// @param ofCell  whether a cell was averaged: what an assembly calls "stress_ratio" is no
/// σ_rφ/σ_rr
std::string endpointSymbol(const std::string& name, bool ofCell);

/// "agree, no difference seen", "agree, small difference", "borderline", "disagree", "undecided".
std::string wordOf(Answer answer);

/// "0.31 margins (0.05 to 0.57)"; empty where nothing was measured.
std::string distanceInWords(const EndpointRow& row);

/// "24 to 60 packings decide with 90 % chance"; empty where nobody knows, or nothing is left.
std::string needsInWords(const EndpointRow& row);

/// "0.0688 for 0.069 m": an engine's value beside the closed form's.
std::string valueInWords(const EndpointRow& row);

/// "by grain-as-x, B = 0.002 margins"; empty: by its own runs.
std::string carrierInWords(const EndpointRow& row);

/// All of them in a line.
std::string answerInWords(const EndpointRow& row);

/// Whether an engine's mirror carries its packings, and what its own run and 3/n have to say.
std::string sentenceOf(const CarriedEngine& carried);

std::string sentenceOf(const AlarmRow& alarm);

/// Which looks were taken, what they spent, why there was no further one.
std::string sentenceOf(const LooksFindings& looks);

/// Endpoints of pairs by answer: "27 comparisons of endpoints: 20 agree, 1 borderline, …".
std::string countsInWords(const std::vector<const EndpointRow*>& rows);

}  // namespace crossgrain::reports
