#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>

#include "cli/outcome.hpp"
#include "reports/common/overview.hpp"

namespace crossgrain::inline cli {

void printOverview(const Overview& overview) {
  reports::TextLook look;
  if (::isatty(STDOUT_FILENO) == 1) {
    // https://no-color.org: set to anything but nothing, there are no colours.
    const char* const noColour = std::getenv("NO_COLOR");
    look.coloured = !noColour || *noColour == '\0';
    winsize window{};
    const bool known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_col > 0;
    look.width = known ? window.ws_col : 80;
  }
  fmt::print("{}", reports::overviewText(overview, look));
}

}  // namespace crossgrain::inline cli
