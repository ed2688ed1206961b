// Newton's method with the one-line bound (local/certified_newton.hpp has the theorem) for pairs in lanes.
//
// Three passes over at most kChunk pairs at a time:
//   1. prepare(): the second body in the frame of the first, the tolerance, the first normal.
//   2. search(): propose, evaluate, and stop when the two sides of the inequality are within the tolerance. A lane whose pair has
//      ended takes the next pair, so that no lane waits for the slowest.
//   3. finish(): the contact by its formula, and everything to the world's frame.
// A pair that the method cannot settle is Open, and the scalar search goes on (hybrid.cpp).
//
// Each operation acts on its lane alone, so the answer of a pair does not depend on the others, nor on the number of lanes.
#pragma once

#include "proximity/lanes/pair_query.hpp"
#include "proximity/limits.hpp"
#include "proximity/tuning.hpp"
#include "shapes/lanes/superellipsoid_jet.hpp"

namespace supernormal {
namespace {  // NOLINT(google-build-namespaces): real.hpp

constexpr double kLaneEpsilon = 0x1p-52;

/// The columns of a table of pairs. Of ellipsoids only the first kEllipsoidFields are in use.
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
constexpr int kEllipsoidFields = kNormal + 3;
constexpr int kNorms1 = kEllipsoidFields;  // inner p - 1, inner 1/p, outer p - 1, outer 1/p
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

  static constexpr int kChunk = W == 1 ? 1 : 4 * W;

  /// A table: one row of numbers for each field.
  template <int kRows, int kColumns>
  struct Table {
    alignas(8 * W) double rows[kRows][kColumns];
    SUPERNORMAL_INLINE R at(int field, int column = 0) const { return load<W>(&rows[field][column]); }
    SUPERNORMAL_INLINE V vec(int field, int column = 0) const {
      return {at(field, column), at(field + 1, column), at(field + 2, column)};
    }
    SUPERNORMAL_INLINE S sym(int field, int column = 0) const {
      return {at(field, column),     at(field + 1, column), at(field + 2, column),
              at(field + 3, column), at(field + 4, column), at(field + 5, column)};
    }
    SUPERNORMAL_INLINE void put(int field, R value, int column = 0) { store(&rows[field][column], value); }
    SUPERNORMAL_INLINE void put(int field, V value, int column = 0) {
      put(field, value.x, column);
      put(field + 1, value.y, column);
      put(field + 2, value.z, column);
    }
    SUPERNORMAL_INLINE void put(int field, const S& value, int column = 0) {
      put(field, V{value.xx, value.yy, value.zz}, column);
      put(field + 3, V{value.xy, value.xz, value.yz}, column);
    }
  };
  using Pairs = Table<kFields, kChunk>;
  using Ends = Table<kFoundFields, kChunk>;

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

  SUPERNORMAL_INLINE static void read_body(const LaneBody& body, bool of_ellipsoids, bool is_second, int column, Pairs& pairs) {
    auto& rows = pairs.rows;
    for (int i = 0; i < 3; ++i) rows[(is_second ? kHalf2 : kHalf1) + i][column] = body.half[i];
    if (of_ellipsoids) return;
    const int norms = is_second ? kNorms2 : kNorms1, flats = is_second ? kFlats2 : kFlats1,
              gauges = is_second ? kGauges2 : kGauges1;
    rows[norms][column] = body.p_minus_1;
    rows[norms + 1][column] = body.inverse_p;
    rows[norms + 2][column] = body.q_minus_1;
    rows[norms + 3][column] = body.inverse_q;
    rows[flats][column] = body.flat_p;
    rows[flats + 1][column] = body.flat_q;
    rows[gauges][column] = body.delta_minus_1;
    rows[gauges + 1][column] = body.inverse_delta;
    rows[gauges + 2][column] = body.epsilon_minus_1;
    rows[gauges + 3][column] = body.inverse_epsilon;
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
                                         int column, Pairs& out) {
    for (int lane = 0; lane < W; ++lane) {
      const LanePair& pair = pairs[lane < count ? lane : count - 1];
      read_body(*pair.body1, of_ellipsoids, false, column + lane, out);
      read_body(*pair.body2, of_ellipsoids, true, column + lane, out);
    }
    const Place place1(pairs, count, false), place2(pairs, count, true);
    const auto number = [&](bool second, double LaneBody::*which) { return of_body(pairs, count, second, which); };
    const Mat<R>& from1 = place1.rotation;
    const Mat<R> rotation = {transposed_times(from1, place2.rotation.x), transposed_times(from1, place2.rotation.y),
                             transposed_times(from1, place2.rotation.z)};
    const V offset = transposed_times(from1, place2.position - place1.position);
    const R distance = length(offset);
    const V half1 = out.vec(kHalf1, column), half2 = out.vec(kHalf2, column);
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
    out.put(kRotation, rotation.x, column);
    out.put(kRotation + 3, rotation.y, column);
    out.put(kRotation + 6, rotation.z, column);
    out.put(kOffset, offset, column);
    out.put(kRho, number(false, &LaneBody::rolling_radius) + number(true, &LaneBody::rolling_radius), column);
    out.put(kUnit, unit_length, column);
    out.put(kTolerance, tolerance, column);
    out.put(kRounding, rounding, column);
    const R radii = number(false, &LaneBody::curvature_radius) + number(true, &LaneBody::curvature_radius);
    out.put(kFollowed, max(unit_length * settings.followed_depth, radii * settings.followed_per_radius), column);
    out.put(kIsTracked, is_tracked, column);
    out.put(kNormal, normal, column);
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
    SUPERNORMAL_INLINE Ellipsoids(const Table<kFields, W>& state, const Mat<R>& of_2) : rotation(of_2) {
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
    SUPERNORMAL_INLINE void put_body2(Table<kFoundFields, W>&) const {}  // evaluated anew where it is needed
    /// A step in the normal is the best for round bodies.
    SUPERNORMAL_INLINE Improvement improve(V, V, const Evaluation&, const Regular&, M, V&) const {
      return {R(1.0) < R(0.0), R(1.0) < R(0.0)};
    }
    SUPERNORMAL_INLINE M has_flat_faces() const { return R(1.0) < R(0.0); }
  };

  /// Of two superellipsoids, evaluated side by side.
  struct Superellipsoids {
    static constexpr bool kOfEllipsoids = false;
    using P = Two<R>;
    const Table<kFields, W>& state;
    Mat<R> rotation;
    PowerBody<P> bodies;
    PointJet<P> jets;
    S H1, H2, rotated2;
    SUPERNORMAL_INLINE Superellipsoids(const Table<kFields, W>& pairs, const Mat<R>& of_2) : state(pairs), rotation(of_2) {
      bodies = {{both(kHalf1, kHalf2), both(kHalf1 + 1, kHalf2 + 1), both(kHalf1 + 2, kHalf2 + 2)},
                {both(kNorms1, kNorms2), both(kNorms1 + 1, kNorms2 + 1)},
                {both(kNorms1 + 2, kNorms2 + 2), both(kNorms1 + 3, kNorms2 + 3)}};
    }
    SUPERNORMAL_INLINE Evaluation evaluate(V n, V m, V offset) {
      jets = point_jet(bodies, Vec<P>{{n.x, m.x}, {n.y, m.y}, {n.z, m.z}});
      const V r1 = {jets.r.x.a, jets.r.y.a, jets.r.z.a};
      const V r2 = rotation * V{jets.r.x.b, jets.r.y.b, jets.r.z.b};
      return {dot(n, offset) - jets.h.a - jets.h.b, jets.h.a, r2 + (offset - r1), r1};
    }
    SUPERNORMAL_INLINE void hessians(V, S& of_1, S& of_both) {
      const Sym<P> H =
          hessian(bodies, jets, P(state.at(kFlats1), state.at(kFlats2)), P(state.at(kFlats1 + 1), state.at(kFlats2 + 1)));
      H1 = {H.xx.a, H.yy.a, H.zz.a, H.xy.a, H.xz.a, H.yz.a};
      H2 = {H.xx.b, H.yy.b, H.zz.b, H.xy.b, H.xz.b, H.yz.b};
      rotated2 = rotated(rotation, H2);
      of_1 = H1;
      of_both = H1 + rotated2;
    }
    SUPERNORMAL_INLINE void put_body2(Table<kFoundFields, W>& found) const {
      found.put(kFoundH2, jets.h.b);
      found.put(kFoundR2, V{jets.r.x.b, jets.r.y.b, jets.r.z.b});
      found.put(kFoundHessian2, H2);
    }
    SUPERNORMAL_INLINE P both(int field1, int field2) const { return P(state.at(field1), state.at(field2)); }
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
      const NormExponents<P> inner = {both(kGauges1, kGauges2), both(kGauges1 + 1, kGauges2 + 1)};
      const LevelJet<P> level = level_jet(inverse, inner, both(kGauges1 + 2, kGauges2 + 2), point);
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
      const Vec<P> normals = {{n.x, m.x}, {n.y, m.y}, {n.z, m.z}},
                   moves = {{move1.x, move2.x}, {move1.y, move2.y}, {move1.z, move2.z}};
      const Meeting meeting = meet(normals, jets.r + moves);
      const V v1 = {meeting.normal.x.a, meeting.normal.y.a, meeting.normal.z.a};
      const V v2 = -(rotation * V{meeting.normal.x.b, meeting.normal.y.b, meeting.normal.z.b});
      const M is_ahead1 = meeting.is_ahead.a, is_ahead2 = meeting.is_ahead.b;

      const auto& K = meeting.curvature;
      const S K1 = {K.xx.a, K.yy.a, K.zz.a, K.xy.a, K.xz.a, K.yz.a}, K2 = {K.xx.b, K.yy.b, K.zz.b, K.xy.b, K.xz.b, K.yz.b};
      const Regular curvatures(K1 + rotated(rotation, K2), R(0.0), n, R(1.0) / state.at(kUnit), limits::kLargestCurvature);
      const M meets = is_ahead1 & is_ahead2 & curvatures.is_regular;
      const V further = curvatures.solve(select(meets, v2 - v1, none));
      // Rounding of large curvatures must not leave the plane across n.
      const V turned = K1 * further;
      const V to_meeting = v1 - n + (turned - n * dot(turned, n));

      const V tilt1 = select(is_flat(kGauges1) & is_ahead1, v1 - n - step, none);
      const V tilt2 = select(is_flat(kGauges2) & is_ahead2, v2 - n - step, none);
      const V tilted = step + regular.solve(H1 * select(has_step, tilt1, none) + rotated2 * select(has_step, tilt2, none));

      const V through = select(meets, to_meeting, tilted);
      const R twice_gain = dot(now.d, through);
      const M meets_halfway = meets & (state.at(kTolerance) * limits::kLeastGain < twice_gain);
      const M is_improved = open & (R(0.0) < twice_gain) & (has_step | meets_halfway);
      step = select(is_improved, through, step);
      return {is_improved, open & ((is_flat(kGauges1) & ~is_ahead1) | (is_flat(kGauges2) & ~is_ahead2))};
    }
  };

  /// The pairs in search, one a lane.
  struct Lanes {
    Table<3, W> best_normal, step;
    alignas(8 * W) double best_s[W];
    alignas(8 * W) double best_at[W];  // the evaluation of the best normal
    alignas(8 * W) double evaluations[W];
    alignas(8 * W) double is_active[W];   // 1 or 0
    alignas(8 * W) double is_halfway[W];  // 1 or 0: the last step was without a step in the normal
    double cuts[W][kMostLaneEvaluations][3];
    Table<kFields, W>& state;
    Table<kFoundFields, W>& found;
    int pair[W];  // of the chunk

    SUPERNORMAL_INLINE void load_pair(int lane, const Pairs& pairs, int index, int fields) {
      if constexpr (W > 1) {
        for (int field = 0; field < fields; ++field) state.rows[field][lane] = pairs.rows[field][index];
      }
      for (int i = 0; i < 3; ++i) best_normal.rows[i][lane] = step.rows[i][lane] = 0;
      best_s[lane] = -1e300;
      best_at[lane] = evaluations[lane] = 0;
      pair[lane] = index;
    }
    void keep_cut(V cut) {
      alignas(8 * W) double c[3][W];
      store(c[0], cut.x);
      store(c[1], cut.y);
      store(c[2], cut.z);
      for (int lane = 0; lane < W; ++lane) {
        const int k = static_cast<int>(evaluations[lane]);
        if (k >= kMostLaneEvaluations) continue;
        for (int i = 0; i < 3; ++i) cuts[lane][k][i] = c[i][lane];
      }
    }
  };

  /// The pairs that end with an evaluation.
  struct Round {
    M is_apart, is_proved, is_followed, is_open;
  };

  /// One evaluation of every lane, and the next normal of those that go on.
  template <typename Bodies>
  SUPERNORMAL_INLINE static Round advance(const LaneSettings& settings, Lanes& lanes) {
    Table<kFields, W>& state = lanes.state;
    const Mat<R> rotation = {state.vec(kRotation), state.vec(kRotation + 3), state.vec(kRotation + 6)};
    const V n = state.vec(kNormal), m = -transposed_times(rotation, n);
    Bodies bodies(state, rotation);
    const Evaluation now = bodies.evaluate(n, m, state.vec(kOffset));
    lanes.found.put(kFoundS, now.s);
    lanes.found.put(kFoundNormal, n);
    lanes.found.put(kFoundD, now.d);
    lanes.found.put(kFoundR, now.r1);
    lanes.found.put(kFoundH, now.h1);

    const M is_active = R(0.5) < load<W>(lanes.is_active);
    const R evaluations = load<W>(lanes.evaluations), best_s = load<W>(lanes.best_s), tolerance = state.at(kTolerance);
    const M is_first = evaluations < R(0.5), is_better = best_s < now.s;
    // The theorem: if s + rho > 0, then s <= max s <= |d + rho n| - rho.
    const R rho = state.at(kRho), height = now.s + rho;
    const M is_provable = R(0.0) < height;
    const V cut = now.d + n * rho;
    const R error = max(length(cut) - height, R(0.0));
    lanes.found.put(kFoundError, error);
    lanes.keep_cut(cut);
    const V best = select(is_better, n, lanes.best_normal.vec(0));
    lanes.best_normal.put(0, best);
    store(lanes.best_s, select(is_better, now.s, best_s));
    store(lanes.best_at, select(is_better, evaluations, load<W>(lanes.best_at)));

    Round round;
    round.is_apart = settings.stop_when_apart ? is_active & is_better & (R(0.0) < now.s) : R(1.0) < R(0.0);
    round.is_proved = is_active & is_better & is_provable & (error <= tolerance) & ~round.is_apart;
    // Deeper than rho there may be several maxima, and Newton's steps may lead away from the one that is tracked.
    // A shallow one is followed to its top.
    const M is_deep = (R(0.5) < state.at(kIsTracked)) & ~is_provable;
    const M may_follow = is_deep & (-now.s <= state.at(kFollowed));
    const M is_left = is_first & is_deep & ~may_follow;
    round.is_followed = R(1.0) < R(0.0);
    round.is_open = is_active & is_left & ~(round.is_apart | round.is_proved);
    M goes_on = is_active & ~(round.is_apart | round.is_proved | round.is_open);
    if (!any(goes_on | round.is_proved | round.is_open)) return round;
    S H1, H;  // for the step, the contact, and the search that goes on elsewhere
    bodies.hessians(n, H1, H);
    lanes.found.put(kFoundHessian1, H1);
    lanes.found.put(kFoundHessian, H);
    bodies.put_body2(lanes.found);
    if (!any(goes_on)) return round;

    const Regular regular(H, now.s, n, state.at(kUnit), limits::kFlattest);
    V step = regular.solve(now.d - n * now.s);
    // The model's gain is half of this product.
    const R twice_gain = dot(now.d, step);
    round.is_followed =
        goes_on & is_better & may_follow & regular.is_regular & (twice_gain * R(0.5 * kTuning.gain_safety) <= tolerance);
    goes_on = goes_on & ~round.is_followed;
    const Improvement improvement = bodies.improve(n, m, now, regular, goes_on & is_better, step);
    const M has_step = regular.is_regular | improvement.is_improved;
    const M gains = tolerance < dot(now.d, step);
    // A face is level: no shorter step leads higher.
    const M is_level = bodies.has_flat_faces() & (best_s - state.at(kRounding) <= now.s);
    // Nor does half of a step to a meeting that was not there.
    const M was_halfway = R(0.5) < load<W>(lanes.is_halfway);
    const M is_last = R(settings.most_evaluations - 1.5) < evaluations;
    const M is_stuck = improvement.is_lost | (is_better & (~has_step | ~(is_provable | may_follow | gains))) |
                       (~is_better & (is_level | was_halfway)) | is_last;
    round.is_open = round.is_open | (goes_on & is_stuck);
    goes_on = goes_on & ~is_stuck;

    store(lanes.is_halfway, select(is_better & ~regular.is_regular, R(1.0), R(0.0)));
    step = select(goes_on & is_better, step, lanes.step.vec(0) * R(0.5));
    const R squared = dot(step, step);
    const M is_long = R(kTuning.longest_step * kTuning.longest_step) < squared;
    step = step * select(is_long, R(kTuning.longest_step) / sqrt(select(is_long, squared, R(1.0))), R(1.0));
    lanes.step.put(0, step);
    state.put(kNormal, select(goes_on, unit(best + step), n));
    return round;
  }

  template <typename Bodies>
  SUPERNORMAL_INLINE static void search(Pairs& pairs, int count, const LaneSettings& settings, Ends& ends, LaneAnswer* answers) {
    constexpr bool kOfEllipsoids = Bodies::kOfEllipsoids;
    constexpr int kInUse = kOfEllipsoids ? kEllipsoidFields : kFields;
    constexpr int kFoundInUse = kOfEllipsoids ? kFoundOfEllipsoids : kFoundFields;
    // A single pair is searched where it lies.
    Table<kFields, W> own_state;
    Table<kFoundFields, W> own_found;
    Lanes lanes = [&]() -> Lanes {
      if constexpr (W == 1) {
        return {{}, {}, {}, {}, {}, {}, {}, {}, pairs, ends, {}};
      } else {
        own_found = {};
        return {{}, {}, {}, {}, {}, {}, {}, {}, own_state, own_found, {}};
      }
    }();
    int next = 0, active = 0;
    for (int lane = 0; lane < W; ++lane) {
      const bool has_pair = next < count;
      lanes.load_pair(lane, pairs, has_pair ? next++ : count - 1, kInUse);
      lanes.is_active[lane] = has_pair ? 1 : 0;
      active += has_pair ? 1 : 0;
    }
    while (active > 0) {
      const Round round = advance<Bodies>(settings, lanes);
      for (int lane = 0; lane < W; ++lane) lanes.evaluations[lane] += 1;
      const unsigned apart = lanes_of(round.is_apart), proved = lanes_of(round.is_proved), open = lanes_of(round.is_open);
      const unsigned followed = lanes_of(round.is_followed);
      for (unsigned ended = apart | proved | followed | open; ended != 0; ended &= ended - 1) {
        const int lane = __builtin_ctz(ended), index = lanes.pair[lane];
        const bool is_open = (open >> lane & 1) != 0;
        LaneAnswer& answer = answers[index];
        answer.outcome = is_open ? LaneOutcome::Open : (apart >> lane & 1) != 0 ? LaneOutcome::Apart : LaneOutcome::Proved;
        answer.is_followed = (followed >> lane & 1) != 0;
        answer.evaluations = static_cast<int>(lanes.evaluations[lane]);
        if constexpr (W > 1) {
          for (int field = 0; field < kFoundInUse; ++field) ends.rows[field][index] = lanes.found.rows[field][lane];
        }
        answer.has_jet = !kOfEllipsoids;
        if (is_open || answer.is_followed) {
          const int best = static_cast<int>(lanes.best_at[lane]);
          answer.has_jet = !kOfEllipsoids && best == answer.evaluations - 1;
          for (int i = 0; i < 3; ++i) ends.rows[kFoundNormal + i][index] = lanes.best_normal.rows[i][lane];
          for (int k = 0; k < answer.evaluations - 1; ++k) {
            for (int i = 0; i < 3; ++i) answer.cuts[k][i] = lanes.cuts[lane][k < best ? k : k + 1][i];
          }
        }
        if (next < count) {
          lanes.load_pair(lane, pairs, next++, kInUse);
        } else {
          lanes.is_active[lane] = 0;
          --active;
        }
      }
    }
  }

  // -------------------------------------------------------------------------------------------------------------------- finish

  /// Whether the bodies contain a point of body 1's frame, by their equations (Shape::surely_contains).
  SUPERNORMAL_INLINE static M both_contain(const Pairs& pairs, int column, bool of_ellipsoids, V point, V from2) {
    const V half1 = pairs.vec(kHalf1, column), half2 = pairs.vec(kHalf2, column);
    const V x1 = {point.x / half1.x, point.y / half1.y, point.z / half1.z},
            x2 = {from2.x / half2.x, from2.y / half2.y, from2.z / half2.z};
    if (of_ellipsoids) return (dot(x1, x1) <= R(1.0)) & (dot(x2, x2) <= R(1.0));
    using P = Two<R>;
    const auto both = [&](int field) { return P(pairs.at(kGauges1 + field, column), pairs.at(kGauges2 + field, column)); };
    const NormExponents<P> inner = {both(0), both(1)}, outer = {both(2), both(3)};
    const P across = norm_value(abs(P(x1.x, x2.x)), abs(P(x1.y, x2.y)), inner);
    const P gauge = norm_value(across, abs(P(x1.z, x2.z)), outer);
    return (gauge.a <= R(1.0)) & (gauge.b <= R(1.0));
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
  SUPERNORMAL_INLINE static M place_contact(const Pairs& pairs, const Ends& ends, int column, bool of_ellipsoids,
                                            const Radii& radii, M wanted, M is_followed, V& contact) {
    const V n = ends.vec(kFoundNormal, column), d = ends.vec(kFoundD, column), r1 = ends.vec(kFoundR, column);
    const R s = ends.at(kFoundS, column), unit_length = pairs.at(kUnit, column);
    const Regular sum(ends.sym(kFoundHessian, column), R(0.0), n, unit_length, limits::kFlatContact);
    const V across = d - n * s;
    // Where the sum is not regular, the radii may be of any size, and a product with them out of range.
    const V along = select(sum.is_regular, across, V{R(0.0), R(0.0), R(0.0)});
    const V from_point1 = ends.sym(kFoundHessian1, column) * sum.solve(along);
    const V shift = from_point1 - n * dot(from_point1, n) - across * R(0.5);
    const R half_distance = length(across) * R(0.5), distance = length(shift);
    const R limit = half_distance + min(radii.size1, radii.size2) * R(2.0);
    const M is_far = limit < distance;
    contact = r1 + d * R(0.5) + shift * select(is_far, limit / select(is_far, distance, R(1.0)), R(1.0));

    const R near = max(unit_length * R(limits::kNear), pairs.at(kTolerance, column));
    const auto is_near_both = [&](V point) {
      const V from1 = point - r1, from2 = from1 - d;
      const auto is_near = [&](V from, R radius) {
        const V tangential = from - n * dot(from, n);
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
    contact = contact + n * (ends.at(kFoundH, column) + s * R(0.5) - dot(n, contact));

    const V to_centre1 = contact - (r1 - n * radii.rolling1), to_centre2 = contact - (r1 + d + n * radii.rolling2);
    const M is_in_balls = (length(to_centre1) <= radii.rolling1 + near) & (length(to_centre2) <= radii.rolling2 + near);
    // That a point is in both bodies also proves that they overlap where a maximum is followed.
    const M is_open = wanted & is_good & (s <= R(0.0)) & (is_followed | ~is_in_balls);
    if (any(is_open)) {
      const Mat<R> rotation = {pairs.vec(kRotation, column), pairs.vec(kRotation + 3, column), pairs.vec(kRotation + 6, column)};
      const V from2 = transposed_times(rotation, contact - pairs.vec(kOffset, column));
      is_good = is_good & (~is_open | both_contain(pairs, column, of_ellipsoids, contact, from2));
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
    const V along = axis - n * dot(n, axis);
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
  SUPERNORMAL_INLINE static void find_curvatures(const Pairs& pairs, const Ends& ends, int column, bool of_ellipsoids, M wanted,
                                                 R& smaller, R& larger) {
    const Mat<R> rotation = {pairs.vec(kRotation, column), pairs.vec(kRotation + 3, column), pairs.vec(kRotation + 6, column)};
    const V half1 = pairs.vec(kHalf1, column), half2 = pairs.vec(kHalf2, column);
    const V n = ends.vec(kFoundNormal, column), m = -transposed_times(rotation, n);
    const S H2 = of_ellipsoids ? ellipsoid_hessian(half2, m, R(1.0) / length(times(half2, m))) : ends.sym(kFoundHessian2, column);
    const Curvature K1 = curvature_of(ends.sym(kFoundHessian1, column), n, smallest(half1));
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

  SUPERNORMAL_INLINE static void finish(const LanePair* inputs, const Pairs& pairs, const Ends& ends, int column, int count,
                                        bool of_ellipsoids, bool wants_curvature, LaneAnswer* answers) {
    const Place place1(inputs, count, false);
    const auto find = [&](auto&& has) {
      return R(0.5) < lanes_from<W>([&](int lane) { return lane < count && has(answers[lane]) ? 1.0 : 0.0; });
    };
    const M is_proved = find([](const LaneAnswer& answer) { return answer.outcome == LaneOutcome::Proved; });
    const M is_followed = find([](const LaneAnswer& answer) { return answer.is_followed; });
    const V n = ends.vec(kFoundNormal, column), d = ends.vec(kFoundD, column), r1 = ends.vec(kFoundR, column);
    V contact = r1 + d * R(0.5);
    M is_complete = is_proved;
    if (any(is_proved)) {
      V placed;
      is_complete =
          is_proved & place_contact(pairs, ends, column, of_ellipsoids, Radii(inputs, count), is_proved, is_followed, placed);
      contact = select(is_complete, placed, contact);
    }
    const auto to_world = [&place1](V point) { return place1.rotation * point + place1.position; };
    const V normal = unit(place1.rotation * n), point1 = to_world(r1), point2 = to_world(r1 + d), point = to_world(contact);
    R smaller = kUnknownCurvature, larger = kUnknownCurvature;
    if (wants_curvature) {
      const M wanted = is_complete & (ends.at(kFoundS, column) < R(0.0));
      if (any(wanted)) find_curvatures(pairs, ends, column, of_ellipsoids, wanted, smaller, larger);
    }
    alignas(8 * W) double out[21][W];
    const auto put = [&out](int i, V v) {
      store(out[i], v.x);
      store(out[i + 1], v.y);
      store(out[i + 2], v.z);
    };
    store(out[0], ends.at(kFoundS, column));
    store(out[1], ends.at(kFoundError, column));
    store(out[2], pairs.at(kRounding, column));
    store(out[3], pairs.at(kTolerance, column));
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
      if (!is_whole && answer.has_jet) {
        for (int field = 0; field < kFoundFields; ++field) answer.jet[field] = ends.rows[field][column + lane];
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
    Ends ends;
    for (int first = 0; first < count; first += kChunk) {
      const int here = count - first < kChunk ? count - first : kChunk;
      for (int column = 0; column < here; column += W) {
        prepare(pairs + first + column, here - column < W ? here - column : W, of_ellipsoids, settings, column, prepared);
      }
      if (of_ellipsoids) {
        search<Ellipsoids>(prepared, here, settings, ends, answers + first);
      } else {
        search<Superellipsoids>(prepared, here, settings, ends, answers + first);
      }
      for (int column = 0; column < here; column += W) {
        // The lanes beyond the last pair compute with its numbers.
        for (int lane = here - column; lane < W; ++lane) {
          for (auto& row : ends.rows) row[column + lane] = row[here - 1];
        }
        finish(pairs + first + column, prepared, ends, column, here - column < W ? here - column : W, of_ellipsoids,
               settings.wants_curvature, answers + first + column);
      }
    }
  }
};

}  // namespace
}  // namespace supernormal
