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
#include <ranges>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "support/json_text.hpp"

/// How structs become JSON and come back. One list of a struct's members serves both ways:
///
///     void fields(auto& io) {
///       io("dt_s", dt);                // always written; where a file lacks it, the default
///       io.required("dt", run.dt);     // must be there and not be null
///       io.present("step", step);      // an optional that is written only where it is there
///       io.when(turns, "spin", spin);  // written where that holds, read where it is there
///       FIELDS(io, engine, caseName);  // io("engine", engine), io("case_name", caseName)
///     }
///
/// A list that does more asks io.reading. A text that becomes part of a file's name, a command or a
/// heading says what it can be (Words) and is refused where a file has anything else. All others
/// are sentences, which whoever prints them has to quote.
///
/// Enumerators are written by name: constexpr auto namesOf(Verdict) { return std::array{…}; }.
/// Where a file has names of its own for some of them, those go along: io("outcome", verdict,
/// outcomeNames). An absent optional is null; a number that is not finite is null too and comes
/// back as NaN.
namespace crossgrain::inline support {

using Json = nlohmann::json;

/// "leaves" and "1.length: is a text, …": "leaves.1.length: is a text, …".
inline std::string path(const std::string& key, const FieldError& error) {
  const std::string_view rest = error.what();
  return fmt::format("{}{}{}", key, rest.starts_with(':') ? "" : ".", rest);
}

/// Meanings that a text can have.
struct Words {
  bool (*fit)(std::string_view);
  std::string_view what;
};

/// Names of members, "one.radius, one.spinRate", as keys of a file: "radius", "spin_rate". Each
/// ends with a 0.
template <std::size_t n>
struct FieldKeys {
  std::array<char, 2 * n> text{};

  // NOLINTNEXTLINE(google-explicit-constructor): from a literal
  constexpr FieldKeys(const char (&members)[n]) {
    std::size_t end = 0, start = 0;  // of the key
    for (const char c : members) {
      if (c == ' ') continue;
      if (c == '.') {
        end = start;
      } else if (c == ',' || c == 0) {
        text[end++] = 0;
        start = end;
      } else {
        const bool capital = 'A' <= c && c <= 'Z';
        if (capital) text[end++] = '_';
        text[end++] = static_cast<char>(capital ? c - 'A' + 'a' : c);
      }
    }
  }
};

template <FieldKeys keys>
void eachField(auto take, auto&... members) {
  const char* key = keys.text.data();
  ((take(key, members), key += std::string_view(key).size() + 1), ...);
}

#define FIELDS_BY(take, ...)                      \
  ::crossgrain::support::eachField<#__VA_ARGS__>( \
      [&](const char* key, auto& member) { take(key, member); }, __VA_ARGS__)

/// Members under their own names, in a file as in the struct; by io.present; by io.required.
#define FIELDS(io, ...) FIELDS_BY(io, __VA_ARGS__)
#define PRESENT_FIELDS(io, ...) FIELDS_BY(io.present, __VA_ARGS__)
#define REQUIRED_FIELDS(io, ...) FIELDS_BY(io.required, __VA_ARGS__)

/// The names that one kind of file has for enumerators; those that are missing have none there.
template <typename Enum, std::size_t n>
using EnumNames = std::array<std::pair<Enum, std::string_view>, n>;

/// @throws std::logic_error where the file has no name for it
template <typename Enum, std::size_t n>
constexpr std::string_view nameOf(Enum value, const EnumNames<Enum, n>& names) {
  const auto found = std::ranges::find(names, value, &EnumNames<Enum, n>::value_type::first);
  if (found == names.end()) throw std::logic_error("an enumerator that files have no name for");
  return found->second;
}

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
template <typename T>
T readAs(const Json& json);

/// Hands a struct's members to an object.
class FieldWriter {
 public:
  static constexpr bool reading = false;
  explicit FieldWriter(Json& object) : object_(object) {}

  template <typename T>
  void operator()(const char* key, const T& value) {
    object_[key] = jsonOf(value);
  }
  template <typename T>
  void required(const char* key, const T& value) {
    (*this)(key, value);
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
  template <typename Enum, std::size_t n>
  void operator()(const char* key, Enum value, const EnumNames<Enum, n>& names) {
    object_[key] = std::string(nameOf(value, names));
  }
  template <typename Enum, std::size_t n>
  void operator()(const char* key, const std::optional<Enum>& value,
                  const EnumNames<Enum, n>& names) {
    object_[key] = value ? Json(std::string(nameOf(*value, names))) : Json();
  }

 private:
  Json& object_;
};

/// Takes a struct's members from an object.
class FieldReader {
 public:
  static constexpr bool reading = true;
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
  void required(const char* key, T& value) {
    const auto found = object_.find(key);
    if (found == object_.end()) throw FieldError(fmt::format("{}: is missing", key));
    if (found->is_null() && !std::is_same_v<T, Json>)
      throw FieldError(fmt::format("{}: is null", key));
    (*this)(key, value);
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
  template <typename Enum, std::size_t n>
  void operator()(const char* key, Enum& value, const EnumNames<Enum, n>& names) {
    if (!object_.contains(key)) return;
    std::string name;
    (*this)(key, name);
    const auto found = std::ranges::find(names, name, &EnumNames<Enum, n>::value_type::second);
    if (found == names.end())
      throw FieldError(fmt::format("{}: is \"{}\", not one of \"{}\"", key, asOneLine(name, 60),
                                   fmt::join(names | std::views::values, "\", \"")));
    value = found->first;
  }
  template <typename Enum, std::size_t n>
  void operator()(const char* key, std::optional<Enum>& value, const EnumNames<Enum, n>& names) {
    const auto found = object_.find(key);
    if (found == object_.end() || found->is_null()) return value.reset();
    (*this)(key, value.emplace(names.front().first), names);
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

template <typename T>
struct IsSet : std::false_type {};
template <typename T>
struct IsSet<std::set<T>> : std::true_type {};

template <typename T>
struct IsVariant : std::false_type {};
template <typename... T>
struct IsVariant<std::variant<T...>> : std::true_type {};

/// Of so many numbers, x and y or x, y and z.
template <typename T>
concept FixedVector = requires(T v) {
  T::SizeAtCompileTime;
  v.x();
};

/// Those that stand in the struct, or beside one of a folder that knows no JSON.
template <typename T>
void fieldsOf(auto& io, T& value) {
  // Of a struct whose base has the one and that has the other, a list would be left out.
  static_assert(!(
      requires { value.fields(io); } && requires { fields(io, value); }));
  if constexpr (requires { value.fields(io); })
    value.fields(io);
  else
    fields(io, value);
}

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

/// As the first alternative that it can be.
template <typename... T>
void readVariant(const Json& json, std::variant<T...>& value) {
  const auto take = [&]<typename Alternative>(Alternative alternative) {
    using A = Alternative;
    const bool fits = std::is_same_v<A, bool>          ? json.is_boolean()
                      : std::is_same_v<A, std::string> ? json.is_string()
                                                       : json.is_number() || json.is_null();
    if (!fits) return false;
    readFrom(json, alternative);
    value = std::move(alternative);
    return true;
  };
  if (!(take(T{}) || ...)) expected("a text, a number or a boolean", json);
}

}  // namespace detail

/// A struct with fields(), an enumeration with namesOf(), a number, a text, a variant of these, a
/// vector [x, y] or [x, y, z], or an optional, list, set or map of such.
template <typename T>
Json jsonOf(const T& value) {
  if constexpr (std::is_same_v<T, Json> || std::is_arithmetic_v<T> ||
                std::is_convertible_v<T, std::string_view>) {
    return Json(value);
  } else if constexpr (Enumerated<T>) {
    return Json(std::string(nameOf(value)));
  } else if constexpr (detail::IsVariant<T>::value) {
    return std::visit([](const auto& held) { return jsonOf(held); }, value);
  } else if constexpr (detail::FixedVector<T>) {
    Json list = Json::array();
    for (int k = 0; k < T::SizeAtCompileTime; ++k) list.push_back(value[k]);
    return list;
  } else if constexpr (detail::IsOptional<T>::value) {
    return value ? jsonOf(*value) : Json(nullptr);
  } else if constexpr (detail::IsVector<T>::value || detail::IsArray<T>::value ||
                       detail::IsSet<T>::value) {
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
    detail::fieldsOf(writer, const_cast<T&>(value));  // a writer only reads
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
  } else if constexpr (detail::IsVariant<T>::value) {
    detail::readVariant(json, value);
  } else if constexpr (detail::FixedVector<T>) {
    constexpr int size = T::SizeAtCompileTime;
    const auto isNumber = [](const Json& each) { return each.is_number(); };
    if (!json.is_array() || json.size() != size || !std::ranges::all_of(json, isNumber))
      detail::expected(size == 2 ? "[x, y]" : "[x, y, z]", json);
    for (int k = 0; k < size; ++k) value[k] = json[static_cast<std::size_t>(k)].get<double>();
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
  } else if constexpr (detail::IsSet<T>::value) {
    const auto list = readAs<std::vector<typename T::value_type>>(json);
    value = T(list.begin(), list.end());
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
    detail::fieldsOf(reader, value);
  }
}

/// @throws FieldError
template <typename T>
T readAs(const Json& json) {
  T value;
  readFrom(json, value);
  return value;
}

}  // namespace crossgrain::inline support
