// Any text as a scene file of samples/falling_particles. It is loaded and the result is within bounds, or it is refused with the
// documented exception. The text after a line "#catalogue" is the grain catalogue "grains.toml" beside it. Without such a line it
// is the samples' catalogue.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>

#include "common/input_error.hpp"
#include "model/scene.hpp"
#include "support/expect.hpp"
#include "support/temporary_folder.hpp"

namespace supernormal::fuzz {
namespace {

using namespace falling_particles;

constexpr std::string_view kCatalogueMark = "#catalogue\n";

// A landscape of 4096 x 4096 samples is valid and takes seconds, and the fuzzer learns nothing from it.
constexpr long kMostSamples = 100;

bool asks_for_a_large_landscape(std::string_view text) {
  constexpr std::string_view kKey = "samples";
  for (auto at = text.find(kKey); at != std::string_view::npos; at = text.find(kKey, at + 1)) {
    std::string value;
    for (const char c : text.substr(at + kKey.size(), 40)) {
      if (c == '\n') break;
      if (c != '_' && c != '"' && c != '\'' && c != '=' && c != ' ' && c != '\t') value += c;
    }
    if (std::abs(std::strtol(value.c_str(), nullptr, value.find('x') == std::string::npos ? 10 : 16)) > kMostSamples) return true;
  }
  return false;
}

void check(const Scene& scene) {
  expect(!scene.kinds.empty() && scene.grains_at_start() >= 1 && scene.grains_at_start() <= 1'000'000, "a scene has grains");
  for (const GrainCount& entry : scene.kinds) {
    expect(entry.count >= 0, "no count is negative");
    expect(entry.kind.smallest_half_axis() > 0 && std::isfinite(entry.kind.bounding_radius()), "grains have a size");
    expect(entry.kind.rounding >= 0 && entry.kind.rounding < entry.kind.smallest_half_axis(), "a rounding fits in the grain");
    expect(entry.kind.density > 0 && std::isfinite(entry.kind.density), "grains have a density");
  }
  expect(scene.time.steps() >= 1 && scene.time.steps() <= 1'000'000'000, "there are steps to take");
  expect(scene.time.steps_per_frame() >= 1 && scene.time.steps_per_frame() <= scene.time.steps(), "there are frames");
  expect(scene.smallest_cell() > 0 && std::isfinite(scene.smallest_cell()), "the cells of the start have a size");
}

class SceneFolder {
 public:
  SceneFolder() : usual_catalogue_(read(SUPERNORMAL_SAMPLES "/data/grains.toml")) {}

  void load(std::string_view input) const {
    const std::size_t mark = input.find(kCatalogueMark);
    const std::string text(input.substr(0, mark));
    const std::string catalogue =
        mark == std::string_view::npos ? usual_catalogue_ : std::string(input.substr(mark + kCatalogueMark.size()));
    if (asks_for_a_large_landscape(text)) return;
    folder_.write("grains.toml", catalogue);
    const std::string path = folder_.write("scene.toml", text);
    try {
      check(load_scene(path));
    } catch (const InputError& error) {
      const std::string_view what = error.what();
      expect(what.starts_with(folder_.path().string()) || what.starts_with("cannot read "), "a refusal names the file",
             error.what());
    }
  }

 private:
  static std::string read(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    expect(stream.good(), "cannot read", path.c_str());
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  TemporaryFolder folder_;
  std::string usual_catalogue_;
};

}  // namespace
}  // namespace supernormal::fuzz

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const supernormal::fuzz::SceneFolder folder;
  folder.load({reinterpret_cast<const char*>(data), size});
  return 0;
}
