// A page that plays a run in a browser.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "packed_frames.hpp"
#include "picture.hpp"

namespace falling_particles {

/// view.html: the page of `page/` with the run in it, without other files. It is written at the end of a run; until then a grain
/// needs up to 45 bytes per frame.
class ViewPage final : public Picture {
 public:
  ViewPage(const std::filesystem::path& path, const Contents& contents);
  void add(const Frame& frame) override;
  void finish(const std::string& summary) override;

 private:
  std::filesystem::path path_;
  const Contents& contents_;
  std::vector<double> times_, kinetic_, potential_;
  std::vector<std::vector<double>> wall_scales_;  // of each frame
  std::vector<std::vector<double>> wall_poses_;   // of each frame: x, y, z of the position and x, y, z, w of each moving wall
  PackedGrains grains_;
  std::vector<std::size_t> grain_counts_;  // of each frame
  PackedContacts contacts_;
};

}  // namespace falling_particles
