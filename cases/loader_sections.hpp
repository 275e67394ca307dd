#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "averaging/fields.hpp"
#include "cases/case.hpp"
#include "cases/loader.hpp"
#include "cases/loader_reader.hpp"
#include "cases/schema.hpp"

namespace crossgrain::inline cases {

// Tables of keys, for the list of them (loader.cpp, loader_law.cpp, …).
std::vector<SectionInfo> headerSections();  ///< [case], [[variants]]
std::vector<SectionInfo> lawSections();     ///< [law], [[law.pairs]]
std::vector<SectionInfo> cellSections();    ///< [bottom], [cell] … [looks], [averaging.margins]
std::vector<SectionInfo> costSections();    ///< [cost]
std::vector<SectionInfo> runSections();     ///< [run], [engines.NAME], [stability]
std::vector<SectionInfo> collisionSections();  ///< [collision], [collision.margins]
std::vector<SectionInfo> assemblySections();   ///< [assembly] …, [assembly.start]
std::vector<SectionInfo> averageSections();    ///< [average] …, [[endpoints]]

// One function per section: reads every key, then checks what the section can tell alone. All throw
// BadInput.

/// @param law          its dimension is set
/// @param ofTwoBodies  in a collision, whose bodies may be of two materials
void readLaw(Reader& in, ContactLaw& law, bool ofTwoBodies);
/// [[law.pairs]], into materials with their laws, of which law.law is that of all others.
/// @param law  read already
void readPairLaws(const Reader& law, std::vector<Reader>& pairs, Case& c);
/// [bottom]; a plate without friction is none.
void readBottom(Reader& root, std::optional<BottomPlate>& bottom);
void readCell(Reader& in, Cell& cell);
/// @param cell  read already: its area and height make numbers and masses
void readParticles(Reader& in, const Cell& cell, Particles& particles);
void readPreparation(Reader& in, Case& c);
/// [preparation] of an assembly: how many packings, and their seed.
void readPackings(Reader& in, Case& c);
/// @param c  whose cell, particles and law have been read: margins may be shares of its scales
void readAveraging(Reader& in, Case& c);
void readInterims(Reader& in, InterimSettings& looks);
void readRun(Reader& in, RunOptions& run);
void readEngines(Reader& in, std::map<std::string, Settings>& engines);
/// Settings of one engine: booleans, numbers, texts.
Settings readSettings(Reader engine);
void readStability(Reader& in, int dimension, Stability& stability);
void readCost(Reader& in, Cost& cost);
/// @param dimension  of the case: some keys are of collisions in space alone
void readCollision(Reader& in, Collision& collision, int dimension);
/// Whether convex bodies meet as the case's law and time step let them be read.
void checkConvexStarts(const Reader& in, const Case& c);
template <int D>
void readAssembly(Reader& in, AssemblyOf<D>& assembly);
/// [assembly.box] and [assembly.start]. @param assembly  whose disks and walls have been read
template <int D>
void readBox(Reader in, AssemblyOf<D>& assembly);
/// @param assembly  whose disks, also of files, and walls have been read
template <int D>
void checkCylinders(const Reader& in, const AssemblyOf<D>& assembly);
template <int D>
void readStartFiles(Reader in, AssemblyOf<D>& assembly);
/// A convex body as the case has it: its centre of mass need not be the origin.
template <int D>
ShapeOf<D> readShape(Reader in);
/// The keys of [[assembly.disks]].
template <int D>
struct DisksInput : DiskGroupOf<D> {
  double density = 0.0, angle = 0.0;
  std::vector<double> inertia, quaternion;
};
/// Of a group with a shape: its own frame, its size, and how its mass is spread.
/// @param in  whose keys radius, density, inertia and quaternion are the group's
template <int D>
void makeConvex(const Reader& in, DisksInput<D>& group);
SectionInfo boxSection();
SectionInfo startSection();
/// @param c  whose [assembly] and [preparation] have been read
void readAverage(Reader& in, Case& c);
/// [[endpoints]]. Packings that are all the same have no scatter to test with; a closed form is of
/// one start.
/// @param average, preparation  read already, as c has it
/// @param starts                where none are made, none are the same
void readEndpoints(std::vector<Reader>& endpoints, const Reader& average, const Reader& preparation,
                   Starts starts, Case& c);
SectionInfo endpointsSection();
/// @param c  whose step is known
void checkAveragedTime(const Reader& in, const std::vector<Reader>& endpoints, const Case& c);

/// Mass of a disk of the section's density: [kg/m³] and its height [m], or [kg/m²] and 1.
/// @throws BadInput where that is nothing, or more than there are numbers
double massOf(const Reader& in, double density, double radius, double height);

/// Mass over area of disks, over volume of spheres.
template <int D>
Range densities() {
  return positive(D == 2 ? "kg/m^2" : "kg/m^3");
}
inline constexpr const char* densityMeaning = "mass over area, in space over volume [kg/m³]";

/// Of a disk 1 m high, or a sphere, as massOf() [kg].
template <int D>
double massOfOne(const Reader& in, double density, double radius) {
  return D == 2 ? massOf(in, density, radius, 1.0)
                : massOf(in, density, radius, 4.0 / 3.0 * radius);  // 4/3 π a³
}

/// Keys that the other dimension has. @throws BadInput for the first that is there
template <int D>
void refuseKeysOf(const Reader& in, int dimension, std::initializer_list<const char*> keys) {
  for (const char* const key : keys)
    in.check(D != dimension || !in.has(key), key, "is of {} alone, and case.dimension = {}",
             dimension == 3 ? "the plane" : "space", dimension);
}

/// Quantities that a margin can be for.
struct Judged {
  std::string name;
  std::string unit;
  std::optional<bool> byRatio = {};  ///< absent: as the margin is, relative or not
};
/// The keys of one margin.
struct MarginInput {
  double relative = 0.0, absolute = 0.0, share = 0.0;
  std::string of, why;
};
/// @param setup  whose scales a share is of; null: no shares
Margin marginOf(Reader& in, const MarginInput& input, const Judged& judged, const Case* setup);
/// A table of margins, one for each of some names: [averaging.margins] …
std::map<std::string, Margin> readMargins(Reader in, const std::vector<Judged>& list,
                                          const Case* setup = nullptr);
/// Their list of keys. @param name  the word that stands for a name, "FIELD"
SectionInfo marginSection(SectionInfo info, const std::string& name, std::string meaning,
                          const std::string& relativeTo, bool shares);

/// Margins of fields: of a cell with `setup`, else of an assembly's bins.
std::vector<Judged> judgedFields(std::span<const FieldSpec> fields);

}  // namespace crossgrain::inline cases
