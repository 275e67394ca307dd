#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Result files of other programs, as they are: their data of one time, in their units, before the
/// scene is known.
namespace crossgrain::files {

using Vec3 = Eigen::Vector3d;

/// A box that particles are in.
struct FileBox {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< [length]
  bool periodic[3] = {false, false, false};
  bool saidFixed[3] = {false, false, false};  ///< where the file says so
};

/// A component of a vector that no column has, whose others are there.
struct MissingComponent {
  std::string column;  ///< "vz", "spin_x"
  int axis = 2;        ///< of the file's x, y, z
  bool axial =
      false;  ///< of a spin or a torque: those in a plane have the component across it alone
};

/// Particles of one time, structure of arrays. Data that the file does not have are empty.
struct FileParticles {
  std::vector<std::int64_t> id;           ///< the file's own; of files without ids, the row, from 0
  std::vector<Vec3> position;             ///< [length]
  std::vector<double> radius;             ///< [length]
  std::vector<Vec3> velocity;             ///< [length/time]
  std::vector<Vec3> spin;                 ///< right-handed [1/time]
  std::vector<double> mass;               ///< [mass]
  std::vector<std::int64_t> kind;         ///< type, species or material number
  std::vector<MissingComponent> missing;  ///< of what is there; its numbers are 0
  bool scaled = false;  ///< places are parts of a box in the file: their digits are not its own
  /// Lines of the file that the first and the last of them are, one a line; 0: not text.
  std::size_t firstLine = 0, lastLine = 0;

  std::size_t size() const { return position.size(); }
};

/// "particle 5 is there twice (lines 11 and 14)". @pre it is
std::string describeTwice(const FileParticles& particles, std::int64_t id);

/// Contacts of one time, each once or twice as the file lists them. Data that it does not have are
/// empty: each array but `first` and `second` is of all contacts or of none.
struct FileContacts {
  /// Ids of particles; a wall k is −k − 1, and always the second. A partner that is neither (a
  /// facet, a fixed body that is no particle) counts as a wall.
  std::vector<std::int64_t> first, second;
  std::vector<Vec3> normal;               ///< unit vector from second to first
  std::vector<Vec3> force;                ///< on the first, damping and attraction included [force]
  std::vector<double> normalForce;        ///< in place of `force`: > 0 pushes [force]
  std::vector<double> tangentialForce;    ///< in place of `force`: its size [force]
  std::vector<Vec3> point;                ///< where they touch [length]
  std::vector<double> overlap;            ///< > 0 where they overlap [length]
  std::vector<Vec3> torque;               ///< of rolling resistance on the first [force·length]
  std::vector<MissingComponent> missing;  ///< as of particles

  std::size_t size() const { return first.size(); }
};

/// One time of a run.
struct FileFrame {
  std::string where;                 ///< "out/run.data, time 3": for messages
  std::optional<double> time;        ///< [time]; absent where the file has steps alone
  std::optional<std::int64_t> step;  ///< absent where it has none
  /// Of velocities and of contacts, where the file says them of their own.
  std::optional<double> velocityTime, contactTime;
  /// Of a file without a time that is the only one, whose number may be anything: the step is that
  /// number, or absent.
  bool alone = false;
  std::optional<FileBox> box;
  FileParticles particles;
  std::optional<FileContacts> contacts;
  /// Where there are files of contacts, but none of this time: the contacts found instead, "the
  /// last are of run.local, step 4000".
  std::string contactsOfOtherTimes;
  /// Where the files of contacts have times between the frame before and this one that the
  /// particles lack: how many, and which is the first, "run.fstat, time 3".
  std::size_t timesSkipped = 0;
  std::string firstSkipped;
};

/// Facts that a file does not contain.
struct FileOptions {
  /// Meanings of columns (or arrays) whose names their program does not fix, as
  /// "NAME=MEANING NAME=MEANING …": "c_q=normal_force,tx,ty,tz,- f_floor=wall v_m=mass". NAME alone
  /// is NAME[1], NAME[2], … in order; "-" is not read. Meanings are the names of columns of CSV
  /// files (docs/file-formats.md). Formats whose names are fixed take none.
  std::string columns;
  /// The case's periodic box, of files that say none [length].
  std::optional<FileBox> box = {};
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

/// Whether it begins as HDF5 does.
bool isHdf5(const std::filesystem::path& file);

/// Whether MercuryDPM wrote it beside a .data or .fstat that is among the files: NAME.restart,
/// NAME.ene and others, which have nothing to be averaged; or an index of VTK files among them has
/// it.
bool isBesideResults(const std::filesystem::path& file,
                     const std::vector<std::filesystem::path>& files);

/// Files of the same format, sorted into runs: files whose names differ by a number alone (their
/// last one) are times of one run (unless their own first times do not rise with it: then each is a
/// run), other names and other folders are other runs. A file of contacts
/// goes with the particles of the same name, but for words such as "atoms", "contacts", "pairs",
/// "spheres", "intrs" and the extension; or with those of its folder, if these are one run. In the
/// format "mercurydpm" a number before ".data" names a run, one after it a time. Runs come in the
/// order of their names, times of a run by their number.
/// @throws BadInput where contacts go with no particles
std::vector<std::vector<std::filesystem::path>> runsOf(std::string_view format,
                                                       std::vector<std::filesystem::path> files);

/// Opens the files of one run. @throws BadInput
std::unique_ptr<FrameReader> openFrames(std::string_view format,
                                        const std::vector<std::filesystem::path>& files,
                                        const FileOptions& options = {});

}  // namespace crossgrain::files
