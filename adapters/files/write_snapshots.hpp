#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/scene.hpp"
#include "adapters/snapshot.hpp"

/// Snapshots as result files of other programs, in SI units. The plane of motion is z = 0, and all
/// numbers are the shortest that read back as the same double.
namespace crossgrain::files {

/// The box that the files of snapshots of the plane state. With its thickness the sums per volume
/// that other programs make are ours: N/m² is then N/m².
struct WrittenBox {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();  ///< [m]
  double height = 1.0;                           ///< along z, half of it on either side of 0 [m]
};

/// Writes snapshots one after the other: memory holds the one that is being written. Files have
/// their names once close() has been called; unfinished files are removed.
template <int D>
class SnapshotWriterOf {
 public:
  virtual ~SnapshotWriterOf() = default;

  /// @pre it is of the writer's scene  @throws OutputError
  virtual void write(const SnapshotOf<D>& now) = 0;

  /// @throws OutputError
  virtual void close() = 0;

  /// Data of the snapshots for which the format has no place, and data that it requires and the
  /// snapshots lack: a line each.
  virtual std::vector<std::string> notWritten() const = 0;
};
using SnapshotWriter = SnapshotWriterOf<2>;

/// "mercurydpm": NAME.data, NAME.fstat and NAME.restart, which MercuryCG averages.
/// "lammps": NAME.dump and NAME.contacts, as `dump custom` and `dump local` write them.
/// "ondem": NAME-000.vtkhdf, -001, …, one a snapshot, in the layout that the Open Network on DEM
/// decided on in October 2026, made for the VTKHDF reader of ParaView 5.13 and later.
std::vector<std::string_view> writtenFormats();

/// The files that a format makes of so many snapshots.
/// @param out  NAME, with its folder  @pre the format is one of writtenFormats()
std::vector<std::filesystem::path> writtenFiles(std::string_view format,
                                                const std::filesystem::path& out,
                                                std::size_t snapshots);

/// @param scene  outlives the writer. Disks, then wall disks, are particles; wall disks are fixed
///        ones without a mass
/// @throws BadInput if there is no such format; OutputError
std::unique_ptr<SnapshotWriter> openWriter(std::string_view format,
                                           const std::filesystem::path& out, const Scene& scene,
                                           const WrittenBox& box);
/// The same in space.
/// @param box  that files state, if their format has one
/// @throws BadInput of mercurydpm, and of walls that the format does not have
std::unique_ptr<SnapshotWriterOf<3>> openWriter(std::string_view format,
                                                const std::filesystem::path& out,
                                                const SpaceScene& scene, const BoxOf<3>& box);

}  // namespace crossgrain::files
