#include "support/input_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "support/nearest.hpp"

namespace crossgrain::inline support {

namespace fs = std::filesystem;

namespace {

/// Names of the files of a folder that end alike, sorted; none if it cannot be listed.
std::vector<std::string> namesIn(const fs::path& folder, const std::string& extension) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (std::error_code ignored;
        at->path().extension() == extension && at->is_regular_file(ignored))
      names.push_back(at->path().filename().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace

bool usableName(std::string_view name) {
  constexpr std::size_t longest = 80;
  const auto allowed = [](unsigned char c) {
    return std::isalnum(c) ||
           std::string_view("._-+").find(static_cast<char>(c)) != std::string_view::npos;
  };
  return !name.empty() && name.size() <= longest && name.front() != '.' &&
         std::ranges::all_of(name, allowed);
}

bool isUtf8(std::string_view text) {
  using Json = nlohmann::json;
  try {
    static_cast<void>(Json(text).dump());
    return true;
  } catch (const Json::type_error&) {
    return false;
  }
}

std::string fileFault(const fs::path& path) {
  std::error_code error;
  switch (fs::status(path, error).type()) {
    case fs::file_type::regular:
      if (::access(path.c_str(), R_OK) == 0) return {};
      return "cannot be read: " + std::generic_category().message(errno);
    case fs::file_type::not_found:
      return noSuchFile;
    case fs::file_type::directory:
      return "is a folder, not a file";
    case fs::file_type::fifo:
      return "is a named pipe, not a file";
    case fs::file_type::socket:
      return "is a socket, not a file";
    case fs::file_type::character:
    case fs::file_type::block:
      return "is a device, not a file";
    default:
      return error ? "cannot be read: " + error.message() : "is not a file";
  }
}

std::string nearestFile(const fs::path& path, const std::string& extension) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    std::vector<std::string> names = namesIn(path, extension);
    constexpr std::size_t most = 5;
    if (names.empty()) return {};
    if (names.size() > most) {
      names.resize(most);
      names.emplace_back("…");
    }
    return fmt::format(" (there are: {})", fmt::join(names, ", "));
  }
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::vector<std::string> stems;
  for (const std::string& name : namesIn(folder, extension))
    if (name != path.filename()) stems.push_back(fs::path(name).stem().string());
  const auto near = nearest(path.stem().string(), stems);
  if (!near) return {};
  return fmt::format(" (did you mean {}?)", (path.parent_path() / (*near + extension)).string());
}

}  // namespace crossgrain::inline support
