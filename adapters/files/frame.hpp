#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Result files of other programs, as they are: what they say of one time, in their units, before
/// anybody knows which scene it is of.
namespace crossgrain::files {

using Vec3 = Eigen::Vector3d;

/// A box that particles are in.
struct FileBox {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< [length]
  bool periodic[3] = {false, false, false};
};

/// Particles of one time, structure of arrays. What the file does not have is empty.
struct FileParticles {
  std::vector<std::int64_t> id;    ///< the file's own; of files without ids, the row, from 0
  std::vector<Vec3> position;      ///< [length]
  std::vector<double> radius;      ///< [length]
  std::vector<Vec3> velocity;      ///< [length/time]
  std::vector<Vec3> spin;          ///< right-handed [1/time]
  std::vector<double> mass;        ///< [mass]
  std::vector<std::int64_t> kind;  ///< type, species or material number

  std::size_t size() const { return position.size(); }
};

/// Contacts of one time, each once or twice as the file lists them. What it does not have is empty.
struct FileContacts {
  std::vector<std::int64_t> first, second;  ///< ids of particles; a wall k is −k − 1
  std::vector<Vec3> normal;                 ///< unit vector from second to first
  std::vector<Vec3> force;              ///< on the first, damping and attraction included [force]
  std::vector<double> normalForce;      ///< in place of `force`: > 0 pushes [force]
  std::vector<double> tangentialForce;  ///< in place of `force`: its size [force]
  std::vector<Vec3> point;              ///< where they touch [length]
  std::vector<double> overlap;          ///< > 0 where they overlap [length]
  std::vector<Vec3> torque;             ///< of rolling resistance on the first [force·length]

  std::size_t size() const { return first.size(); }
};

/// One time of a run.
struct FileFrame {
  std::string where;                 ///< "out/run.data, time 3": for messages
  std::optional<double> time;        ///< [time]; absent where the file has steps alone
  std::optional<std::int64_t> step;  ///< absent where it has none
  std::optional<FileBox> box;
  FileParticles particles;
  std::optional<FileContacts> contacts;
};

/// The frames of one run, read one by one: memory holds one at a time.
class FrameReader {
 public:
  virtual ~FrameReader() = default;
  /// The next frame, by time; absent after the last.
  /// @throws BadInput naming file, line (or dataset) and what would be right
  virtual std::optional<FileFrame> next() = 0;
  /// How far it has read, 0 … 1, by bytes.
  virtual double progress() const = 0;
};

/// The formats that are read: "mercurydpm", "lammps", …
std::vector<std::string_view> fileFormats();

/// The format of a file, by what it begins with; absent: none that is known.
std::optional<std::string_view> formatOf(const std::filesystem::path& file);

/// Files of the same format, sorted into runs: files whose names differ by a number alone (their
/// last one) are times of one run, other names and other folders are other runs; files of particles
/// and of contacts of the same name go together. Runs come in the order of their names, numbers
/// counted as numbers.
std::vector<std::vector<std::filesystem::path>> runsOf(std::string_view format,
                                                       std::vector<std::filesystem::path> files);

/// Opens the files of one run. @throws BadInput
std::unique_ptr<FrameReader> openFrames(std::string_view format,
                                        const std::vector<std::filesystem::path>& files);

}  // namespace crossgrain::files
