#include "adapters/files/readers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "support/bad_input.hpp"
#include "support/input_file.hpp"

namespace crossgrain::files {
namespace fs = std::filesystem;
namespace {

/// Times are printed with six digits at least.
constexpr double sameTime = 2e-6;

/// Where the last number of a name begins and ends.
std::pair<std::size_t, std::size_t> lastNumber(const std::string& name) {
  constexpr const char* digits = "0123456789";
  const std::size_t last = name.find_last_of(digits);
  if (last == std::string::npos) return {name.size(), name.size()};
  const std::size_t before = name.find_last_not_of(digits, last);
  return {before == std::string::npos ? 0 : before + 1, last + 1};
}

std::size_t sizeOf(const std::vector<fs::path>& files) {
  std::size_t sum = 0;
  for (const fs::path& file : files) {
    if (const std::string why = fileFault(file); !why.empty())
      throw BadInput(fmt::format("{}: {}", file.string(), why));
    std::error_code ignored;
    sum += fs::file_size(file, ignored);
  }
  return sum;
}

/// −1: a is before b; 1: after it; 0: the same time.
int order(const FileFrame& a, const FileFrame& b) {
  if (a.alone && b.alone) return 0;
  if (a.step && b.step) return *a.step < *b.step ? -1 : *a.step > *b.step ? 1 : 0;
  if (!a.time || !b.time)
    throw BadInput(fmt::format("{} and {}: one has a time, the other {}: they cannot be compared",
                               a.where, b.where, a.step || b.step ? "a step" : "none"));
  if (std::abs(*a.time - *b.time) <= sameTime * std::max(std::abs(*a.time), std::abs(*b.time)))
    return 0;
  return *a.time < *b.time ? -1 : 1;
}

bool rises(const FileFrame& before, const FileFrame& after) {
  if (before.step && after.step) return *before.step < *after.step;
  return !before.time || !after.time || *before.time < *after.time;
}

/// The next part of a reader, later than the one before.
class Rising {
 public:
  explicit Rising(std::unique_ptr<PartReader> reader) : reader_(std::move(reader)) {}

  std::optional<Part> next() {
    std::optional<Part> part = reader_->next();
    if (!part) return part;
    if (last_ && !rises(*last_, part->frame))
      throw BadInput(fmt::format(
          "{}: comes after {}: times of a run must rise; files of other runs should be in folders "
          "of their own",
          part->frame.where, last_->where));
    last_.emplace();
    last_->where = part->frame.where;
    last_->time = part->frame.time;
    last_->step = part->frame.step;
    return part;
  }
  const PartReader& reader() const { return *reader_; }

 private:
  std::unique_ptr<PartReader> reader_;
  std::optional<FileFrame> last_;
};

/// Arrays of particles are of all of them or of none, whatever a file says of their lengths.
void requireWhole(const FileFrame& frame) {
  const FileParticles& all = frame.particles;
  const auto require = [&](const char* what, std::size_t rows) {
    if (rows != 0 && rows != all.size())
      throw BadInput(
          fmt::format("{}: {} {}, there are {} particles", frame.where, rows, what, all.size()));
  };
  require("ids", all.id.size());
  require("radii", all.radius.size());
  require("velocities", all.velocity.size());
  require("spins", all.spin.size());
  require("masses", all.mass.size());
}

class Joined : public FrameReader {
 public:
  Joined(std::unique_ptr<PartReader> particles, std::vector<std::unique_ptr<PartReader>> contacts,
         std::shared_ptr<const ColumnOptions> options,
         std::function<void(ContactTable&, FileFrame&)> prepare)
      : particles_(std::move(particles)),
        options_(std::move(options)),
        prepare_(std::move(prepare)) {
    for (auto& reader : contacts) contacts_.emplace_back(std::move(reader));
  }

  std::optional<FileFrame> next() override {
    std::optional<Part> part = particles_.next();
    if (!part) {
      if (!contacts_.empty() && !matched_ && frames_ > 0)
        throw BadInput(
            fmt::format("{}: none of its times is one of {}", contacts_.front().last, lastFrame_));
      return {};
    }
    FileFrame& frame = part->frame;
    requireWhole(frame);
    ++frames_;
    lastFrame_ = frame.where;
    std::vector<Part> parts;
    for (Contacts& reader : contacts_) {
      if (advance(reader, frame))
        parts.push_back(*std::exchange(reader.pending, std::nullopt));
      else if (frame.contactsOfOtherTimes.empty())
        frame.contactsOfOtherTimes = describeTimes(reader);
    }
    if (contacts_.empty() && part->table && !part->wallsAlone)
      frame.contacts = completed(std::move(*part->table), frame, frame.where);
    if (options_ && parts.size() == contacts_.size())
      std::exchange(options_, nullptr)->checkUsed(frame.where);
    if (contacts_.empty() || parts.size() < contacts_.size()) return std::move(frame);
    matched_ = true;
    add(frame, std::move(parts), std::move(part->table));
    return std::move(frame);
  }

  double progress() const override {
    std::size_t read = particles_.reader().bytesRead(), all = particles_.reader().bytes();
    for (const Contacts& one : contacts_) {
      read += one.rising.reader().bytesRead();
      all += one.rising.reader().bytes();
    }
    return all == 0 ? 1.0 : static_cast<double>(read) / static_cast<double>(all);
  }

 private:
  struct Contacts {
    explicit Contacts(std::unique_ptr<PartReader> reader) : rising(std::move(reader)) {}
    Rising rising;
    std::optional<Part> pending;
    std::string last = "contacts";  ///< where the last part that was read is
  };

  /// Whether `pending` is of the frame's time then.
  bool advance(Contacts& reader, FileFrame& frame) {
    for (;;) {
      if (!reader.pending) reader.pending = reader.rising.next();
      if (!reader.pending) return false;
      reader.last = reader.pending->frame.where;
      const int later = order(reader.pending->frame, frame);
      if (later >= 0) return later == 0;
      if (frame.timesSkipped++ == 0) frame.firstSkipped = reader.last;
      reader.pending.reset();
    }
  }

  /// Text that names the contacts found in place of those of the frame's time.
  static std::string describeTimes(const Contacts& reader) {
    return fmt::format("the {} are of {}", reader.pending ? "next" : "last", reader.last);
  }

  void add(FileFrame& frame, std::vector<Part> parts, std::optional<ContactTable> walls) {
    if (!frame.box) frame.box = parts.front().frame.box;
    if (!frame.time) frame.time = parts.front().frame.time;
    frame.alone &= parts.front().frame.alone;
    frame.contacts.emplace();
    for (Part& part : parts) {
      if (!part.table) continue;
      if (prepare_) prepare_(*part.table, frame);
      append(*frame.contacts, completed(std::move(*part.table), frame, part.frame.where), frame);
    }
    if (walls) append(*frame.contacts, completed(std::move(*walls), frame, frame.where), frame);
  }

  Rising particles_;
  std::shared_ptr<const ColumnOptions> options_;  ///< until all columns were seen
  std::vector<Contacts> contacts_;
  std::function<void(ContactTable&, FileFrame&)> prepare_;
  bool matched_ = false;
  std::size_t frames_ = 0;
  std::string lastFrame_;
};

}  // namespace

TextParts::TextParts(std::vector<fs::path> files, std::function<Part(TextFile&)> read,
                     std::function<void(TextFile&)> begin)
    : files_(std::move(files)),
      read_(std::move(read)),
      begin_(std::move(begin)),
      bytes_(sizeOf(files_)) {}

std::optional<Part> TextParts::next() {
  for (;;) {
    if (!text_) {
      if (at_ == files_.size()) return {};
      text_.emplace(files_[at_++]);
      if (!text_->next()) throw BadInput(fmt::format("{}: is empty", text_->path().string()));
      text_->back();
      begin_(*text_);
    }
    if (text_->next()) {
      text_->back();
      return read_(*text_);
    }
    before_ += text_->fileSize();
    text_.reset();
  }
}

WholeFiles::WholeFiles(std::vector<fs::path> files, std::function<Part(const fs::path&)> read)
    : files_(std::move(files)), read_(std::move(read)), bytes_(sizeOf(files_)) {}

std::optional<Part> WholeFiles::next() {
  if (at_ == files_.size()) return {};
  const fs::path& file = files_[at_++];
  Part part = read_(file);
  if (!part.frame.time && !part.frame.step) {
    part.frame.step = numberInName(file);
    part.frame.alone = files_.size() == 1;
    if (!part.frame.step && !part.frame.alone)
      throw BadInput(fmt::format("{}: neither the file nor a number in its name says its time",
                                 file.string()));
  }
  std::error_code ignored;
  before_ += fs::file_size(file, ignored);
  return part;
}

std::optional<std::int64_t> numberInName(const fs::path& file) {
  const std::string name = file.filename().string();
  const auto [from, to] = lastNumber(name);
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(name.data() + from, name.data() + to, number);
  if (error != std::errc()) return {};
  return number;
}

std::string seriesOf(const fs::path& file) {
  std::string name = file.filename().string();
  const auto [from, to] = lastNumber(name);
  return name.erase(from, to - from);
}

std::vector<std::vector<fs::path>> bySeries(std::vector<fs::path> files) {
  std::map<std::pair<fs::path, std::string>, std::vector<fs::path>> series;
  for (fs::path& file : files) {
    std::pair key(file.parent_path(), seriesOf(file));
    series[std::move(key)].push_back(std::move(file));
  }
  std::vector<std::vector<fs::path>> sorted;
  for (auto& [key, list] : series) {
    std::ranges::stable_sort(list, {}, [](const fs::path& file) {
      return std::pair(numberInName(file).value_or(-1), file.filename().string());
    });
    sorted.push_back(std::move(list));
  }
  return sorted;
}

std::unique_ptr<FrameReader> joinParts(std::unique_ptr<PartReader> particles,
                                       std::vector<std::unique_ptr<PartReader>> contacts,
                                       std::shared_ptr<const ColumnOptions> options,
                                       std::function<void(ContactTable&, FileFrame&)> prepare) {
  return std::make_unique<Joined>(std::move(particles), std::move(contacts), std::move(options),
                                  std::move(prepare));
}

}  // namespace crossgrain::files
