#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/json_text.hpp"

/// How the structs of this folder become JSON and come back. One list of a struct's members serves
/// both ways; it stands beside the struct's toJson() and fromJson():
///
///     void fields(auto& io, StabilityRun& run) {
///       io("engine", run.engine);           // always written; where a file lacks it, the default
///       io.present("step", run.step);       // an optional that is written only where it is there
///       io.when(run.turns, "spin", run.spin);  // written where that holds, read where it is there
///     }
///
/// A text that becomes part of a file's name, a command or a heading says what it can be, aName,
/// aField or aUnit, and is refused where a file has anything else. All others are sentences, which
/// whoever prints them has to quote.
///
/// Enumerators are written by name: constexpr auto namesOf(Verdict) { return std::array{…}; }.
/// An absent optional is null; a number that is not finite is null too and comes back as NaN.
namespace crossgrain::inline results {

using Json = nlohmann::json;

/// "leaves" and "1.length: is a text, …": "leaves.1.length: is a text, …".
inline std::string path(const std::string& key, const FieldError& error) {
  const std::string_view rest = error.what();
  return fmt::format("{}{}{}", key, rest.starts_with(':') ? "" : ".", rest);
}

/// What a text can be.
struct Words {
  bool (*fit)(std::string_view);
  std::string_view what;
};

/// Of engines, cases, variants, methods, quantities, …; empty where there is none.
bool isName(std::string_view text);
inline constexpr Words aName{isName, "a name of letters, digits and . _ - +"};

/// Of a field: a name, and a unit, as averaging/fields.hpp has them.
bool isField(std::string_view text);
inline constexpr Words aField{isField, "a field (crossgrain list fields has them)"};

/// "N/m²", "Ω D/d", "1"; empty where there is none.
bool isUnit(std::string_view text);
inline constexpr Words aUnit{isUnit, "a unit"};

class FieldWriter;
class FieldReader;

template <typename T>
concept Enumerated = std::is_enum_v<T> && requires(T value) {
  namesOf(value);
};

/// As it is written.
template <Enumerated T>
constexpr std::string_view nameOf(T value) {
  return namesOf(value)[static_cast<std::size_t>(value)];
}

template <typename T>
Json jsonOf(const T& value);
template <typename T>
void readFrom(const Json& json, T& value);

/// Hands a struct's members to an object.
class FieldWriter {
 public:
  explicit FieldWriter(Json& object) : object_(object) {}

  template <typename T>
  void operator()(const char* key, const T& value) {
    object_[key] = jsonOf(value);
  }
  template <typename T>
  void present(const char* key, const std::optional<T>& value) {
    if (value) object_[key] = jsonOf(*value);
  }
  template <typename T>
  void when(bool there, const char* key, const T& value) {
    if (there) (*this)(key, value);
  }
  template <typename T>
  void operator()(const char* key, const T& value, const Words&) {
    (*this)(key, value);
  }
  template <typename T>
  void when(bool there, const char* key, const T& value, const Words&) {
    when(there, key, value);
  }

 private:
  Json& object_;
};

/// Takes a struct's members from an object.
class FieldReader {
 public:
  explicit FieldReader(const Json& object) : object_(object) {}

  /// @throws FieldError where it is of another type
  template <typename T>
  void operator()(const char* key, T& value) {
    const auto found = object_.find(key);
    if (found == object_.end()) return;
    try {
      readFrom(*found, value);
    } catch (const FieldError& error) {
      throw FieldError(path(key, error));
    }
  }
  template <typename T>
  void present(const char* key, std::optional<T>& value) {
    (*this)(key, value);
  }
  template <typename T>
  void when(bool, const char* key, T& value) {
    (*this)(key, value);
  }
  /// A text, or a list of such.
  template <typename T>
  void operator()(const char* key, T& value, const Words& words) {
    (*this)(key, value);
    if constexpr (std::is_same_v<T, std::string>)
      require(key, value, words);
    else
      for (const std::string& each : value) require(key, each, words);
  }
  template <typename T>
  void when(bool, const char* key, T& value, const Words& words) {
    (*this)(key, value, words);
  }

 private:
  static void require(const char* key, const std::string& text, const Words& words) {
    if (!words.fit(text))
      throw FieldError(fmt::format("{}: is \"{}\", not {}", key, asOneLine(text, 60), words.what));
  }

  const Json& object_;
};

namespace detail {

template <typename T>
struct IsOptional : std::false_type {};
template <typename T>
struct IsOptional<std::optional<T>> : std::true_type {};
template <typename T>
struct IsVector : std::false_type {};
template <typename T>
struct IsVector<std::vector<T>> : std::true_type {};
template <typename T>
struct IsArray : std::false_type {};
template <typename T, std::size_t N>
struct IsArray<std::array<T, N>> : std::true_type {};
template <typename T>
struct IsMap : std::false_type {};
template <typename T>
struct IsMap<std::map<std::string, T>> : std::true_type {};

[[noreturn]] inline void expected(const char* what, const Json& found) {
  throw FieldError(fmt::format(": is {}, not {}", found.type_name(), what));
}

template <typename List>
void readElements(const Json& json, List& list) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    try {
      typename List::value_type element{};  // those of vector<bool> have no address
      readFrom(json[k], element);
      list[k] = std::move(element);
    } catch (const FieldError& error) {
      throw FieldError(path(fmt::to_string(k), error));
    }
  }
}

}  // namespace detail

/// A struct with fields(), an enumeration with namesOf(), a number, a text, or an optional, list or
/// map of such.
template <typename T>
Json jsonOf(const T& value) {
  if constexpr (std::is_same_v<T, Json> || std::is_arithmetic_v<T> ||
                std::is_convertible_v<T, std::string_view>) {
    return Json(value);
  } else if constexpr (Enumerated<T>) {
    return Json(std::string(nameOf(value)));
  } else if constexpr (detail::IsOptional<T>::value) {
    return value ? jsonOf(*value) : Json(nullptr);
  } else if constexpr (detail::IsVector<T>::value || detail::IsArray<T>::value) {
    Json list = Json::array();
    for (const auto& each : value) list.push_back(jsonOf(each));
    return list;
  } else if constexpr (detail::IsMap<T>::value) {
    Json object = Json::object();
    for (const auto& [key, each] : value) object[key] = jsonOf(each);
    return object;
  } else {
    Json object = Json::object();
    FieldWriter writer(object);
    fields(writer, const_cast<T&>(value));  // a writer only reads
    return object;
  }
}

/// @throws FieldError saying what was found where
template <typename T>
void readFrom(const Json& json, T& value) {
  if constexpr (std::is_same_v<T, Json>) {
    value = json;
  } else if constexpr (detail::IsOptional<T>::value) {
    if (json.is_null()) {
      value.reset();
    } else {
      readFrom(json, value.emplace());
    }
  } else if constexpr (std::is_same_v<T, bool>) {
    if (!json.is_boolean()) detail::expected("true or false", json);
    value = json.get<bool>();
  } else if constexpr (std::is_floating_point_v<T>) {
    if (json.is_null()) {
      value = std::numeric_limits<T>::quiet_NaN();
    } else {
      if (!json.is_number()) detail::expected("a number", json);
      value = json.get<T>();
    }
  } else if constexpr (std::is_integral_v<T>) {
    if (!json.is_number_integer()) detail::expected("a whole number", json);
    value = json.get<T>();
  } else if constexpr (std::is_same_v<T, std::string>) {
    if (!json.is_string()) detail::expected("a text", json);
    value = json.get<std::string>();
  } else if constexpr (Enumerated<T>) {
    const auto names = namesOf(T{});
    const std::string name = json.is_string() ? json.get<std::string>() : json.dump();
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
      throw FieldError(
          fmt::format(": is \"{}\", not one of \"{}\"", name, fmt::join(names, "\", \"")));
    value = static_cast<T>(found - names.begin());
  } else if constexpr (detail::IsVector<T>::value) {
    if (!json.is_array()) detail::expected("a list", json);
    value.assign(json.size(), {});
    detail::readElements(json, value);
  } else if constexpr (detail::IsArray<T>::value) {
    if (!json.is_array() || json.size() != value.size())
      detail::expected("a list of the right length", json);
    detail::readElements(json, value);
  } else if constexpr (detail::IsMap<T>::value) {
    if (!json.is_object()) detail::expected("an object", json);
    value.clear();
    FieldReader reader(json);
    for (const auto& [key, each] : json.items()) reader(key.c_str(), value[key]);
  } else {
    if (!json.is_object()) detail::expected("an object", json);
    FieldReader reader(json);
    fields(reader, value);
  }
}

/// @throws FieldError
template <typename T>
T readAs(const Json& json) {
  T value;
  readFrom(json, value);
  return value;
}

}  // namespace crossgrain::inline results
