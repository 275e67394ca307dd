#include "adapters/worker/exchange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <span>

#include "adapters/worker/answer.hpp"
#include "adapters/worker/serve.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"
#include "support/regular_file.hpp"

namespace crossgrain {
namespace {

using nlohmann::json;

constexpr const char* recordingKey =
    "crossgrain_recording";  // first key of the head: the protocol's version

}  // namespace

std::string keptContent(const std::filesystem::path& file) {
  const RegularFile in(file);
  if (in.size() > longestKeptFile) return {};
  std::string content(in.size(), '\0');
  content.resize(in.read(0, std::as_writable_bytes(std::span(content))));
  return content;
}

ExchangeWriter::ExchangeWriter(const std::filesystem::path& file, json head)
    : file_(file), out_(file, std::ios::binary | std::ios::trunc) {
  head[recordingKey] = protocolVersion;
  put(head.dump(), {}, {});
}

void ExchangeWriter::write(const Exchange& exchange) {
  json line = {{"request", exchange.request},
               {"sent", exchange.sent.size()},
               {"received", exchange.received.size()}};
  // Where the arrays were is nobody's business but that run's.
  line["request"].erase("file");
  if (exchange.answer.is_null())
    line["failure"] = exchange.failure;
  else
    line["answer"] = exchange.answer;
  put(line.dump(-1, ' ', false, json::error_handler_t::replace), exchange.sent, exchange.received);
}

void ExchangeWriter::put(const std::string& line, const std::string& sent,
                         const std::string& received) {
  errno = 0;
  out_ << line << '\n' << sent << received << std::flush;
  if (!out_) throw OutputError(file_, errno);
}

ExchangeReader::ExchangeReader(const std::filesystem::path& file) : file_(file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw BadInput(fmt::format("{}: no such file", file.string()));
  length_ = std::filesystem::file_size(file, error);
  in_.open(file, std::ios::binary);
  try {
    head_ = line();
  } catch (const BadInput&) {
    // Said below.
  }
  if (!head_.contains(recordingKey))
    throw BadInput(fmt::format("{}: is no recording of `crossgrain record`", file.string()));
  if (head_[recordingKey] != protocolVersion)
    throw BadInput(fmt::format("{}: was recorded in protocol {}, this program speaks {}",
                               file.string(), head_[recordingKey].dump(), protocolVersion));
}

std::optional<Exchange> ExchangeReader::next() {
  if (in_.peek() == std::ifstream::traits_type::eof()) return std::nullopt;
  ++read_;
  json said = line();
  Exchange exchange;
  exchange.request = said.value("request", json());
  exchange.answer = said.value("answer", json());
  const json failure = said.value("failure", json(""));
  if (!exchange.request.is_object() || !exchange.request.value("request", json()).is_string() ||
      !failure.is_string())
    throw BadInput(fmt::format("{}: exchange {} has no request", file_.string(), read_));
  exchange.failure = failure;
  exchange.sent = bytes(said, "sent");
  exchange.received = bytes(said, "received");
  return exchange;
}

json ExchangeReader::line() {
  std::string text;
  std::getline(in_, text);
  try {
    return parseAnswer(text);
  } catch (const std::exception& error) {
    throw BadInput(fmt::format("{}: line of exchange {} {}", file_.string(), read_, error.what()));
  }
}

std::string ExchangeReader::bytes(const json& said, const char* key) {
  const json count = said.value(key, json(0));
  const auto at = static_cast<std::uintmax_t>(std::max<std::streamoff>(0, in_.tellg()));
  if (!count.is_number_unsigned() || count.get<std::uintmax_t>() > length_ - std::min(at, length_))
    throw BadInput(fmt::format("{}: is cut off in exchange {}: {} says {} bytes, {} are left",
                               file_.string(), read_, key, count.dump(),
                               length_ - std::min(at, length_)));
  std::string content(count.get<std::size_t>(), '\0');
  in_.read(content.data(), static_cast<std::streamsize>(content.size()));
  return content;
}

}  // namespace crossgrain
