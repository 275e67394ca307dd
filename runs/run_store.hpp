#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace crossgrain {

/// Finished runs in an output folder, one file each, so that nothing computed is ever lost.
class RunStore {
 public:
  /// Makes the folder; what is there stays.
  /// @throws OutputError if it cannot be written to
  /// @throws BadInput if it is not empty and not of an earlier run: nobody's files are deleted
  explicit RunStore(std::filesystem::path out);

  /// Removes what an earlier run left. Called once it is known that this one can begin.
  void startAfresh() const;

  /// The finished run of that name, if it was made with the same key (everything it depends on).
  std::optional<nlohmann::json> find(const std::string& name, const std::string& key) const;
  void keep(const std::string& name, const std::string& key, const nlohmann::json& run) const;

  std::filesystem::path scratch(const std::string& name) const;
  std::filesystem::path snapshots(const std::string& name) const;
  /// What a run that is under way keeps; gone once it is finished.
  std::filesystem::path unfinished(const std::string& name) const;

 private:
  std::filesystem::path file(const std::string& name) const;

  std::filesystem::path out_;
};

}  // namespace crossgrain
