#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/bad_input.hpp"

namespace crossgrain::inline cases {

/// What a number may be, with its unit for the message.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool lowOpen = false, highOpen = false;  ///< whether the end itself is out
  std::string unit = {};
  bool mayBeInfinite = false;
  bool notZero = false;

  bool contains(double value) const;
  std::string text() const;  ///< "> 0 m", ">= 1", "in (0, 1)"
};

/// Largest seed: the random numbers' generator takes 32 bits and would drop the others unsaid.
inline constexpr std::uint64_t mostSeed = 0xffffffff;

Range positive(std::string unit = {});
Range above(double low, std::string unit = {});
Range atLeast(double low, std::string unit = {});
Range between(double low, double high, std::string unit = {});  ///< ends included
Range inside(double low, double high, std::string unit = {});   ///< ends excluded
Range aboveZeroTo(double high);                                 ///< (0, high]
Range eitherSign(std::string unit = {});                        ///< any but 0

/// Reads one table of a case file: knows every key asked for, so that finish() can name the others.
/// A key that is absent leaves its target alone. All members throw BadInput.
class Reader {
 public:
  /// @param table  may be null: a section that is not there
  /// @param path   "law", "averaging.margins"; empty for the root
  /// @param file   for messages about what is missing altogether
  Reader(const toml::table* table, std::string path, std::string file);

  bool has(std::string_view key) const;
  std::vector<std::string> keys() const;  ///< in the table, whether known or not

  void read(std::string_view key, bool& target);
  void read(std::string_view key, double& target, const Range& range);
  void read(std::string_view key, int& target, const Range& range);
  void read(std::string_view key, std::uint64_t& target, const Range& range);
  void read(std::string_view key, std::string& target);
  void read(std::string_view key, std::string& target, std::span<const std::string> choices);
  /// A list, or one value that stands for a list of one; never empty.
  void read(std::string_view key, std::vector<double>& target, const Range& range);
  /// A list of different names out of `choices`, or one name; may be empty.
  void read(std::string_view key, std::vector<std::string>& target,
            std::span<const std::string> choices);

  /// A list of texts, or one text.
  void read(std::string_view key, std::vector<std::string>& target);

  /// As read(); a key that is absent is reported by finish().
  template <typename... Arguments>
  void require(std::string_view key, Arguments&&... arguments) {
    if (!has(key)) missing_.emplace_back(key);
    read(key, std::forward<Arguments>(arguments)...);
  }

  /// A sentence: not empty, and not of blanks alone. @param otherwise  what to say then
  void requireText(std::string_view key, std::string& target, std::string_view otherwise);

  /// The path of a file that exists; relative to the file that says it, or the working directory
  /// where `--set` does. @param extension  of files to suggest in place of one that does not
  std::optional<std::filesystem::path> readFile(std::string_view key, const std::string& extension);
  /// A list of them, or one.
  void read(std::string_view key, std::vector<std::filesystem::path>& target,
            const std::string& extension);
  bool isTable(std::string_view key) const;
  bool isNumber(std::string_view key) const;
  /// The table under a key; an empty reader where it is absent.
  Reader section(std::string_view key);
  /// A list of tables, [[path.key]]; none where it is absent.
  std::vector<Reader> sections(std::string_view key);
  /// The node under a key, or null; for values of more than one form.
  const toml::node* take(std::string_view key);

  /// Reports the first unknown key, else the first missing one.
  void finish() const;
  [[noreturn]] void failMissing(std::string_view key, std::string_view reason = {}) const;
  /// "where: path = value: what"
  [[noreturn]] void fail(std::string_view key, std::string_view what) const;

 private:
  std::string pathOf(std::string_view key) const;
  std::filesystem::path fileNamed(std::string_view key, const std::string& name,
                                  const std::string& extension) const;

  const toml::table* table_;
  std::string path_, file_;
  std::vector<std::string> known_, missing_;
};

}  // namespace crossgrain::inline cases
