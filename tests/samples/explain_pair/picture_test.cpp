// Tests that the picture of a pair shows the library's results.
#include "drawing/picture.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <regex>
#include <sstream>

#include "drawing/colours.hpp"
#include "drawing/lengths.hpp"
#include "drawing/map_panel.hpp"
#include "drawing/pair_panel.hpp"
#include "drawing/svg.hpp"
#include "drawing/view.hpp"
#include "pair/hard_case.hpp"
#include "pairs.hpp"

using namespace explain_pair;

namespace {

constexpr std::size_t kLargestPicture = 400'000;  // bytes

/// The attributes of the first element that contains all of these texts.
std::smatch find(const std::string& document, const std::string& pattern) {
  std::smatch match;
  REQUIRE(std::regex_search(document, match, std::regex(pattern)));
  return match;
}

double number(const std::ssub_match& match) { return std::stod(match.str()); }

Frame frame_of(const Explanation& explanation) { return frame_of_picture(explanation.pair, explanation.answer().normal); }

}  // namespace

TEST_CASE("picture: the normal points to the right, in a right-handed frame") {
  for (const Pair& pair : sample_pairs()) {
    const Explanation explanation = explain(pair, {});
    const Frame frame = frame_of(explanation);
    CHECK((frame.right - explanation.answer().normal).norm() < 1e-12);
    CHECK((frame.right.cross(frame.up) - frame.toward).norm() < 1e-12);
    CHECK(frame.up.norm() == doctest::Approx(1));
  }
}

TEST_CASE("picture: an outline has the extent of its body, and the lit area is inside") {
  for (const Pair& pair : sample_pairs()) {
    const Frame frame{Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
    constexpr double kScale = 400;  // px for a metre
    const View view(frame, pair.body1.pose.position, kScale, {0, 0, 800, 800});
    for (const PlacedBody* body : {&pair.body1, &pair.body2}) {
      const Polyline line = outline(*body, view);
      const Polyline lit = lit_part(*body, view, Vector3(0.3, -0.5, 0.8).normalized(), 0.4);
      REQUIRE(lit.size() > 3);
      for (int k = 0; k < 40; ++k) {
        const Vector3 along(std::cos(0.157 * k), std::sin(0.157 * k), 0);
        const auto reach_of = [&](const Polyline& points) {
          double reach = -1e300;
          for (const Vector2& point : points)
            reach = std::max(reach, along.x() * (point.x() - 400) - along.y() * (point.y() - 400));
          return reach;
        };
        const double exact = kScale * (body->reach(along) - pair.body1.pose.position.dot(along));
        CHECK(std::abs(reach_of(line) - exact) < 0.3);
        CHECK(reach_of(lit) <= exact + 0.01);
      }
    }
  }
}

TEST_CASE("picture: the witness points, the planes and the scale agree with the library's answer") {
  for (const Pair& pair : sample_pairs()) {
    const Explanation explanation = explain(pair, {});
    const supernormal::Proximity& answer = explanation.answer();
    const Frame frame = frame_of(explanation);
    const Box box{10, 90, 560, 440};
    Svg svg(600, 600, "test");
    draw_pair(svg, box, explanation, frame);
    const std::string document = svg.document();
    const auto point = [&](const std::string& colour) {
      const std::smatch match = find(document, "circle cx=\"([-0-9.]+)\" cy=\"([-0-9.]+)\" r=\"4.2\" fill=\"" + colour);
      return Vector2(number(match[1]), number(match[2]));
    };
    const Vector2 point1 = point("#1F5F8F"), point2 = point("#A3600F");
    // The scale states the length of its line.
    const std::smatch bar =
        find(document,
             "line x1=\"([-0-9.]+)\" y1=\"76\" x2=\"([-0-9.]+)\" y2=\"76\"[^\n]*\n[^\n]*\n[^\n]*\n<text[^>]*>([0-9.]+) (m|mm)<");
    const double metres = number(bar[3]) * (bar[4] == "mm" ? 1e-3 : 1);
    const double scale = (number(bar[2]) - number(bar[1])) / metres;
    CHECK(std::abs(point2.x() - point1.x() - scale * answer.gap) < 0.01 * std::abs(scale * answer.gap) + 0.2);
    const Vector3 between = answer.point2 - answer.point1;
    CHECK(std::abs(point1.y() - point2.y() - scale * frame.up.dot(between)) < 0.3);
    for (const Vector2& one : {point1, point2}) {
      CHECK(one.x() >= box.x);
      CHECK(one.x() <= box.right());
      CHECK(document.find("<line x1=\"" + coordinate(one.x()) + "\" y1=\"96\" x2=\"" + coordinate(one.x()) + "\" y2=\"530\"") !=
            std::string::npos);
    }
    CHECK(document.find((answer.gap >= 0 ? "gap " : "depth ") + length_text(std::abs(answer.gap))) != std::string::npos);
  }
}

TEST_CASE("picture: every hard case has a picture of limited size with finite coordinates") {
  std::istringstream list(list_of_hard_cases());
  std::string name, reason;
  int count = 0;
  while (std::getline(list, name) && std::getline(list, reason)) {
    CAPTURE(name);
    const std::string document = picture_of(explain(hard_case(name), {}));
    CHECK(document.size() < kLargestPicture);
    CHECK(document.find("nan") == std::string::npos);
    CHECK(document.find("\"inf") == std::string::npos);
    CHECK(document.find("-inf") == std::string::npos);
    ++count;
  }
  CHECK(count == 397);
}

TEST_CASE("picture: neighbouring colours of the map differ equally, and its lines differ from all of them") {
  const auto rectangular = [](const Oklch& colour) {
    const double angle = colour.hue * 3.14159265358979 / 180;
    return Vector3(colour.lightness, colour.chroma * std::cos(angle), colour.chroma * std::sin(angle));
  };
  constexpr int kSteps = 12;
  const double first = (rectangular(map_colour(1.0 / kSteps)) - rectangular(map_colour(0))).norm();
  for (int k = 1; k < kSteps; ++k) {
    const Vector3 step = rectangular(map_colour((k + 1.0) / kSteps)) - rectangular(map_colour(static_cast<double>(k) / kSteps));
    CHECK(step.norm() == doctest::Approx(first).epsilon(0.001));
    CHECK(step.x() > 0);
  }
  CHECK(hex({0, 0, 0}) == "#000000");
  CHECK(hex({1, 0, 0}) == "#ffffff");
  // Ottosson's red: L 0.628, C 0.258, h 29.2.
  CHECK(hex({0.62796, 0.25768, 29.234}) == "#ff0000");
}

TEST_CASE("picture: text is escaped, and numbers are short") {
  Svg svg(10, 10, "a < b & \"c\"");
  svg.text({1, 2}, "<script>\x01");
  CHECK(svg.document().find("<title>a &lt; b &amp; &quot;c&quot;</title>") != std::string::npos);
  CHECK(svg.document().find("&lt;script&gt; <") != std::string::npos);
  CHECK(coordinate(-0.04) == "0");
  CHECK(coordinate(12.25) == "12.2");
  CHECK(coordinate(3) == "3");
  CHECK(coordinate(1e300).size() == 301);
}

TEST_CASE("picture: lengths have units that leave few zeros") {
  CHECK(length_text(0.5) == "0.5 m");
  CHECK(length_text(0.0123456) == "12.35 mm");
  CHECK(length_text(-1.5e-5) == "−15 µm");
  CHECK(length_text(0) == "0 m");
  CHECK(length_text(2e-12) == "2e-12 m");
}
