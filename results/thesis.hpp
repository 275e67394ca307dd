#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/collision.hpp"
#include "results/engine_row.hpp"
#include "results/flow_frame.hpp"
#include "results/head.hpp"
#include "results/json_fields.hpp"
#include "results/run.hpp"

/// The thesis' cell over volume fractions, rates, walls and laws, and what its claims come to.
namespace crossgrain::inline results {

/// One case of the parameter sweep: what it differs in, so that a claim finds the cases it is
/// about.
struct ThesisCase {
  std::string name;     ///< "nu-0.804", "nu-0.804-omega-0.01"
  std::string purpose;  ///< one sentence
  std::string file;     ///< of the case
  /// Families of cases that differ in one thing: "packings", "rate", "spacing", "kn", "mass",
  /// "radius", "bottom", "friction", "time". A case may belong to several.
  std::vector<std::string> families;
  CouetteCell cell;
  double label = 0.0;  ///< ν̄ as the thesis' Table 3.2 has it; the cell's own beside it [-]
  double kn = 0.0;     ///< [N/m]
  double mu = 0.0;     ///< µ of the disks [-]
  bool bottomFriction = true;
  double settleRotations = 0.0;    ///< since the ring had closed
  double averagedRotations = 0.0;  ///< after them
  std::string caseToml;            ///< as resolved

  double endRotation() const { return settleRotations + averagedRotations; }

  void fields(auto& io) {
    io("name", name, aName);
    io("purpose", purpose);
    io("file", file);
    io("families", families);
    io("cell", cell);
    io("label", label);
    io("kn", kn);
    io("mu", mu);
    io("bottom_friction", bottomFriction);
    io("settle_rotations", settleRotations);
    io("averaged_rotations", averagedRotations);
    io("toml", caseToml);
  }
};

/// Means over one part of a run, most often one rotation, of what single snapshots show; the
/// largest overlap is that of all of them. Absent is what the run has no data for.
struct ThesisSpan {
  double from = 0.0, to = 0.0;          ///< rotations of the wheel since the ring had closed
  std::optional<double> outerPressure;  ///< [N/m²]
  std::optional<double> wheelTorque;    ///< [N m]
  std::optional<double> wheelContacts;  ///< of the wheel's disks with others, at a time
  std::optional<double> wheelTouched;   ///< fraction of the time with any of those [-]
  std::optional<double> coordination;   ///< [-]
  std::optional<double> volumeFractionAtWheel;  ///< of the innermost ring of the case [-]
  std::optional<double> volumeFractionOutside;  ///< area mean over the outer half of the rings [-]
  std::optional<double> velocityAtWheel;        ///< v_φ/(ΩR_i) of the innermost ring [-]
  std::optional<double> kineticEnergy;          ///< [J]
  std::optional<double> maxOverlap, meanOverlap;  ///< [m]
};

/// All numbers of a span with their names in files, in the order of history.csv.
struct SpanNumber {
  std::string_view name;
  std::optional<double> ThesisSpan::*of;
};
inline constexpr SpanNumber spanNumbers[] = {
    {"outer_pressure", &ThesisSpan::outerPressure},
    {"wheel_torque", &ThesisSpan::wheelTorque},
    {"wheel_contacts", &ThesisSpan::wheelContacts},
    {"wheel_touched", &ThesisSpan::wheelTouched},
    {"coordination", &ThesisSpan::coordination},
    {"volume_fraction_at_wheel", &ThesisSpan::volumeFractionAtWheel},
    {"volume_fraction_outside", &ThesisSpan::volumeFractionOutside},
    {"velocity_at_wheel", &ThesisSpan::velocityAtWheel},
    {"kinetic_energy", &ThesisSpan::kineticEnergy},
    {"max_overlap", &ThesisSpan::maxOverlap},
    {"mean_overlap", &ThesisSpan::meanOverlap}};

void fields(auto& io, ThesisSpan& span) {
  io("from", span.from);
  io("to", span.to);
  for (const SpanNumber& number : spanNumbers) io(number.name.data(), span.*number.of);
}

/// Averages over rings of another width than the case's.
struct RingAverages {
  int rings = 0;
  RingPlaces places;              ///< empty: equally wide, from the wheel to the ring
  std::vector<Profile> profiles;  ///< of all the case's methods, without n_eff and dof

  void fields(auto& io) {
    io("count", rings);
    io("places", places);
    io("profiles", profiles);
  }
};

/// One engine on one packing of one case.
struct ThesisRun {
  std::string setup, engine;  ///< names of the case and the engine
  int packing = 0;
  std::uint64_t seed = 0;
  std::string key = {};      ///< of all that it depends on, so that another session loads it
  std::string program = {};  ///< that made it: "0.3.0 (7902f0e)"
  FlowRun run;               ///< averaged over the case's last rotations, on the case's rings
  std::vector<RingAverages> finer;  ///< the same time on narrower rings: about d/3
  std::vector<ThesisSpan> history;  ///< from the closing of the ring to the end

  void fields(auto& io) {
    io("leg", setup, aName);
    io("engine", engine, aName);
    io("packing", packing);
    io("seed", seed);
    io("key", key);
    io("program", program);
    io("run", run);
    io("finer", finer);
    io("history", history);
  }
};

/// What files and reports call a claim's verdict.
inline constexpr support::EnumNames<Verdict, 4> claimVerdictNames{
    {{Verdict::pass, "reproduced"},
     {Verdict::fail, "refuted"},
     {Verdict::undecided, "undecided"},
     {Verdict::notApplicable, "cannot_be_tested"}}};

/// One number that a claim's verdict rests on, beside what the thesis says it should be.
struct ClaimFigure {
  std::string name;  ///< "exponent of σ_rφ"
  std::string unit;
  std::optional<double> value, standardError;  ///< over packings
  std::optional<double> low, high;             ///< what the rule asks for; absent: no bound there
  std::string key = {};                        ///< the rule's name of it: "exponent_rp"
  std::optional<Verdict> verdict = {};         ///< absent: reported, not judged

  void fields(auto& io) {
    io("name", name);
    io("unit", unit, aUnit);
    io("value", value);
    io("stderr", standardError);
    io("low", low);
    io("high", high);
    io("key", key);
    io("verdict", verdict, claimVerdictNames);
  }
};

/// What one claim comes to for one engine, under one interpretation of what the thesis leaves open.
struct ClaimRow {
  std::string id;              ///< "C7"
  std::string claim;           ///< in one sentence
  std::string engine;          ///< "-" where no engine takes part (a model, the averaging alone)
  std::string mirror;          ///< whose runs stand for the engine's, too; empty: the engine's own
  std::string interpretation;  ///< "wall spacing 2.5 mm, as printed"
  std::vector<ClaimFigure> figures;  ///< the first is the one that the table shows
  Verdict verdict = Verdict::undecided;
  std::string why;  ///< the reason, by rule, with the numbers
  /// Of a refuted claim: why it fails, or where it would hold, as far as that was found.
  std::vector<std::string> reasons;
  std::vector<std::string> cases;  ///< that it rests on
  std::string plot;                ///< "figure 7.14": the report's redrawn one; empty: none

  void fields(auto& io) {
    io("id", id);
    io("claim", claim);
    io("engine", engine, aName);
    io("carrier", mirror, aName);
    io("reading", interpretation);
    io("figures", figures);
    io("verdict", verdict, claimVerdictNames);
    io("why", why);
    io("reasons", reasons);
    io("legs", cases);
    io("plot", plot);
  }
};

/// An engine that lockstep compared with its mirror, whose runs may stand for it.
struct ThesisSurrogate {
  std::string engine, mirror;
  bool accepted = false;             ///< the mirror's runs are the engine's, too
  std::optional<double> equivalent;  ///< ε_eq: a change of k_n that would make the same difference
  std::size_t starts = 0;            ///< windows that were followed to the end
  std::string why;                   ///< the verdict as a sentence

  void fields(auto& io) {
    io("engine", engine, aName);
    io("mirror", mirror, aName);
    io("carries", accepted);
    io("equivalent", equivalent);
    io("starts", starts);
    io("why", why);
  }
};

/// Kind "thesis".
struct ThesisResults {
  ResultsHead head;
  std::optional<double> elapsed;  ///< wall time of the last command [s]
  std::vector<EngineRow> engines;
  std::vector<ThesisSurrogate> surrogates;
  std::string rules;  ///< the claims' rules, the file's text as it was applied
  /// Reasons that somebody found for what is refuted, and when they hold; the file's text, or none.
  std::string reasons;
  std::optional<CollideResults> collisions;  ///< of the sweep's case of them
  std::vector<ThesisCase> cases;
  std::vector<ThesisRun> runs;
  std::vector<ClaimRow> claims;
  std::vector<std::string> notes;  ///< what was left out, and why
};

Json toJson(const ThesisResults& results);
/// @throws FieldError
ThesisResults thesisFromJson(const Json& json);

/// Claims, tables and figures are made of this alone, about a tenth of the runs: profiles of the
/// fields that they read; finer rings and distributions of Table 3.2's cases and their
/// interpretations, the latter on the rings that are read; no series, checks and pictures; of
/// collisions e_n and Ψ_f. Profiles and collisions have 6 significant digits (their errors 3),
/// distributions 4, all else is as it was; compacted(compacted(r)) == compacted(r).
///
/// A campaign compacts before it judges, so that the file says all that its claims rest on, to the
/// bit. The whole of each run stays in the command's folder (runs/).
ThesisResults compacted(ThesisResults results);
/// Whether profiles of that field are kept, so that claims and figures may read it.
bool isReadByFormulas(std::string_view field);

}  // namespace crossgrain::inline results
