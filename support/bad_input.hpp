#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

namespace crossgrain::inline support {

/// An input of the user that cannot be used. what() is always one line:
/// where ("file:line:column: " or "--set key=value: "), what is there, what would be right.
struct BadInput : std::runtime_error {
  explicit BadInput(std::string message) : std::runtime_error(oneLine(std::move(message))) {}

 private:
  /// File names and quoted values may hold anything, also line breaks and escape sequences.
  static std::string oneLine(std::string message) {
    std::ranges::replace_if(
        message, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
    return message;
  }
};

}  // namespace crossgrain::inline support
