#include "collider_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/grain_form.hpp"
#include "common/number_text.hpp"
#include "ode_timing.hpp"
#include "report/statistics.hpp"
#include "supernormal/supernormal.h"

namespace accuracy_cost {
namespace {

using common::FormKind;
using common::grain_maker;
using common::GrainForm;
using common::joined;
using common::MeasuredTable;
using common::MeshSize;
using common::number;
using common::OdeGeom;

constexpr double kDepth = 0.02 * kSmallestHalfAxis;  // m
constexpr std::array kColliders = {ColliderClass::Plane, ColliderClass::Box, ColliderClass::Capsule, ColliderClass::Trimesh};

constexpr common::GrainBody kBody{{0.5, 0.4, kSmallestHalfAxis}, 4, 4};  // that of ode_bodies.cpp

/// The name without the number of triangles.
std::string short_name(ColliderClass collider) {
  const std::string name = name_of(collider);
  return name.substr(0, name.find(','));
}

struct Contender {
  GrainForm form;
  bool is_warm;
  OdeGeom geom;
  std::vector<double> times, errors, contacts;
  std::size_t misses = 0;  // queries without a contact
};

std::vector<Contender> contenders() {
  std::vector<Contender> all;
  const auto add = [&](const GrainForm& form, bool is_warm) {
    all.push_back({form, is_warm, grain_maker(form, kBody)(), {}, {}, {}});
  };
  for (const bool is_warm : {false, true}) {
    for (int digits = 1; digits <= 12; ++digits) add({FormKind::Smooth, std::pow(10.0, -digits), {}}, is_warm);
  }
  for (const FormKind kind : {FormKind::Convex, FormKind::Trimesh}) {
    for (const MeshSize size : {MeshSize{6, 5}, {12, 10}, {24, 20}, {48, 40}}) add({kind, 0, size}, false);
  }
  return all;
}

/// The depth of the deepest contact at the first pose, m; NaN if there is none.
double depth_of(const OdeQuery& query) {
  std::array<dContactGeom, kMaxContacts> contacts;
  query.pair.move_body(query.poses[0]);
  const int count = query.pair.collide(contacts);
  double depth = count == 0 ? std::numeric_limits<double>::quiet_NaN() : 0;
  for (int k = 0; k < count; ++k) depth = std::max<double>(depth, contacts[static_cast<std::size_t>(k)].depth);
  return depth;
}

/// Measures all bodies at the pose in which the exact one overlaps.
void measure_pose(const Approach& approach, const OdePair& exact, const Effort& effort, std::vector<Contender>& all) {
  snSetWarmStart(0);
  const std::optional<double> touching = touching_distance(exact, approach);
  if (!touching) return;
  const auto poses = approach.poses_at(*touching - kDepth);
  const double true_depth = depth_of({exact, false, poses});
  std::vector<OdeQuery> queries;
  queries.reserve(all.size());
  for (const Contender& contender : all) queries.push_back({{contender.geom.id(), exact.collider}, contender.is_warm, poses});
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double error = std::abs(depth_of(queries[k]) - true_depth) / kSmallestHalfAxis;
    if (std::isnan(error)) {
      ++all[k].misses;
    } else {
      all[k].errors.push_back(error);
    }
  }
  measure_queries(queries, effort);
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].times.push_back(queries[k].time());
    all[k].contacts.push_back(queries[k].contacts);
  }
}

std::vector<std::string> measure_collider(ColliderClass collider, std::size_t poses, std::uint64_t seed, const Effort& effort) {
  if (snInit() == 0) throw std::runtime_error(snLastError());
  common::Random random(seed);
  const OdeGeom exact = grain_maker({FormKind::Smooth, 1e-14, {}}, kBody)();
  const OdeGeom other = make_collider(collider, {});
  std::vector<Contender> all = contenders();
  for (std::size_t k = 0; k < poses; ++k) {
    const Approach approach = Approach::draw(collider, random);
    approach.move_collider(collider, other.id());
    measure_pose(approach, {exact.id(), other.id()}, effort, all);
  }
  snSetWarmStart(1);
  std::vector<std::string> lines;
  lines.reserve(all.size());
  for (const Contender& c : all) {
    lines.push_back(
        joined({name_of(collider), c.form.name() + (c.is_warm ? " (warm)" : ""), c.form.accuracy(), std::to_string(c.times.size()),
                number(median(c.times)), number(quantile(c.times, 0.99)), number(median(c.errors)), number(quantile(c.errors, 1)),
                number(median(c.contacts)), std::to_string(c.misses)}));
  }
  return lines;
}

}  // namespace

MeasuredTable collider_sweep(std::size_t poses, std::uint64_t seed, const Effort& effort) {
  MeasuredTable table{
      "colliders", "collider,method,accuracy,poses,time_s,time_p99_s,depth_error,depth_error_worst,contacts,misses", {}};
  for (const ColliderClass collider : kColliders) {
    table.tasks.push_back({short_name(collider), [=] { return measure_collider(collider, poses, seed, effort); }});
  }
  return table;
}

}  // namespace accuracy_cost
