// The nearest point of a hull, against all subsets of its points in extended precision.
#include "proximity/bounds/minimum_norm_point.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "support/shape_samples.hpp"
#include "support/traps.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

using Points = std::vector<Vector3>;
using Long = Eigen::Matrix<long double, 3, 1>;

constexpr double kRounding = std::numeric_limits<double>::epsilon();

/// The distance of the origin from the hull, by Carathéodory's theorem: zero where four points surround it, otherwise the least of
/// the distances from the points, segments and triangles whose nearest point is in their interior.
class BruteForce {
 public:
  explicit BruteForce(const Points& points) {
    for (const Vector3& point : points) points_.emplace_back(point.cast<long double>());
  }

  double distance() {
    best_ = std::numeric_limits<long double>::infinity();
    const std::size_t n = points_.size();
    for (std::size_t i = 0; i < n; ++i) {
      best_ = std::min(best_, points_[i].norm());
      for (std::size_t j = 0; j < i; ++j) {
        look_at(points_[i], points_[j]);
        for (std::size_t k = 0; k < j; ++k) {
          look_at(points_[i], points_[j], points_[k]);
          for (std::size_t l = 0; l < k; ++l) {
            if (is_origin_in(points_[i], points_[j], points_[k], points_[l])) return 0;
          }
        }
      }
    }
    return static_cast<double>(best_);
  }

 private:
  void look_at(const Long& a, const Long& b) {
    const Long edge = b - a;
    const long double share = -a.dot(edge), squared = edge.squaredNorm();
    if (share > 0 && share < squared) best_ = std::min(best_, a.cross(edge).norm() / edge.norm());
  }

  void look_at(const Long& a, const Long& b, const Long& c) {
    const Long normal = (b - a).cross(c - a);
    if (!(normal.squaredNorm() > 0)) return;
    // Each side's volume with the normal, by the edges: their differences are exact where points are near one another.
    const auto is_left = [&](const Long& p, const Long& q) { return p.cross(q - p).dot(normal) >= 0; };
    if (is_left(a, b) && is_left(b, c) && is_left(c, a)) best_ = std::min(best_, std::abs(a.dot(normal)) / normal.norm());
  }

  /// Six times the volume of the tetrahedron with the origin; zero where it drowns in rounding.
  static long double volume(const Long& a, const Long& b, const Long& c) {
    const Long edge1 = b - a, edge2 = c - a;
    const long double volume = a.dot(edge1.cross(edge2));
    const long double rounding = 16 * std::numeric_limits<long double>::epsilon() * a.norm() * edge1.norm() * edge2.norm();
    return std::abs(volume) > rounding ? volume : 0;
  }

  static bool is_origin_in(const Long& a, const Long& b, const Long& c, const Long& d) {
    const long double abc = volume(a, b, c), acd = volume(a, c, d), adb = volume(a, d, b), bdc = volume(b, d, c);
    return (abc > 0 && acd > 0 && adb > 0 && bdc > 0) || (abc < 0 && acd < 0 && adb < 0 && bdc < 0);
  }

  std::vector<Long> points_;
  long double best_ = 0;
};

double largest_of(const Points& points) {
  double largest = 0;
  for (const Vector3& point : points) largest = std::max(largest, point.norm());
  return largest;
}

/// How far the point is from the hull, m.
double distance_from_hull(Points points, const Vector3& point) {
  for (Vector3& corner : points) corner -= point;
  return BruteForce(points).distance();
}

Vector3 nearest_of(const Points& points) {
  const Traps traps("nearest point of a hull");
  return minimum_norm_point(points).point;
}

/// As near as the reference and in the hull, to `rounding` of the largest of the points.
void check(const Points& points, double rounding) {
  const Vector3 nearest = nearest_of(points);
  const double allowed = rounding * largest_of(points);
  REQUIRE(nearest.allFinite());
  const double distance = BruteForce(points).distance();
  CHECK(nearest.norm() <= distance + allowed);
  CHECK(nearest.norm() >= distance - allowed);
  CHECK(distance_from_hull(points, nearest) <= allowed);
  for (const Vector3& point : points) CHECK(nearest.norm() <= point.norm());
  for (const Vector3& m : random_normals(20, 61)) {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const Vector3& point : points) {
      lowest = std::min(lowest, m.dot(point));
      highest = std::max(highest, m.dot(point));
    }
    CHECK(m.dot(nearest) <= highest + allowed);
    CHECK(m.dot(nearest) >= lowest - allowed);
    CHECK(lowest <= nearest.norm() + allowed);  // the lemma: no linear function of the hull is above |p| everywhere
  }
}

struct PointDraw : test::Draw {
  using Draw::Draw;
  Vector3 vector() { return Vector3{gauss(), gauss(), gauss()}; }
  static Points points(std::size_t count, const std::function<Vector3()>& make) {
    Points points(count);
    for (Vector3& point : points) point = make();
    return points;
  }
};

std::size_t some(int trial) { return 1 + static_cast<std::size_t>(trial) % 10; }

}  // namespace

TEST_CASE("random points: the nearest point of the hull equals the nearest point by brute force") {
  PointDraw draw(71);
  int inside = 0, outside = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Vector3 centre = draw.uniform(0, 2) * draw.vector();
    const Points points = draw.points(some(trial), [&] { return Vector3(centre + draw.vector()); });
    check(points, 1e-14);
    (nearest_of(points).isZero(0) ? inside : outside) += 1;
  }
  CHECK(inside > 50);
  CHECK(outside > 500);
}

TEST_CASE("a search that goes on with more points finds the nearest point of all, also of those that are not named again") {
  PointDraw draw(76);
  for (int trial = 0; trial < 300; ++trial) {
    const Vector3 centre = draw.uniform(0, 2) * draw.vector();
    Points points;
    MinimumNormSearch search;
    for (int count = 0; count < 9; ++count) {
      points.emplace_back(centre + draw.vector());
      const Points named(points.begin() + (count > 5 ? count - 5 : 0), points.end());
      const double norm = search.update(named).norm;
      // What is named no more may have been a vertex of the simplex, or not.
      CHECK(norm >= BruteForce(points).distance() - 1e-14 * largest_of(points));
      CHECK(norm <= BruteForce(named).distance() + 1e-14 * largest_of(points));
    }
    const double norm = search.update(points).norm;
    CHECK(search.around().has_value() == (norm == 0));
  }
}

TEST_CASE("one point is its own hull") {
  const Vector3 point(0.3, -0.7, 1e-5);
  CHECK(nearest_of({point}) == point);
  CHECK(nearest_of({Vector3::Zero()}) == Vector3::Zero());
}

TEST_CASE("where four points surround the origin the result is exactly zero") {
  PointDraw draw(72);
  for (int trial = 0; trial < 300; ++trial) {
    const Matrix3 turn = draw.rotation();
    const double size = std::pow(10, draw.uniform(-6, 6));
    Points points;
    for (const Vector3& corner : {Vector3(1, 1, 1), Vector3(1, -1, -1), Vector3(-1, 1, -1), Vector3(-1, -1, 1)}) {
      points.emplace_back(size * (turn * (corner + 0.2 * draw.vector().normalized())));
    }
    for (int more = 0; more < trial % 5; ++more) points.emplace_back(size * draw.vector());
    std::rotate(points.begin(), points.begin() + trial % static_cast<int>(points.size()), points.end());
    CHECK(nearest_of(points) == Vector3::Zero());
  }
}

TEST_CASE("the origin is one of the points, or on an edge or a face") {
  PointDraw draw(73);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3 a = draw.vector(), b = draw.vector();
    Points points = draw.points(some(trial), [&] { return draw.vector(); });
    points.emplace_back(Vector3::Zero());
    CHECK(nearest_of(points) == Vector3::Zero());
    points.back() = a;
    points.emplace_back(-draw.uniform(0.1, 3) * a);
    CHECK(nearest_of(points).norm() <= 1e-15 * largest_of(points));
    points.back() = b;
    points.emplace_back(-draw.uniform(0.1, 3) * a - draw.uniform(0.1, 3) * b);
    CHECK(nearest_of(points).norm() <= 1e-14 * largest_of(points));
  }
}

TEST_CASE("degenerate sets: repeated points, points on a line, on a plane through the origin, and within rounding of one another") {
  PointDraw draw(74);
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t count = some(trial);
    const Vector3 a = draw.vector(), b = draw.vector(), c = draw.vector();
    check(Points(count, a), 1e-15);
    Points twice = draw.points(count, [&] { return Vector3(a + draw.vector()); });
    twice.insert(twice.end(), twice.begin(), twice.end());
    check(twice, 1e-14);
    check(draw.points(count, [&] { return Vector3(a + draw.gauss() * b); }), 1e-14);
    check(draw.points(count, [&] { return Vector3(draw.gauss() * b); }), 1e-14);
    check(draw.points(count, [&] { return Vector3(a + draw.gauss() * b + draw.gauss() * c); }), 1e-13);
    check(draw.points(count, [&] { return Vector3(draw.gauss() * b + draw.gauss() * c); }), 1e-13);
    // As the cuts of an ascent are near its end.
    for (const double size : {1e-4, 1e-8, 1e-12, 1e-16}) {
      check(draw.points(count, [&] { return Vector3(a + size * draw.vector()); }), 1e-14);
    }
  }
}

TEST_CASE("needles and discs of aspect 1e5") {
  PointDraw draw(75);
  for (int trial = 0; trial < 500; ++trial) {
    for (const Vector3& lengths : {Vector3(1, 1e-5, 1e-5), Vector3(1, 1, 1e-5)}) {
      const Matrix3 turn = draw.rotation();
      const Vector3 centre = std::pow(10, draw.uniform(-7, 1)) * draw.vector();
      const auto point = [&] { return Vector3(centre + turn * lengths.cwiseProduct(draw.vector())); };
      check(draw.points(some(trial), point), 1e-14);
    }
  }
}

TEST_CASE("points on one side of a plane surround no origin, however nearly they are on one line") {
  PointDraw draw(78);
  for (int trial = 0; trial < 3000; ++trial) {
    const Matrix3 turn = draw.rotation();
    const double height = std::pow(10, draw.uniform(-14, -10)), width = std::pow(10, draw.uniform(-6, -2));
    const auto point = [&] { return Vector3(turn * Vector3(draw.gauss(), width * draw.gauss(), height * draw.uniform(1, 2))); };
    const Points points = draw.points(8, point);
    CHECK(minimum_norm_point(points).norm >= height - 8 * kRounding * largest_of(points));
  }
}

TEST_CASE("the unit of length, however small or large, changes nothing") {
  PointDraw draw(77);
  for (int trial = 0; trial < 100; ++trial) {
    const Vector3 centre = draw.vector();
    const Points points = draw.points(some(trial), [&] { return Vector3(centre + draw.vector()); });
    const Vector3 nearest = nearest_of(points);
    for (const double unit : {0x1p-60, 0x1p60}) {
      Points other = points;
      for (Vector3& point : other) point *= unit;
      CHECK(nearest_of(other) == unit * nearest);
    }
  }
}
