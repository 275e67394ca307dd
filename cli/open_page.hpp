#pragma once

#include <filesystem>

namespace crossgrain::inline cli {

/// @throws BadInput if nothing here opens pages
void requireBrowser();

/// Shows a page in the user's browser, which is left to itself.
/// @throws std::runtime_error, one line, if it could not be started
void openPage(const std::filesystem::path& page);

}  // namespace crossgrain::inline cli
