// The formats in which a run can be looked at.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/output_folder.hpp"
#include "frame.hpp"
#include "rendering.hpp"

namespace falling_particles {

/// Writes a run in one format. A picture is told every frame as the run goes, and then that it has ended. The contents must outlive
/// it; before a frame they have the grains that have come.
class Picture {
 public:
  Picture() = default;
  virtual ~Picture() = default;
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  virtual void add(const Frame& frame) = 0;
  /// Writes what is left to write; throws std::runtime_error when anything could not be written. `summary`: the text of
  /// summary.toml.
  virtual void finish(const std::string& summary) = 0;
  /// What other programs are to make of the files when the results of the run are in place.
  virtual std::vector<Rendering> renderings() const { return {}; }
};

/// A format that a scene can ask for: [output] pictures = ["name", …].
struct PictureFormat {
  std::string_view name;
  std::vector<std::string_view> files;  ///< names of the files and folders that it writes into the output folder
  std::unique_ptr<Picture> (*make)(const OutputFolder& folder, const PictureFormat& format, const Contents& contents);
  std::vector<std::string_view> rendered = {};  ///< names of the files that other programs make
};

/// All formats, in the order in which they are listed for users.
const std::vector<PictureFormat>& picture_formats();

/// Null if there is no such format.
const PictureFormat* find_picture_format(std::string_view name);

}  // namespace falling_particles
