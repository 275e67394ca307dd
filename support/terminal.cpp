#include "support/terminal.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace crossgrain::inline support {

std::size_t terminalWidth(int descriptor) {
  constexpr std::size_t usual = 80, most = 100000;
  if (const char* const columns = std::getenv("COLUMNS"))
    if (const long given = std::strtol(columns, nullptr, 10); given > 0)
      return std::min(static_cast<std::size_t>(given), most);
  winsize window{};
  const bool known = ::ioctl(descriptor, TIOCGWINSZ, &window) == 0 && window.ws_col > 0;
  return known ? window.ws_col : usual;
}

std::size_t displayWidth(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}

std::string padded(std::string text, std::size_t width) {
  const std::size_t own = displayWidth(text);
  return std::move(text) + std::string(width - std::min(width, own), ' ');
}

std::string cut(const std::string& line, std::size_t width) {
  if (displayWidth(line) <= width) return line;
  std::string some;
  for (const char c : line) {
    const bool begins = (static_cast<unsigned char>(c) & 0xc0u) != 0x80u;
    if (begins && displayWidth(some) + 1 >= width) break;
    some += c;
  }
  return some + "…";
}

std::string wrapped(const std::string& line, std::size_t width, std::size_t hang,
                    std::string_view end) {
  std::string text;
  std::string_view rest = line;
  std::size_t before = 0;  // blanks that this line begins with
  const auto fits = [&](std::size_t bytes, std::size_t more) {
    return before + displayWidth(rest.substr(0, bytes)) + more <= width;
  };
  while (!fits(rest.size(), 0)) {
    const std::size_t indent = rest.find_first_not_of(' ');
    std::size_t at = rest.npos;
    for (std::size_t k = rest.find(' ', indent); k != rest.npos; k = rest.find(' ', k + 1))
      if (rest[k - 1] != ' ' && (at == rest.npos || fits(k, displayWidth(end)))) at = k;
    if (at == rest.npos) break;
    text += std::string(before, ' ').append(rest.substr(0, at)).append(end) + "\n";
    rest = rest.substr(std::min(rest.find_first_not_of(' ', at), rest.size()));
    before = hang;
  }
  return text + std::string(before, ' ').append(rest);
}

std::string wrappedLines(const std::string& text, std::size_t width) {
  std::string all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::string mark = line.starts_with("# ") ? "# " : "";
    line.erase(0, mark.size());
    const std::size_t hang = std::min(line.find_first_not_of(' '), line.size()) + 2;
    std::istringstream parts(wrapped(line, width - std::min(width, mark.size()), hang) + "\n");
    for (std::string part; std::getline(parts, part);) all += mark + part + "\n";
  }
  return all;
}

void printLines(std::FILE* to, const std::string& text) {
  const int descriptor = ::fileno(to);
  fmt::print(to, "{}",
             ::isatty(descriptor) == 1 ? wrappedLines(text, terminalWidth(descriptor)) : text);
}

}  // namespace crossgrain::inline support
