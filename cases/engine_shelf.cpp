#include "cases/engine_shelf.hpp"

#include <algorithm>
#include <system_error>

#include "support/data_folder.hpp"

namespace crossgrain::inline cases {

namespace fs = std::filesystem;

std::vector<fs::path> shelvedEngines() {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& folder : fs::directory_iterator(dataFolder() / "engines", none))
    for (const auto& file : fs::directory_iterator(folder.path(), none))
      if (file.path().extension() == ".toml") files.push_back(file.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace crossgrain::inline cases
