#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <map>

#include "adapters/files/readers.hpp"
#include "support/bad_input.hpp"
#include "support/input_file.hpp"
#include "support/regular_file.hpp"

namespace crossgrain::files {
namespace fs = std::filesystem;
namespace {

using Open = std::unique_ptr<FrameReader> (*)(const Files&, const FileOptions&);

struct Format {
  std::string_view name;
  Open open;
  Content (*contentOf)(const fs::path&);   ///< null: particles and contacts are in one file
  double (*firstTimeOf)(const fs::path&);  ///< of formats with any number of times a file
};

constexpr Format formats[] = {{"mercurydpm", openMercuryDpm, contentOfMercuryDpm, nullptr},
                              {"lammps", openLammps, contentOfLammps, firstTimeOfLammps},
                              {"yade-text", openYadeText, nullptr, nullptr},
                              {"vtk", openVtk, contentOfVtk, nullptr},
                              {"ondem", openOnDem, nullptr, nullptr},
                              {"csv", openCsv, contentOfCsv, firstTimeOfCsv},
                              {"xyz", openXyz, nullptr, firstTimeOfXyz}};

constexpr std::string_view hdf5Mark = "\x89HDF";

const Format& formatNamed(std::string_view name) {
  const auto* const found = std::ranges::find(formats, name, &Format::name);
  if (found == std::end(formats))
    throw BadInput(fmt::format("{}: there is no such format (there are: {})", name,
                               fmt::join(fileFormats(), ", ")));
  return *found;
}

Content contentOf(const Format& format, const fs::path& file) {
  if (const std::string why = fileFault(file); !why.empty())
    throw BadInput(fmt::format("{}: {}", file.string(), why));
  return format.contentOf ? format.contentOf(file) : Content::particles;
}

/// Words of file names that say what is in the file, not which run it is of.
bool saysContent(const std::string& word) {
  constexpr std::string_view known[] = {
      "atom",      "atoms",        "particle", "particles", "sphere", "spheres", "contact",
      "contacts",  "pair",         "pairs",    "local",     "wall",   "walls",   "intr",
      "intrs",     "interactions", "dump",     "custom",    "txt",    "csv",     "data",
      "fstat",     "vtk",          "vtu",      "vtp",       "vtkhdf", "hdf",     "h5",
      "lammpstrj", "gz",           "pvtu",     "pvtp",      "xyz",    "extxyz"};
  return std::ranges::find(known, word) != std::end(known);
}

/// Name that the files of a run share: without the last number and words such as "contacts".
std::string runName(const Format& format, const fs::path& file) {
  std::string name = file.filename().string();
  if (format.name == "mercurydpm") {  // run1.data, run1.fstat.0003
    for (const std::string_view ending : {".data", ".fstat"})
      if (const std::size_t at = name.rfind(ending); at != std::string::npos)
        return name.substr(0, at);
    return name;
  }
  std::string run, word;
  for (const char c : seriesOf(file) + ".") {
    if (std::isalnum(static_cast<unsigned char>(c))) {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      continue;
    }
    if (!word.empty() && !saysContent(word)) run += (run.empty() ? "" : ".") + word;
    word.clear();
  }
  return run;
}

/// Names with numbers in them, as people sort them: run2 before run10.
bool naturallyBefore(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      const auto run = [&](const std::string& text, std::size_t& at) {
        while (at < text.size() && text[at] == '0') ++at;
        const std::size_t from = at;
        while (at < text.size() && digit(text[at])) ++at;
        return text.substr(from, at - from);
      };
      const std::string first = run(a, i), second = run(b, j);
      if (first.size() != second.size()) return first.size() < second.size();
      if (first != second) return first < second;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  if ((i < a.size()) != (j < b.size())) return j < b.size();
  return a < b;
}

struct Run {
  fs::path folder;
  std::string name;
  Files particles, contacts;
};

bool byName(const fs::path& a, const fs::path& b) {
  return naturallyBefore(a.filename().string(), b.filename().string());
}

/// Files whose numbers rise while their times do not are of other runs each: run1.dump, run2.dump,
/// which both begin at step 0.
bool areRuns(const Format& format, const Files& files) {
  if (!format.firstTimeOf || files.size() < 2) return false;
  for (std::size_t k = 1; k < files.size(); ++k)
    if (!(format.firstTimeOf(files[k - 1]) < format.firstTimeOf(files[k]))) return true;
  return false;
}

/// Whether a line has the names of columns of the rows below it: known ones, or words above a row
/// of numbers, which `columns` may say the meaning of.
bool isTable(std::string_view names, std::string_view below) {
  const auto separator = separatorOf(names);
  if (!separator) return false;
  const auto columns = separatedWords(names, *separator);
  const auto isKnown = [](std::string_view name) { return meaningOf(name) != Meaning::none; };
  if (std::ranges::any_of(columns, isKnown)) return true;
  const auto isNumber = [](std::string_view word) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size();
  };
  const auto row = separatedWords(below.substr(0, below.find('\n')), *separator);
  return std::ranges::none_of(
             columns, [&](std::string_view name) { return name.empty() || isNumber(name); }) &&
         row.size() == columns.size() &&
         2 * static_cast<std::size_t>(std::ranges::count_if(row, isNumber)) > row.size();
}

/// A run for each number.
std::vector<Run> split(const Run& whole) {
  std::map<std::int64_t, Run> runs;
  const auto add = [&](const Files& files, Files Run::*list) {
    for (const fs::path& file : files) {
      const std::int64_t number = numberInName(file).value_or(-1);
      Run& run = runs[number];
      run.folder = whole.folder;
      run.name = fmt::format("{}{}", whole.name, number);
      (run.*list).push_back(file);
    }
  };
  add(whole.particles, &Run::particles);
  add(whole.contacts, &Run::contacts);
  std::vector<Run> list;
  for (auto& [number, run] : runs) list.push_back(std::move(run));
  return list;
}

}  // namespace

Files filesOf(const Files& files, Content content, Content (*contentOf)(const fs::path&)) {
  Files found;
  std::ranges::copy_if(files, std::back_inserter(found),
                       [&](const fs::path& file) { return contentOf(file) == content; });
  return found;
}

bool isHdf5(const fs::path& file) {
  std::string head(hdf5Mark.size(), '\0');
  head.resize(RegularFile(file).read(0, std::as_writable_bytes(std::span(head))));
  return head == hdf5Mark;
}

std::vector<std::string_view> fileFormats() {
  std::vector<std::string_view> names;
  for (const Format& format : formats) names.push_back(format.name);
  return names;
}

std::optional<std::string_view> formatOf(const fs::path& file) {
  if (!fileFault(file).empty()) return std::nullopt;
  std::string head = headOf(file, std::size_t{1} << 14);
  if (head.starts_with(byteOrderMark)) head.erase(0, byteOrderMark.size());
  if (head.starts_with(hdf5Mark)) {
    // Names of groups stand near the beginning.
    if (head.find("VTKHDF") != std::string::npos) return "ondem";
    return std::nullopt;
  }
  if (head.starts_with("ITEM:")) return "lammps";
  if (head.starts_with("#format ")) return "yade-text";
  if (head.starts_with("# vtk DataFile")) return "vtk";
  if (head.starts_with("<?xml") || head.starts_with("<VTKFile"))
    return head.find("<VTKFile") != std::string::npos ? std::optional<std::string_view>("vtk")
                                                      : std::nullopt;
  if (head.find('\0') != std::string::npos) return std::nullopt;
  for (std::size_t at = 0; at < head.size();) {
    const std::size_t end = std::min(head.find('\n', at), head.size());
    const std::string_view line = std::string_view(head).substr(at, end - at);
    at = end + 1;
    const auto parts = words(line);
    if (parts.empty()) continue;
    const auto isNumber = [](std::string_view word) {
      return word.find_first_not_of("0123456789+-.eE") == std::string_view::npos;
    };
    const bool numbers = std::ranges::all_of(
        parts.front() == "#" ? std::span(parts).subspan(1) : std::span(parts), isNumber);
    if (parts.front() == "#" && parts.size() == 3 && numbers) return "mercurydpm";
    if (parts.front() != "#" && (parts.size() == 6 || parts.size() == 8) && numbers)
      return "mercurydpm";
    if (line.front() == '#') continue;
    if (numbers && parts.size() == 1 &&
        head.substr(std::min(at, head.size()), 2000).find("Properties=") != std::string::npos)
      return "xyz";
    return isTable(line, std::string_view(head).substr(std::min(at, head.size())))
               ? std::optional<std::string_view>("csv")
               : std::nullopt;
  }
  return std::nullopt;
}

bool isBesideResults(const fs::path& file, const Files& files) {
  const auto isPiece = [&](const fs::path& index) {
    const std::string ending = index.extension().string();
    if (index == file || (ending != ".pvtu" && ending != ".pvtp")) return false;
    std::error_code ignored;
    return std::ranges::any_of(piecesOfVtk(index), [&](const fs::path& piece) {
      return fs::equivalent(piece, file, ignored);
    });
  };
  if (std::ranges::any_of(files, isPiece)) return true;
  const fs::path name = numberInName(file) && seriesOf(file).ends_with('.') ? file.stem() : file;
  constexpr std::string_view endings[] = {".restart", ".ene", ".xballs", ".stat", ".interaction"};
  if (std::ranges::find(endings, name.extension().string()) == std::end(endings)) return false;
  const std::string own = name.stem().string();
  return std::ranges::any_of(files, [&](const fs::path& other) {
    const std::string there = other.filename().string();
    return other.parent_path() == file.parent_path() &&
           (there.starts_with(own + ".data") || there.starts_with(own + ".fstat"));
  });
}

std::vector<Files> runsOf(std::string_view name, Files files) {
  const Format& format = formatNamed(name);
  std::map<std::pair<fs::path, std::string>, Run> runs;
  for (fs::path& file : files) {
    const std::string own = runName(format, file);
    Run& run = runs[{file.parent_path(), own}];
    run.folder = file.parent_path();
    run.name = own;
    (contentOf(format, file) == Content::particles ? run.particles : run.contacts)
        .push_back(std::move(file));
  }
  std::vector<Run> whole, contactsAlone;
  for (auto& [key, run] : runs) {
    std::ranges::stable_sort(run.particles, byName);
    std::ranges::stable_sort(run.contacts, byName);
    for (Run& one : areRuns(format, run.particles) ? split(run) : std::vector<Run>{run})
      (one.particles.empty() ? contactsAlone : whole).push_back(std::move(one));
  }
  if (whole.empty() && !contactsAlone.empty())
    throw BadInput(fmt::format("{}: contacts alone: the file of the particles is missing before it",
                               contactsAlone.front().contacts.front().string()));
  // Contacts of another name are of the folder's only run.
  for (const Run& run : contactsAlone) {
    const auto ofFolder = [&](const Run& one) { return one.folder == run.folder; };
    if (std::ranges::count_if(whole, ofFolder) != 1)
      throw BadInput(fmt::format(
          "{}: contacts of which run? the particles' files should have the same name, or "
          "a folder should be of one run",
          run.contacts.front().string()));
    Files& own = std::ranges::find_if(whole, ofFolder)->contacts;
    own.insert(own.end(), run.contacts.begin(), run.contacts.end());
  }
  std::ranges::stable_sort(whole, [](const Run& a, const Run& b) {
    return a.folder != b.folder ? naturallyBefore(a.folder.string(), b.folder.string())
                                : naturallyBefore(a.name, b.name);
  });
  std::vector<Files> sorted;
  for (Run& run : whole) {
    Files& list = sorted.emplace_back(std::move(run.particles));
    list.insert(list.end(), run.contacts.begin(), run.contacts.end());
  }
  return sorted;
}

std::unique_ptr<FrameReader> openFrames(std::string_view name, const Files& files,
                                        const FileOptions& options) {
  const Format& format = formatNamed(name);
  const bool particles = std::ranges::any_of(
      files, [&](const fs::path& file) { return contentOf(format, file) == Content::particles; });
  if (!particles)
    throw BadInput(fmt::format("{}: {}", files.empty() ? "no files" : files.front().string(),
                               files.empty()
                                   ? "there is nothing to read"
                                   : "contacts alone: the file of the particles is missing"));
  return format.open(files, options);
}

}  // namespace crossgrain::files
