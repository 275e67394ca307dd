#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "averaging/fields.hpp"
#include "cases/case.hpp"
#include "cases/loader_reader.hpp"

namespace crossgrain::inline cases {

// One function per section of a case file: reads every key, then checks what the section can tell
// alone. All throw BadInput.

/// Of a disk that is made of the section's density: [kg/m³] and its height [m], or [kg/m²] and 1.
/// @throws BadInput where that is nothing, or more than there are numbers
double massOf(const Reader& in, double density, double radius, double height);

/// One number for both bodies, or two.
void requirePair(Reader& in, std::string_view key, double (&pair)[2], const Range& range);

void readLaw(Reader& in, ContactLaw& law, bool ofTwoBodies);
void readBottom(Reader& in, BottomPlate& bottom);
void readCell(Reader& in, Cell& cell);
/// @param cell  read already: its area and height make numbers and masses
void readParticles(Reader& in, const Cell& cell, Particles& particles);
void readPreparation(Reader& in, Preparation& preparation);
/// @param setup  whose cell, particles and law have been read: margins may be shares of its scales
void readAveraging(Reader& in, const Case& setup, Averaging& averaging);
void readLooks(Reader& in, Looks& looks);
/// [averaging.margins] and [collision.margins].
std::map<std::string, Margin> readFieldMargins(Reader in, const Case& setup);
std::map<std::string, Margin> readEndpointMargins(Reader in, const Case& setup);
std::map<std::string, Margin> readCollisionMargins(Reader in);
/// [average.margins]. @param fields  of its bins
std::map<std::string, Margin> readBinMargins(Reader in, std::span<const FieldSpec> fields);
/// Of one of [[endpoints]], whose other keys have been read.
Margin readOwnMargin(Reader& in, const std::string& endpoint);
void readRun(Reader& in, RunOptions& run);
void readCollision(Reader& in, Collision& collision);
void readAssembly(Reader& in, Assembly& assembly);
/// [assembly.start]: starts from files. @param assembly  whose inertia factor has been read
void readStart(Reader& in, Assembly& assembly);
/// [preparation] of an assembly: how many packings, and their seed.
void readPackings(Reader& in, Case& c);
/// [average] and [[endpoints]]. @param c  whose [assembly] and [preparation] have been read
void readAverage(Reader& in, std::vector<Reader> endpoints, Case& c);
/// @param c  whose step is known
void checkAveragedTime(const Reader& in, const Case& c);
void readStability(Reader& in, Stability& stability);
void readCost(Reader& in, Cost& cost);
/// Settings of one engine: booleans, numbers, texts.
Settings readSettings(Reader engine);
void readEngines(Reader& in, std::map<std::string, Settings>& engines);

}  // namespace crossgrain::inline cases
