// Tests of files that cannot be written whole: /dev/full, which takes nothing, in the place of each in turn.
#include <doctest/doctest.h>

#include <filesystem>
#include <functional>
#include <vector>

#include "base/write_file.hpp"
#include "common/input_error.hpp"
#include "observe/measuring.hpp"
#include "output/picture.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;
namespace fs = std::filesystem;

namespace {

Scene scene_of_a_die() {
  Scene scene{};
  scene.name = "full";
  scene.container = Box{{0.1, 0.1}};
  scene.kinds = {{{"die", {0.008, 0.008, 0.008}, 20, 20, 0.001, 1200, "typical"}, 1}};
  return scene;
}

/// Writes two frames of a die in a format.
void write_picture(const PictureFormat& format, const Scene& scene, const OutputFolder& folder) {
  const Contents contents{&scene, {0}, {}};
  const std::unique_ptr<Picture> picture = format.make(folder, format, contents);
  Frame frame;
  frame.grains = {{{0, 0, 0.1}, {1, 0, 0, 0}, {}, {}}};
  picture->add(frame);
  frame.time = 0.1;
  frame.grains[0].position[2] = 0.08;
  picture->add(frame);
  picture->finish("");
}

/// The files of a format, relative to its folder.
std::vector<std::string> files_of(const PictureFormat& format, const Scene& scene) {
  const TemporaryFolder parent;
  const OutputFolder folder(parent.path(), "full", result_names());
  write_picture(format, scene, folder);
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.file(""))) {
    const std::string name = fs::relative(entry.path(), folder.file("")).string();
    if (entry.is_regular_file() && name != "UNFINISHED") files.push_back(name);
  }
  return files;
}

void check_complaint(const std::function<void()>& write, const fs::path& path) {
  const std::string complaint = "cannot write \"" + path.string() + "\": No space left on device";
  CHECK_THROWS_WITH_AS(write(), complaint.c_str(), std::runtime_error);
}

}  // namespace

TEST_CASE("each file of a picture that does not fit on the disk is named, with the reason") {
  const Scene scene = scene_of_a_die();
  for (const PictureFormat& format : picture_formats()) {
    const std::vector<std::string> files = files_of(format, scene);
    CHECK(files.size() >= format.files.size());
    for (const std::string& file : files) {
      CAPTURE(file);
      const TemporaryFolder parent;
      const OutputFolder folder(parent.path(), "full", result_names());
      fs::create_directories(folder.file(file).parent_path());
      fs::create_symlink("/dev/full", folder.file(file));
      check_complaint([&] { write_picture(format, scene, folder); }, folder.file(file));
    }
  }
}

TEST_CASE("a table that does not fit on the disk is named, with the reason") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "table";
  fs::create_symlink("/dev/full", path);
  check_complaint([&] { OutputFile(path).write("time_s\n"); }, path);
}

TEST_CASE("a file is written whole or not at all") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "file";
  fs::create_symlink("/dev/full", path);
  check_complaint([&] { write_file(path, "text"); }, path);
  CHECK_FALSE(fs::exists(fs::symlink_status(path)));
  CHECK_THROWS_WITH_AS(write_file(folder.path() / "none" / "file", "text"), doctest::Contains("No such file or directory"),
                       std::runtime_error);
}

TEST_CASE("results that cannot go to their place are kept, and it is told where") {
  const TemporaryFolder parent;
  OutputFolder folder(parent.path(), "scene", result_names());
  write_file(folder.file("summary.toml"), "results");
  fs::create_directory(parent.path() / "scene");
  parent.write("scene/thesis.txt", "put there during the run");
  const fs::path unfinished = parent.path() / "scene.unfinished-1";
  CHECK_THROWS_WITH_AS(folder.commit(), doctest::Contains(("the results are in \"" + unfinished.string()).c_str()),
                       std::runtime_error);
  CHECK(fs::exists(unfinished / "summary.toml"));
  CHECK_FALSE(fs::exists(unfinished / "UNFINISHED"));  // the next run would remove it
  CHECK(fs::exists(parent.path() / "scene/thesis.txt"));
}
