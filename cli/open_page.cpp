#include "cli/open_page.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <cstring>
#include <stdexcept>
#include <string>

#include "support/bad_input.hpp"
#include "support/program.hpp"

namespace crossgrain::inline cli {

void requireBrowser() {
  if (!isOnPath("xdg-open"))
    throw BadInput("--open: there is no program 'xdg-open' in PATH (Debian: package xdg-utils)");
}

void openPage(const std::filesystem::path& page) {
  std::string program = "xdg-open", path = std::filesystem::absolute(page).string();
  char* const arguments[] = {program.data(), path.data(), nullptr};
  posix_spawn_file_actions_t silent;
  posix_spawn_file_actions_init(&silent);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&silent, stream, "/dev/null", O_RDWR, 0);
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), &silent, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&silent);
  if (error != 0)
    throw std::runtime_error(
        fmt::format("xdg-open could not be started: {}", std::strerror(error)));
}

}  // namespace crossgrain::inline cli
