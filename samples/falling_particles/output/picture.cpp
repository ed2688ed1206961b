#include "picture.hpp"

#include <algorithm>

#include "lammps_dump.hpp"
#include "plots.hpp"
#include "povray_scene.hpp"
#include "scene_glb.hpp"
#include "view_page.hpp"
#include "vtk_series.hpp"

namespace falling_particles {
namespace {

template <typename Format>
std::unique_ptr<Picture> make_file(const OutputFolder& folder, const PictureFormat& format, const Contents& contents) {
  return std::make_unique<Format>(folder.file(std::string(format.files.front())), contents);
}

std::unique_ptr<Picture> make_vtk(const OutputFolder& folder, const PictureFormat&, const Contents& contents) {
  return std::make_unique<VtkSeries>(folder, contents);
}

std::unique_ptr<Picture> make_plots(const OutputFolder&, const PictureFormat&, const Contents& contents) {
  return std::make_unique<Plots>(contents);
}

}  // namespace

const std::vector<PictureFormat>& picture_formats() {
  static const std::vector<PictureFormat> formats = {
      {"page", {"view.html"}, make_file<ViewPage>},
      {"glb", {"scene.glb"}, make_file<SceneGlb>},
      {"lammps", {"grains.lammpstrj"}, make_file<LammpsDump>},
      {"vtk", {"grains.pvd", "contacts.pvd", "container.pvd", "vtk"}, make_vtk},
      {"povray", {"still.pov"}, make_file<PovrayScene>, {"still.png"}},
      {"plots", {}, make_plots, {"energies.svg", "state.svg", "discharge.svg", "compression.svg"}}};
  return formats;
}

const PictureFormat* find_picture_format(std::string_view name) {
  const auto found = std::ranges::find(picture_formats(), name, &PictureFormat::name);
  return found == picture_formats().end() ? nullptr : &*found;
}

}  // namespace falling_particles
