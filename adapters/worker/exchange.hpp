#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace crossgrain {

/// A request to a worker and what came of it, as they travelled.
struct Exchange {
  nlohmann::json request;
  std::string sent;  ///< content of the array file of `load`
  /// Null where none came: `failure` says why, in the words that the user is told.
  nlohmann::json answer;
  std::string received;  ///< content of the array file of `snapshot`
  std::string failure;
};

/// Told every exchange with a worker once it is over, before anything in it is believed.
using ExchangeListener = std::function<void(const Exchange&)>;

/// The longest array file that is kept of an exchange [bytes]; a longer one, or what is no regular
/// file, is kept as empty.
inline constexpr std::size_t longestKeptFile = std::size_t{1} << 30;

/// The content of an array file, to be kept.
std::string keptContent(const std::filesystem::path& file);

/// A recording: one file of exchanges, in their order. A line of JSON is its head. Each exchange is
/// a line of JSON, {"request", "answer" or "failure", "sent", "received"}, the last two being
/// numbers of bytes, and then those bytes: array files as they were, `sent` first.
class ExchangeWriter {
 public:
  /// @param head  an object; what it says is the caller's
  /// @throws OutputError naming the file
  ExchangeWriter(const std::filesystem::path& file, nlohmann::json head);

  /// It is in the file when this returns: what breaks down next loses nothing.
  /// @throws OutputError
  void write(const Exchange& exchange);

 private:
  void put(const std::string& line, const std::string& sent, const std::string& received);

  std::filesystem::path file_;
  std::ofstream out_;
};

/// Reads a recording, whoever made it.
class ExchangeReader {
 public:
  /// @throws BadInput naming the file where it is no recording of this protocol
  explicit ExchangeReader(const std::filesystem::path& file);

  const nlohmann::json& head() const { return head_; }

  /// The next one; absent at the end. @throws BadInput where the file is cut off or malformed
  std::optional<Exchange> next();

 private:
  nlohmann::json line();
  std::string bytes(const nlohmann::json& line, const char* key);

  std::filesystem::path file_;
  std::ifstream in_;
  std::uintmax_t length_ = 0;
  std::size_t read_ = 0;  ///< exchanges so far
  nlohmann::json head_;
};

}  // namespace crossgrain
