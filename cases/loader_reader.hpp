#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "adapters/vec2.hpp"
#include "cases/keys.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cases {

using Names = std::vector<std::string>;
struct MaterialName;

/// Text that may be anything, and true or false.
struct Anything {};
inline constexpr Anything any{};

/// Text that is not blank.
struct Sentence {
  std::string_view otherwise;  ///< the message if it is
};

/// The path of a file that exists, relative to the file that contains the key, or to the working
/// directory for `--set`.
struct ExistingFile {
  const char* extension;  ///< of files to suggest in place of one that does not exist
};

/// One value under its full path, e.g. "run.may_differ[2]".
struct Value {
  const toml::node& node;
  std::string path;

  /// "where: path = value: what"; nothing of a file outside the case's own folder is quoted.
  [[noreturn]] void fail(std::string_view what) const;
  [[noreturn]] void failType(std::string_view wanted) const;
};

/// @name Reading one value; what is wrong with it is thrown as BadInput
/// @{
void convert(const Value& value, bool& target, Anything = {});
void convert(const Value& value, double& target, const Range& range);
void convert(const Value& value, int& target, const Range& range);
void convert(const Value& value, std::uint64_t& target, const Range& range);
void convert(const Value& value, std::string& target, Anything = {});
void convert(const Value& value, std::string& target, const Sentence& sentence);
void convert(const Value& value, std::string& target, const Names& choices);
void convert(const Value& value, MaterialName& target, Anything = {});
void convert(const Value& value, std::filesystem::path& target, const ExistingFile& wanted);
/// A list, or one value that stands for a list of one; never empty.
void convert(const Value& value, std::vector<double>& target, const Range& range);
/// A list of different names, or one name; may be empty.
void convert(const Value& value, Names& target, const Names& choices);
void convert(const Value& value, Names& target, Anything = {});
void convert(const Value& value, std::vector<std::filesystem::path>& target,
             const ExistingFile& wanted);
/// [x, y], [x, y, z]
void convert(const Value& value, Vec2& target, const Range& range);
void convert(const Value& value, Vec3& target, const Range& range);
/// Lists of those; a list of one is no vector.
void convert(const Value& value, std::vector<Vec2>& target, const Range& range);
void convert(const Value& value, std::vector<Vec3>& target, const Range& range);
/// One number for both bodies, or two.
void convert(const Value& value, double (&target)[2], const Range& range);
/// An enum whose values have these names, in its order.
template <typename Enum>
requires std::is_enum_v<Enum>
void convert(const Value& value, Enum& target, const Names& names) {
  std::string name;
  convert(value, name, names);
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k] == name) target = static_cast<Enum>(k);
}
/// A list of different ones, or one; may be empty.
template <typename Enum>
requires std::is_enum_v<Enum>
void convert(const Value& value, std::vector<Enum>& target, const Names& names) {
  Names chosen;
  convert(value, chosen, names);
  target.clear();
  for (const std::string& name : chosen)
    target.push_back(static_cast<Enum>(std::ranges::find(names, name) - names.begin()));
}
template <typename T, typename... Allowed>
void convert(const Value& value, std::optional<T>& target, const Allowed&... allowed) {
  convert(value, target.emplace(), allowed...);
}
/// @}

/// Reads one table of a case file and records every key asked for, so that finish() can name the
/// others. A key that is absent leaves its target alone. All members throw BadInput.
class Reader {
 public:
  /// @param table  may be null: a section that is absent
  /// @param path   "law", "averaging.margins"; empty for the root
  /// @param file   for messages about keys of a section that is absent
  Reader(const toml::table* table, std::string path, std::string file);

  bool has(std::string_view key) const;
  bool isTable(std::string_view key) const;
  bool isNumber(std::string_view key) const;
  Names keys() const;  ///< in the table, whether known or not

  template <typename T, typename... Allowed>
  void read(std::string_view key, T& target, const Allowed&... allowed) {
    if (const toml::node* const node = take(key)) convert({*node, pathOf(key)}, target, allowed...);
  }
  /// As read(); a key that is absent is reported by finish().
  template <typename T, typename... Allowed>
  void require(std::string_view key, T& target, const Allowed&... allowed) {
    need(key);
    read(key, target, allowed...);
  }
  void need(std::string_view key) {
    if (!has(key)) missing_.emplace_back(key);
  }

  /// This table on top of another: what it lacks it has from there, but for some keys.
  Reader above(const Reader& base, const Names& without) const;

  /// The table under a key; an empty reader where it is absent.
  Reader section(std::string_view key);
  /// A list of tables, [[path.key]]; none where it is absent.
  std::vector<Reader> sections(std::string_view key);
  /// The node under a key, or null; for values of more than one form.
  const toml::node* take(std::string_view key);
  /// The one of some keys that is present, or empty. More than one is an error at the later one:
  /// "stands beside FIRST: rule".
  std::string onlyOne(std::initializer_list<const char*> keys,
                      std::string_view rule = "give one of the two");
  /// Of two keys of which either says all: both are an error at `key`, "stands beside OTHER…".
  /// @param which  what the other is, after its name
  void notBeside(std::string_view key, std::string_view other, std::string_view which = "") const {
    check(!has(key) || !has(other), key, "stands beside {}{}: give one of the two", other, which);
  }

  /// Reports the first unknown key, else the first missing one.
  void finish() const;
  [[noreturn]] void failMissing(std::string_view key, std::string_view reason = {}) const;
  /// "where: path = value: message". @pre the key is present
  [[noreturn]] void fail(std::string_view key, std::string_view message) const;
  template <typename First, typename... Rest>
  [[noreturn]] void fail(std::string_view key, fmt::format_string<First, Rest...> message,
                         First&& first, Rest&&... rest) const {
    fail(key, fmt::format(message, std::forward<First>(first), std::forward<Rest>(rest)...));
  }
  template <typename... Arguments>
  void check(bool sound, std::string_view key, fmt::format_string<Arguments...> message,
             Arguments&&... arguments) const {
    if (!sound) fail(key, fmt::format(message, std::forward<Arguments>(arguments)...));
  }

 private:
  const toml::node* find(std::string_view key) const;
  std::string pathOf(std::string_view key) const;

  const toml::table* table_;
  std::string path_, file_;
  const toml::table* below_ = nullptr;
  std::string pathBelow_;
  Names without_;
  Names known_, missing_;
};

}  // namespace crossgrain::inline cases
