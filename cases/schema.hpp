#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "cases/loader_reader.hpp"

/// The schema of case files: one table per section. An entry has a key's name, the member that it
/// sets, what it allows (a range with its unit, or names) and one line that explains it. The loader
/// reads by it; keys.hpp lists it.
namespace crossgrain::inline cases {

/// A value as a case file has it.
std::string printed(double value);
std::string printed(const std::string& value);
std::string printed(const Vec2& value);
std::string printed(const Vec3& value);
std::string printed(const std::vector<double>& values);
std::string printed(const Names& values);
template <typename T, typename Allowed>
std::string printedDefault(const T& value, const Allowed& allowed) {
  if constexpr (std::is_enum_v<T>)
    return printed(allowed[static_cast<std::size_t>(value)]);
  else if constexpr (std::is_same_v<T, bool>)
    return value ? "true" : "false";
  else if constexpr (std::is_arithmetic_v<T>)
    return printed(static_cast<double>(value));
  else if constexpr (requires { printed(value); })
    return printed(value);
  else
    return "–";  // optional values and files; pairs are required
}

std::string unitOf(const Range& range);
std::string valuesOf(const Range& range);
std::string valuesOf(const Names& names);

/// An entry of the table of a section that is read into a T.
template <typename T>
struct Key {
  KeyInfo info;
  bool required = false;
  std::function<void(Reader&, const std::string& key, T&)> read;
  std::function<std::string(T)> standard = nullptr;  ///< of a T with its defaults

  Key(KeyInfo about, bool needed, decltype(read) reader, decltype(standard) defaults = nullptr)
      : info(std::move(about)),
        required(needed),
        read(std::move(reader)),
        standard(std::move(defaults)) {}
  /// Of a base of T.
  template <typename Base>
  requires std::is_base_of_v<Base, T> Key(const Key<Base>& of)
      : Key(of.info, of.required, of.read, of.standard) {}

  /// The default as it is listed, where it is not simply T's: "required (linear)".
  Key listed(std::string text, std::string unit = {}) && {
    info.standard = std::move(text);
    if (!unit.empty()) info.unit = std::move(unit);
    return std::move(*this);
  }
  Key usedBy(std::string commands) && {
    info.commands = std::move(commands);
    return std::move(*this);
  }
};

/// @param member   a function that returns a reference
/// @param allowed  as for convert(): a Range, Names, any, …
template <typename T, typename Member, typename Allowed>
Key<T> keyOf(std::string name, Member member, const Allowed& allowed, std::string meaning) {
  KeyInfo info{.name = std::move(name), .meaning = std::move(meaning)};
  if constexpr (requires { valuesOf(allowed); }) info.values = valuesOf(allowed);
  if constexpr (std::is_same_v<Allowed, Range>) info.unit = unitOf(allowed);
  return {std::move(info), false,
          [=](Reader& in, const std::string& key, T& target) {
            in.read(key, std::invoke(member, target), allowed);
          },
          [=](T made) { return printedDefault(std::invoke(member, made), allowed); }};
}

template <typename T, typename M, typename Allowed>
Key<T> key(std::string name, M T::*member, const Allowed& allowed, std::string meaning) {
  return keyOf<T>(std::move(name), member, allowed, std::move(meaning));
}

/// As key(), and it must be present.
template <typename T, typename M, typename Allowed>
Key<T> need(std::string name, M T::*member, const Allowed& allowed, std::string meaning) {
  Key<T> entry = key(std::move(name), member, allowed, std::move(meaning));
  entry.required = true;
  return entry;
}

/// A key that a function reads: of more than one form, or that depends on other keys.
template <typename T>
Key<T> special(KeyInfo info, std::function<void(Reader&, const std::string& key, T&)> read) {
  return {std::move(info), false, std::move(read)};
}

template <typename T>
class Section {
 public:
  Section(SectionInfo info, std::vector<Key<T>> keys)
      : info_(std::move(info)), keys_(std::move(keys)) {
    for (Key<T>& key : keys_) {
      std::string& standard = key.info.standard;
      if (standard.empty())
        standard = key.required ? "required" : key.standard ? key.standard(T{}) : "–";
      info_.keys.push_back(key.info);
    }
  }

  const SectionInfo& info() const { return info_; }

  /// Reads every key, or those named, and then reports what is unknown or missing.
  /// @pre sections below this one have been taken from `in`
  void read(Reader& in, T& target, const Names& only = {}) const {
    for (const Key<T>& key : keys_) {
      const std::string& name = key.info.name;
      if (!only.empty() && std::ranges::find(only, name) == only.end()) continue;
      if (key.required) in.need(name);
      key.read(in, name, target);
    }
    in.finish();
  }

 private:
  SectionInfo info_;
  std::vector<Key<T>> keys_;
};

}  // namespace crossgrain::inline cases
