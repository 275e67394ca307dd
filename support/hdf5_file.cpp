#include "support/hdf5_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <new>
#include <regex>
#include <stdexcept>
#include <utility>

#include "support/bad_input.hpp"
#include "support/descriptor.hpp"
#include "support/files.hpp"
#include "support/fingerprint.hpp"
#include "support/input_file.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline support {
namespace {

std::mutex libraryMutex;

using Handle = Hdf5Handle;

/// Throws after clearing HDF5's own record of the error, of which it keeps one per thread: left
/// there, it upsets the library's clean-up when the program ends.
[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  H5Eclear2(H5E_DEFAULT);
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

/// The innermost of the errors that HDF5 has recorded, in its own words; empty without one.
std::string libraryReason() {
  std::string reason;
  const auto first = [](unsigned, const H5E_error2_t* error, void* text) -> herr_t {
    auto& kept = *static_cast<std::string*>(text);
    if (kept.empty() && error->desc) kept = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, first, &reason);
  H5Eclear2(H5E_DEFAULT);
  return reason;
}

/// errno would be of any call since; what HDF5's drivers reported is in its record: "… errno = 28,
/// …".
OutputError notWritten(const std::filesystem::path& file) {
  const std::string reason = libraryReason();
  static const std::regex code("errno = ([0-9]+)");
  if (std::smatch found; std::regex_search(reason, found, code))
    return OutputError(file, std::stoi(found[1]));
  return OutputError(file, reason.empty() ? "HDF5 does not say why" : "HDF5: " + reason);
}

/// Whether there is room for one value where HDF5 would write as many as a damaged file claims.
bool isOneValue(hid_t attribute) {
  const Handle space(H5Aget_space(attribute));
  return H5Sget_simple_extent_npoints(space) == 1;
}

/// Whether values are numbers as processors have them. Of others HDF5 believes what a damaged file
/// says: makes and fills room for values of gigabytes, puts bits where there is no room for them.
bool isOfNumbers(const Handle& type) {
  const hid_t usual[] = {H5T_IEEE_F64LE,     H5T_IEEE_F64BE, H5T_IEEE_F32LE, H5T_IEEE_F32BE,
                         H5T_NATIVE_LDOUBLE, H5T_STD_I8LE,   H5T_STD_I16LE,  H5T_STD_I32LE,
                         H5T_STD_I64LE,      H5T_STD_U8LE,   H5T_STD_U16LE,  H5T_STD_U32LE,
                         H5T_STD_U64LE,      H5T_STD_I8BE,   H5T_STD_I16BE,  H5T_STD_I32BE,
                         H5T_STD_I64BE,      H5T_STD_U8BE,   H5T_STD_U16BE,  H5T_STD_U32BE,
                         H5T_STD_U64BE};
  return std::ranges::any_of(usual, [&](hid_t one) { return H5Tequal(type, one) > 0; });
}

/// Whether a dataset keeps as much as its size and type ask for: HDF5 reads what is not there. In
/// pieces it looks for each; what was never written is zeros.
bool isWhole(const Handle& set, const Handle& type, std::size_t count) {
  const Handle how(H5Dget_create_plist(set));
  const H5D_layout_t layout = H5Pget_layout(how);
  if (layout == H5D_CHUNKED) return true;
  const hsize_t kept = H5Dget_storage_size(set);
  return (layout == H5D_COMPACT || layout == H5D_CONTIGUOUS) &&
         (kept == count * H5Tget_size(type) || (kept == 0 && layout == H5D_CONTIGUOUS));
}

std::unique_lock<std::mutex> lockLibrary() {
  std::unique_lock lock(libraryMutex);
  // At the end of the program the library would try once more to write what a full disk did not
  // take, and crash. Files are closed one by one; there is nothing left for it to do.
  [[maybe_unused]] static const herr_t quiet = H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are exceptions here, not print-outs
  // A link of a file of others may lead to any file of this user, or to a pipe that never ends:
  // none is followed out of a file.
  [[maybe_unused]] static const herr_t within = H5Lunregister(H5L_TYPE_EXTERNAL);
  return lock;
}

/// Of an array or attribute, whichever order they come in; integers as the doubles that they are
/// read as.
std::uint64_t checksumOf(const std::string& name, std::string_view bytes) {
  return fnv1a(bytes, fnv1a(name));
}

std::string_view bytesOf(const double* values, std::size_t count) {
  return {reinterpret_cast<const char*>(values), count * sizeof *values};
}

constexpr const char* checksumName = "crossgrain_checksum";

/// How an array is kept; in other files, "virtual", is no way to keep one here.
bool isOfThisFile(const Handle& set) {
  const Handle how(H5Dget_create_plist(set));
  const H5D_layout_t layout = H5Pget_layout(how);
  return layout == H5D_COMPACT || layout == H5D_CHUNKED ||
         (layout == H5D_CONTIGUOUS && H5Pget_external_count(how) == 0);
}

}  // namespace

Hdf5File::Hdf5File(hid_t file, std::filesystem::path name, Place place,
                   std::unique_lock<std::mutex> lock)
    : lock_(std::move(lock)), file_(file), name_(std::move(name)), place_(place) {}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : lock_(std::move(other.lock_)),
      file_(std::exchange(other.file_, -1)),
      name_(std::move(other.name_)),
      place_(other.place_),
      seen_(std::move(other.seen_)) {}

Hdf5File::~Hdf5File() {
  if (file_ >= 0) H5Fclose(file_);
}

Hdf5File Hdf5File::create(const std::filesystem::path& file) {
  auto lock = lockLibrary();
  constexpr std::size_t growth = 1 << 20;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_fapl_core(access, growth, /*backing_store=*/false);
  const hid_t id = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (id < 0) fail(file, "cannot be made in memory");
  return {id, file, Place::memory, std::move(lock)};
}

Hdf5File Hdf5File::append(const std::filesystem::path& file) {
  auto lock = lockLibrary();
  const std::string why = fileFault(file);
  const bool there = why != noSuchFile;
  if (there && !why.empty()) throw OutputError(file, why);
  // A lock would live on in worker processes that are started while the file is open.
  const Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_file_locking(access, /*use=*/false, /*ignore when disabled=*/true);
  const hid_t id = there ? H5Fopen(file.c_str(), H5F_ACC_RDWR, access)
                         : H5Fcreate(file.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, access);
  if (id < 0) throw notWritten(file);
  return {id, file, Place::disk, std::move(lock)};
}

void Hdf5File::save() {
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "its end");
  if (place_ == Place::disk) return;
  const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
  std::string image(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  if (size <= 0 || H5Fget_file_image(file_, image.data(), image.size()) != size)
    fail(name_, "cannot be put together in memory");
  writeFile(name_, image);
}

Hdf5File Hdf5File::open(const std::filesystem::path& file) {
  auto lock = lockLibrary();
  // A named pipe would be waited for without end.
  if (const std::string why = fileFault(file); !why.empty())
    fail(file, fmt::format("{}: cannot be read as an HDF5 file{}", why, nearestFile(file, ".h5")));
  const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (id < 0) fail(file, "cannot be read as an HDF5 file");
  return {id, file, Place::disk, std::move(lock)};
}

void Hdf5File::check(herr_t status, const std::string& what) const {
  if (status >= 0) return;
  if (place_ == Place::memory) fail(name_, fmt::format("{} cannot be put into it", what));
  throw notWritten(name_);
}

void Hdf5File::writeArray(const std::string& path, const void* values, hid_t type, std::size_t rows,
                          std::size_t columns) {
  const hsize_t size[2] = {rows, columns};
  const Handle space(H5Screate_simple(columns > 1 ? 2 : 1, size, nullptr));
  const Handle links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links, 1);
  const Handle how(H5Pcreate(H5P_DATASET_CREATE));
  H5Pset_obj_track_times(how, false);  // the same content is the same bytes at any time
  const Handle set(H5Dcreate2(file_, path.c_str(), type, space, links, how, H5P_DEFAULT));
  check(set < 0 ? -1 : H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), path);
}

void Hdf5File::saw(const std::string& name, std::string_view bytes) const {
  seen_[name] = checksumOf(name, bytes);
}

std::string Hdf5File::checksum() const {
  std::uint64_t sum = 0;
  for (const auto& [name, own] : seen_) sum += own;
  return fmt::format("{:016x}", sum);
}

void Hdf5File::writeChecksum() {
  writeAttribute(checksumName, checksum());
}

bool Hdf5File::isAsWritten() const {
  const std::string own = checksum();  // before the attribute is read
  return readTextAttribute(checksumName) == own;
}

void Hdf5File::write(const std::string& path, const double* values, std::size_t rows,
                     std::size_t columns) {
  writeArray(path, values, H5T_NATIVE_DOUBLE, rows, columns);
  saw(path, bytesOf(values, rows * columns));
}

void Hdf5File::write(const std::string& path, const std::vector<double>& values) {
  write(path, values.data(), values.size(), 1);
}

void Hdf5File::write(const std::string& path, const std::vector<std::int32_t>& values) {
  writeArray(path, values.data(), H5T_NATIVE_INT32, values.size(), 1);
  const std::vector<double> read(values.begin(), values.end());
  saw(path, bytesOf(read.data(), read.size()));
}

void Hdf5File::writeAttribute(const std::string& name, double value) {
  const Handle space(H5Screate(H5S_SCALAR));
  const Handle attribute(
      H5Acreate2(file_, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT));
  check(attribute < 0 ? -1 : H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value), name);
  saw(name, bytesOf(&value, 1));
}

void Hdf5File::writeAttribute(const std::string& name, const std::string& value) {
  const Handle space(H5Screate(H5S_SCALAR));
  const Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type, value.size() + 1);
  const Handle attribute(H5Acreate2(file_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT));
  check(attribute < 0 ? -1 : H5Awrite(attribute, type, value.c_str()), name);
  saw(name, value);
}

bool Hdf5File::holds(const std::string& path) const {
  // HDF5 asks for every group on the way by itself.
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    if (H5Lexists(file_, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

std::optional<std::size_t> Hdf5File::length(const std::string& path) const {
  if (!holds(path)) return std::nullopt;
  const Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT));
  if (set < 0) fail(name_, path + " cannot be opened: it leads nowhere, or into another file");
  if (!isOfThisFile(set)) fail(name_, path + " is kept in another file");
  const Handle space(H5Dget_space(set));
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  // A damaged file may claim any size, and room is taken before anything is read. Packed are at
  // most 1032 bytes into one, by zlib.
  constexpr hsize_t most = 100'000'000, packed = 1032;
  hsize_t fileSize = 0;
  if (count < 0 || H5Fget_filesize(file_, &fileSize) < 0 ||
      static_cast<hsize_t>(count) > std::min(most, packed * fileSize))
    fail(name_, path + " is damaged");
  return static_cast<std::size_t>(count);
}

std::optional<std::vector<double>> Hdf5File::read(const std::string& path) const {
  const auto count = length(path);
  if (!count) return std::nullopt;
  const Handle set(H5Dopen2(file_, path.c_str(), H5P_DEFAULT));
  const Handle type(H5Dget_type(set));
  if (!isOfNumbers(type)) fail(name_, path + " does not hold numbers");
  if (!isWhole(set, type, *count)) fail(name_, path + " is damaged");
  std::vector<double> values(*count);
  if (H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail(name_, path + " cannot be read");
  saw(path, bytesOf(values.data(), values.size()));
  return values;
}

std::optional<double> Hdf5File::readAttribute(const std::string& name) const {
  return readAttribute(file_, name, name);
}

std::optional<double> Hdf5File::readAttributeOf(const std::string& path,
                                                const std::string& name) const {
  if (!holds(path)) return std::nullopt;
  const Handle object(H5Oopen(file_, path.c_str(), H5P_DEFAULT));
  if (object < 0) fail(name_, path + " cannot be opened");
  return readAttribute(object, name, path + "/" + name);
}

std::optional<double> Hdf5File::readAttribute(hid_t of, const std::string& name,
                                              const std::string& shown) const {
  if (H5Aexists(of, name.c_str()) <= 0) return std::nullopt;
  const Handle attribute(H5Aopen(of, name.c_str(), H5P_DEFAULT));
  double value = 0.0;
  if (!isOneValue(attribute) || !isOfNumbers(Handle(H5Aget_type(attribute))) ||
      H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) < 0)
    fail(name_, shown + " is not one number");
  saw(shown, bytesOf(&value, 1));
  return value;
}

std::optional<std::string> Hdf5File::readTextAttribute(const std::string& name) const {
  if (H5Aexists(file_, name.c_str()) <= 0) return std::nullopt;
  const Handle attribute(H5Aopen(file_, name.c_str(), H5P_DEFAULT));
  const Handle type(H5Aget_type(attribute));
  if (!isOneValue(attribute) || H5Tget_class(type) != H5T_STRING)
    fail(name_, name + " is not one text");
  if (H5Tis_variable_str(type) > 0) {  // as Python writes it: HDF5 makes the room
    char* text = nullptr;
    if (H5Aread(attribute, type, &text) < 0 || !text) fail(name_, name + " cannot be read");
    const std::string copy = text;
    H5free_memory(text);
    saw(name, copy);
    return copy;
  }
  constexpr std::size_t most = 1 << 16;  // a damaged file may claim gigabytes
  if (H5Tget_size(type) > most) fail(name_, name + " is damaged");
  std::string value(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, value.data()) < 0) fail(name_, name + " cannot be read");
  value.resize(std::min(value.find('\0'), value.size()));
  saw(name, value);
  return value;
}

namespace {

constexpr int threw = 3;  ///< exit status; what it said is in the pipe

void bound(int resource, rlim_t most) {
  const rlimit both{most, most};
  ::setrlimit(resource, &both);
}

/// A gigabyte beyond what the program has by then, and what a file of that size may hold packed.
/// CPU time, which a busy machine does not make longer: 5 s, and 1 s for 20 MB of the file.
void setBounds(const std::filesystem::path& file) {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  std::error_code unknown;
  const std::uintmax_t reported = std::filesystem::file_size(file, unknown);
  const rlim_t size = unknown ? 0 : reported;
  bound(RLIMIT_AS,
        pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + (rlim_t{1} << 30) + 64 * size);
  bound(RLIMIT_CPU, 5 + size / 20'000'000);
  bound(RLIMIT_CORE, 0);
}

/// In the new process. What the C library or sanitizers say when they give up is for nobody.
[[noreturn]] void readAndExit(const std::function<void()>& read, int answer) {
  if (const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0)
    ::dup2(nowhere, STDERR_FILENO);
  try {
    read();
    ::_exit(0);
  } catch (const std::bad_alloc&) {
    ::_exit(1);
  } catch (const std::exception& error) {
    const std::string what = error.what();
    // A line is shorter than what a pipe holds.
    static_cast<void>(!::write(answer, what.data(), std::min<std::size_t>(what.size(), 4096)));
    ::_exit(threw);
  }
}

/// Waits until the trial is over; the user need not. What waits for a file system that does not
/// answer takes no CPU time, so that only this ends it.
/// @returns its status, as waitpid() has it; −1: not known  @throws Interrupted
int await(int answer, pid_t child) {
  constexpr int patience = 100;  // [ms]
  pollfd entry{answer, POLLIN, 0};
  for (int status = 0;;) {
    ::poll(&entry, 1, patience);
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR) return -1;
    if (!interrupted()) continue;
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    throw Interrupted();
  }
}

std::string whatWasSaid(int answer) {
  std::string said(4096, '\0');
  const ssize_t size = ::read(answer, said.data(), said.size());
  said.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return said;
}

}  // namespace

void tryReading(const std::filesystem::path& file, const std::function<void()>& read) {
  int pipe[2];
  if (::pipe2(pipe, O_CLOEXEC | O_NONBLOCK) != 0) throw BadInput("no pipe for a trial");
  const pid_t child = [] {
    const std::lock_guard lock(libraryMutex);  // let go of in both processes
    return ::fork();
  }();
  if (child == 0) {
    setBounds(file);
    readAndExit(read, pipe[1]);
  }
  ::close(pipe[1]);
  const Descriptor answer(pipe[0]);
  const int status = child > 0 ? await(answer.get(), child) : -1;
  const std::string said = whatWasSaid(answer.get());
  if (child < 0) throw BadInput(fmt::format("{}: no process for a trial", file.string()));
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == threw && !said.empty()) throw BadInput(said);
  throw BadInput(fmt::format("{}: is damaged: HDF5 does not get to the end of it", file.string()));
}

}  // namespace crossgrain::inline support
