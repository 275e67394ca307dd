#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "adapters/audit.hpp"
#include "adapters/files/displacements.hpp"
#include "adapters/files/file_units.hpp"
#include "adapters/files/frame_contacts.hpp"
#include "adapters/snapshot_source.hpp"

/// From result files of other programs to snapshots of a scene.
namespace crossgrain::files {

/// The scene that files are to be of.
template <int D>
struct FileSceneOf {
  std::string name;                   ///< engine()
  std::string where;                  ///< "[engines.mine]", for messages
  std::vector<WallBodyOf<D>> bodies;  ///< of the case, at t = 0
  std::optional<BoxOf<D>> box;        ///< of the case
  /// In the plane wall disks may be anywhere on the circle about their body's centre, as in a cell
  /// whose wheel has turned before.
  bool anyAngle = false;
  /// The scene with those disks, radii and masses empty where the files have none. @throws BadInput
  std::function<SceneOf<D>(DisksOf<D>)> around;
  /// The scene without disks, and the disks that the case begins with: particles may come and go
  /// where the first time of the files has these, or where their number changes before the averaged
  /// time. Empty: `around` says what is wrong with any other number.
  std::function<std::pair<SceneOf<D>, DisksOf<D>>()> open;
  /// Refuses disks of another size than the case's. @throws BadInput
  std::function<void(const DisksOf<D>&)> checkLengths;
  /// Reason why the case needs each particle from the start on: "the endpoint top is of disk 3".
  /// Empty: particles may come and go.
  std::string needsAll;
  /// Frames of (from, to] are averaged, those of other times left out, as engines are averaged from
  /// the first snapshot after `from` to that at `to`. Of files that have none there, the instant
  /// `from` itself is taken [s].
  double from = 0.0, to = INFINITY;
  double dt = 0.0;                      ///< of the case [s]
  VecOf<D> gravity = VecOf<D>::Zero();  ///< of the case [m/s²]
  std::vector<std::string> remarks;     ///< on the files, before they are read
};

/// Rows of particles that are wall disks of the case, which their place alone says: of all of the
/// case's wall disks in their order, or of none. Those of an assembly are found by the place that
/// the case prescribes at time t [s], or an image of it; those of a cell, which may be at any
/// angle, by their radius and their distance from the centre, and the target's reference places
/// then follow from theirs.
/// @throws BadInput where some of them are there and others are not
template <int D>
std::vector<std::size_t> wallRows(const FileFrame& frame, const FileUnits& units,
                                  FileSceneOf<D>& target, double t);

/// Frames as snapshots, one at a time: in SI units, along the scene's axes, audited.
///
/// Wall disks that are particles of the files are found by where they are, and all walls are where
/// the case prescribes them; forces on walls are the sums over their contacts. In a periodic box
/// files may wrap places or leave paths whole.
template <int D>
class FileSnapshotsOf : public SnapshotSourceOf<D> {
 public:
  /// Reads the first frame that is not left out.
  /// @throws BadInput naming the frame and what is wrong
  FileSnapshotsOf(std::unique_ptr<FrameReader> reader, FileUnits units, FileSceneOf<D> target);
  FileSnapshotsOf(const FileSnapshotsOf&) = delete;  // basis_ points into it
  FileSnapshotsOf& operator=(const FileSnapshotsOf&) = delete;

  const SceneOf<D>& scene() const override { return scene_; }
  bool disksChanged() const override { return disksChanged_; }
  const std::string& engine() const override { return target_.name; }
  std::optional<SnapshotOf<D>> next() override;
  double progress() const override { return reader_->progress(); }
  std::vector<std::string> remarks() const override;
  bool hasOtherLaw() const override { return lawDiffers_; }

 private:
  std::optional<FileFrame> readWithin();
  void requireContacts(const FileFrame& frame) const;
  void requireSame(const FileFrame& frame, SnapshotOf<D>& now);
  void recognise(const FileFrame& frame);
  void begin();
  void settleBasis();
  void requireOpen(const FileFrame& frame, std::size_t before) const;
  void learn(const FileFrame& frame);
  void remember();
  void changeDisks(const FileFrame& frame);
  DisksOf<D> disksOf(const FileFrame& frame, std::vector<std::int32_t>& materials) const;
  SnapshotOf<D> convert(const FileFrame& frame);
  void checkRadius(const FileFrame& frame, std::size_t row, std::size_t k) const;
  void allowForRounding(const FileFrame& frame);
  void checkSpeeds(const FileFrame& frame, const SnapshotOf<D>& now);
  void checkMotion(const FileFrame& frame, const SnapshotOf<D>& now);
  void checkEarlyMotion(const FileFrame& frame, double t);
  [[noreturn]] void refuseMotion(const FileFrame& frame, const MotionFinding& found) const;
  std::string remedyOfMotion(const FileFrame& frame) const;
  void audit(const FileFrame& frame, SnapshotOf<D>& snapshot);
  void checkLaw(const FileFrame& frame, const SnapshotOf<D>& snapshot);
  void checkSliding(const FileFrame& frame, const SnapshotOf<D>& snapshot);
  double timeOf(const FileFrame& frame) const;
  std::optional<double> timeByName(const FileFrame& frame) const;
  /// Unit that the files count: the time step, or the time from one file to the next [s].
  double step() const { return units_.dt > 0.0 ? units_.dt * units_.time : target_.dt; }
  /// As short as the engine's time step can be known to be [s].
  double shortestStep() const { return target_.dt > 0.0 ? std::min(step(), target_.dt) : step(); }

  std::unique_ptr<FrameReader> reader_;
  FileUnits units_;
  FileSceneOf<D> target_;
  std::optional<FileFrame> pending_;  ///< the first, until it is asked for
  SceneOf<D> scene_, bare_;           ///< with walls, and without
  std::optional<ParticleIds> ids_;
  /// Properties of a particle, known by its id.
  struct Known {
    double radius, mass;  ///< [m], [kg]
    std::int32_t material;
  };
  std::unordered_map<std::int64_t, Known> known_;        ///< of times before, once they come and go
  std::map<std::int64_t, std::int32_t> materialOfKind_;  ///< −1: several
  std::optional<double> density_;   ///< m/a², in space m/a³, of all that is known
  std::optional<FileFrame> first_;  ///< of all, without contacts, until the first averaged one
  double inertiaFactor_ = 0.0;      ///< J/(m a²)
  bool rows_ = false;               ///< ids are but numbers of rows
  bool disksChanged_ = false, cameAndWent_ = false;
  std::size_t fewest_ = 0, most_ = 0;  ///< particles of a snapshot, where they come and go
  AuditBasisOf<D> basis_, bareBasis_;
  std::optional<double> last_;  ///< time of the frame before [s]
  std::string lastWhere_;       ///< where that is
  std::size_t snapshots_ = 0, early_ = 0, late_ = 0, skipped_ = 0;
  std::string firstSkipped_;  ///< of contacts whose particles the files lack
  /// Whether the first snapshot has them; absent before it. All others have to be alike.
  std::optional<bool> contacts_, spins_;
  bool wallContacts_ = false;               ///< whether any was seen
  bool lawDiffers_ = false, moves_ = true;  ///< moves_: as velocities say, so far
  SlidingSense sliding_;
  bool saidSliding_ = false;
  bool alike_ = true;                 ///< no velocity stands out, so far
  std::vector<VecOf<D>> lastPlaces_;  ///< of the snapshot before [m]
  double lastTime_ = 0.0;             ///< its time [s]
  DisplacementsOf<D> displacements_, earlyDisplacements_;
  std::vector<std::int64_t> earlyIds_;  ///< of the frame before, rising
  std::set<std::string> remarks_;
};

}  // namespace crossgrain::files
