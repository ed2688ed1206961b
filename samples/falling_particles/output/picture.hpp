// The formats of pictures of a run, and the names of its results.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/output_folder.hpp"
#include "frame.hpp"
#include "rendering.hpp"

namespace falling_particles {

/// Writes a run in one format. Call add() for each frame, then finish(). The contents must outlive it. Before add() they must
/// contain the inserted grains.
class Picture {
 public:
  virtual ~Picture() = default;

  virtual void add(const Frame& frame) = 0;
  /// Writes the rest. Throws std::runtime_error when anything could not be written. `summary`: the text of summary.toml.
  virtual void finish(const std::string& summary) = 0;
  /// The pictures that other programs make from the files after the run.
  virtual std::vector<Rendering> renderings() const { return {}; }
};

/// A format that a scene can request: [output] pictures = ["name", …].
struct PictureFormat {
  std::string_view name;
  std::vector<std::string_view> files;  ///< names of the files and folders that it writes into the output folder
  std::unique_ptr<Picture> (*make)(const OutputFolder& folder, const PictureFormat& format, const Contents& contents);
  std::vector<std::string> rendered = {};  ///< names of the files that other programs make
};

/// PictureFormat::make of a picture that is one file.
template <typename Format>
std::unique_ptr<Picture> make_file(const OutputFolder& folder, const PictureFormat& format, const Contents& contents) {
  return std::make_unique<Format>(folder.file(std::string(format.files.front())), contents);
}

// Each is in a file of its own, but for the plots.
PictureFormat page_format();
PictureFormat glb_format();
PictureFormat lammps_format();
PictureFormat vtk_format();
PictureFormat povray_format();

/// Of the frames of `vtk`, within the folder of the results.
inline constexpr std::string_view kVtkFolder = "vtk";

/// All formats, in the order of the list for users.
const std::vector<PictureFormat>& picture_formats();

/// Null if there is no such format.
const PictureFormat* find_picture_format(std::string_view name);

/// The names of the summary and of the tables, measurements and pictures of all scenes.
ResultNames result_names();

}  // namespace falling_particles
