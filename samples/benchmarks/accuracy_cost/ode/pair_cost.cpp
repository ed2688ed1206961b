#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include "../costs.hpp"
#include "colliders.hpp"
#include "common/measured_tables.hpp"
#include "common/ode_geom.hpp"
#include "measurement.hpp"
#include "methods/method.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/supernormal.h"

namespace accuracy_cost {
namespace {

using common::OdeGeom;
using common::text;
using supernormal::Shape;
using supernormal::Vector3;

constexpr double kEpaTolerance = 1e-6;

OdeGeom make_geom(const Shape& shape) {
  const Vector3 half = shape.half_extents();
  const auto* const body = dynamic_cast<const supernormal::Superellipsoid*>(&shape);
  if (body == nullptr) return OdeGeom(snCreateEllipsoid(nullptr, half.x(), half.y(), half.z()));
  return OdeGeom(snCreateSuperellipsoid(nullptr, half.x(), half.y(), half.z(), body->delta(), body->epsilon()));
}

/// The pairs must outlive it, because it knows their bodies by their addresses.
class DCollide final : public Method {
 public:
  DCollide() : Method("dCollide") {}

  Answer query(const Pair& pair) const override {
    dContactGeom contact;
    if (&pair != last_) {
      last_ = &pair;
      geom1_ = geom(*pair.shape1, pair.pose1);
      geom2_ = geom(*pair.shape2, pair.pose2);
    }
    if (dCollide(geom1_, geom2_, 1, &contact, sizeof contact) == 0) return {Answer::Kind::Apart, 0, Vector3::UnitX(), 0};
    return {Answer::Kind::Gap, -double{contact.depth}, -Vector3(contact.normal[0], contact.normal[1], contact.normal[2]), 0,
            Vector3(contact.pos[0], contact.pos[1], contact.pos[2])};
  }

 private:
  /// Made and placed by the first query of a pair, which is not timed.
  dGeomID geom(const Shape& shape, const supernormal::Pose& pose) const {
    const auto known = geoms_.find(&shape);
    if (known != geoms_.end()) return known->second.id();
    const dGeomID id = geoms_.emplace(&shape, make_geom(shape)).first->second.id();
    OdePair{id, nullptr}.move_body(pose);
    return id;
  }

  mutable std::unordered_map<const Shape*, OdeGeom> geoms_;
  mutable const Pair* last_ = nullptr;
  mutable dGeomID geom1_ = nullptr, geom2_ = nullptr;
};

struct Named {
  BodyClass body_class;
  const char* name;
};
constexpr std::array kRows = {Named{BodyClass::Sphere, "spheres"},
                              Named{BodyClass::Ellipsoid, "ellipsoids"},
                              Named{BodyClass::Moderate, "exponents 1.3…5"},
                              Named{BodyClass::Boxy, "exponents 6…20"},
                              Named{BodyClass::Octahedral, "exponents 1.1…1.3"},
                              Named{BodyClass::Needle, "needles"}};

void write_row(const Named& row, Situation situation, std::size_t count, std::uint64_t seed, const Effort& effort,
               std::ostream& out) {
  const std::vector<Pair> pairs = draw_pairs_of(row.body_class, situation, count, seed);
  Methods methods;
  methods.push_back(std::make_unique<DCollide>());
  methods.push_back(ccd_epa(kCcdEpa, kEpaTolerance));
  const auto samples = measure(methods, pairs, effort);
  const Statistics ours = statistics(samples[0], pairs), theirs = statistics(samples[1], pairs);
  double our_sum = 0, their_sum = 0;
  for (std::size_t p = 0; p < pairs.size(); ++p) our_sum += samples[0][p].time, their_sum += samples[1][p].time;
  out << "| " << row.name << ", " << (situation == Situation::Shallow ? "1" : "30") << " % overlap | "
      << text("%.2f", ours.time * 1e6) << " | " << text("%.1f", theirs.time / ours.time) << " | "
      << text("%.1f", their_sum / our_sum) << " | " << text("%.0e", ours.worst_error) << " / " << text("%.0e", theirs.worst_error)
      << " | " << ours.failures() << " / " << theirs.failures() << " |\n"
      << std::flush;
}

}  // namespace

void write_pair_costs(std::size_t pairs, std::uint64_t seed, const Effort& effort, std::ostream& out) {
  snSetWarmStart(0);
  out << "* " << pairs
      << " pairs a row\n\n| pairs | dCollide, µs | libccd / dCollide, medians | means | worst gap error, dCollide / "
         "libccd | failures |\n|---|---:|---:|---:|---|---|\n";
  for (const Situation situation : {Situation::Shallow, Situation::Deep}) {
    for (const Named& row : kRows) write_row(row, situation, pairs, seed, effort, out);
  }
}

}  // namespace accuracy_cost
