#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adapters/files/frame.hpp"
#include "adapters/files/write_snapshots.hpp"

/// Parts that the writers share.
namespace crossgrain::files {

/// A text file that grows in NAME.part, a megabyte at a time. One that is not closed is removed.
class TextOutput {
 public:
  /// Makes the folder too. @throws OutputError
  explicit TextOutput(std::filesystem::path file);
  ~TextOutput();
  TextOutput(const TextOutput&) = delete;
  TextOutput& operator=(const TextOutput&) = delete;

  /// @throws OutputError
  template <class... Values>
  void print(fmt::format_string<Values...> text, Values&&... values) {
    fmt::format_to(std::back_inserter(buffer_), text, std::forward<Values>(values)...);
    if (buffer_.size() >= fullBuffer) flush();
  }

  /// It gets its name. @throws OutputError
  void close();

 private:
  static constexpr std::size_t fullBuffer = 1 << 20;
  void flush();

  std::filesystem::path file_, part_;
  std::FILE* stream_;
  fmt::memory_buffer buffer_;
};

/// A disk or a wall disk.
template <int D>
struct WrittenParticleOf {
  VecOf<D> position, velocity;   ///< [m], [m/s]
  double radius = 0.0;           ///< [m]
  SpinOf<D> spin = noSpin<D>();  ///< in the plane counter-clockwise positive [rad/s]
  std::optional<double> mass;    ///< absent of wall disks, which are fixed [kg]
  std::int32_t body = -1;        ///< wall body of a wall disk
  std::int32_t material = 0;
};
using WrittenParticle = WrittenParticleOf<2>;

/// The same, with 0 for −0.
inline Vec2 unsignedZeros(const Vec2& v) {
  return {v.x() + 0.0, v.y() + 0.0};
}

/// A wall body as a snapshot shows it.
template <int D>
BodyStateOf<D> stateOf(const BodySnapshotOf<D>& shown) {
  return {.centre = shown.centre,
          .angle = shown.angle,
          .velocity = shown.velocity,
          .angularVelocity = shown.angularVelocity};
}

/// Disks, then wall disks, by the scene's ids.
template <int D>
class WrittenParticlesOf {
 public:
  explicit WrittenParticlesOf(const SceneOf<D>& scene);

  std::size_t size() const { return radius_.size(); }
  const std::vector<double>& radii() const { return radius_; }
  bool areRound() const { return scene_.shapes.empty(); }
  WrittenParticleOf<D> at(const SnapshotOf<D>& now, std::size_t id) const;

 private:
  const SceneOf<D>& scene_;
  std::vector<double> radius_;
  std::vector<std::int32_t> body_;  ///< of wall disks
};
using WrittenParticles = WrittenParticlesOf<2>;

/// A contact as files have it. Forces are on the first, which is never a wall.
template <int D>
struct WrittenContactOf {
  std::size_t first = 0, second = 0;        ///< ids; planes follow wall disks
  VecOf<D> normal;                          ///< from the second to the first
  VecOf<D> point;                           ///< half of the overlap inside of both [m]
  double overlap = 0.0;                     ///< [m]
  double normalForce = 0.0;                 ///< > 0 pushes [N]
  SpinOf<D> tangentialForce = noSpin<D>();  ///< in the plane along z × normal [N]
  SpinOf<D> rollingTorque = noSpin<D>();    ///< on the first [N m]

  /// z × normal
  Vec2 tangent() const requires(D == 2) { return perpendicular(normal); }
};
using WrittenContact = WrittenContactOf<2>;

/// @param particles  those of the scene  @pre the snapshot holds contacts
template <int D>
WrittenContactOf<D> contactAt(const WrittenParticlesOf<D>& particles, const SnapshotOf<D>& now,
                              std::size_t k);

/// SnapshotWriter::notWritten(), as far as it is the same for all formats.
/// @param rolling  whether the format has a place for rolling torques
template <int D>
std::vector<std::string> notInFormats(const SnapshotOf<D>& now, bool rolling = false);

std::unique_ptr<SnapshotWriter> openMercuryDpm(const std::filesystem::path& out, const Scene& scene,
                                               const WrittenBox& box);
template <int D>
std::unique_ptr<SnapshotWriterOf<D>> openLammps(const std::filesystem::path& out,
                                                const SceneOf<D>& scene, const FileBox& box);
/// @param height  of disks [m]
template <int D>
std::unique_ptr<SnapshotWriterOf<D>> openOnDem(const std::filesystem::path& out,
                                               const SceneOf<D>& scene, double height);

}  // namespace crossgrain::files
