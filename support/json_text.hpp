#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

/// JSON of others: bounded in all that it may claim, and every fault of it one line with its place.
namespace crossgrain::inline support {

/// A file's content that is not as it should be; the message begins with the path to it within the
/// file.
class FieldError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Of objects and lists in each other: what takes them apart and copies them calls itself for each.
/// Results have some ten.
inline constexpr int deepestJson = 64;

/// It is no JSON at all.
class NotJson : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// @throws NotJson; std::runtime_error where it has more objects and lists in each other, or a
/// key twice, of which one reader would take the first and another the last
nlohmann::json parseJson(const std::string& text, int deepest = deepestJson);

/// Absent if there is no such file. @throws BadInput naming the file; Interrupted
std::optional<nlohmann::json> readJsonFile(const std::filesystem::path& file);

/// Message of an exception of the JSON library, without the library's own numbers.
std::string withoutPrefix(const std::string& what);

/// The text in one line of valid UTF-8, with an ellipsis where it has more than `longest` bytes.
std::string asOneLine(const std::string& text, std::size_t longest);

/// Takes what a file holds; whatever is thrown is BadInput that begins with the file.
template <typename Read>
auto understood(const std::filesystem::path& file, Read&& read) {
  try {
    return std::forward<Read>(read)();
  } catch (const BadInput&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const FieldError& error) {
    throw BadInput(fmt::format("{}: {}", file.string(), error.what()));
  } catch (const nlohmann::json::exception& error) {
    throw BadInput(fmt::format("{}: {}", file.string(), withoutPrefix(error.what())));
  } catch (const std::logic_error& error) {  // each part is right, and lengths or places are not
    throw BadInput(
        fmt::format("{}: its parts do not fit each other: {}", file.string(), error.what()));
  } catch (const std::bad_alloc&) {
    throw BadInput(fmt::format("{}: has a number that no memory holds", file.string()));
  }
}

/// A member of an object, which its conversion names where it is missing or of another type.
/// @throws FieldError
template <typename T>
T member(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) throw FieldError(fmt::format("{}: is missing", key));
  try {
    return found->get<T>();
  } catch (const nlohmann::json::exception& error) {
    throw FieldError(fmt::format("{}: {}", key, withoutPrefix(error.what())));
  }
}

}  // namespace crossgrain::inline support
