#include "output_folder.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "input_error.hpp"
#include "temporary_folder.hpp"

using namespace falling_particles;
namespace fs = std::filesystem;

namespace {

std::ptrdiff_t entries(const fs::path& folder) { return std::distance(fs::directory_iterator(folder), fs::directory_iterator()); }

void run_once(const fs::path& out, const std::string& content, bool commit) {
  OutputFolder folder(out, "scene");
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

TEST_CASE("what a run has not written is never deleted") {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "scene");
  folder.write("scene/thesis.txt", "ten years' work");
  CHECK_THROWS_AS(OutputFolder(folder.path(), "scene"), InputError);
  CHECK(content_of(folder.path() / "scene/thesis.txt") == "ten years' work");
  const TemporaryFolder other;
  other.write("scene", "a file");
  CHECK_THROWS_AS(OutputFolder(other.path(), "scene"), InputError);
}
