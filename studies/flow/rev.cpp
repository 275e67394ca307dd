#include "studies/flow/average.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "averaging/profiles.hpp"
#include "results/schema.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/study_cases.hpp"
#include "studies/flow/frame.hpp"
#include "studies/flow/run.hpp"
#include "studies/flow/snapshot_file.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

namespace {

/// Where the rings lie, as parts of the way from R_i to R_o: r = 0.12, 0.13, 0.14 and 0.20 m in the
/// thesis' cell (Lätzel 2003, Fig. 5.6).
constexpr double places[] = {0.0168 / 0.1492, 0.0268 / 0.1492, 0.0368 / 0.1492, 0.0968 / 0.1492};

/// Ring widths in units of d, closest where methods are expected to meet.
std::vector<double> widths() {
  std::vector<double> result = {0.1,  0.12, 0.15, 0.18, 0.22, 0.26,
                                0.31, 0.37, 0.45, 0.54, 0.65, 0.75};
  for (int k = 16; k <= 50; ++k) result.push_back(k / 20.0);
  for (int k = 14; k <= 20; ++k) result.push_back(k / 5.0);
  return result;
}

/// The ring about r of that width with its two neighbours, and what is left of the cell; absent
/// where it does not fit. The rest is there for the walls' stress to be where it belongs.
std::optional<Rings> ringsAbout(const Case& setup, double r, double width) {
  const double inner = couetteIn(setup).cell.innerRadius, outer = couetteIn(setup).cell.outerRadius;
  if (r - 0.5 * width < inner || r + 0.5 * width > outer) return std::nullopt;
  std::vector<double> edges = {inner};
  for (const double edge : {-1.5, -0.5, 0.5, 1.5})
    if (const double at = r + edge * width; at > edges.back() && at < outer) edges.push_back(at);
  edges.push_back(outer);
  return Rings(std::move(edges), couetteIn(setup).cell.height,
               2.0 * couetteIn(setup).particles.smallRadius);
}

using Curves = std::map<std::tuple<std::string, std::string, double>, RevCurve>;

void addWidth(const Case& setup, const SnapshotReader& reader, double width, Curves& curves) {
  const double diameter = 2.0 * couetteIn(setup).particles.smallRadius;
  const std::vector<std::string> names(weightNames.begin(), weightNames.end());
  const std::vector<Weight> weights = weightsOf(setup, names);
  for (const double place : places) {
    const double r =
        couetteIn(setup).cell.innerRadius +
        place * (couetteIn(setup).cell.outerRadius - couetteIn(setup).cell.innerRadius);
    const auto rings = ringsAbout(setup, r, width * diameter);
    if (!rings) continue;
    ProfileAccumulator accumulator(*rings, weights, reader.scene());
    for (std::size_t k = 0; k < reader.count(); ++k) {
      throwIfInterrupted();
      try {
        accumulator.add(reader.read(k));
      } catch (const std::invalid_argument& misfit) {
        throw BadInput(fmt::format("snapshot {}: {}", k, misfit.what()));
      }
    }
    const auto ring = static_cast<std::size_t>(rings->binOf(r));
    for (const Profile& profile : accumulator.profiles()) {
      RevCurve& curve = curves[{profile.method, profile.field, r}];
      curve.method = profile.method;
      curve.field = profile.field;
      curve.unit = profile.unit;
      curve.r = r;
      curve.width.push_back(width);
      curve.mean.push_back(profile.mean[ring]);
      curve.standardError.push_back(profile.standardError[ring]);
    }
  }
}

std::vector<RevMeeting> meetingsOf(const std::vector<RevCurve>& curves) {
  std::vector<RevMeeting> rows;
  for (const std::string_view method : weightNames) {
    if (method == "slicing") continue;
    for (const FieldSpec& spec : fieldTable())
      for (const double near : {1.0, 2.0}) {
        std::optional<RevMeeting> best;
        for (const double width : widths()) {
          if (std::abs(width - near) > 0.26) continue;
          const auto found = differenceFromSlicing(curves, spec.name, method, width);
          if (found && (!best || *found < best->difference))
            best = {std::string(method), std::string(spec.name), near, width, *found};
        }
        if (best) rows.push_back(*best);
      }
  }
  return rows;
}

RevResults averagePerWidth(const StudyWork& work, const AverageOptions&) {
  const Case& setup = work.setup();
  const std::filesystem::path& file = work.line.snapshots;
  const auto opened = openSnapshotFile<2>(file, setup);
  while (opened->next()) throwIfInterrupted();  // sound to the end
  const SnapshotReader& reader = *opened;
  Progress progress(work.line.run.quiet);
  const std::vector<double> all = widths();
  progress.begin("averaging", std::vector<double>(all.size(), 1.0));
  Curves curves;
  for (std::size_t k = 0; k < all.size(); ++k) {
    addWidth(setup, reader, all[k], curves);
    progress.update(k, "ring widths", 1.0);
  }
  RevResults results{
      flowFrame(kindRev, setup, work.line.run.commandLine, reader.scene().disks.radius),
      reader.engine(),
      {},
      {}};
  results.averaging.snapshots = static_cast<std::int64_t>(reader.count());
  results.averaging.lineWidth = setup.averaging.lineWidth;
  results.notes = {fmt::format("Averaged from the {} snapshots of {}; nothing was run.",
                               reader.count(), file.string())};
  for (const std::string_view method : weightNames)
    for (const FieldSpec& field : fieldTable())
      for (const auto& [_, curve] : curves)
        if (curve.method == method && curve.field == field.name) results.curves.push_back(curve);
  results.meetings = meetingsOf(results.curves);
  return results;
}

}  // namespace

const Study<AverageOptions, RevResults> revStudy = {
    "rev",
    {.input = SharedOptions::Input::snapshots, .engines = false},
    Keeps::nothing,
    [](AverageOptions&, CommandLine& line) {
      return std::vector<StudyOption>{{"--quiet", "no progress", &line.run.quiet}};
    },
    [](const CommandLine& line, AverageOptions&) { return std::vector{onlyCase(line, "rev")}; },
    nullptr,
    averagePerWidth,
    [](const RevResults&, const CommandLine&, const AverageOptions&) { return Outcome(); }};

}  // namespace crossgrain::inline studies
