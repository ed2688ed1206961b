// Newton's method with the one-line bound (local/certified_newton.hpp has the theorem) for pairs in lanes.
//
// W pairs at a time, one a lane:
//   1. prepare(): the second body in the frame of the first, the tolerance, the first normal.
//   2. search(): propose, evaluate, and stop when the two sides of the inequality are within the tolerance. Where no step leads
//      higher on flat faces, a few tilted normals may still prove the best (tilts.hpp). A pair that has ended
//      keeps its normal, and so its numbers, until the slowest ends. To give its lane to another pair costs more than to wait: the
//      numbers of a pair, written one by one, are not yet there when all lanes are read at once.
//   3. finish(): the contact by its formula, and everything to the world's frame.
// A pair that the method cannot settle is Open, and the scalar search goes on (hybrid.cpp).
//
// Each operation acts on its lane alone, so the answer of a pair does not depend on the others, nor on the number of lanes.
#pragma once

#include "proximity/gap/limits.hpp"
#include "proximity/gap/tuning.hpp"
#include "proximity/lanes/pair_query.hpp"
#include "proximity/lanes/tilts.hpp"
#include "shapes/lanes/superellipsoid_jet.hpp"

namespace supernormal {
namespace {  // NOLINT(google-build-namespaces): real.hpp

constexpr double kLaneEpsilon = 0x1p-52;

/// The columns of a table of pairs. Of ellipsoids only those before kNorms1 are in use.
constexpr int kHalf1 = 0;
constexpr int kHalf2 = 3;
constexpr int kRotation = 6;  // of body 2 in body 1's frame, by columns
constexpr int kOffset = 15;
constexpr int kRho = 18;
constexpr int kUnit = kRho + 1;
constexpr int kTolerance = kUnit + 1;
constexpr int kRounding = kTolerance + 1;
constexpr int kFollowed = kRounding + 1;   // the depth up to which a maximum is followed
constexpr int kIsTracked = kFollowed + 1;  // 1 if a first normal was given
constexpr int kNormal = kIsTracked + 1;
constexpr int kNorms1 = kNormal + 3;  // inner p - 1, inner 1/p, outer p - 1, outer 1/p
constexpr int kNorms2 = kNorms1 + 4;
constexpr int kFlats1 = kNorms2 + 4;  // inner, outer
constexpr int kFlats2 = kFlats1 + 2;
constexpr int kGauges1 = kFlats2 + 2;  // delta - 1, 1/delta, epsilon - 1, 1/epsilon
constexpr int kGauges2 = kGauges1 + 4;
constexpr int kFields = kGauges2 + 4;

template <int W>
struct LaneSearch {
  using R = Real<W>;
  using V = Vec<R>;
  using S = Sym<R>;
  using M = Mask<W>;
  using P = typename SideBySide<W>::Type;  // of both bodies

  SUPERNORMAL_INLINE static P both(R x, R y) { return SideBySide<W>::of(x, y); }
  SUPERNORMAL_INLINE static Vec<P> both(V x, V y) { return {both(x.x, y.x), both(x.y, y.y), both(x.z, y.z)}; }

  /// A table: one row of numbers for each field, one column for each pair.
  template <int kRows>
  struct Table {
    alignas(8 * W) double rows[kRows][W];
    SUPERNORMAL_INLINE R at(int field) const { return load<W>(rows[field]); }
    SUPERNORMAL_INLINE V vec(int field) const { return {at(field), at(field + 1), at(field + 2)}; }
    SUPERNORMAL_INLINE S sym(int field) const {
      return {at(field), at(field + 1), at(field + 2), at(field + 3), at(field + 4), at(field + 5)};
    }
    SUPERNORMAL_INLINE void put(int field, R value) { store(rows[field], value); }
    SUPERNORMAL_INLINE void put(int field, V value) {
      put(field, value.x);
      put(field + 1, value.y);
      put(field + 2, value.z);
    }
    SUPERNORMAL_INLINE void put(int field, const S& value) {
      put(field, V{value.xx, value.yy, value.zz});
      put(field + 3, V{value.xy, value.xz, value.yz});
    }
    /// Puts the numbers of some lanes.
    SUPERNORMAL_INLINE void put_in(M lanes, int field, R value) {
      if constexpr (W == 1) {
        if (lanes.v) put(field, value);
      } else {
        put(field, select(lanes, value, at(field)));
      }
    }
    SUPERNORMAL_INLINE void put_in(M lanes, int field, V value) {
      put_in(lanes, field, value.x);
      put_in(lanes, field + 1, value.y);
      put_in(lanes, field + 2, value.z);
    }
    SUPERNORMAL_INLINE void put_in(M lanes, int field, const S& value) {
      put_in(lanes, field, V{value.xx, value.yy, value.zz});
      put_in(lanes, field + 3, V{value.xy, value.xz, value.yz});
    }
  };
  using Pairs = Table<kFields>;
  using Found = Table<kFoundFields>;
  using Tilts = LaneTilts<W>;

  /// H + s I + t n n^T as in RegularHessian, by cofactors. Where it is not regular, it is the identity.
  struct Regular {
    S inverse;
    M is_regular;
    SUPERNORMAL_INLINE Regular(const S& H, R s, V n, R unit_length, double flattest) {
      const R t = trace(H) + abs(s);
      is_regular = (t < unit_length * flattest) & (unit_length * limits::kNothing < t);
      const S identity = {R(1.0), R(1.0), R(1.0), R(0.0), R(0.0), R(0.0)};
      // In units of the trace, so that no product is out of range.
      const R scale = R(1.0) / select(is_regular, t, R(1.0));
      S A = select(is_regular, H * scale, identity);
      const R shift = select(is_regular, s * scale, R(0.0));
      A = {A.xx + (shift + n.x * n.x), A.yy + (shift + n.y * n.y), A.zz + (shift + n.z * n.z),
           A.xy + n.x * n.y,           A.xz + n.x * n.z,           A.yz + n.y * n.z};
      const S C = cofactors(A);
      const R determinant = A.xx * C.xx + (A.xy * C.xy + A.xz * C.xz);
      // The three pivots of the elimination: xx, C.zz / xx and determinant / C.zz.
      is_regular = is_regular & (R(limits::kSingularHessian) < A.xx) & (A.xx * limits::kSingularHessian < C.zz) &
                   (C.zz * limits::kSingularHessian < determinant);
      inverse = C * (scale / select(is_regular, determinant, R(1.0)));
    }
    SUPERNORMAL_INLINE V solve(V b) const { return inverse * b; }
  };

  // ------------------------------------------------------------------------------------------------------------------- prepare

  SUPERNORMAL_INLINE static void read_body(const LaneBody& body, bool of_ellipsoids, bool is_second, int lane, Pairs& pairs) {
    auto& rows = pairs.rows;
    for (int i = 0; i < 3; ++i) rows[(is_second ? kHalf2 : kHalf1) + i][lane] = body.half[i];
    if (of_ellipsoids) return;
    const int norms = is_second ? kNorms2 : kNorms1, flats = is_second ? kFlats2 : kFlats1,
              gauges = is_second ? kGauges2 : kGauges1;
    rows[norms][lane] = body.p_minus_1;
    rows[norms + 1][lane] = body.inverse_p;
    rows[norms + 2][lane] = body.q_minus_1;
    rows[norms + 3][lane] = body.inverse_q;
    rows[flats][lane] = body.flat_p;
    rows[flats + 1][lane] = body.flat_q;
    rows[gauges][lane] = body.delta_minus_1;
    rows[gauges + 1][lane] = body.inverse_delta;
    rows[gauges + 2][lane] = body.epsilon_minus_1;
    rows[gauges + 3][lane] = body.inverse_epsilon;
  }

  /// One number of each of W pairs, in lanes. The lanes beyond the last pair take its number.
  template <typename Number>
  SUPERNORMAL_INLINE static R gather(const LanePair* pairs, int count, const Number& number) {
    return lanes_from<W>([&](int lane) { return number(pairs[lane < count ? lane : count - 1]); });
  }
  template <typename Numbers>
  SUPERNORMAL_INLINE static V gather3(const LanePair* pairs, int count, const Numbers& numbers, int first = 0) {
    return {gather(pairs, count, [&](const LanePair& pair) { return numbers(pair)[first]; }),
            gather(pairs, count, [&](const LanePair& pair) { return numbers(pair)[first + 1]; }),
            gather(pairs, count, [&](const LanePair& pair) { return numbers(pair)[first + 2]; })};
  }

  /// The place of a body of each of W pairs.
  struct Place {
    Mat<R> rotation;
    V position;
    SUPERNORMAL_INLINE Place(const LanePair* pairs, int count, bool second) {
      const auto columns = [second](const LanePair& pair) { return second ? pair.rotation2 : pair.rotation1; };
      rotation = {gather3(pairs, count, columns), gather3(pairs, count, columns, 3), gather3(pairs, count, columns, 6)};
      position = gather3(pairs, count, [second](const LanePair& pair) { return second ? pair.position2 : pair.position1; });
    }
  };

  /// A number of a body of each of W pairs.
  SUPERNORMAL_INLINE static R of_body(const LanePair* pairs, int count, bool second, double LaneBody::*number) {
    return gather(pairs, count, [=](const LanePair& pair) { return (second ? pair.body2 : pair.body1)->*number; });
  }

  /// The axis along which a vector has its smallest component.
  SUPERNORMAL_INLINE static V smallest_axis(V v) {
    const M is_x = (v.x <= v.y) & (v.x <= v.z), is_y = ~is_x & (v.y <= v.z);
    const R x = select(is_x, R(1.0), R(0.0)), y = select(is_y, R(1.0), R(0.0));
    return {x, y, R(1.0) - x - y};
  }

  /// first_guess.cpp: the normal of the two bodies' ellipsoids, were they one ellipsoid and a point.
  SUPERNORMAL_INLINE static V guess(const Mat<R>& rotation, V half1, V half2, R size1, R size2, V direction) {
    const R scale = R(1.0) / (size1 + size2);
    const V squares1 = times(half1, half1 * (scale / size1)), squares2 = times(half2, half2 * (scale / size2));
    S A = rotated_diagonal(rotation, squares2);
    A = {A.xx + squares1.x, A.yy + squares1.y, A.zz + squares1.z, A.xy, A.xz, A.yz};
    const S C = cofactors(A);
    const R determinant = A.xx * C.xx + (A.xy * C.xy + A.xz * C.xz);
    return select(R(limits::kSingularGuess) < determinant, C * direction, direction);
  }

  SUPERNORMAL_INLINE static void prepare(const LanePair* pairs, int count, bool of_ellipsoids, const LaneSettings& settings,
                                         Pairs& out) {
    for (int lane = 0; lane < W; ++lane) {
      const LanePair& pair = pairs[lane < count ? lane : count - 1];
      read_body(*pair.body1, of_ellipsoids, false, lane, out);
      read_body(*pair.body2, of_ellipsoids, true, lane, out);
    }
    const Place place1(pairs, count, false), place2(pairs, count, true);
    const auto number = [&](bool second, double LaneBody::*which) { return of_body(pairs, count, second, which); };
    const Mat<R>& from1 = place1.rotation;
    const Mat<R> rotation = {transposed_times(from1, place2.rotation.x), transposed_times(from1, place2.rotation.y),
                             transposed_times(from1, place2.rotation.z)};
    const V offset = transposed_times(from1, place2.position - place1.position);
    const R distance = length(offset);
    const V half1 = out.vec(kHalf1), half2 = out.vec(kHalf2);
    const R unit_length = min(smallest(half1), smallest(half2));
    const R rounding = (distance + number(false, &LaneBody::bounding_radius) + number(true, &LaneBody::bounding_radius)) *
                       R(limits::kRoundingUnits * kLaneEpsilon);
    const R tolerance = max(unit_length * settings.tolerance - rounding, rounding * limits::kFloor);
    const R is_tracked = gather(pairs, count, [](const LanePair& pair) { return pair.first_normal != nullptr ? 1.0 : 0.0; });
    const M is_given = R(0.5) < is_tracked;
    static constexpr double kNone[3] = {1, 0, 0};
    V normal = gather3(pairs, count, [](const LanePair& pair) { return pair.first_normal != nullptr ? pair.first_normal : kNone; });
    if (any(~is_given)) {
      const R size1 = number(false, &LaneBody::size), size2 = number(true, &LaneBody::size);
      const M is_concentric = distance <= (size1 + size2) * limits::kConcentric;
      const V direction =
          select(is_concentric, V{R(1.0), R(0.0), R(0.0)}, offset * (R(1.0) / select(is_concentric, R(1.0), distance)));
      V guessed = guess(rotation, half1, half2, size1, size2, direction);
      if (any(is_concentric)) {
        const V axis = select(smallest(half1) <= smallest(half2), smallest_axis(half1), rotation * smallest_axis(half2));
        guessed = select(is_concentric, axis, guessed);
      }
      normal = select(is_given, normal, guessed);
    }
    normal = unit(normal);
    out.put(kRotation, rotation.x);
    out.put(kRotation + 3, rotation.y);
    out.put(kRotation + 6, rotation.z);
    out.put(kOffset, offset);
    out.put(kRho, number(false, &LaneBody::rolling_radius) + number(true, &LaneBody::rolling_radius));
    out.put(kUnit, unit_length);
    out.put(kTolerance, tolerance);
    out.put(kRounding, rounding);
    const R radii = number(false, &LaneBody::curvature_radius) + number(true, &LaneBody::curvature_radius);
    out.put(kFollowed, max(unit_length * settings.followed_depth, radii * settings.followed_per_radius));
    out.put(kIsTracked, is_tracked);
    out.put(kNormal, normal);
  }

  // -------------------------------------------------------------------------------------------------------------------- search

  /// The evaluation of W pairs.
  struct Evaluation {
    R s, h1;
    V d, r1;
  };

  /// The pairs with another step than Newton's, and those that have none at all.
  struct Improvement {
    M is_improved, is_lost;
  };

  /// (A A - r r^T) / h of an ellipsoid, as below.
  SUPERNORMAL_INLINE static S ellipsoid_hessian(V half, V n, R inverse_h) {
    const V w = times(half, n) * inverse_h, a = times(half, w), squares = times(half, half) * inverse_h, w2 = times(w, w);
    // 1 - w_x^2 = w_y^2 + w_z^2 keeps the digits of a needle's small radii (ellipsoid.cpp).
    return {squares.x * (w2.y + w2.z), squares.y * (w2.z + w2.x), squares.z * (w2.x + w2.y),
            -(a.x * a.y * inverse_h),  -(a.x * a.z * inverse_h),  -(a.y * a.z * inverse_h)};
  }

  /// Of two ellipsoids: h = |A n| with A = diag(half), r = A A n / h, and H = (A A - r r^T) / h.
  struct Ellipsoids {
    static constexpr bool kOfEllipsoids = true;
    Mat<R> rotation;
    V half1, half2;
    V r2;  // minus the boundary point of body 2, in body 1's frame
    V r1;
    R inverse1, inverse2;
    SUPERNORMAL_INLINE Ellipsoids(const Pairs& state, const Mat<R>& of_2) : rotation(of_2) {
      half1 = state.vec(kHalf1);
      half2 = state.vec(kHalf2);
    }
    SUPERNORMAL_INLINE Evaluation evaluate(V n, V m, V offset) {
      const V w1 = times(half1, n), w2 = times(half2, m);
      const R h1 = length(w1), h2 = length(w2);
      inverse1 = R(1.0) / h1;
      inverse2 = R(1.0) / h2;
      r1 = times(half1, w1) * inverse1;
      r2 = -(rotation * (times(half2, w2) * inverse2));
      return {dot(n, offset) - h1 - h2, h1, offset - r2 - r1, r1};
    }
    SUPERNORMAL_INLINE void hessians(V n, S& H1, S& H) const {
      H1 = ellipsoid_hessian(half1, n, inverse1);
      const S B = rotated_diagonal(rotation, times(half2, half2) * inverse2);
      const V b = r2 * inverse2;
      H = {H1.xx + (B.xx - r2.x * b.x), H1.yy + (B.yy - r2.y * b.y), H1.zz + (B.zz - r2.z * b.z),
           H1.xy + (B.xy - r2.x * b.y), H1.xz + (B.xz - r2.x * b.z), H1.yz + (B.yz - r2.y * b.z)};
    }
    SUPERNORMAL_INLINE void put_body2(M, Found&) const {}  // evaluated anew where it is needed
    /// A step in the normal is the best for round bodies.
    SUPERNORMAL_INLINE Improvement improve(V, V, const Evaluation&, const Regular&, M, V&) const {
      return {R(1.0) < R(0.0), R(1.0) < R(0.0)};
    }
    SUPERNORMAL_INLINE M has_flat_faces() const { return R(1.0) < R(0.0); }
  };

  /// Of two superellipsoids, evaluated side by side.
  struct Superellipsoids {
    static constexpr bool kOfEllipsoids = false;
    const Pairs& state;
    Mat<R> rotation;
    PowerBody<P> bodies;
    PointJet<P> jets;
    S H1, H2, rotated2;
    SUPERNORMAL_INLINE Superellipsoids(const Pairs& pairs, const Mat<R>& of_2) : state(pairs), rotation(of_2) {
      bodies = {both(state.vec(kHalf1), state.vec(kHalf2)),
                {both_at(kNorms1, kNorms2), both_at(kNorms1 + 1, kNorms2 + 1)},
                {both_at(kNorms1 + 2, kNorms2 + 2), both_at(kNorms1 + 3, kNorms2 + 3)}};
    }
    SUPERNORMAL_INLINE Evaluation evaluate(V n, V m, V offset) {
      jets = point_jet(bodies, both(n, m));
      const V r1 = first(jets.r), r2 = rotation * second(jets.r);
      return {dot(n, offset) - first(jets.h) - second(jets.h), first(jets.h), r2 + (offset - r1), r1};
    }
    SUPERNORMAL_INLINE void hessians(V, S& of_1, S& of_both) {
      const Sym<P> H = hessian(bodies, jets, both_at(kFlats1, kFlats2), both_at(kFlats1 + 1, kFlats2 + 1));
      H1 = first(H);
      H2 = second(H);
      rotated2 = rotated(rotation, H2);
      of_1 = H1;
      of_both = H1 + rotated2;
    }
    SUPERNORMAL_INLINE void put_body2(M lanes, Found& found) const {
      found.put_in(lanes, kFoundH2, second(jets.h));
      found.put_in(lanes, kFoundR2, second(jets.r));
      found.put_in(lanes, kFoundHessian2, H2);
    }
    SUPERNORMAL_INLINE P both_at(int field1, int field2) const { return both(state.at(field1), state.at(field2)); }
    SUPERNORMAL_INLINE M has_flat_faces() const {
      const auto of = [this](int gauges) { return (R(1.0) < state.at(gauges)) | (R(1.0) < state.at(gauges + 2)); };
      return of(kGauges1) | of(kGauges2);
    }

    /// Bodies of which both norms are flat: delta and epsilon above 2.
    SUPERNORMAL_INLINE M is_flat(int gauges) const { return (R(1.0) < state.at(gauges)) & (R(1.0) < state.at(gauges + 2)); }

    /// The bodies at boundary points where they meet to first order.
    struct Meeting {
      Vec<P> normal;              // of each body in its own frame; its component along the evaluated normal is 1
      Sym<P> curvature;           // 1/m: by how much this normal changes with the point
      typename P::Mask is_ahead;  // whether there is such a normal
    };

    SUPERNORMAL_INLINE Meeting meet(const Vec<P>& normal, const Vec<P>& point) const {
      const Vec<P> inverse = {P(1.0) / bodies.half.x, P(1.0) / bodies.half.y, P(1.0) / bodies.half.z};
      const NormExponents<P> inner = {both_at(kGauges1, kGauges2), both_at(kGauges1 + 1, kGauges2 + 1)};
      const LevelJet<P> level = level_jet(inverse, inner, both_at(kGauges1 + 2, kGauges2 + 2), point);
      const P height = dot(level.gradient, normal);
      Meeting out;
      out.is_ahead = length(level.gradient) * limits::kGrazing < height;
      const P scale = P(1.0) / select(out.is_ahead, height, P(1.0));
      const Vec<P>& v = out.normal = level.gradient * scale;
      // A point that moves by y along the plane across n moves by y - n (v . y) on the boundary. The same projection of the change
      // of the gradient keeps n . v = 1.
      const Vec<P> b = level.second * normal;
      const P nb = dot(normal, b);
      const Sym<P>& A = level.second;
      out.curvature = Sym<P>{A.xx + v.x * (nb * v.x - b.x - b.x),
                             A.yy + v.y * (nb * v.y - b.y - b.y),
                             A.zz + v.z * (nb * v.z - b.z - b.z),
                             A.xy + (nb * v.x * v.y - v.x * b.y - b.x * v.y),
                             A.xz + (nb * v.x * v.z - v.x * b.z - b.x * v.z),
                             A.yz + (nb * v.y * v.z - v.y * b.z - b.y * v.z)} *
                      scale;
      return out;
    }

    /// Replaces Newton's step in the normal by one through the boundary points, for the wanted pairs. Lost are those of which the
    /// normal of a flat body would rotate too far.
    ///
    /// The step leads both bodies to a common point. There their normals v1 and v2 differ. Two bodies with curvatures K1 and K2
    /// have a common normal y further on, with v1 + K1 y = v2 - K2 y: Newton's method for the point. So each evaluation serves one
    /// step in the normal and one in the point, and bricks on one another take half of the evaluations. On faces so flat that there
    /// is no step in the normal, the bodies meet halfway. Where the curvatures are singular, Newton's equation for the normal is
    /// solved with the tilts of the normals beyond the step, as CertifiedNewton::through_boundary_points does.
    SUPERNORMAL_INLINE Improvement improve(V n, V m, const Evaluation& now, const Regular& regular, M wanted, V& step) const {
      const auto is_less = [](V tilt, V normal) {
        return (abs(tilt.x) <= abs(normal.x) * kTuning.same_tilt) & (abs(tilt.y) <= abs(normal.y) * kTuning.same_tilt) &
               (abs(tilt.z) <= abs(normal.z) * kTuning.same_tilt);
      };
      const V step_in_2 = -transposed_times(rotation, step);
      const M open = wanted & ~(regular.is_regular & is_less(step, n) & is_less(step_in_2, m));
      if (!any(open)) return {open, open};
      const V none = {R(0.0), R(0.0), R(0.0)};
      const M has_step = open & regular.is_regular;
      const V normal_step = select(has_step, step, none), across = now.d - n * now.s;
      // Of two flat bodies each moves half of the way, beside a flat body the other hardly moves.
      const R flattest = state.at(kUnit) * R(limits::kFlatContact);
      const R flatness1 = min(trace(H1), flattest), flatness2 = min(trace(rotated2), flattest), flatness = flatness1 + flatness2;
      const V share1 = across * (flatness1 / select(R(0.0) < flatness, flatness, R(1.0)));
      const V move1 = select(has_step, H1 * normal_step, share1);
      const V move2 = transposed_times(rotation, select(has_step, -(rotated2 * normal_step), share1 - across));
      const Meeting meeting = meet(both(n, m), jets.r + both(move1, move2));
      const V v1 = first(meeting.normal), v2 = -(rotation * second(meeting.normal));
      const M is_ahead1 = first(meeting.is_ahead), is_ahead2 = second(meeting.is_ahead);

      const S K1 = first(meeting.curvature), K2 = second(meeting.curvature);
      const Regular curvatures(K1 + rotated(rotation, K2), R(0.0), n, R(1.0) / state.at(kUnit), limits::kLargestCurvature);
      const M meets = is_ahead1 & is_ahead2 & curvatures.is_regular;
      const V further = curvatures.solve(select(meets, v2 - v1, none));
      // Rounding of large curvatures must not leave the plane across n.
      const V turned = K1 * further;
      const V to_meeting = v1 - n + part_across(turned, n);

      const V tilt1 = select(is_flat(kGauges1) & is_ahead1, v1 - n - step, none);
      const V tilt2 = select(is_flat(kGauges2) & is_ahead2, v2 - n - step, none);
      const V tilted = step + regular.solve(H1 * select(has_step, tilt1, none) + rotated2 * select(has_step, tilt2, none));

      const V through = select(meets, to_meeting, tilted);
      const R twice_gain = dot(now.d, through);
      const M meets_halfway = meets & (state.at(kTolerance) * limits::kLeastGain < twice_gain);
      const M is_improved = open & (R(0.0) < twice_gain) & (has_step | meets_halfway);
      step = select(is_improved, through, step);
      return {is_improved, open & ~has_step & ((is_flat(kGauges1) & ~is_ahead1) | (is_flat(kGauges2) & ~is_ahead2))};
    }
  };

  /// Where the search of every lane is.
  struct Lanes {
    int round;  // the evaluation, from 0
    M is_active;
    M was_halfway;  // the last step was without a step in the normal
    R best_at;      // the evaluation of the best normal
    V step;
    Tilts tilts;
    Table<3> cuts[kMostLaneRounds];
  };

  /// The pairs that end with an evaluation.
  struct Ended {
    M apart, proved, followed, open;
    SUPERNORMAL_INLINE M all() const { return (apart | proved) | (followed | open); }
  };

  /// The share of a step from the best normal up to where a cut is lower than `cut`, that of the best. Nothing higher is beyond. On
  /// faces this is the normal of an edge or a face, which a shorter step would pass again; of a parabola it is the top.
  SUPERNORMAL_INLINE static R share_below_cuts(V best, V cut, V step, const Lanes& lanes) {
    R share(1.0);
    for (int k = 0; k <= lanes.round; ++k) {
      const V bend = cut - lanes.cuts[k].vec(0);
      const R above = -dot(best, bend), along = dot(step, bend) * share;
      const M meets = (R(0.0) < above) & (above < along);
      if (any(meets)) share = share * select(meets, above / select(meets, along, R(1.0)), R(1.0));
    }
    return share;
  }

  /// One evaluation of every lane, and the next normal of those that go on. `found` keeps the evaluation of the best normal.
  template <typename Bodies>
  SUPERNORMAL_INLINE static Ended advance(const LaneSettings& settings, Pairs& pairs, Found& found, Lanes& lanes) {
    const Mat<R> rotation = {pairs.vec(kRotation), pairs.vec(kRotation + 3), pairs.vec(kRotation + 6)};
    const V n = pairs.vec(kNormal), m = -transposed_times(rotation, n);
    Bodies bodies(pairs, rotation);
    const Evaluation now = bodies.evaluate(n, m, pairs.vec(kOffset));
    const R best_s = found.at(kFoundS), tolerance = pairs.at(kTolerance), rho = pairs.at(kRho);
    const V cut = now.d + n * rho;
    lanes.cuts[lanes.round].put(0, cut);

    const M none = R(1.0) < R(0.0);
    const M climbs = lanes.is_active & ~lanes.tilts.is_on, is_better = ~lanes.tilts.is_on & (best_s < now.s);
    found.put_in(is_better, kFoundS, now.s);
    found.put_in(is_better, kFoundNormal, n);
    found.put_in(is_better, kFoundD, now.d);
    found.put_in(is_better, kFoundR, now.r1);
    found.put_in(is_better, kFoundH, now.h1);
    // The theorem: if s + rho > 0, then s <= max s <= |d + rho n| - rho.
    const R height = now.s + rho;
    const M is_provable = R(0.0) < height;
    const R error = max(length(cut) - height, R(0.0));
    found.put_in(is_better, kFoundError, error);
    lanes.best_at = select(is_better, R(static_cast<double>(lanes.round)), lanes.best_at);

    Ended ended = {none, none, none, none};
    if (settings.stop_when_apart) ended.apart = climbs & is_better & (R(0.0) < now.s);
    ended.proved = climbs & is_better & is_provable & (error <= tolerance) & ~ended.apart;
    // Deeper than rho there may be several maxima, and Newton's steps may lead away from the one that is tracked.
    // A shallow one is followed to its top.
    const M is_deep = (R(0.5) < pairs.at(kIsTracked)) & ~is_provable;
    const M may_follow = is_deep & (-now.s <= pairs.at(kFollowed));
    if (lanes.round == 0) ended.open = climbs & is_deep & ~may_follow & ~(ended.apart | ended.proved);
    M goes_on = climbs & ~ended.all(), is_stuck = none;
    if (any(goes_on | ended.proved | ended.open)) {
      S H1, H;  // for the step, the contact, and the search that goes on elsewhere
      bodies.hessians(n, H1, H);
      found.put_in(is_better, kFoundHessian1, H1);
      found.put_in(is_better, kFoundHessian, H);
      bodies.put_body2(is_better, found);
      if (any(goes_on)) {
        const Regular regular(H, now.s, n, pairs.at(kUnit), limits::kFlattest);
        V step = regular.solve(now.d - n * now.s);
        // The model's gain is half of this product.
        const R twice_gain = dot(now.d, step);
        ended.followed =
            goes_on & is_better & may_follow & regular.is_regular & (twice_gain * R(0.5 * kTuning.gain_safety) <= tolerance);
        goes_on = goes_on & ~ended.followed;
        const Improvement improvement = bodies.improve(n, m, now, regular, goes_on & is_better, step);
        const M has_step = regular.is_regular | improvement.is_improved;
        const M gains = tolerance < dot(now.d, step);
        // A face is level: no shorter step leads higher.
        const M is_level = bodies.has_flat_faces() & (best_s - pairs.at(kRounding) <= now.s);
        // Nor does half of a step to a meeting that was not there.
        is_stuck = improvement.is_lost | (is_better & (~has_step | ~(is_provable | may_follow | gains))) |
                   (~is_better & (is_level | lanes.was_halfway));
        if (lanes.round + 1 >= settings.most_evaluations) is_stuck = R(0.0) < R(1.0);
        is_stuck = is_stuck & goes_on;
        goes_on = goes_on & ~is_stuck;

        lanes.was_halfway = is_better & ~regular.is_regular;
        step = select(goes_on & is_better, step, lanes.step);
        const R squared = dot(step, step);
        const M is_long = R(kTuning.longest_step * kTuning.longest_step) < squared;
        step = step * select(is_long, R(kTuning.longest_step) / sqrt(select(is_long, squared, R(1.0))), R(1.0));
        const V best = found.vec(kFoundNormal);
        R share(1.0);
        if constexpr (!Bodies::kOfEllipsoids) share = share_below_cuts(best, found.vec(kFoundD) + best * rho, step, lanes);
        lanes.step = step * select(is_better | (share < R(1.0)), share, R(0.5));
        pairs.put(kNormal, select(goes_on, unit(best + lanes.step), n));
      }
    }
    if constexpr (Bodies::kOfEllipsoids) {
      ended.open = ended.open | is_stuck;
    } else {
      tilt(settings, now, cut, is_stuck, is_better, bodies.has_flat_faces(), pairs, found, lanes, ended);
    }
    return ended;
  }

  /// Tilts the normals of pairs that are stuck on flat faces, and of those that were tilted already.
  SUPERNORMAL_INLINE static void tilt(const LaneSettings& settings, const Evaluation& now, V cut, M is_stuck, M is_better,
                                      M has_flat_faces, Pairs& pairs, Found& found, Lanes& lanes, Ended& ended) {
    const R rho = pairs.at(kRho), height = found.at(kFoundS) + rho, tolerance = pairs.at(kTolerance);
    const M starts = is_stuck & has_flat_faces & (R(0.0) < height);
    ended.open = ended.open | (is_stuck & ~starts);
    const M is_tilted = lanes.is_active & (lanes.tilts.is_on | starts);
    if (!any(is_tilted)) return;
    const V best = found.vec(kFoundNormal), best_d = found.vec(kFoundD);
    const typename Tilts::Point of_best = {best_d + best * rho, found.vec(kFoundR) + best_d * R(0.5)};
    const M is_best = starts & is_better;
    const typename Tilts::Point here = {select(is_best, of_best.cut, cut),
                                        select(is_best, of_best.middle, now.r1 + now.d * R(0.5))};
    lanes.tilts.start(starts, of_best);
    const typename Tilts::Nearest nearest = lanes.tilts.add(here, best);
    const R error = max(length(nearest.point.cut) - height, R(0.0));
    const M is_proved = is_tilted & (error <= tolerance);
    found.put_in(is_proved, kFoundError, error);
    found.put_in(is_proved, kFoundMiddle, nearest.point.middle);
    found.put_in(is_proved, kFoundSpread, nearest.distance);
    ended.proved = ended.proved | is_proved;
    M goes_on = is_tilted & ~is_proved & (lanes.tilts.count < R(limits::kMostTilts - 0.5)) & (R(0.0) < nearest.distance);
    if (lanes.round + 1 >= settings.most_rounds) goes_on = R(1.0) < R(0.0);
    ended.open = ended.open | (is_tilted & ~is_proved & ~goes_on);
    const V turned = best + lanes.tilts.next(nearest, now.d, best_d, found.sym(kFoundHessian), tolerance, pairs.at(kUnit), goes_on);
    pairs.put_in(goes_on, kNormal, unit(turned));
  }

  /// Finds the ends of all pairs. `found` keeps the evaluations of their best normals.
  template <typename Bodies>
  SUPERNORMAL_INLINE static void search(Pairs& pairs, int count, const LaneSettings& settings, Found& found, LaneAnswer* answers) {
    const M none = R(1.0) < R(0.0);
    Lanes lanes;
    lanes.round = 0;
    lanes.is_active = lanes_from<W>([](int lane) { return static_cast<double>(lane); }) < R(static_cast<double>(count));
    lanes.was_halfway = none;
    lanes.best_at = R(0.0);
    const V zero = {R(0.0), R(0.0), R(0.0)};
    lanes.step = zero;
    lanes.tilts = Tilts::none();
    found.put(kFoundS, R(-1e300));
    found.put(kFoundMiddle, zero);
    found.put(kFoundSpread, R(-1.0));
    Ended all = {none, none, none, none};
    R evaluations = R(0.0);
    while (any(lanes.is_active)) {
      const Ended ended = advance<Bodies>(settings, pairs, found, lanes);
      ++lanes.round;
      evaluations = select(lanes.is_active, R(static_cast<double>(lanes.round)), evaluations);
      all = {all.apart | ended.apart, all.proved | ended.proved, all.followed | ended.followed, all.open | ended.open};
      lanes.is_active = lanes.is_active & ~ended.all();
    }

    alignas(8 * W) double evaluations_of[W], best_of[W];
    store(evaluations_of, evaluations);
    store(best_of, lanes.best_at);
    const unsigned apart = lanes_of(all.apart), followed = lanes_of(all.followed), open = lanes_of(all.open);
    for (int lane = 0; lane < count; ++lane) {
      const auto is_in = [lane](unsigned mask) { return (mask >> lane & 1) != 0; };
      LaneAnswer& answer = answers[lane];
      answer.outcome = is_in(open) ? LaneOutcome::Open : is_in(apart) ? LaneOutcome::Apart : LaneOutcome::Proved;
      answer.is_followed = is_in(followed);
      answer.evaluations = static_cast<int>(evaluations_of[lane]);
      // A followed pair becomes Open in finish() if its contact is not proved.
      if (!is_in(open | followed)) continue;
      const int best = static_cast<int>(best_of[lane]), others = answer.evaluations - 1;
      for (int k = 0; k < others; ++k) {
        for (int i = 0; i < 3; ++i) answer.cuts[k][i] = lanes.cuts[k < best ? k : k + 1].rows[i][lane];
      }
    }
  }

  // -------------------------------------------------------------------------------------------------------------------- finish

  /// Whether the bodies contain a point of body 1's frame, by their equations (Shape::surely_contains).
  SUPERNORMAL_INLINE static M both_contain(const Pairs& pairs, bool of_ellipsoids, V point, V from2) {
    const V half1 = pairs.vec(kHalf1), half2 = pairs.vec(kHalf2);
    const V x1 = {point.x / half1.x, point.y / half1.y, point.z / half1.z},
            x2 = {from2.x / half2.x, from2.y / half2.y, from2.z / half2.z};
    if (of_ellipsoids) return (dot(x1, x1) <= R(1.0)) & (dot(x2, x2) <= R(1.0));
    const auto of_both = [&](int field) { return both(pairs.at(kGauges1 + field), pairs.at(kGauges2 + field)); };
    const NormExponents<P> inner = {of_both(0), of_both(1)}, outer = {of_both(2), of_both(3)};
    const Vec<P> x = both(x1, x2);
    const P gauge = norm_value(norm_value(abs(x.x), abs(x.y), inner), abs(x.z), outer);
    return (first(gauge) <= R(1.0)) & (second(gauge) <= R(1.0));
  }

  /// m; sizes of the bodies of W pairs.
  struct Radii {
    R size1, size2, curvature1, curvature2, rolling1, rolling2;
    SUPERNORMAL_INLINE Radii(const LanePair* pairs, int count)
        : size1(of_body(pairs, count, false, &LaneBody::size)),
          size2(of_body(pairs, count, true, &LaneBody::size)),
          curvature1(of_body(pairs, count, false, &LaneBody::curvature_radius)),
          curvature2(of_body(pairs, count, true, &LaneBody::curvature_radius)),
          rolling1(of_body(pairs, count, false, &LaneBody::rolling_radius)),
          rolling2(of_body(pairs, count, true, &LaneBody::rolling_radius)) {}
  };

  /// The contact (contact_point.cpp), and where its formula serves.
  SUPERNORMAL_INLINE static M place_contact(const Pairs& pairs, const Found& found, bool of_ellipsoids, const Radii& radii,
                                            M wanted, M is_followed, V& contact) {
    const V n = found.vec(kFoundNormal), d = found.vec(kFoundD), r1 = found.vec(kFoundR);
    const R s = found.at(kFoundS), unit_length = pairs.at(kUnit);
    const Regular sum(found.sym(kFoundHessian), R(0.0), n, unit_length, limits::kFlatContact);
    const V across = d - n * s;
    // Where the sum is not regular, the radii may be of any size, and a product with them out of range.
    const V along = select(sum.is_regular, across, V{R(0.0), R(0.0), R(0.0)});
    const V from_point1 = found.sym(kFoundHessian1) * sum.solve(along);
    const V shift = part_across(from_point1, n) - across * R(0.5);
    const R half_distance = length(across) * R(0.5), distance = length(shift);
    const R limit = half_distance + min(radii.size1, radii.size2) * R(2.0);
    const M is_far = limit < distance;
    contact = r1 + d * R(0.5) + shift * select(is_far, limit / select(is_far, distance, R(1.0)), R(1.0));

    const R near = max(unit_length * R(limits::kNear), pairs.at(kTolerance));
    const auto is_near_both = [&](V point) {
      const V from1 = point - r1, from2 = from1 - d;
      const auto is_near = [&](V from, R radius) {
        const V tangential = part_across(from, n);
        const R squared = dot(tangential, tangential);
        return (squared <= near * near) | (squared <= near * radius * R(2.0));
      };
      return is_near(from1, radii.curvature1) & is_near(from2, radii.curvature2);
    };
    M is_good = is_near_both(contact);
    const R sum_of_radii = radii.curvature1 + radii.curvature2;
    const M has_radii = R(0.0) < sum_of_radii;
    const R share = select(has_radii, radii.curvature1 / select(has_radii, sum_of_radii, R(1.0)), R(0.5));
    const V of_balls = r1 + n * (s * R(0.5)) + across * share;
    contact = select(is_good, contact, of_balls);
    is_good = sum.is_regular & (is_good | is_near_both(of_balls));
    // The middle of tilted normals is a point that two faces have in common.
    const R spread = found.at(kFoundSpread);
    const M is_of_faces = ~is_good & (R(0.0) <= spread) & (spread <= near);
    contact = select(is_of_faces, found.vec(kFoundMiddle), contact);
    is_good = is_good | is_of_faces;
    contact = contact + n * (found.at(kFoundH) + s * R(0.5) - dot(n, contact));

    const V to_centre1 = contact - (r1 - n * radii.rolling1), to_centre2 = contact - (r1 + d + n * radii.rolling2);
    const M is_in_balls = (length(to_centre1) <= radii.rolling1 + near) & (length(to_centre2) <= radii.rolling2 + near);
    // That a point is in both bodies also proves that they overlap where a maximum is followed.
    const M is_open = wanted & is_good & (s <= R(0.0)) & (is_followed | is_of_faces | ~is_in_balls);
    if (any(is_open)) {
      const Mat<R> rotation = {pairs.vec(kRotation), pairs.vec(kRotation + 3), pairs.vec(kRotation + 6)};
      const V from2 = transposed_times(rotation, contact - pairs.vec(kOffset));
      is_good = is_good & (~is_open | both_contain(pairs, of_ellipsoids, contact, from2));
    }
    return is_good;
  }

  /// The curvature tensor of a body in a basis of the plane perpendicular to the normal.
  struct Curvature {
    V t1, t2;
    R xx, xy, yy;  // 1/m
    M is_known;
  };

  /// find_curvature() (contact_curvature.cpp) of radii that are neither sharp nor flat, by the cofactors of H.
  SUPERNORMAL_INLINE static Curvature curvature_of(const S& hessian, V n, R size) {
    const R total = trace(hessian);
    Curvature out;
    out.is_known = (total < size * limits::kFlat) & (size * limits::kSharpest < total);
    const S H = select(out.is_known, hessian, S{R(1.0), R(1.0), R(1.0), R(0.0), R(0.0), R(0.0)});
    // Along the flattest axis, as there. It is far from the normal, since H n = 0.
    const V axis = smallest_axis(-V{H.xx, H.yy, H.zz});
    const V along = part_across(axis, n);
    const R squared = dot(along, along);
    const M is_plane = R(limits::kGrazing) < squared;
    out.is_known = out.is_known & is_plane;
    out.t1 = along * (R(1.0) / sqrt(select(is_plane, squared, R(1.0))));
    out.t2 = cross(n, out.t1);
    const V H1 = H * out.t1, H2 = H * out.t2;
    const R xx = dot(out.t1, H1), xy = dot(out.t2, H1), yy = dot(out.t2, H2);
    const Principal radii(xx, xy, yy);
    out.is_known = out.is_known & (size * limits::kSharpest < radii.low);
    const R inverse = R(1.0) / select(out.is_known, radii.high * radii.low, R(1.0));
    out.xx = yy * inverse;
    out.xy = -(xy * inverse);
    out.yy = xx * inverse;
    return out;
  }

  /// The eigenvalues of a symmetric 2 x 2 matrix with a positive trace (Eigen2 in tangent_plane.hpp).
  struct Principal {
    R low, high;
    SUPERNORMAL_INLINE Principal(R xx, R xy, R yy) {
      const R half_difference = (xx - yy) * R(0.5);
      high = (xx + yy) * R(0.5) + sqrt(half_difference * half_difference + xy * xy);
      const M is_positive = R(0.0) < high;
      const R inverse = R(1.0) / select(is_positive, high, R(1.0));
      low = xx * (yy * inverse) - xy * (xy * inverse);
    }
  };

  /// The curvatures of the bodies together at their contacts.
  SUPERNORMAL_INLINE static void find_curvatures(const Pairs& pairs, const Found& found, bool of_ellipsoids, M wanted, R& smaller,
                                                 R& larger) {
    const Mat<R> rotation = {pairs.vec(kRotation), pairs.vec(kRotation + 3), pairs.vec(kRotation + 6)};
    const V half1 = pairs.vec(kHalf1), half2 = pairs.vec(kHalf2);
    const V n = found.vec(kFoundNormal), m = -transposed_times(rotation, n);
    const S H2 = of_ellipsoids ? ellipsoid_hessian(half2, m, R(1.0) / length(times(half2, m))) : found.sym(kFoundHessian2);
    const Curvature K1 = curvature_of(found.sym(kFoundHessian1), n, smallest(half1));
    const Curvature K2 = curvature_of(H2, m, smallest(half2));
    // The first axis of the second basis in the first; the second axis is (s, -c), because m = -n.
    const V t = rotation * K2.t1;
    const R c = dot(K1.t1, t), s = dot(K1.t2, t);
    const R mixed = c * s * K2.xy * R(2.0);
    const Principal sum(K1.xx + (c * c * K2.xx + s * s * K2.yy + mixed),
                        K1.xy + (c * s * (K2.xx - K2.yy) + (s * s - c * c) * K2.xy),
                        K1.yy + (s * s * K2.xx + c * c * K2.yy - mixed));
    const M is_known = wanted & K1.is_known & K2.is_known;
    smaller = select(is_known, max(sum.low, R(0.0)), R(kUnknownCurvature));
    larger = select(is_known, sum.high, R(kUnknownCurvature));
  }

  SUPERNORMAL_INLINE static void finish(const LanePair* inputs, const Pairs& pairs, const Found& found, int count,
                                        bool of_ellipsoids, bool wants_curvature, LaneAnswer* answers) {
    const Place place1(inputs, count, false);
    const auto find = [&](auto&& has) {
      return R(0.5) < lanes_from<W>([&](int lane) { return lane < count && has(answers[lane]) ? 1.0 : 0.0; });
    };
    const M is_proved = find([](const LaneAnswer& answer) { return answer.outcome == LaneOutcome::Proved; });
    const M is_followed = find([](const LaneAnswer& answer) { return answer.is_followed; });
    const V n = found.vec(kFoundNormal), d = found.vec(kFoundD), r1 = found.vec(kFoundR);
    V contact = r1 + d * R(0.5);
    M is_complete = is_proved;
    if (any(is_proved)) {
      V placed;
      is_complete = is_proved & place_contact(pairs, found, of_ellipsoids, Radii(inputs, count), is_proved, is_followed, placed);
      contact = select(is_complete, placed, contact);
    }
    const auto to_world = [&place1](V point) { return place1.rotation * point + place1.position; };
    const V normal = unit(place1.rotation * n), point1 = to_world(r1), point2 = to_world(r1 + d), point = to_world(contact);
    R smaller = kUnknownCurvature, larger = kUnknownCurvature;
    if (wants_curvature) {
      const M wanted = is_complete & (found.at(kFoundS) < R(0.0));
      if (any(wanted)) find_curvatures(pairs, found, of_ellipsoids, wanted, smaller, larger);
    }
    alignas(8 * W) double out[21][W];
    const auto put = [&out](int i, V v) {
      store(out[i], v.x);
      store(out[i + 1], v.y);
      store(out[i + 2], v.z);
    };
    store(out[0], found.at(kFoundS));
    store(out[1], found.at(kFoundError));
    store(out[2], pairs.at(kRounding));
    store(out[3], pairs.at(kTolerance));
    put(4, normal);
    put(7, point1);
    put(10, point2);
    put(13, point);
    put(16, n);
    store(out[19], smaller);
    store(out[20], larger);
    const unsigned complete = lanes_of(is_complete);
    for (int lane = 0; lane < count; ++lane) {
      LaneAnswer& answer = answers[lane];
      if (answer.outcome == LaneOutcome::Proved && (complete >> lane & 1) == 0) {
        answer.outcome = answer.is_followed ? LaneOutcome::Open : LaneOutcome::ProvedButContact;
      }
      answer.gap = out[0][lane];
      answer.error = out[1][lane];
      answer.rounding = out[2][lane];
      answer.tolerance = out[3][lane];
      const bool is_whole = answer.outcome == LaneOutcome::Proved || answer.outcome == LaneOutcome::Apart;
      if (!is_whole && !of_ellipsoids) {
        for (int field = 0; field < kJetFields; ++field) answer.jet[field] = found.rows[field][lane];
      }
      for (int i = 0; i < 3; ++i) {
        answer.normal[i] = out[(is_whole ? 4 : 16) + i][lane];
        answer.point1[i] = out[7 + i][lane];
        answer.point2[i] = out[10 + i][lane];
        answer.contact[i] = out[13 + i][lane];
      }
      for (int i = 0; i < 2; ++i) answer.curvature[i] = out[19 + i][lane];
    }
  }

  static void query(const LanePair* pairs, int count, bool of_ellipsoids, const LaneSettings& settings, LaneAnswer* answers) {
    Pairs prepared;
    Found found;
    for (int first = 0; first < count; first += W) {
      const int here = count - first < W ? count - first : W;
      prepare(pairs + first, here, of_ellipsoids, settings, prepared);
      if (of_ellipsoids) {
        search<Ellipsoids>(prepared, here, settings, found, answers + first);
      } else {
        search<Superellipsoids>(prepared, here, settings, found, answers + first);
      }
      finish(pairs + first, prepared, found, here, of_ellipsoids, settings.wants_curvature, answers + first);
    }
  }
};

}  // namespace
}  // namespace supernormal
