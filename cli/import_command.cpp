#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/option_groups.hpp"
#include "cli/outcome.hpp"
#include "studies/flow/import.hpp"
#include "support/numbers.hpp"
#include "support/terminal.hpp"

namespace crossgrain::inline cli {

namespace {

int importFiles(const CommandLine& line, const ImportOptions& options) {
  const Imported done = importSnapshots(line, options);
  if (line.run.dryRun)
    return printPlanned(
        line, fmt::format("would convert {} of {} to {}",
                          support::counted(filesOf(line).size(), "file"), done.name, options.out));
  if (line.json) {
    printJson({{"file", options.out},
               {"engine", done.name},
               {"snapshots", done.snapshots},
               {"disks", done.disks},
               {"from_s", done.from},
               {"to_s", done.to},
               {"notes", done.remarks}});
    return exitPassed;
  }
  fmt::print("{} snapshots of {} disks by {}, t = {:.6g} to {:.6g} s: {}\n", done.snapshots,
             done.disks, done.name, done.from, done.to, options.out);
  for (const std::string& remark : done.remarks)
    printLines(stdout, fmt::format("note: {}\n", remark));
  return exitPassed;
}

Action declareImport(CLI::App& app, CommandLine& line) {
  const auto options = std::make_shared<ImportOptions>();
  addArgument(app, "format", options->format,
              "mercurydpm, lammps, yade-text, vtk, ondem, csv or xyz (docs/file-formats.md)",
              "FORMAT");
  addFilesAndCase(app, line, "result files of one run",
                  "case file: the scene, the law, what is averaged");
  addArgument(app, "--out", options->out,
              "HDF5 file to write; an older file of snapshots is replaced", "RUN.h5");
  addText(app, "--name", options->name,
          "settings of the files: units and columns in [engines.NAME] of the case (default: the "
          "format)",
          "NAME");
  addOverrides(app, line);
  addQuiet(app, line);
  addJson(app, line);
  addDryRun(app, line);
  return [&line, options] { return importFiles(line, *options); };
}

}  // namespace

extern const Command importCommand = {
    "import", "convert result files of another program to snapshots, for average and compare",
    "crossgrain import lammps atoms-1.dump pairs-1.dump examples/import/box.toml --name my-lammps "
    "--out out/lammps-1.h5\n"
    "crossgrain import mercurydpm run.data run.fstat my.toml --set engines.mercurydpm.plane=xz "
    "--out "
    "out/run.h5",
    declareImport};

}  // namespace crossgrain::inline cli
