#include "contact/contact_point.hpp"
#include "solvers/answer.hpp"
#include "solvers/ascent.hpp"
#include "solvers/first_guess.hpp"
#include "solvers/global_search.hpp"
#include "solvers/solvers.hpp"

namespace supernormal {

namespace {

// A branch is followed without a look at others down to this depth, in units of the pair's length: between two steps of a
// simulation that does not let bodies sink into one another, no other branch can become much better.
constexpr double kUnquestionedDepth = 0.02;

bool is_questioned(const GapFunction& gap, Branch branch, const GapJet& best) {
  return branch == Branch::Highest || -best.s > kUnquestionedDepth * gap.length_unit();
}

/// Whether the normal that a query without history would start from is already higher than the branch followed.
bool is_higher_at_first_guess(GapFunction& gap, CuttingPlanes& cuts, const GapJet& best) {
  GapJet elsewhere;
  gap.evaluate(first_guess(gap), Order::Point, elsewhere);
  cuts.add(elsewhere.d);
  return elsewhere.s > best.s;
}

}  // namespace

// Steps: climb from the start; if the bodies overlap so deeply against their sharpest edges that there may be other maxima, look
// for a higher one, but leave the branch of an earlier pose only when it has stopped being the best.
Proximity solve_hybrid(GapFunction& gap, const Settings& settings, const Vector3& start, Branch branch) {
  const double tolerance = absolute_tolerance(gap, settings);
  CuttingPlanes cuts;
  Ascent ascent(gap, cuts, settings, tolerance);
  Status status = ascent.climb(start);
  GapJet best = ascent.best();
  double error = ascent.error();
  // A maximum that is not negative is the only one: s is concave on the cone where it is positive.
  if (best.s < -tolerance && is_questioned(gap, branch, best)) {
    const SharpFeatures features1 = gap.shape1().sharp_features();
    const SharpFeatures features2 = gap.shape2().sharp_features();
    const bool in_doubt = may_have_other_maxima(features1, features2, -best.s, gap.length_unit(), gap.shape2().has_kinks());
    if (in_doubt && gap.evaluations() >= settings.max_evaluations) {
      status = Status::EvaluationLimit;
    } else if (in_doubt && (branch == Branch::Highest || is_higher_at_first_guess(gap, cuts, best))) {
      status = GlobalSearch(gap, cuts, ascent, settings).improve(features1, features2, status, best, error);
    }
  }
  Proximity out = answer(gap, best, error, status);
  out.contact = contact_point(gap, best);
  return out;
}

}  // namespace supernormal
