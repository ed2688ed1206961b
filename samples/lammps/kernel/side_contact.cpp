#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <unsupported/Eigen/AutoDiff>

#include "kernel/face_contact.hpp"
#include "kernel/fading.hpp"
#include "kernel/maximum_on_arc.hpp"

namespace granular {

namespace {

// The part of a normal across a side. Lines end in a pole of the body there, so they have no share, by which the derivative of
// their tilt would be divided: a body that stands upright on a brick has the force NaN with 0. The share falls with the fourth
// power of this part. Here it is below 1e-14 for profiles with exponents up to 3.9; 1e-10 with ten times, 1e-18 with a tenth.
constexpr double kPole = 1e-6;

/// A number with its derivatives by a displacement of body 1 and by a rotation about its centre.
using Wrench = Eigen::Matrix<double, 6, 1>;
using Varying = Eigen::AutoDiffScalar<Wrench>;

Varying varying(double value, const Vector3& by_way, const Vector3& by_turn) {
  Varying made(value);
  made.derivatives() << by_way, by_turn;
  return made;
}

Varying constant(double value) { return varying(value, Vector3::Zero(), Vector3::Zero()); }

Varying ramp(const Varying& x) {
  const Ramp ramp(x.value());
  return {ramp.value, ramp.slope * x.derivatives()};
}

double value_of(double x) { return x; }
double value_of(const Varying& x) { return x.value(); }

/// Adds an end of the common line. The force acts at `point` (m) along `normal`.
void add_end(const Varying& depth, const Vector3& point, const Vector3& normal, FaceContact& contact) {
  if (depth.value() <= 0) return;
  constexpr double kWeight = 0.5;
  const Vector3 by_way = depth.derivatives().head<3>();
  const Vector3 by_turn = depth.derivatives().tail<3>() - (point - contact.origin).cross(by_way);
  contact.corners.at(static_cast<std::size_t>(contact.count++)) = {point, normal, by_way - normal, depth.value(), kWeight};
  contact.mean_square += kWeight * depth.value() * depth.value();
  contact.mean += kWeight * depth.value();
  contact.turning += 2 * kWeight * depth.value() * by_turn;
  contact.turning_of_mean += kWeight * by_turn;
}

void set_share(const Varying& share, FaceContact& contact) {
  contact.share = share.value();
  contact.share_by_way = share.derivatives().head<3>();
  contact.share_by_turn = share.derivatives().tail<3>();
}

template <typename T>
using Place = Eigen::Matrix<T, 2, 1>;

const Place<double>& value_of(const Place<double>& place) { return place; }
Place<double> value_of(const Place<Varying>& place) { return {place.x().value(), place.y().value()}; }

template <typename T>
T cross(const Place<T>& a, const Place<T>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// How far a place is inside of an edge of a patch, times the length of the edge.
template <typename T>
T inside(const Patch& patch, std::size_t edge, const Place<T>& place) {
  const Vector2 &start = patch[edge], along = patch[(edge + 1) % patch.size()] - start;
  return along.x() * (place.y() - start.y()) - along.y() * (place.x() - start.x());
}

/// A part of the line between its ends, which are at 0 and 1.
struct Part {
  Varying from{0}, to{1};
};

/// The part of a line that is over a patch. Without length if there is none.
Part clip(const std::array<Place<Varying>, 2>& line, const Patch& patch) {
  Part part;
  for (std::size_t edge = 0; edge < patch.size(); ++edge) {
    const Varying start = inside(patch, edge, line[0]), end = inside(patch, edge, line[1]);
    if (start.value() < 0 && end.value() < 0) return {Varying(1), Varying(0)};
    if (start.value() >= 0 && end.value() >= 0) continue;
    const Varying crossing = start / (start - end);
    if (start.value() < 0 && crossing > part.from) part.from = crossing;
    if (end.value() < 0 && crossing < part.to) part.to = crossing;
  }
  return part;
}

/// The area that a quadrilateral and a patch have in common, by Sutherland and Hodgman's clipping.
template <typename T>
T common_area(const std::array<Place<T>, 4>& quadrilateral, const Patch& patch) {
  Eigen::AlignedBox2d box, of_patch;
  for (const Place<T>& place : quadrilateral) box.extend(value_of(place));
  for (const Vector2& vertex : patch) of_patch.extend(vertex);
  if (!box.intersects(of_patch)) return T(0);
  std::array<Place<T>, Face::kMostVertices + 4> kept, before;
  std::copy(quadrilateral.begin(), quadrilateral.end(), kept.begin());
  std::size_t count = quadrilateral.size();
  for (std::size_t edge = 0; edge < patch.size() && count > 0; ++edge) {
    std::copy_n(kept.begin(), count, before.begin());
    const std::size_t all = count;
    count = 0;
    for (std::size_t k = 0; k < all; ++k) {
      const Place<T>&here = before.at(k), &next = before.at((k + 1) % all);
      const T of_here = inside(patch, edge, here), of_next = inside(patch, edge, next);
      if (value_of(of_here) >= 0) kept.at(count++) = here;
      if ((value_of(of_here) >= 0) == (value_of(of_next) >= 0)) continue;
      const T crossing = of_here / (of_here - of_next);
      kept.at(count++) = {here.x() + crossing * (next.x() - here.x()), here.y() + crossing * (next.y() - here.y())};
    }
  }
  T twice(0);
  for (std::size_t k = 2; k < count; ++k) {
    twice += cross<T>(kept[k - 1] - kept[0], kept[k] - kept[0]);
  }
  return 0.5 * twice;
}

double length_of(const Place<double>& line) { return std::hypot(line.x(), line.y()); }
Varying length_of(const Place<Varying>& line) {
  const double x = line.x().value(), y = line.y().value(), length = std::hypot(x, y);
  return {length, x / length * line.x().derivatives() + y / length * line.y().derivatives()};
}

/// The area of the strip beside the line that is on the ground. Its `width` (m) is positive to the left of the line.
template <typename T>
T area_beside(const Place<T>& start, const Place<T>& end, double width, std::span<const Patch> patches) {
  const Place<T> line(end.x() - start.x(), end.y() - start.y());
  const T length = length_of(line);
  if (patches.empty()) return std::abs(width) * length;
  const T aside_x = -width * line.y() / length, aside_y = width * line.x() / length;
  const std::array<Place<T>, 4> strip{start, end, Place<T>(end.x() + aside_x, end.y() + aside_y),
                                      Place<T>(start.x() + aside_x, start.y() + aside_y)};
  T area(0);
  for (const Patch& patch : patches) area += common_area<T>(strip, patch);
  return width > 0 ? area : T(-area);
}

/// How much the line counts, by its length on the ground, away from the border.
Varying find_cover(const std::array<Place<Varying>, 2>& line, double width, std::span<const Patch> patches) {
  const double full = kFullOverlap * width, square = 0.5 * full * full;
  Varying cover = constant(1);
  for (const double beside : {0.5 * full, -0.5 * full}) {
    if (area_beside<double>(value_of(line[0]), value_of(line[1]), beside, patches) >= square) continue;
    cover = cover * ramp(area_beside<Varying>(line[0], line[1], beside, patches) / square);
  }
  return cover;
}

/// How much the line counts, by how far the patches are under all of it.
Varying find_whole_cover(const std::array<Place<Varying>, 2>& line, double width, std::span<const Patch> patches) {
  const std::array strips{0.5 * kFullOverlap * width, -0.5 * kFullOverlap * width};
  const Place<double> start = value_of(line[0]), end = value_of(line[1]);
  double bare = 0;
  for (const double beside : strips) {
    bare += area_beside<double>(start, end, beside, {}) - area_beside<double>(start, end, beside, patches);
  }
  if (bare <= 0) return constant(1);
  Varying covered = constant(0), all = constant(0);
  for (const double beside : strips) {
    covered += area_beside<Varying>(line[0], line[1], beside, patches);
    all += area_beside<Varying>(line[0], line[1], beside, {});
  }
  return ramp(constant(1) - (constant(1) - covered / all) / kFullOverlap);
}

const Side* find_side(const Body& body, const Vector3& own_normal) {
  const auto side = std::ranges::max_element(body.sides, {}, [&](const Side& one) { return one.part_across(own_normal); });
  return side == body.sides.end() || side->part_across(own_normal) < kPole ? nullptr : &*side;
}

/// How much a side counts on the ground, by its tilt, for its normal in its own frame.
Varying find_tilt_share(const Body& body, const Side& side, const Vector3& own, double largest) {
  const double across = side.part_across(own), along = own[side.along];
  const Ramp ramp(std::atan2(std::abs(along), across) / largest - 1);
  // d(angle) by the normal in the body's frame.
  Vector3 by_normal =
      side.across == side.along ? Vector3(own / across) : Vector3(Vector3::Unit(side.across) * (own[side.across] > 0 ? 1 : -1));
  by_normal *= -std::abs(along);
  by_normal[side.along] = along > 0 ? across : -across;
  by_normal /= across * across + along * along;
  const Matrix3& rotation = body.pose.rotation;
  return varying(1 - ramp.value, Vector3::Zero(), -ramp.slope / largest * (rotation * by_normal).cross(rotation * own));
}

/// The second derivative of an end's support function along a direction, m.
double bend_along(const Side::End& end, const Matrix3& rotation, const Vector3& along) {
  const double part = along.dot(rotation * end.by_roll);
  return end.bend * part * part;
}

/// Two sides that run around their bodies, and the sections across their mean axis.
class SidePair {
 public:
  SidePair(const Body& body1, const Side& side1, const Body& body2, const Side& side2, const Vector3& normal)
      : body1_(body1), body2_(body2), side1_(side1), side2_(side2), axis1_(body1.pose.rotation.col(side1.along)) {
    axis2_ = body2.pose.rotation.col(side2.along);
    const double cosine = axis1_.dot(axis2_);
    if (cosine < 0) axis2_ = -axis2_;
    sum_ = (axis1_ + axis2_).norm();
    mean_ = (axis1_ + axis2_) / sum_;
    guess_ = (normal - normal.dot(mean_) * mean_).normalized();
    apart_ = body1.pose.position - body2.pose.position;
    const double slant = 0.5 * sum_;  // the cosine of half the angle
    slant_ = varying(slant, Vector3::Zero(), axis1_.cross(axis2_) / (4 * slant));
    middle1_ = along_mean(apart_);
    middle1_.derivatives().head<3>() = mean_;
  }

  /// The ends of the common line, along the mean axis from the centre of body 2, m.
  struct Interval {
    Varying from, to;
  };
  Interval common() const {
    const Varying half1 = side1_.reach * slant_, half2 = side2_.reach * slant_;
    const Varying from1 = middle1_ - half1, from2 = -half2, to1 = middle1_ + half1;
    return {from1 > from2 ? from1 : from2, to1 < half2 ? to1 : half2};
  }

  /// The deepest points of two sections.
  struct Section {
    Varying depth;
    Vector3 point, normal;
  };
  Section section(const Varying& place) const {
    const Varying place1 = (place - middle1_) / slant_, place2 = place / slant_;
    const Vector3 centre1 = place1.value() * axis1_, centre2 = place2.value() * axis2_;
    const Vector3 across = mean_.cross(guess_);
    const auto at = [&](double angle) { return deepest(std::cos(angle) * guess_ + std::sin(angle) * across, centre1, centre2); };
    const double angle = find_maximum_uphill([&](double here) { return at(here).slope; });
    const Candidate found = at(angle);
    const Vector3& n = found.normal;
    // The normal is the best one across the mean axis. So the depth changes with the axis, but not with the normal.
    Section section{varying(found.depth, n, (centre1 + found.arm1).cross(n) - mean_.dot(found.distance) * axis1_.cross(n) / sum_),
                    body1_.pose.position + centre1 + found.arm1, n};
    section.depth.derivatives() += n.dot(axis1_) * place1.derivatives() - n.dot(axis2_) * place2.derivatives();
    return section;
  }

 private:
  /// m.(mean axis) times a length, for a fixed m; the axis rotates with body 1.
  Varying along_mean(const Vector3& m) const {
    return varying(m.dot(mean_), Vector3::Zero(), axis1_.cross(Vector3(m - m.dot(mean_) * mean_)) / sum_);
  }

  struct Candidate {
    Vector3 normal, arm1, distance;
    double depth;
    ArcSlope slope;  // of the gap
  };
  Candidate deepest(const Vector3& n, const Vector3& centre1, const Vector3& centre2) const {
    const Matrix3 &rotation1 = body1_.pose.rotation, &rotation2 = body2_.pose.rotation;
    const Side::End end1 = side1_.end(rotation1.transpose() * n, 0), end2 = side2_.end(-(rotation2.transpose() * n), 0);
    const Vector3 t = mean_.cross(n), arm1 = rotation1 * end1.point;
    const Vector3 distance = apart_ + centre1 + arm1 - centre2 - rotation2 * end2.point;
    const double depth = n.dot(distance);
    const double bend = bend_along(end1, rotation1, t) + bend_along(end2, rotation2, t);
    return {n, arm1, distance, depth, {-t.dot(distance), depth - bend}};
  }

  const Body &body1_, &body2_;
  const Side &side1_, &side2_;
  Vector3 axis1_, axis2_, mean_, guess_, apart_;
  double sum_;
  Varying slant_, middle1_;
};

/// How much the line counts: the ends must be deep, beside what the middle is deeper than both.
Varying find_straightness(const Varying& end1, const Varying& end2, const Varying& middle) {
  const Varying straight = constant(1);
  const Varying sag = middle - 0.5 * (end1 + end2);
  if (sag.value() <= 0) return straight;
  Varying all = sag;
  for (const Varying& end : {end1, end2}) {
    if (end.value() > 0) all = all + end;
  }
  return straight - ramp(sag / all);
}

/// The side that runs around a body.
const Side* find_round_side(const Body& body) {
  const auto side = std::ranges::find_if(body.sides, [](const Side& one) { return one.across == one.along; });
  return side == body.sides.end() ? nullptr : &*side;
}

/// The end of a side that sticks out of a pipe farthest, near a normal.
struct PipeEnd {
  Varying depth;
  Vector3 point, normal;
};
PipeEnd find_pipe_end(const Body& body, const Side& side, int sign, const Pipe& pipe, const Vector3& near) {
  const Matrix3& rotation = body.pose.rotation;
  const Vector3 beside = pipe.axis.cross(near), centre = body.pose.position - pipe.point;
  const auto normal_at = [&](double angle) -> Vector3 { return std::cos(angle) * near + std::sin(angle) * beside; };
  const auto slope = [&](double angle) -> ArcSlope {
    const Vector3 normal = normal_at(angle), along = pipe.axis.cross(normal);
    const Side::End end = side.end(rotation.transpose() * normal, sign);
    const Vector3 point = centre + rotation * end.point;
    return {along.dot(point), bend_along(end, rotation, along) - normal.dot(point)};
  };
  const double angle = find_maximum_uphill(slope);
  const Vector3 normal = normal_at(angle), arm = rotation * side.end(rotation.transpose() * normal, sign).point;
  return {varying(normal.dot(centre + arm) - pipe.radius, normal, arm.cross(normal)), body.pose.position + arm, normal};
}

}  // namespace

std::optional<FaceContact> find_side_contact(const Body& body, const Ground& ground) {
  const Vector3 normal = -ground.frame.col(2);
  const Vector3 own = body.pose.rotation.transpose() * normal;
  const Side* const side = find_side(body, own);
  if (side == nullptr) return std::nullopt;
  const Varying tilt_share = find_tilt_share(body, *side, own, std::min(side->tilt, ground.tilt));
  if (tilt_share.value() == 0) return std::nullopt;

  std::array<Vector3, 2> points;
  std::array<Varying, 2> depths;
  std::array<Place<Varying>, 2> line;
  for (std::size_t k = 0; k < 2; ++k) {
    const Side::End end = side->end(own, k == 0 ? -1 : 1);
    const Matrix3& rotation = body.pose.rotation;
    const Vector3 arm = rotation * end.point, place = rotation * end.place, turn = (rotation * end.by_roll).cross(normal);
    const Vector3 centre = body.pose.position - ground.origin;
    points.at(k) = body.pose.position + arm;
    depths.at(k) = varying(normal.dot(centre + arm), normal, arm.cross(normal));
    const auto part = [&](const Vector3& axis) {
      return varying(axis.dot(centre + place), axis, place.cross(axis) + axis.dot(rotation * end.roll) * turn);
    };
    line.at(k) = {part(ground.frame.col(0)), part(ground.frame.col(1))};
  }

  Part common;
  if (!ground.patches.empty() && !ground.is_surface) {
    common = clip(line, ground.patches.front());
    if (!(common.from < common.to)) return std::nullopt;
  }
  const double width = std::min(2 * side->reach, ground.width);
  Varying share = tilt_share * find_cover(line, width, ground.is_surface ? std::span<const Patch>() : ground.patches);
  if (ground.is_surface && share.value() > 0) share = share * find_whole_cover(line, width, ground.patches);
  if (share.value() == 0) return std::nullopt;

  FaceContact contact;
  contact.origin = body.pose.position;
  for (const Varying& place : {common.from, common.to}) {
    const Varying depth = depths[0] + place * (depths[1] - depths[0]);
    add_end(depth, points[0] + place.value() * (points[1] - points[0]), normal, contact);
  }
  set_share(share, contact);
  return contact;
}

std::optional<FaceContact> find_pipe_contact(const Body& body, const Pipe& pipe, std::span<const Vector3> normals,
                                             std::size_t which) {
  const Side* const side = find_round_side(body);
  if (side == nullptr) return std::nullopt;
  const Vector3 axis = body.pose.rotation.col(side->along);
  const Tilt tilt(axis, axis.dot(pipe.axis) > 0 ? Vector3(-pipe.axis) : pipe.axis, side->tilt);
  if (tilt.share == 0) return std::nullopt;
  FaceContact contact;
  contact.origin = body.pose.position;
  contact.share = tilt.share;
  contact.share_by_turn = tilt.by_turn;
  for (const int sign : {-1, 1}) {
    if (which >= normals.size()) break;
    const PipeEnd end = find_pipe_end(body, *side, sign, pipe, normals[which]);
    const auto nearest = std::ranges::max_element(normals, {}, [&](const Vector3& one) { return one.dot(end.normal); });
    if (nearest == normals.begin() + static_cast<std::ptrdiff_t>(which)) add_end(end.depth, end.point, end.normal, contact);
  }
  return contact;
}

std::optional<FaceContact> find_side_pair_contact(const Body& body1, const Body& body2, const Vector3& normal) {
  const Side *const side1 = find_round_side(body1), *const side2 = find_round_side(body2);
  if (side1 == nullptr || side2 == nullptr) return std::nullopt;
  const Vector3 axis1 = body1.pose.rotation.col(side1->along), axis2 = body2.pose.rotation.col(side2->along);
  const Tilt tilt(axis1, axis1.dot(axis2) > 0 ? Vector3(-axis2) : axis2, std::min(side1->tilt, side2->tilt));
  if (tilt.share == 0) return std::nullopt;

  const SidePair pair(body1, *side1, body2, *side2, normal);
  const auto [from, to] = pair.common();
  if (!(from < to)) return std::nullopt;
  const auto end1 = pair.section(from), end2 = pair.section(to), middle = pair.section(0.5 * (from + to));
  const Varying length = (to - from) / (kFullOverlap * 2 * std::min(side1->reach, side2->reach));
  const Varying share =
      varying(tilt.share, Vector3::Zero(), tilt.by_turn) * ramp(length) * find_straightness(end1.depth, end2.depth, middle.depth);
  if (share.value() == 0) return std::nullopt;

  FaceContact contact;
  contact.origin = body1.pose.position;
  for (const auto& end : {end1, end2}) add_end(end.depth, end.point, end.normal, contact);
  set_share(share, contact);
  return contact;
}

}  // namespace granular
