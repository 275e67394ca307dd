#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "adapters/files/frame.hpp"

/// The readers of single formats; formats.cpp has the list.
namespace crossgrain::files {

using Files = std::vector<std::filesystem::path>;

std::unique_ptr<FrameReader> openMercuryDpm(const Files& files, const FileOptions& options);
std::unique_ptr<FrameReader> openLammps(const Files& files, const FileOptions& options);
std::unique_ptr<FrameReader> openYadeText(const Files& files, const FileOptions& options);
std::unique_ptr<FrameReader> openVtk(const Files& files, const FileOptions& options);
std::unique_ptr<FrameReader> openOnDem(const Files& files, const FileOptions& options);
std::unique_ptr<FrameReader> openCsv(const Files& files, const FileOptions& options);
std::unique_ptr<FrameReader> openXyz(const Files& files, const FileOptions& options);

/// Kind of data in a file, where a format keeps particles and contacts apart. @throws BadInput
enum class Content { particles, contacts };
Content contentOfMercuryDpm(const std::filesystem::path& file);
Content contentOfLammps(const std::filesystem::path& file);
Content contentOfVtk(const std::filesystem::path& file);
Content contentOfCsv(const std::filesystem::path& file);

/// The first time or step that such a file has: by which times of one run are known from other
/// runs.
double firstTimeOfLammps(const std::filesystem::path& file);
double firstTimeOfCsv(const std::filesystem::path& file);
double firstTimeOfXyz(const std::filesystem::path& file);

/// Of an index of VTK files (.pvtu, .pvtp), those that it names; of any other file none.
/// @throws BadInput
Files piecesOfVtk(const std::filesystem::path& file);

/// Files of one content.
Files filesOf(const Files& files, Content content,
              Content (*contentOf)(const std::filesystem::path&));

}  // namespace crossgrain::files
