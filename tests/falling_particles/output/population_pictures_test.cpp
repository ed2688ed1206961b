// Tests of the pictures of runs in which grains come and go.
#include <doctest/doctest.h>
#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "common/read_file.hpp"
#include "output/picture.hpp"
#include "read_array.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;

namespace {

/// The first grain is there until the third frame, the second one comes with the second frame.
std::vector<Frame> frames() {
  std::vector<Frame> all(4);
  for (std::size_t index = 0; index < all.size(); ++index) {
    const auto t = static_cast<double>(index);
    Frame& frame = all[index];
    frame.time = 0.1 * t;
    frame.grains.push_back(index < 2 ? GrainState{{0, 0, 0.1 - 0.01 * t}, {1, 0, 0, 0}, {}, {}}
                                     : GrainState{{}, {1, 0, 0, 0}, {}, {}, false});
    if (index > 0) frame.grains.push_back({{0.05, 0.02 * t, 0.1}, {1, 0, 0, 0}, {}, {}});
  }
  return all;
}

/// Writes the frames in one format, as a run does: the contents grow with them.
class PictureOfChanges {
 public:
  explicit PictureOfChanges(std::string_view name) : out_(folder_.path(), "changes", result_names()) {
    scene_.name = "changes";
    scene_.container = Open{};
    scene_.kinds = {{{"pea", {0.003, 0.003, 0.003}, 2, 2, 0, 1200, "typical"}, 1}};
    scene_.sinks = {{"drain", HalfSpace{{0, 0, 0}, {0, 0, 1}}}};
    const PictureFormat& format = *find_picture_format(name);
    Contents contents{&scene_, {0}, {}};
    const std::unique_ptr<Picture> picture = format.make(out_, format, contents);
    for (const Frame& frame : frames()) {
      contents.kind_of_grain.resize(frame.grains.size(), 0);
      picture->add(frame);
    }
    picture->finish("");
  }
  std::string path(const std::string& file) const { return out_.file(file).string(); }
  std::string text(const std::string& file) const { return read_file(path(file)); }

 private:
  TemporaryFolder folder_;
  Scene scene_{};
  OutputFolder out_;
};

/// What follows each occurrence of a key, up to a mark.
std::vector<std::string> after(const std::string& text, const std::string& key, char mark) {
  std::vector<std::string> values;
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at)) {
    at += key.size();
    values.push_back(text.substr(at, text.find(mark, at) - at));
  }
  return values;
}

/// The numbers of the track of a node; none where it has none.
std::vector<float> track(const tinygltf::Model& model, int node, const std::string& path) {
  for (const tinygltf::AnimationChannel& channel : model.animations.at(0).channels) {
    if (channel.target_node != node || channel.target_path != path) continue;
    const auto& sampler = model.animations[0].samplers[static_cast<std::size_t>(channel.sampler)];
    if (path == "scale") CHECK(sampler.interpolation == "STEP");
    return read(model, sampler.output);
  }
  return {};
}

}  // namespace

TEST_CASE("lammps and vtk have the grains that are there, with their indices") {
  const PictureOfChanges lammps("lammps");
  CHECK(after(lammps.text("grains.lammpstrj"), "NUMBER OF ATOMS\n", '\n') == std::vector<std::string>{"1", "2", "1", "1"});
  CHECK(after(lammps.text("grains.lammpstrj"), "roundness_theta\n", ' ') == std::vector<std::string>{"1", "1", "2", "2"});
  const PictureOfChanges vtk("vtk");
  const std::string grain = "Name=\"grain\" NumberOfComponents=\"1\" format=\"ascii\">\n";
  CHECK(after(vtk.text("vtk/grains_000000.vtp"), "NumberOfPoints=\"", '"') == std::vector<std::string>{"1"});
  CHECK(after(vtk.text("vtk/grains_000001.vtp"), "NumberOfPoints=\"", '"') == std::vector<std::string>{"2"});
  CHECK(after(vtk.text("vtk/grains_000003.vtp"), "NumberOfPoints=\"", '"') == std::vector<std::string>{"1"});
  CHECK(after(vtk.text("vtk/grains_000003.vtp"), grain, ' ') == std::vector<std::string>{"1"});
}

TEST_CASE("a still has the grains of the last frame") {
  const PictureOfChanges written("povray");
  CHECK(after(written.text("still.pov"), "object { Kind0 matrix ", '>').size() == 1);
}

TEST_CASE("glb: a node is scaled to nothing while its grain is not there") {
  const PictureOfChanges written("glb");
  const tinygltf::Model model = read_glb(written.path("scene.glb"));
  REQUIRE(model.nodes.size() == 3);
  CHECK(track(model, 0, "scale") == std::vector<float>{1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0});
  CHECK(track(model, 1, "scale") == std::vector<float>{0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1});
  CHECK(model.nodes[0].scale.empty());
  CHECK(model.nodes[1].scale == std::vector<double>{0, 0, 0});
  // Where it is not there it stays where it was last, or comes first, so that nothing flies through the picture.
  const std::vector<float> first = track(model, 0, "translation");
  REQUIRE(first.size() == 12);
  CHECK(first[5] == static_cast<float>(0.09));
  CHECK(first[11] == static_cast<float>(0.09));
  const std::vector<float> second = track(model, 1, "translation");
  REQUIRE(second.size() == 12);
  CHECK(second[1] == static_cast<float>(0.02));
  CHECK(second[4] == static_cast<float>(0.02));
  CHECK(second[10] == static_cast<float>(0.06));
}

TEST_CASE("page: the numbers of bodies in each frame are told") {
  const PictureOfChanges written("page");
  CHECK(written.text("view.html").find("\"bodyCounts\":[1,2,2,2]") != std::string::npos);
}
