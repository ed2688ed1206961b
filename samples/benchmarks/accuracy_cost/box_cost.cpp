#include "box_cost.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>

#include "common/number_text.hpp"
#include "literature/extent.hpp"
#include "random_geometry.hpp"
#include "report/statistics.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/bounding_box.hpp"

namespace accuracy_cost {
namespace {

using common::joined;
using common::MeasuredTable;
using common::number;
using common::Random;
using supernormal::BoundingBox;
using supernormal::Pose;
using supernormal::Vector3;
using Clock = std::chrono::steady_clock;

constexpr double kVolumeFraction = 0.6;  // of a bed
constexpr double kNewtonTolerance = 1e-9;

struct Body {
  std::shared_ptr<const supernormal::Shape> shape;
  literature::Superquadric surface;
  Pose pose;
};

BoundingBox around(const Body& body, const Vector3& reach) { return {body.pose.position - reach, body.pose.position + reach}; }

BoundingBox by_support(const Body& body) { return find_bounding_box(*body.shape, body.pose); }

/// NaN if Newton's method does not converge. The bodies are symmetric, so three searches replace six.
BoundingBox by_newton(const Body& body) {
  Vector3 reach;
  for (int axis = 0; axis < 3; ++axis) {
    const auto found = literature::extent_by_newton(body.surface, body.pose.rotation.row(axis).transpose(), kNewtonTolerance);
    reach[axis] = found.has_converged ? found.reach : std::numeric_limits<double>::quiet_NaN();
  }
  return around(body, reach);
}

BoundingBox by_turned_box(const Body& body) { return around(body, body.pose.rotation.cwiseAbs() * body.surface.half_axes); }

BoundingBox by_sphere(const Body& body) { return around(body, Vector3::Constant(body.shape->bounding_radius())); }

struct Way {
  const char* name;
  BoundingBox (*box)(const Body& body);
};
constexpr std::array<Way, 4> kWays = {{{"support function", by_support},
                                       {"Newton on the implicit function", by_newton},
                                       {"box around the turned box", by_turned_box},
                                       {"box around the bounding sphere", by_sphere}}};

/// Bodies on a lattice, each at a random place in its cell. They fill the volume fraction of the cube.
std::vector<Body> draw_bodies(BodyClass body_class, std::size_t count, std::uint64_t seed) {
  const std::vector<Pair> pairs = draw_pairs_of(body_class, Situation::Far, (count + 1) / 2, seed);
  std::vector<Body> bodies;
  double volume = 0;
  for (const Pair& pair : pairs) {
    for (const auto& shape : {pair.shape1, pair.shape2}) {
      bodies.push_back({shape, *literature::Superquadric::of(*shape), {}});
      volume += shape->mass_properties().volume;
    }
  }
  const auto cells = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(bodies.size()))));
  const double cell = std::cbrt(volume / kVolumeFraction / static_cast<double>(bodies.size()));
  Random random(seed);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::size_t layer = i / (cells * cells), row = i / cells % cells;
    const Vector3 corner(static_cast<double>(i % cells), static_cast<double>(row), static_cast<double>(layer));
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    bodies[i].pose = {cell * (corner + Vector3(x, y, z)), random_orientation(random)};
  }
  return bodies;
}

double volume_of(const BoundingBox& box) { return (box.high - box.low).prod(); }

bool overlap(const BoundingBox& a, const BoundingBox& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

/// The shortest time of several rounds, s.
double shortest(int rounds, const auto& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const auto start = Clock::now();
    work();
    least = std::min(least, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return least;
}

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

supernormal::Proximity ask(const std::vector<Body>& bodies, const Pairs::value_type& pair) {
  supernormal::Settings settings;
  settings.stop_when_apart = true;
  const auto& [i, j] = pair;
  return find_proximity(*bodies[i].shape, bodies[i].pose, *bodies[j].shape, bodies[j].pose, settings);
}

Pairs overlapping_boxes(const std::vector<BoundingBox>& boxes) {
  Pairs pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      if (overlap(boxes[i], boxes[j])) pairs.emplace_back(i, j);
    }
  }
  return pairs;
}

std::string line(BodyClass body_class, const Way& way, const std::vector<Body>& bodies, const Effort& effort) {
  std::vector<BoundingBox> boxes(bodies.size());
  const double time = shortest(effort.rounds, [&] { std::transform(bodies.begin(), bodies.end(), boxes.begin(), way.box); });
  std::vector<double> looseness;
  std::size_t failures = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const double ratio = volume_of(boxes[i]) / volume_of(by_support(bodies[i]));
    if (!(ratio > 1 - 1e-6)) {  // not converged, or too small
      ++failures;
    } else {
      looseness.push_back(ratio);
    }
  }
  const Pairs pairs = overlapping_boxes(boxes);
  Pairs apart;
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(apart), [&](const auto& pair) { return ask(bodies, pair).gap >= 0; });
  double sink = 0;
  const double narrow = shortest(effort.rounds, [&] {
    for (const auto& pair : apart) sink += ask(bodies, pair).gap;
  });
  if (!(sink >= 0)) throw std::logic_error("bodies apart have a gap");
  const auto count = static_cast<double>(bodies.size());
  return joined({std::string{letter(body_class)}, way.name, std::to_string(bodies.size()), number(time / count),
                 number(median(looseness)), number(quantile(looseness, 0.99)), std::to_string(failures),
                 number(static_cast<double>(pairs.size()) / count), number(static_cast<double>(apart.size()) / count),
                 number(narrow / count)});
}

}  // namespace

MeasuredTable box_costs(std::size_t bodies, std::uint64_t seed, const Effort& effort) {
  MeasuredTable table{"boxes", "class,box,bodies,time_s,volume,volume_p99,failures,pairs,apart,narrow_s", {}};
  for (const BodyClass body_class : kAllBodyClasses) {
    table.tasks.push_back({std::string{letter(body_class)}, [=] {
                             const std::vector<Body> all = draw_bodies(body_class, bodies, seed);
                             std::vector<std::string> lines;
                             lines.reserve(std::size(kWays));
                             for (const Way& way : kWays) lines.push_back(line(body_class, way, all, effort));
                             return lines;
                           }});
  }
  return table;
}

}  // namespace accuracy_cost
