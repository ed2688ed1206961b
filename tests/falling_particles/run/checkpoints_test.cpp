// The files of a run with checkpoints.
#include "run/checkpoints.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "base/write_file.hpp"
#include "common/input_error.hpp"
#include "common/read_file.hpp"
#include "observe/measuring.hpp"
#include "output/picture.hpp"
#include "output/recorder.hpp"
#include "scenes.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;
namespace fs = std::filesystem;

namespace {

const std::string kHead = "time_s,discharged_kg,discharged_grains\n";

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

Checkpoint sample() {
  return {{"1.2.3", 8, {{"box.toml", {1, 2}}, {"grains.toml", {3, 4}}}, {"seed=5"}, {"page", "glb"}, 100},
          std::string("state\0of a run", 14)};
}

std::string complaint_about(const std::string& bytes) {
  return refusal_by([&bytes] { unseal(bytes, "out/box/checkpoint"); });
}

void check_refused(const std::function<void(Origin&)>& change, const std::string& text) {
  Origin here = sample().origin;
  change(here);
  const std::string got = refusal_by([&here] { refuse_other(sample().origin, here, "out/box/checkpoint"); });
  CHECK(got == "checkpoint \"out/box/checkpoint\" is of " + text + kStartAnew);
}

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
    OutputFile table(path);
    table.write(kHead + "0.1,1,2\n");
    kept = table.state();
    table.write("0.2,3,4\n");
  }
  {
    OutputFile table(path, kept);
    table.write("0.3,5,6\n");
    table.sync();
    CHECK(table.state().bytes == read_file(path).size());
  }
  CHECK(read_file(path) == "time_s,discharged_kg,discharged_grains\n0.1,1,2\n0.3,5,6\n");
  CHECK_THROWS_WITH_AS(OutputFile(path, FileState{1000, {}}), doctest::Contains("has 55 bytes, and had 1000"), InputError);
  CHECK(read_file(path).size() == 55);
}

TEST_CASE("checkpoint: a table that was changed or removed since is refused and stays") {
  const TemporaryFolder folder;
  const fs::path path = folder.path() / "discharge.csv";
  FileState kept;
  {
    OutputFile table(path);
    table.write(kHead + "0.1,1,2\n");
    kept = table.state();
    table.write("0.2,3,4\n");
  }
  std::string changed = read_file(path);
  changed[kept.bytes - 2] = '7';
  write_file(path, changed);
  CHECK_THROWS_WITH_AS(OutputFile(path, kept), doctest::Contains("discharge.csv\" was changed since it was last saved"),
                       InputError);
  CHECK(read_file(path) == changed);
  fs::remove(path);
  CHECK_THROWS_WITH_AS(OutputFile(path, kept), doctest::Contains("discharge.csv\" is missing; without --resume"), InputError);
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
    OutputFile log(path);
    log_frame(frame, log);
    frame.time = 0.2;
    log_frame(frame, log);
    kept = log.state().bytes;
    log_frame(frame, log);
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

TEST_CASE("checkpoint: what is sealed comes out of its envelope") {
  const Checkpoint checkpoint = unseal(seal(sample()), "checkpoint");
  CHECK(checkpoint.state == sample().state);
  CHECK(checkpoint.origin.program == "1.2.3");
  CHECK(checkpoint.origin.bytes_of_a_real == 8);
  CHECK(checkpoint.origin.files[1].name == "grains.toml");
  CHECK(checkpoint.origin.files[1].hash == Hash{3, 4});
  CHECK(checkpoint.origin.overrides == std::vector<std::string>{"seed=5"});
  CHECK(checkpoint.origin.pictures == std::vector<std::string>{"page", "glb"});
  CHECK(checkpoint.origin.every == 100);
}

TEST_CASE("checkpoint: a file that ends too early is refused at every length") {
  const std::string whole = seal(sample());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    CAPTURE(size);
    const std::string got = complaint_about(whole.substr(0, size));
    const bool is_named = got.find(size == 0 ? " is empty" : size < 8 ? " is not one of" : " is torn") != std::string::npos;
    CHECK(is_named);
  }
  CHECK(complaint_about(whole + '\0').find(" is torn") != std::string::npos);
}

TEST_CASE("checkpoint: a byte that has changed is noticed, wherever it is") {
  const std::string whole = seal(sample());
  for (std::size_t at = 0; at < whole.size(); ++at) {
    CAPTURE(at);
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    CHECK(complaint_about(changed) != "");
  }
  std::string of_other_machine = whole;
  std::reverse(of_other_machine.begin() + 8, of_other_machine.begin() + 12);
  CHECK(complaint_about(of_other_machine) ==
        std::string("checkpoint \"out/box/checkpoint\" is of a machine with the other byte order, on which it can go on") +
            kStartAnew);
  std::string of_later_format = whole;
  const int format = static_cast<unsigned char>(++of_later_format[8]);
  CHECK(complaint_about(of_later_format) == "checkpoint \"out/box/checkpoint\" has format " + std::to_string(format) +
                                                "; allowed: " + std::to_string(format - 1) + ", that of this program" + kStartAnew);
}

TEST_CASE("checkpoint: one of another run is refused, and it is told why") {
  CHECK(refusal_by([] { refuse_other(sample().origin, sample().origin, "checkpoint"); }) == "");
  check_refused([](Origin& here) { here.program = "1.2.4"; }, "version 1.2.3 of the program; allowed: 1.2.4, this one");
  check_refused([](Origin& here) { here.bytes_of_a_real = 4; },
                "ODE with double precision; allowed: single precision, that of this program");
  check_refused([](Origin& here) { here.files[1].hash[0] = 5; },
                "another scene: the text of grains.toml was another one when it was written");
  check_refused([](Origin& here) { here.files.pop_back(); }, "another scene, which names other files");
  check_refused([](Origin& here) { here.overrides.clear(); }, "a run with seed=5 set; this one has nothing (see --set)");
  check_refused([](Origin& here) { here.pictures.clear(); },
                "a run that leaves page, glb; this one leaves no pictures (see --no-pictures)");
  check_refused(
      [](Origin& here) { here.every = 50; },
      "a run with --checkpoint-every 100; allowed: the same, or none, and not 50, with which the results would be others");
  Origin any = sample().origin;
  any.every = 0;
  CHECK(refusal_by([&any] { refuse_other(sample().origin, any, "checkpoint"); }) == "");
}

TEST_CASE("checkpoint: a scene is known by its text and that of its catalogue, wherever they are") {
  const auto origin_in = [](const std::string& scene, const std::string& catalogue) {
    const TemporaryFolder folder;
    folder.write("grains.toml", catalogue);
    return origin_of(load_scene(folder.write("box.toml", scene)), 7);
  };
  const Origin origin = origin_in(kSceneText, kCatalogueText);
  CHECK(origin.bytes_of_a_real == sizeof(dReal));
  CHECK(origin.files.size() == 2);
  CHECK(origin.files[0].name == "box.toml");
  CHECK(refusal_by([&] { refuse_other(origin, origin_in(kSceneText, kCatalogueText), "c"); }) == "");
  const std::string other_seed = replaced(kSceneText, "seed = 7", "seed = 8");
  CHECK(refusal_by([&] { refuse_other(origin, origin_in(other_seed, kCatalogueText), "c"); }).find("box.toml") !=
        std::string::npos);
  const std::string other_pea = replaced(kCatalogueText, "density = 1200", "density = 1201");
  CHECK(refusal_by([&] { refuse_other(origin, origin_in(kSceneText, other_pea), "c"); }).find("grains.toml") != std::string::npos);
}
