#include "base/output_folder.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "common/input_error.hpp"
#include "output/picture.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;
namespace fs = std::filesystem;

namespace {

std::ptrdiff_t entries(const fs::path& folder) { return std::distance(fs::directory_iterator(folder), fs::directory_iterator()); }

void run_once(const fs::path& out, const std::string& content, bool commit) {
  OutputFolder folder(out, "scene", result_names());
  std::ofstream(folder.file("summary.toml")) << content;
  if (commit) folder.commit();
}

std::string content_of(const fs::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("results appear when they are complete, and replace an earlier run's") {
  const TemporaryFolder folder;
  run_once(folder.path() / "a" / "b", "first", true);
  CHECK(content_of(folder.path() / "a/b/scene/summary.toml") == "first");
  run_once(folder.path() / "a" / "b", "second", true);
  CHECK(content_of(folder.path() / "a/b/scene/summary.toml") == "second");
  CHECK(entries(folder.path() / "a/b") == 1);
}

TEST_CASE("an unfinished run leaves nothing behind and earlier results alone") {
  const TemporaryFolder folder;
  run_once(folder.path() / "a" / "b", "unfinished", false);
  CHECK(entries(folder.path()) == 0);
  run_once(folder.path(), "finished", true);
  run_once(folder.path(), "unfinished", false);
  CHECK(content_of(folder.path() / "scene/summary.toml") == "finished");
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a run on its way is in a folder that says so, and a second one beside it") {
  const TemporaryFolder folder;
  OutputFolder first(folder.path(), "scene", result_names());
  OutputFolder second(folder.path(), "scene", result_names());
  CHECK(first.file("summary.toml") == folder.path() / "scene.unfinished-1/summary.toml");
  CHECK(second.file("summary.toml") == folder.path() / "scene.unfinished-2/summary.toml");
  CHECK(content_of(first.file("UNFINISHED")).find("has not ended") != std::string::npos);
  first.commit();
  second.commit();
  CHECK(entries(folder.path()) == 1);
  CHECK(entries(folder.path() / "scene") == 0);
}

TEST_CASE("what a killed run has left goes, but only where it is a run's") {
  const TemporaryFolder folder;
  const auto leave = [&folder](const std::string& name, const std::string& file) {
    fs::create_directories(folder.path() / name);
    folder.write(name + "/" + file, "text");
  };
  leave("scene.unfinished-1", "UNFINISHED");
  leave("scene.unfinished-1", "trajectory.csv");
  leave("scene.unfinished-2", "UNFINISHED");
  leave("scene.unfinished-2", "thesis.txt");
  leave("scene.unfinished-3", "trajectory.csv");
  leave("other.unfinished-1", "UNFINISHED");
  run_once(folder.path(), "finished", true);
  CHECK(entries(folder.path()) == 4);
  CHECK_FALSE(fs::exists(folder.path() / "scene.unfinished-1"));
  CHECK(content_of(folder.path() / "scene.unfinished-2/thesis.txt") == "text");
  CHECK(content_of(folder.path() / "scene/summary.toml") == "finished");
}

TEST_CASE("what somebody put into the folders of a run is never deleted") {
  for (const char* foreign : {"measurements/heights.png", "measurements/mine.svg", "vtk/view.pvsm", "measurements/old/grid.csv"}) {
    CAPTURE(foreign);
    const TemporaryFolder folder;
    for (const char* of_run : {"scene", "scene.unfinished-1"}) {
      fs::create_directories((folder.path() / of_run / foreign).parent_path());
      folder.write(std::string(of_run) + '/' + foreign, "a user's");
    }
    folder.write("scene.unfinished-1/UNFINISHED", "");
    CHECK_THROWS_WITH_AS(OutputFolder(folder.path(), "scene", result_names()), doctest::Contains("which no run writes"),
                         InputError);
    fs::rename(folder.path() / "scene", folder.path() / "other");
    run_once(folder.path(), "finished", true);
    CHECK(content_of(folder.path() / "scene.unfinished-1" / foreign) == "a user's");
    CHECK(content_of(folder.path() / "scene/summary.toml") == "finished");
  }
  const TemporaryFolder folder;
  {
    OutputFolder run(folder.path(), "scene", result_names());
    std::ofstream(run.file("plot.png")) << "a user's";
  }
  CHECK(content_of(folder.path() / "scene.unfinished-1/plot.png") == "a user's");
}

TEST_CASE("folders of other scenes are not those of a run") {
  const TemporaryFolder folder;
  for (const char* name : {"scene.unfinished-1.unfinished-1", "scene.unfinished-", "scene.unfinished-1a"}) {
    fs::create_directory(folder.path() / name);
    folder.write(std::string(name) + "/UNFINISHED", "");
  }
  run_once(folder.path(), "finished", true);
  CHECK(entries(folder.path()) == 4);
}

TEST_CASE("a run that was killed while it took its place is finished by the next one") {
  const TemporaryFolder folder;
  const auto leave = [&folder](const std::string& name, const std::string& file) {
    fs::create_directories(folder.path() / name);
    folder.write(name + "/" + file, "killed");
  };
  // Its results are there, with what is removed at the end; what it has replaced is a leftover, and another one is all but gone.
  for (const char* file : {"summary.toml", "UNFINISHED", "checkpoint", "checkpoint.frames"}) leave("scene", file);
  for (const char* file : {"summary.toml", "UNFINISHED"}) leave("scene.unfinished-1", file);
  fs::create_directories(folder.path() / "scene.unfinished-2");
  run_once(folder.path(), "again", true);
  CHECK(entries(folder.path()) == 1);
  CHECK(entries(folder.path() / "scene") == 1);
  CHECK(content_of(folder.path() / "scene/summary.toml") == "again");
}

TEST_CASE("what a run has not written is never deleted") {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "scene");
  folder.write("scene/thesis.txt", "ten years' work");
  CHECK_THROWS_AS(OutputFolder(folder.path(), "scene", result_names()), InputError);
  CHECK(content_of(folder.path() / "scene/thesis.txt") == "ten years' work");
  const TemporaryFolder other;
  other.write("scene", "a file");
  CHECK_THROWS_AS(OutputFolder(other.path(), "scene", result_names()), InputError);
}
