#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "adapters/files/contact_table.hpp"
#include "adapters/files/frame.hpp"
#include "adapters/files/text_file.hpp"

/// The readers of single formats; formats.cpp has the list.
namespace crossgrain::files {

using Files = std::vector<std::filesystem::path>;

std::unique_ptr<FrameReader> openMercuryDpm(const Files& files, const FileOptions& options);
std::unique_ptr<FrameReader> openLammps(const Files& files, const FileOptions& options);
std::unique_ptr<FrameReader> openYadeText(const Files& files, const FileOptions& options);
std::unique_ptr<FrameReader> openVtk(const Files& files, const FileOptions& options);
std::unique_ptr<FrameReader> openOnDem(const Files& files, const FileOptions& options);
std::unique_ptr<FrameReader> openCsv(const Files& files, const FileOptions& options);
std::unique_ptr<FrameReader> openXyz(const Files& files, const FileOptions& options);

/// Kind of data in a file, where a format keeps particles and contacts apart. @throws BadInput
enum class Content { particles, contacts };
Content contentOfMercuryDpm(const std::filesystem::path& file);
Content contentOfLammps(const std::filesystem::path& file);
Content contentOfVtk(const std::filesystem::path& file);
Content contentOfCsv(const std::filesystem::path& file);

/// The first time or step that such a file has: by which times of one run are known from other
/// runs.
double firstTimeOfLammps(const std::filesystem::path& file);
double firstTimeOfCsv(const std::filesystem::path& file);
double firstTimeOfXyz(const std::filesystem::path& file);

/// Of an index of VTK files (.pvtu, .pvtp), those that it names; of any other file none.
/// @throws BadInput
Files piecesOfVtk(const std::filesystem::path& file);

/// Files of one content.
Files filesOf(const Files& files, Content content,
              Content (*contentOf)(const std::filesystem::path&));

/// One time of one kind of file: particles, or contacts, or both.
struct Part {
  FileFrame frame;                    ///< contacts only where they are in their final terms
  std::optional<ContactTable> table;  ///< contacts that want the particles
  bool wallsAlone = false;            ///< those of particles with each other are in other files
};

/// The times of one kind of file, one after the other.
class PartReader {
 public:
  virtual ~PartReader() = default;
  virtual std::optional<Part> next() = 0;
  virtual std::size_t bytesRead() const = 0;
  virtual std::size_t bytes() const = 0;
};

/// Text files with any number of times each.
class TextParts : public PartReader {
 public:
  /// @param read   the next time of a file that has something left; the text is before its first
  ///               line
  /// @param begin  called with each file before
  TextParts(
      std::vector<std::filesystem::path> files, std::function<Part(TextFile&)> read,
      std::function<void(TextFile&)> begin = [](TextFile&) {});
  std::optional<Part> next() override;
  std::size_t bytesRead() const override { return before_ + (text_ ? text_->bytesRead() : 0); }
  std::size_t bytes() const override { return bytes_; }

 private:
  std::vector<std::filesystem::path> files_;
  std::function<Part(TextFile&)> read_;
  std::function<void(TextFile&)> begin_;
  std::size_t at_ = 0, before_ = 0, bytes_ = 0;
  std::optional<TextFile> text_;
};

/// Files of one time each.
class WholeFiles : public PartReader {
 public:
  /// @param read  a file; where it says neither time nor step, the last number of its name is the
  ///              step: of a single file it may be (FileFrame::alone)
  WholeFiles(std::vector<std::filesystem::path> files,
             std::function<Part(const std::filesystem::path&)> read);
  std::optional<Part> next() override;
  std::size_t bytesRead() const override { return before_; }
  std::size_t bytes() const override { return bytes_; }

 private:
  std::vector<std::filesystem::path> files_;
  std::function<Part(const std::filesystem::path&)> read_;
  std::size_t at_ = 0, before_ = 0, bytes_ = 0;
};

/// The last number in a file's name: 400 of "run2-spheres.400.vtu".
std::optional<std::int64_t> numberInName(const std::filesystem::path& file);

/// A file's name without its last number (the extension's counts), the same for all files of a
/// series.
std::string seriesOf(const std::filesystem::path& file);
/// Files by that, each series in the order of its numbers.
std::vector<std::vector<std::filesystem::path>> bySeries(std::vector<std::filesystem::path> files);

/// Particles with the contacts of the same time: of the same step where both have steps, else of
/// times that are equal within six digits. Contacts of other times are left out; a time of which
/// there are none has none. Of several readers of contacts all must have it.
/// @param options  whose names must be among the columns; may be null
/// @param prepare  what the format does with contacts once their particles are known; may be empty
std::unique_ptr<FrameReader> joinParts(std::unique_ptr<PartReader> particles,
                                       std::vector<std::unique_ptr<PartReader>> contacts,
                                       std::shared_ptr<const ColumnOptions> options,
                                       std::function<void(ContactTable&, FileFrame&)> prepare = {});

}  // namespace crossgrain::files
