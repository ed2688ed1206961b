#include "collider_reference.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <vector>

namespace supernormal::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kCorners = 3;
constexpr std::size_t kMaxCuts = 6;  // per triangle: at its corners and at the latest maxima of its linear programs

using Index = std::size_t;

/// A unit normal that has been evaluated.
struct Node {
  Vector3 n;
  Vector3 d;  // m; point2 - point1: s(n) = n.d, and s(m) <= m.d for every other m
};

/// A triangle of directions with its cuts and bounds.
struct Cell {
  std::array<Index, kCorners> corner;
  std::array<Index, kMaxCuts> cut;  // the corners come first
  std::size_t cut_count;
  double bound;  // m; s is not larger in this triangle
  Vector3 peak;  // where the bound is attained, not normalised
  bool operator<(const Cell& other) const { return bound < other.bound; }
};

/// Computes max over w >= 0, sum(w) = 1 of min over k of cuts[k].w, by trying every point where as many cuts and sides meet as a
/// maximum needs.
class SmallLinearProgram {
 public:
  explicit SmallLinearProgram(const std::vector<Vector3>& cuts) : cuts_(cuts) {
    for (int v = 0; v < 3; ++v) offer(Vector3::Unit(v));
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      for (std::size_t j = i + 1; j < cuts.size(); ++j) {
        const Vector3 difference = cuts[i] - cuts[j];
        offer_sides(difference);
        for (std::size_t k = j + 1; k < cuts.size(); ++k) offer_interior(difference.cross(cuts[i] - cuts[k]));
      }
    }
  }

  double value() const { return value_; }
  const Vector3& weights() const { return weights_; }

 private:
  /// Offers the points where two cuts meet on the sides.
  void offer_sides(const Vector3& difference) {
    for (int v = 0; v < 3; ++v) {
      const int next = (v + 1) % 3;
      const double here = difference[v], there = difference[next];
      if (!(here * there < 0)) continue;
      Vector3 w = Vector3::Zero();
      w[next] = here / (here - there);
      w[v] = 1 - w[next];
      offer(w);
    }
  }

  /// Offers the point where three cuts meet: both differences vanish along their cross product.
  void offer_interior(const Vector3& common) {
    const double sum = common.sum();
    if (sum != 0 && (common / sum).minCoeff() > 0) offer(common / sum);
  }

  void offer(const Vector3& w) {
    double least = kInfinity;
    for (const Vector3& cut : cuts_) {
      least = std::min(least, cut.dot(w));
      if (least <= value_) return;
    }
    value_ = least;
    weights_ = w;
  }

  const std::vector<Vector3>& cuts_;
  double value_ = -kInfinity;
  Vector3 weights_ = Vector3::Zero();
};

class BranchAndBound {
 public:
  BranchAndBound(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2)
      : shape1_(shape1),
        shape2_(shape2),
        offset_(pose1.rotation.transpose() * (pose2.position - pose1.position)),
        rotation_(pose1.rotation.transpose() * pose2.rotation) {}

  GapBounds enclose(double width, int max_evaluations) {
    start_from_octahedron();
    while (best_.evaluations < max_evaluations && cells_.top().bound - best_.lower > width) {
      Cell cell = cells_.top();
      cells_.pop();
      const double slack = cell.bound - best_.lower;
      add_cut(cell, evaluate(cell.peak));
      update_bound(cell);
      // A cut with little effect shows that the triangle is too large for bounds that are linear.
      if (cell.bound - best_.lower > 0.25 * slack) {
        split(cell);
      } else {
        cells_.push(cell);
      }
    }
    best_.upper = std::max(cells_.top().bound, best_.lower);
    return best_;
  }

 private:
  // The octahedron is along body 1's axes, so that its coordinate planes, on which the support functions of boxy bodies bend
  // sharply, stay sides of triangles.
  void start_from_octahedron() {
    const auto axis = [&](int k, double sign) { return evaluate(sign * Vector3::Unit(k)); };
    const std::array<std::array<Index, 2>, 3> ends{
        {{axis(0, 1), axis(0, -1)}, {axis(1, 1), axis(1, -1)}, {axis(2, 1), axis(2, -1)}}};
    for (const Index x : ends[0]) {
      for (const Index y : ends[1]) {
        for (const Index z : ends[2]) push(make_cell({x, y, z}));
      }
    }
  }

  Index evaluate(const Vector3& direction) {
    Node node;
    node.n = direction.normalized();
    node.d = offset_ + rotation_ * shape2_.point(-(rotation_.transpose() * node.n)) - shape1_.point(node.n);
    ++best_.evaluations;
    const double s = node.n.dot(node.d);
    if (nodes_.empty() || s > best_.lower) {
      best_.lower = s;
      best_.normal = node.n;
    }
    nodes_.push_back(node);
    return nodes_.size() - 1;
  }

  static Cell make_cell(const std::array<Index, kCorners>& corner) {
    Cell cell{corner, {}, kCorners, kInfinity, Vector3::Zero()};
    std::copy(corner.begin(), corner.end(), cell.cut.begin());
    return cell;
  }

  /// The cut replaces the oldest one if all places are taken.
  static void add_cut(Cell& cell, Index node) {
    if (cell.cut_count == kMaxCuts) {
      std::copy(cell.cut.begin() + kCorners + 1, cell.cut.end(), cell.cut.begin() + kCorners);
      --cell.cut_count;
    }
    cell.cut[cell.cut_count++] = node;
  }

  /// The bounds are linear over the flat triangle, which lies between its distance from the origin and 1.
  void update_bound(Cell& cell) {
    const Vector3& a = nodes_[cell.corner[0]].n;
    const Vector3& b = nodes_[cell.corner[1]].n;
    const Vector3& c = nodes_[cell.corner[2]].n;
    cuts_.clear();
    for (std::size_t k = 0; k < cell.cut_count; ++k) {
      const Vector3& d = nodes_[cell.cut[k]].d;
      cuts_.emplace_back(d.dot(a), d.dot(b), d.dot(c));
    }
    const SmallLinearProgram program(cuts_);
    double bound = program.value();
    if (bound > 0) bound /= std::abs((b - a).cross(c - a).normalized().dot(a));
    cell.bound = std::min(cell.bound, bound);
    cell.peak = program.weights()[0] * a + program.weights()[1] * b + program.weights()[2] * c;
  }

  void push(Cell cell) {
    update_bound(cell);
    cells_.push(cell);
  }

  /// Halves the longest side, so that the angles stay away from zero.
  void split(const Cell& cell) {
    std::size_t longest = 0;
    double length = -1;
    for (std::size_t v = 0; v < kCorners; ++v) {
      const double side = (nodes_[cell.corner[(v + 1) % 3]].n - nodes_[cell.corner[v]].n).squaredNorm();
      if (side > length) {
        length = side;
        longest = v;
      }
    }
    const std::size_t next = (longest + 1) % kCorners;
    const Index middle = evaluate(nodes_[cell.corner[longest]].n + nodes_[cell.corner[next]].n);
    for (const std::size_t replaced : {longest, next}) {
      std::array<Index, kCorners> corner = cell.corner;
      corner[replaced] = middle;
      Cell half = make_cell(corner);
      half.bound = cell.bound;
      for (std::size_t k = kCorners; k < cell.cut_count; ++k) add_cut(half, cell.cut[k]);
      push(half);
    }
  }

  const Shape& shape1_;
  const Shape& shape2_;
  Vector3 offset_;
  Matrix3 rotation_;
  std::vector<Node> nodes_;
  std::vector<Vector3> cuts_;
  std::priority_queue<Cell> cells_;
  GapBounds best_;
};

}  // namespace

GapBounds bound_gap(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2, double width,
                    int max_evaluations) {
  return BranchAndBound(shape1, pose1, shape2, pose2).enclose(width, max_evaluations);
}

}  // namespace supernormal::test
