// Tests of the sources of pairs: the command line, a run, the hard cases.
#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "base/input_error.hpp"
#include "pair/described_body.hpp"
#include "pair/hard_case.hpp"
#include "pair/recorded_pair.hpp"
#include "scene_text.hpp"
#include "support/temporary_folder.hpp"

using namespace explain_pair;

namespace {

std::string complaint_of(const std::function<void()>& attempt) {
  try {
    attempt();
  } catch (const falling_particles::InputError& error) {
    return error.what();
  }
  return "";
}

void check_complaint(const std::function<void()>& attempt, const std::vector<std::string>& parts) {
  const std::string text = complaint_of(attempt);
  CAPTURE(text);
  CHECK(text.find("allowed: ") != std::string::npos);
  for (const std::string& part : parts) CHECK(text.find(part) != std::string::npos);
}

constexpr const char* kTrajectory =
    "time_s,body,grain,x_m,y_m,z_m,qw,qx,qy,qz\n"
    "0,0,pea,0,0,0,1,0,0,0\n"
    "0,1,pea,0.1,0,0,1,0,0,0\n"
    "0,2,pea,0,0,0.05,1,0,0,0\n"
    "0.5,0,pea,0,0,0.1,1,0,0,0\n"
    "0.5,1,pea,0.02,0,0.1,0.6,0.8,0,0\n"
    "0.5,2,pea,0,0,0.5,1,0,0,0\n";

/// A run of the scene of the loader's tests.
class Run {
 public:
  explicit Run(const std::string& trajectory = kTrajectory, const std::string& scene = kSceneText) {
    folder_.write("grains.toml", kCatalogueText);
    recording_ = {folder_.write("scene.toml", scene), folder_.write("trajectory.csv", trajectory), 0, 0, {}};
  }
  Recording recording(double time, std::size_t first, std::optional<std::size_t> second) const {
    Recording out = recording_;
    out.time = time;
    out.first = first;
    out.second = second;
    return out;
  }

 private:
  TemporaryFolder folder_;
  Recording recording_;
};

}  // namespace

TEST_CASE("pair: bodies are read from the command line") {
  const PlacedBody body = described_body("1", " superellipsoid  1 0.8 5e-1 2.5 8 ", 0.1);
  CHECK(body.shape->half_extents().isApprox(Vector3(1.1, 0.9, 0.6)));
  CHECK(body.description == "superellipsoid (1, 0.8, 0.5) m; 2.5, 8, rounded 0.1 m");
  CHECK(described_body("1", "sphere 2", 0).shape->support(Vector3::UnitX()) == doctest::Approx(2));
  for (const char* text : {"ellipsoid 1 2 3", "superovoid 1 1 1 2 2 0.1 -0.1", "box 1 2 3", "capsule 1 2", "cylinder 1 2"}) {
    CHECK(complaint_of([&] { described_body("2", text, 0); }) == "");
  }
}

TEST_CASE("pair: an error in a body is reported with the valid range") {
  const auto body = [](const char* text, double rounding = 0) { return [=] { described_body("2", text, rounding); }; };
  check_complaint(body("elipsoid 1 2 3"), {"--body2", "\"elipsoid\"", "did you mean \"ellipsoid\"?", "cylinder"});
  check_complaint(body(""), {"--body2", "superovoid"});
  check_complaint(body("ellipsoid 1 2"), {"--body2", "has 2 numbers", "3, A B C"});
  check_complaint(body("ellipsoid 1 2 3x"), {"--body2", "\"3x\" is not a number"});
  check_complaint(body("ellipsoid 1 2 nan"), {"--body2", "\"nan\" is not a number"});
  check_complaint(body("ellipsoid 1 2 3", -1), {"--rounding2 is -1", "[0, 1e+30] m"});
  CHECK(complaint_of(body("superellipsoid 1 1 1 2 0.5")).find("0.5") != std::string::npos);
  check_complaint([] { rotation_of("--quaternion1", std::array{1.0, 1.0, 0.0, 0.0}); }, {"--quaternion1", "1.41", "unit length"});
  check_complaint([] { position_of("--position1", std::array{0.0, 1e200, 0.0}); }, {"--position1", "1e+200", "m"});
}

TEST_CASE("pair: a hard case is selected by its name") {
  const Pair pair = hard_case("concentric: identical ellipsoids");
  CHECK(pair.title == "concentric: identical ellipsoids");
  CHECK(pair.body2.shape->half_extents() == Vector3(1, 0.8, 0.5));
  check_complaint([] { hard_case("concentric: identical elipsoids"); },
                  {"--case", "397 names", "--list", "did you mean \"concentric: identical ellipsoids\"?"});
}

TEST_CASE("pair: two grains of a run are selected, or one and its neighbour") {
  const Run run;
  const Pair pair = recorded_pair(run.recording(0.5, 0, 1));
  CHECK(pair.body1.pose.position == Vector3(0, 0, 0.1));
  CHECK(pair.body2.pose.position == Vector3(0.02, 0, 0.1));
  CHECK(pair.body2.pose.rotation(2, 1) == doctest::Approx(0.96));
  CHECK(pair.body2.description.starts_with("body 1: "));
  CHECK(recorded_pair(run.recording(0.5, 0, {})).body2.pose.position == Vector3(0.02, 0, 0.1));
  CHECK(recorded_pair(run.recording(0, 0, {})).body2.pose.position == Vector3(0, 0, 0.05));
}

TEST_CASE("pair: grains keep their indices when others are removed") {
  const Run run("time_s,body,grain,x_m,y_m,z_m,qw,qx,qy,qz\n0,1,pea,0.1,0,0,1,0,0,0\n0,4,pea,0.2,0,0,1,0,0,0\n");
  const Pair pair = recorded_pair(run.recording(0, 4, {}));
  CHECK(pair.body1.pose.position == Vector3(0.2, 0, 0));
  CHECK(pair.body2.description.starts_with("body 1: "));
  check_complaint([&] { recorded_pair(run.recording(0, 2, {})); }, {"no body 2", "1 to 4, without those that have gone"});
}

TEST_CASE("pair: a grain from a feeder is refused because its size is not known") {
  const std::string size = "size = { distribution = \"uniform\", smallest = 5e-3, largest = 7e-3 }";
  const std::string scene = replaced(kSceneText, "count = 5", "count = 5\n" + size);
  const Run run(
      "time_s,body,grain,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,pea,0,0,0,1,0,0,0\n0,7,die,0.1,0,0,1,0,0,0\n0,8,pea,0.2,0,0,1,0,0,0\n",
      scene);
  CHECK(recorded_pair(run.recording(0, 0, 7)).body2.pose.position == Vector3(0.1, 0, 0));
  check_complaint([&] { recorded_pair(run.recording(0, 0, 8)); }, {"body 8: pea", "does not tell its size"});
  // It might be the neighbour.
  check_complaint([&] { recorded_pair(run.recording(0, 0, {})); }, {"body 8: pea", "does not tell its size"});
}

TEST_CASE("pair: a run with values other than the scene's is read with these values") {
  const Run run;
  Recording recording = run.recording(0.5, 0, 1);
  recording.overrides = {"grain[pea].count=3"};
  CHECK(recorded_pair(recording).body1.pose.position == Vector3(0, 0, 0.1));
  recording.overrides = {"grain[pea].counts=3"};
  CHECK(complaint_of([&] { recorded_pair(recording); }).find("counts") != std::string::npos);
}

TEST_CASE("pair: an error in a run is reported with the valid range") {
  const Run run;
  const auto pair = [&](double time, std::size_t first, std::optional<std::size_t> second) {
    return [&run, time, first, second] { recorded_pair(run.recording(time, first, second)); };
  };
  check_complaint(pair(0.4, 0, 1), {"--time is 0.4", "0.5 s is the nearest"});
  check_complaint(pair(0.5, 3, {}), {"--bodies", "no body 3", "0 to 2"});
  check_complaint(pair(0.5, 1, 1), {"--bodies", "two different bodies"});
  const auto broken = [](const std::string& trajectory) {
    return complaint_of([&] { recorded_pair(Run(trajectory).recording(0, 0, 1)); });
  };
  const std::string head = "time_s,body,grain,x_m,y_m,z_m,qw,qx,qy,qz\n";
  CHECK(broken("").find("cannot read") != std::string::npos);
  CHECK(broken("time,x\n").find("trajectory.csv:1: ") != std::string::npos);
  CHECK(broken(head).find("has no frames") != std::string::npos);
  CHECK(broken(head + "0,0,pea,0,0\n").find("trajectory.csv:2: the line has not the 10 columns") != std::string::npos);
  CHECK(broken(head + "0,0,pea,0,0,x,1,0,0,0\n").find("trajectory.csv:2: \"x\" is not a number") != std::string::npos);
  CHECK(broken(head + "0,0,pea,0,0,0,2,0,0,0\n").find("trajectory.csv:2: the quaternion has the length 2") != std::string::npos);
  CHECK(broken(head + "0,0,stone,0,0,0,1,0,0,0\n0,1,stone,0,0,1,1,0,0,0\n").find("a grain \"stone\"") != std::string::npos);
}
