// The proof of faces by tilted normals, in lanes (CertifiedNewton::prove_by_tilts).
#pragma once

#include "proximity/gap/tuning.hpp"
#include "shapes/lanes/vectors.hpp"

namespace supernormal {
namespace {  // NOLINT(google-build-namespaces): real.hpp

/// On a flat face the boundary point crosses the face within a tilt below rounding. So d(n) does not come near the line along n.
/// But a tilt that does not change s by the tolerance brings it to the other side of this line. Each point of the hull of such d +
/// rho n bounds the gap. Here the hull is a triangle: the point of the last tilt, and the two before it that are nearest to the
/// line. Across n this is GJK in the plane, which needs no more (Gilbert, Johnson, Keerthi 1988).
template <int W>
struct LaneTilts {
  using R = Real<W>;
  using V = Vec<R>;
  using M = Mask<W>;

  /// Of one normal, in body 1's frame, m.
  struct Point {
    V cut;     // d + rho n
    V middle;  // of the two boundary points
  };

  /// The point of a hull that is nearest to the line along the best normal.
  struct Nearest {
    Point point;
    V across;    // m; its part across the normal
    R distance;  // m; the length of this part
  };

  M is_on;  // the pairs whose normal is tilted, to their end
  R count;  // the tilts of a pair
  Point first, second;
  V direction;  // of the last tilt, unit
  R before;     // m; how far the point of the best normal is in this direction
  R growth;     // the last tilt in units of the least that moves the distance by the tolerance

  SUPERNORMAL_INLINE static LaneTilts none() {
    const V zero = {R(0.0), R(0.0), R(0.0)};
    return {R(1.0) < R(0.0), R(0.0), {zero, zero}, {zero, zero}, zero, R(0.0), R(0.0)};
  }

  SUPERNORMAL_INLINE void start(M lanes, const Point& best) {
    is_on = is_on | lanes;
    count = select(lanes, R(0.0), count);
    first = select_point(lanes, best, first);
    second = select_point(lanes, best, second);
  }

  /// Adds a point, and keeps the two of the three that are nearest to the line along n.
  SUPERNORMAL_INLINE Nearest add(const Point& point, V n) {
    const V p = part_across(point.cut, n), a = part_across(first.cut, n), b = part_across(second.cut, n);
    const Segment pa(p, a), pb(p, b), ab(a, b);
    // Where the line meets the triangle: the shares of the areas.
    const R of_p = dot(n, cross(a, b)), of_a = dot(n, cross(b, p)), of_b = dot(n, cross(p, a));
    const R area = of_p + (of_a + of_b);
    const R zero(0.0);
    const M is_inside = ((zero < of_p) & (zero < of_a) & (zero < of_b)) | ((of_p < zero) & (of_a < zero) & (of_b < zero));
    const R share = R(1.0) / select(is_inside, area, R(1.0));
    const M is_pa = (pa.squared <= pb.squared) & (pa.squared <= ab.squared), is_pb = ~is_pa & (pb.squared <= ab.squared);
    R p_share = select(is_pa, R(1.0) - pa.t, select(is_pb, R(1.0) - pb.t, zero));
    R a_share = select(is_pa, pa.t, select(is_pb, zero, R(1.0) - ab.t));
    p_share = select(is_inside, of_p * share, p_share);
    a_share = select(is_inside, of_a * share, a_share);
    const R b_share = select(is_inside, of_b * share, select(is_pa, zero, select(is_pb, pb.t, ab.t)));

    Nearest nearest;
    nearest.point.cut = point.cut * p_share + (first.cut * a_share + second.cut * b_share);
    nearest.point.middle = point.middle * p_share + (first.middle * a_share + second.middle * b_share);
    nearest.across = p * p_share + (a * a_share + b * b_share);
    nearest.distance = length(nearest.across);
    const M drops_first = is_on & (a_share <= b_share) & (a_share <= p_share);
    const M drops_second = is_on & ~drops_first & (b_share <= p_share);
    first = select_point(drops_first, point, first);
    second = select_point(drops_second, point, second);
    return nearest;
  }

  /// The next tilt: a vector across n to be added to it. `here` is the d of the last tilt and `best` that of the best normal, m;
  /// `hessian` is H1 + H2 there.
  SUPERNORMAL_INLINE V next(const Nearest& nearest, V here, V best, const Sym<R>& hessian, R tolerance, R unit_length, M goes_on) {
    const R apart = select(goes_on, nearest.distance, R(1.0));
    // If the radius was too large, the point has only moved a part of the way.
    const R reached = dot(here, direction), left = before - reached;
    const M is_short = (R(0.5) < count) & (R(0.0) < reached) & (R(0.0) < left);
    const R wanted = select(is_short, growth * (R(2.0) * (before / select(is_short, left, R(1.0)))), R(1.0));
    direction = nearest.across * (R(1.0) / apart);
    before = dot(best, direction);
    // The point of the best normal is as far on the other side at this tilt, by its radius of curvature. On a flat face no digit of
    // the radius need be right, and the least tilt crosses it.
    const R radius = dot(direction, hessian * direction), least = tolerance / max(apart, unit_length), most = tolerance / apart;
    const M crosses = (R(0.0) < before) & (R(0.0) < radius), is_below = crosses & (before * R(2.0) < most * radius);
    const R crossing = select(is_below, before * R(2.0) / select(is_below, radius, R(1.0)), select(crosses, most, R(0.0)));
    const R tilt = min(max(wanted * least, crossing), most);
    growth = tilt / least;
    count = count + R(1.0);
    return direction * tilt;
  }

 private:
  /// The point of a segment that is nearest to the origin: its share of the way, and its squared distance.
  struct Segment {
    R t, squared;
    SUPERNORMAL_INLINE Segment(V from, V to) {
      const V along = to - from;
      const R length2 = dot(along, along);
      const M has_length = R(0.0) < length2;
      t = min(max(select(has_length, -dot(from, along) / select(has_length, length2, R(1.0)), R(0.0)), R(0.0)), R(1.0));
      const V nearest = from + along * t;
      squared = dot(nearest, nearest);
    }
  };

  SUPERNORMAL_INLINE static Point select_point(M lanes, const Point& x, const Point& y) {
    return {select(lanes, x.cut, y.cut), select(lanes, x.middle, y.middle)};
  }
};

}  // namespace
}  // namespace supernormal
