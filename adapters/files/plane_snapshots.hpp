#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "adapters/audit.hpp"
#include "adapters/engine.hpp"
#include "adapters/files/displacements.hpp"
#include "adapters/files/frame.hpp"
#include "adapters/snapshot_source.hpp"

/// From result files of other programs to snapshots of a plane scene.
namespace crossgrain::files {

/// What no file says of itself: [engines.NAME] of a case.
struct PlaneUnits {
  double length = 1.0, time = 1.0, mass = 1.0;  ///< of the file's units [m], [s], [kg]
  double dt = 0.0;              ///< time step of files that count steps [file's time]; 0: not said
  double start = 0.0;           ///< when the case's t = 0 is [file's time]
  double contactsBehind = 0.0;  ///< steps by which contacts are older than positions [dt]
  int axes[2] = {0, 1};         ///< of the file's x, y, z, that are x and y of the scene
  double turn = 1.0;            ///< z of the scene along the third axis (1) or against it (−1)

  double force() const { return mass * length / (time * time); }  ///< of the file's units [N]
  int third() const { return 3 - axes[0] - axes[1]; }
  Vec2 inPlane(const Vec3& v) const { return {v[axes[0]], v[axes[1]]}; }
  double aboutNormal(const Vec3& v) const { return turn * v[third()]; }
};

/// The settings of a format's files, with its own defaults.
std::vector<SettingSpec> planeSettings(std::string_view format);
/// @param settings  of planeSettings(); what is missing has its default
PlaneUnits planeUnits(std::string_view format, const Settings& settings);

/// The scene that files are to be of.
struct PlaneScene {
  std::string name;              ///< engine()
  std::string where;             ///< "[engines.mine]", for messages
  std::vector<WallBody> bodies;  ///< of the case, at t = 0
  /// Wall disks may be anywhere on the circle about their body's centre, as in a cell whose wheel
  /// has turned before.
  bool anyAngle = false;
  /// The scene with those disks, radii and masses empty where the files have none. @throws BadInput
  std::function<Scene(Disks)> around;
  double from = 0.0, to = INFINITY;  ///< frames of other times are left out [s]
  double dt = 0.0;                   ///< of the case [s]
  Vec2 gravity = Vec2::Zero();       ///< of the case [m/s²]
  std::vector<std::string> remarks;  ///< on the files, before they are read
};

/// Which particle of the files is which disk: disks by rising id, wall disks by where they are.
class ParticleIds {
 public:
  /// @param walls  rows that are wall disks, in the order of wall disks
  ParticleIds(const std::vector<std::int64_t>& idOfRow, const std::vector<std::size_t>& walls);

  std::size_t disks() const { return disks_; }
  std::size_t size() const { return sorted_.size(); }
  /// Disks, then wall disks; absent: no such particle.
  std::optional<std::size_t> ourOf(std::int64_t id) const;
  std::int64_t theirOf(std::size_t our) const { return theirs_[our]; }

 private:
  std::vector<std::int64_t> sorted_, theirs_;
  std::vector<std::size_t> ours_;  ///< of sorted_
  std::size_t disks_ = 0;
};

/// Contacts of a frame by our ids, i < j, each once.
/// @param snapshot  all but its contacts; its planes follow from the basis
/// @param remarks   what is missing and what that costs is added
/// @returns absent where the files do not say them
/// @throws BadInput naming the frame and the contact
std::optional<Contacts> planeContacts(const FileFrame& frame, const PlaneUnits& units,
                                      const ParticleIds& ids, const Snapshot& snapshot,
                                      const AuditBasis& basis, std::set<std::string>& remarks);

/// Frames as snapshots, one at a time: in SI units, in the plane, audited.
///
/// Wall disks that are particles of the files are found by where they are, and all walls are where
/// the case prescribes them; forces on walls are the sums over their contacts.
class PlaneSnapshots : public SnapshotSource {
 public:
  /// Reads the first frame that is not left out.
  /// @throws BadInput naming the frame and what is wrong
  PlaneSnapshots(std::unique_ptr<FrameReader> reader, PlaneUnits units, PlaneScene target);
  PlaneSnapshots(const PlaneSnapshots&) = delete;  // basis_ points into it
  PlaneSnapshots& operator=(const PlaneSnapshots&) = delete;

  const Scene& scene() const override { return scene_; }
  const std::string& engine() const override { return target_.name; }
  std::optional<Snapshot> next() override;
  double progress() const override { return reader_->progress(); }
  std::vector<std::string> remarks() const override;

 private:
  std::optional<FileFrame> readWithin();
  void requireContacts(const FileFrame& frame) const;
  void recognise(const FileFrame& frame);
  Snapshot convert(const FileFrame& frame);
  void allowForRounding(const FileFrame& frame);
  void checkMotion(const FileFrame& frame, const Snapshot& now);
  void checkEarlyMotion(const FileFrame& frame, double t);
  [[noreturn]] void refuseMotion(const FileFrame& frame, const Displacements::Finding& found) const;
  std::string remedyOfMotion(const FileFrame& frame) const;
  void audit(const FileFrame& frame, Snapshot& snapshot);
  double timeOf(const FileFrame& frame) const;
  double step() const { return units_.dt > 0.0 ? units_.dt * units_.time : target_.dt; }

  std::unique_ptr<FrameReader> reader_;
  PlaneUnits units_;
  PlaneScene target_;
  std::optional<FileFrame> pending_;  ///< the first, until it is asked for
  Scene scene_, bare_;                ///< with walls, and without
  std::optional<ParticleIds> ids_;
  AuditBasis basis_, bareBasis_;
  std::optional<double> last_;  ///< time of the frame before [s]
  std::string lastWhere_;       ///< where that is
  std::size_t early_ = 0, late_ = 0;
  bool wallContacts_ = false;               ///< whether any was seen
  bool lawDiffers_ = false, moves_ = true;  ///< moves_: as velocities say, so far
  Displacements displacements_, earlyDisplacements_;
  std::vector<std::int64_t> earlyIds_;  ///< of the frame before, rising
  std::set<std::string> remarks_;
};

}  // namespace crossgrain::files
