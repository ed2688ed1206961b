// Checkpoints that are not whole, or not of this run.
#include "run/envelope.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "base/files.hpp"
#include "common/input_error.hpp"
#include "complaint.hpp"
#include "scene_text.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;

namespace {

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
