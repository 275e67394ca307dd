#pragma once

#include <fstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace crossgrain::planted {

/// Writes parts(), numbers and vectors of plain numbers, as they lie in memory.
/// @throws std::runtime_error
void writeParts(const std::string& path, auto& simulation) {
  std::ofstream file(path, std::ios::binary);
  const auto write = [&](const auto* first, std::size_t count) {
    file.write(reinterpret_cast<const char*>(first),
               static_cast<std::streamsize>(count * sizeof *first));
  };
  simulation.parts([&](const auto& part) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(part)>>) {
      write(&part, 1);
    } else {
      const std::size_t size = part.size();
      write(&size, 1);
      write(part.data(), size);
    }
  });
  if (!file.flush()) throw std::runtime_error(path + " cannot be written");
}

/// Reads what writeParts() wrote of the same scene. @throws std::runtime_error
void readParts(const std::string& path, auto& simulation) {
  std::ifstream file(path, std::ios::binary);
  const auto read = [&](auto* first, std::size_t count) {
    if (!file.read(reinterpret_cast<char*>(first),
                   static_cast<std::streamsize>(count * sizeof *first)))
      throw std::runtime_error(path + " is too short");
  };
  simulation.parts([&](auto& part) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(part)>>) {
      read(&part, 1);
    } else {
      std::size_t size = 0;
      read(&size, 1);
      part.resize(size);
      read(part.data(), size);
    }
  });
}

}  // namespace crossgrain::planted
