// The files of a run with checkpoints.
#include "run/checkpoints.hpp"

#include <doctest/doctest.h>

#include <array>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "base/write_file.hpp"
#include "common/input_error.hpp"
#include "common/read_file.hpp"
#include "observe/measuring.hpp"
#include "output/frame_log.hpp"
#include "output/picture.hpp"
#include "scene_text.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;
namespace fs = std::filesystem;

namespace {

constexpr const char* kColumns = "time_s,discharged_kg,discharged_grains";

class SceneInFolder {
 public:
  SceneInFolder() {
    folder_.write("grains.toml", kCatalogueText);
    scene_ = load_scene(folder_.write("box.toml", kSceneText));
  }
  const Scene& scene() const { return scene_; }
  fs::path out() const { return folder_.path() / "out"; }
  fs::path unfinished(const std::string& file) const { return out() / "box.unfinished-1" / file; }

 private:
  TemporaryFolder folder_;
  Scene scene_;
};

}  // namespace

TEST_CASE("checkpoint: a run that was left is taken over, with what it saved last") {
  const SceneInFolder box;
  {
    OutputFolder folder(box.out(), "box", result_names());
    Checkpoints checkpoints(folder, box.scene(), 10);
    CHECK_FALSE(checkpoints.last());
    checkpoints.write("first");
    checkpoints.write("second");
  }
  OutputFolder folder(box.out(), "box", result_names(), true);
  CHECK(folder.is_resumed());
  CHECK(folder.file("") == box.unfinished(""));
  const Checkpoints checkpoints(folder, box.scene(), 0);
  CHECK(checkpoints.every() == 10);
  CHECK(checkpoints.last() == std::string("second"));
  CHECK_THROWS_WITH_AS(OutputFolder(box.out(), "box", result_names(), true), doctest::Contains("is that of a run on its way"),
                       InputError);
  folder.commit();
  CHECK_FALSE(fs::exists(box.unfinished("")));
  CHECK(fs::is_empty(box.out() / "box"));
}

TEST_CASE("checkpoint: a run that has saved nothing leaves nothing, and one without --resume starts anew") {
  const SceneInFolder box;
  {
    OutputFolder folder(box.out(), "box", result_names());
    const Checkpoints checkpoints(folder, box.scene(), 10);
  }
  CHECK_FALSE(fs::exists(box.out()));
  CHECK_FALSE(OutputFolder(box.out(), "box", result_names(), true).is_resumed());
  {
    OutputFolder folder(box.out(), "box", result_names());
    Checkpoints(folder, box.scene(), 10).write("state");
  }
  CHECK(fs::exists(box.unfinished("checkpoint")));
  const OutputFolder anew(box.out(), "box", result_names());
  CHECK_FALSE(anew.is_resumed());
  CHECK_FALSE(fs::exists(box.unfinished("checkpoint")));
}

TEST_CASE("checkpoint: a run is gone on with whatever else is in its folder, which goes with it") {
  for (const char* foreign : {"energies.svg~", ".energies.csv.swp", "measurements/heights.png", "thesis/chapter.txt"}) {
    CAPTURE(foreign);
    const SceneInFolder box;
    {
      OutputFolder folder(box.out(), "box", result_names());
      Checkpoints(folder, box.scene(), 10).write("state");
    }
    fs::create_directories(box.unfinished(foreign).parent_path());
    write_file(box.unfinished(foreign), "a user's");
    OutputFolder folder(box.out(), "box", result_names(), true);
    CHECK(folder.is_resumed());
    CHECK(Checkpoints(folder, box.scene(), 10).last() == std::string("state"));
    folder.commit();
    CHECK(read_file(box.out() / "box" / foreign) == "a user's");
    CHECK_THROWS_WITH_AS(OutputFolder(box.out(), "box", result_names(), true), doctest::Contains("which no run writes"),
                         InputError);
    CHECK(read_file(box.out() / "box" / foreign) == "a user's");
  }
}

TEST_CASE("checkpoint: a folder that no run can lock is refused by name, and not taken for none") {
  const SceneInFolder box;
  {
    OutputFolder folder(box.out(), "box", result_names());
    Checkpoints(folder, box.scene(), 10).write("state");
  }
  fs::remove(box.unfinished("UNFINISHED"));
  CHECK_THROWS_WITH_AS(OutputFolder(box.out(), "box", result_names(), true),
                       doctest::Contains("box.unfinished-1\" has a checkpoint but no file UNFINISHED"), InputError);
  write_file(box.unfinished("UNFINISHED"), "");
  CHECK(OutputFolder(box.out(), "box", result_names(), true).is_resumed());
  const fs::path folder = box.unfinished("").parent_path();
  fs::rename(folder, box.out() / "elsewhere");
  fs::create_directory_symlink("elsewhere", folder);
  CHECK_THROWS_WITH_AS(OutputFolder(box.out(), "box", result_names(), true),
                       doctest::Contains("box.unfinished-1\" has a checkpoint and is a link"), InputError);
}

TEST_CASE("checkpoint: where there is no space for a new one the last one stays") {
  const SceneInFolder box;
  {
    OutputFolder folder(box.out(), "box", result_names());
    Checkpoints checkpoints(folder, box.scene(), 10);
    checkpoints.write("first");
    fs::create_symlink("/dev/full", box.unfinished("checkpoint.new"));
    CHECK_THROWS_WITH_AS(checkpoints.write("second"), doctest::Contains("checkpoint.new\": No space left on device"),
                         std::runtime_error);
    CHECK_FALSE(fs::exists(fs::symlink_status(box.unfinished("checkpoint.new"))));
    CHECK(checkpoints.last() == std::string("first"));
  }
  OutputFolder folder(box.out(), "box", result_names(), true);
  Checkpoints checkpoints(folder, box.scene(), 10);
  CHECK(checkpoints.last() == std::string("first"));
  checkpoints.write("second");
  CHECK(unseal(read_file(box.unfinished("checkpoint")), "").state == "second");
}

TEST_CASE("checkpoint: one that is refused stays as it is") {
  const SceneInFolder box;
  {
    OutputFolder folder(box.out(), "box", result_names());
    Checkpoints(folder, box.scene(), 10).write("state");
  }
  Scene other = box.scene();
  other.pictures.clear();
  const std::string before = read_file(box.unfinished("checkpoint"));
  for (const auto& [scene, every] : {std::pair(&box.scene(), 20), std::pair<const Scene*, int>(&other, 10)}) {
    OutputFolder folder(box.out(), "box", result_names(), true);
    CHECK_THROWS_AS(Checkpoints(folder, *scene, every), InputError);
  }
  CHECK(read_file(box.unfinished("checkpoint")) == before);
}

TEST_CASE("checkpoint: bodies have the time to fall asleep between two") {
  const SceneInFolder box;
  Scene scene = box.scene();
  scene.effects.emplace_back(supernormal::effects::AutoDisable{0.01, 0.01, 0.1, 20});  // 200 steps
  OutputFolder folder(box.out(), "box", result_names());
  CHECK_THROWS_WITH_AS(
      Checkpoints(folder, scene, 240),
      "--checkpoint-every is 240; allowed with [auto_disable] of the scene: at least 241 steps, within which bodies "
      "can fall asleep",
      InputError);
  CHECK(Checkpoints(folder, scene, 241).are_on());
}

TEST_CASE("checkpoint: a table goes on after the bytes that are kept") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "discharge.csv";
  FileState kept;
  {
    TableFile table(path, kColumns);
    table.write("0.1,1,2\n");
    kept = table.state();
    table.write("0.2,3,4\n");
  }
  {
    TableFile table(path, kColumns, kept);
    table.write("0.3,5,6\n");
    table.sync();
    CHECK(table.state().bytes == read_file(path).size());
  }
  CHECK(read_file(path) == "time_s,discharged_kg,discharged_grains\n0.1,1,2\n0.3,5,6\n");
  CHECK_THROWS_WITH_AS(TableFile(path, kColumns, FileState{1000, {}}), doctest::Contains("has 55 bytes, and had 1000"), InputError);
  CHECK(read_file(path).size() == 55);
}

TEST_CASE("checkpoint: a table that was changed or removed since is refused and stays") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "discharge.csv";
  FileState kept;
  {
    TableFile table(path, kColumns);
    table.write("0.1,1,2\n");
    kept = table.state();
    table.write("0.2,3,4\n");
  }
  std::string changed = read_file(path);
  changed[kept.bytes - 2] = '7';
  write_file(path, changed);
  CHECK_THROWS_WITH_AS(TableFile(path, kColumns, kept), doctest::Contains("discharge.csv\" was changed since it was last saved"),
                       InputError);
  CHECK(read_file(path) == changed);
  fs::remove(path);
  CHECK_THROWS_WITH_AS(TableFile(path, kColumns, kept), doctest::Contains("discharge.csv\" is missing; without --resume"),
                       InputError);
  CHECK_FALSE(fs::exists(path));
}

TEST_CASE("checkpoint: frames come back bit for bit, up to where the log was saved") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "frames";
  Frame frame;
  frame.time = 0.1;
  frame.energy = {1.0 / 3, 2.0 / 3};
  frame.grains = {{{1, 2, 3}, {0.5, 0.5, 0.5, 0.5}, {4, 5, 6}, {7, 8, 9}, true}, {{}, {1, 0, 0, 0}, {}, {}, false}};
  frame.contacts = {{{1, 2, 3}, {0, 0, 1}, 1e-6, 0, kWall, Point{1, 2, 3}}, {{1, 2, 3}, {0, 0, 1}, 1e-6, 0, 1, {}}};
  frame.wall_places = {{{1, 2, 3}, {1, 0, 0, 0}, 0.5}};
  std::uint64_t kept = 0;
  {
    FrameLog log(path);
    log.add(frame);
    frame.time = 0.2;
    log.add(frame);
    kept = log.state().bytes;
    log.add(frame);
  }
  std::vector<Frame> frames;
  replay_frames(path, kept, [&frames](const Frame& each) { frames.push_back(each); });
  CHECK(frames.size() == 2);
  CHECK(frames[0].time == 0.1);
  CHECK(frames[1].time == 0.2);
  CHECK(frames[1].energy.kinetic == 1.0 / 3);
  CHECK(frames[1].grains[0].angular_velocity == Point{7, 8, 9});
  CHECK(frames[1].grains[0].is_present);
  CHECK_FALSE(frames[1].grains[1].is_present);
  CHECK(frames[1].contacts[0].force == Point{1, 2, 3});
  CHECK_FALSE(frames[1].contacts[1].force);
  CHECK(frames[1].wall_places == frame.wall_places);
  const auto ignore = [](const Frame&) {};
  CHECK_THROWS_WITH_AS(replay_frames(path, kept - 1, ignore), doctest::Contains("ends within a frame"), InputError);
  std::string bytes = read_file(path);
  bytes[100] = static_cast<char>(bytes[100] ^ 1);
  write_file(path, bytes);
  CHECK_THROWS_WITH_AS(replay_frames(path, kept, ignore), doctest::Contains("is damaged"), InputError);
}
