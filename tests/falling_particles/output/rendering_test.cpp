// Tests of the programs that a run calls at its end.
#include "output/rendering.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>

#include "base/interrupt.hpp"
#include "common/read_file.hpp"
#include "output/picture.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;

namespace {

ProgramEnd run_shell(const std::string& commands, const std::string& input = "") {
  const TemporaryFolder folder;
  return run_program({"sh", "-c", commands}, folder.path(), input);
}

bool holds(const auto& names, const std::string& name) { return std::ranges::find(names, name) != names.end(); }

}  // namespace

TEST_CASE("a program has its input, its folder and its own words") {
  const TemporaryFolder folder;
  folder.write("table.csv", "1,2\n");
  const ProgramEnd end =
      run_program({"sh", "-c", "cat; cat table.csv; printf '%s' \"$1\"", "sh", "a 'b' $HOME"}, folder.path(), "text\n");
  CHECK(end.is_installed);
  CHECK(end.has_succeeded);
  CHECK(end.output == "text\n1,2\na 'b' $HOME");
  CHECK(end.messages.empty());
}

TEST_CASE("what a program writes is kept whole, also if it is much") {
  const ProgramEnd end = run_shell("head -c 3000000 /dev/zero; head -c 200000 /dev/zero >&2");
  CHECK(end.output.size() == 3'000'000);
  CHECK(end.messages.size() == 200'000);
}

TEST_CASE("a PNG is the same bytes whenever it is drawn") {
  const TemporaryFolder folder;
  const auto chunk = [](const std::string& name, const std::string& content) {
    return std::string("\0\0\0", 3) + static_cast<char>(content.size()) + name + content + "sum.";
  };
  const std::string head = "\x89PNG\r\n\x1a\n" + chunk("IHDR", "900 x 560"), end = chunk("IDAT", "pixels") + chunk("IEND", "");
  const std::string dated = head + chunk("tIME", "now") + chunk("tEXt", "Comment: now") + end;
  const auto drawn = [&folder](const std::string& output) {
    render({{"still.png", {"cat"}, output, "coreutils"}}, folder.path(), true);
    return read_file(folder.path() / "still.png");
  };
  CHECK(drawn(dated) == head + end);
  CHECK(drawn(head + end) == head + end);
  for (const std::size_t size : {dated.size() - 1, dated.size() - 6, head.size() + 5}) {
    CHECK(drawn(dated.substr(0, size)) == dated.substr(0, size));  // torn: as it is
  }
  CHECK(drawn("<svg/>") == "<svg/>");
}

TEST_CASE("a program that fails says why") {
  const ProgramEnd silent = run_shell("exit 3");
  CHECK(silent.is_installed);
  CHECK_FALSE(silent.has_succeeded);
  CHECK(silent.messages == "exit code 3");
  CHECK(run_shell("echo no ink >&2; exit 1").messages == "no ink\n");
  const ProgramEnd killed = run_shell("kill -KILL $$");
  CHECK_FALSE(killed.has_succeeded);
  CHECK(killed.messages.find("signal 9") != std::string::npos);
}

TEST_CASE("a program that is not there is not a failure") {
  const TemporaryFolder folder;
  CHECK_FALSE(run_program({"no-such-program-anywhere"}, folder.path(), "").is_installed);
}

TEST_CASE("Ctrl-C ends a program, and what has been drawn stays") {
  const TemporaryFolder folder;
  catch_interrupts();
  const std::vector<Rendering> renderings = {{"first.svg", {"echo", "<svg/>"}, "", ""},
                                             {"second.svg", {"sh", "-c", "kill -TERM $PPID; exec sleep 600"}, "", ""},
                                             {"third.svg", {"echo", "<svg/>"}, "", ""}};
  render(renderings, folder.path(), true);
  CHECK(interrupted());
  std::signal(SIGINT, SIG_DFL);
  catch_interrupts();  // lowers the flag
  CHECK_FALSE(interrupted());
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  CHECK(std::filesystem::exists(folder.path() / "first.svg"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "second.svg"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "third.svg"));
}

TEST_CASE("a drawing that fails leaves no file, and the next ones are drawn") {
  const TemporaryFolder folder;
  const std::vector<Rendering> renderings = {{"failed.svg", {"sh", "-c", "echo '<svg'; exit 1"}, "", ""},
                                             {"empty.svg", {"true"}, "", ""},
                                             {"missing.svg", {"no-such-program-anywhere"}, "", "package"},
                                             {"drawn.svg", {"cat"}, "<svg/>", ""}};
  render(renderings, folder.path(), true);
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
  std::ifstream drawn(folder.path() / "drawn.svg");
  CHECK(std::string(std::istreambuf_iterator<char>(drawn), {}) == "<svg/>");
}

TEST_CASE("a drawing that cannot be written is named with the reason") {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder.path() / "drawn.svg");
  CHECK_THROWS_WITH_AS(render({{"drawn.svg", {"cat"}, "<svg/>", ""}}, folder.path(), true),
                       doctest::Contains("drawn.svg\": No space left on device"), std::runtime_error);
}

// Otherwise the next run of the scene would take a drawing for a user's file and refuse to replace the folder.
TEST_CASE("formats name all that other programs make for them, and plots have a table each") {
  Scene scene{};
  scene.container = Hopper{};
  scene.compression = Compression{};
  TemporaryFolder folder;
  OutputFolder out(folder.path(), "pictures", result_names());
  std::size_t count = 0;
  for (const PictureFormat& format : picture_formats()) {
    const Contents contents{&scene, {}, {}};
    for (const Rendering& rendering : format.make(out, format, contents)->renderings()) {
      CAPTURE(rendering.file);
      CHECK(holds(format.rendered, rendering.file));
      ++count;
      if (format.name != "plots") continue;
      CHECK(holds(result_names().files, std::filesystem::path(rendering.file).replace_extension("csv").string()));
      CHECK(rendering.input.find("plot ARG1") != std::string::npos);
    }
  }
  CHECK(count == 5);
}
