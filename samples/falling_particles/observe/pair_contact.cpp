#include "pair_contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>
#include <utility>

#include "world/grain.hpp"

namespace falling_particles {
namespace {

/// A contact point, with the same grain 1 as its PairContact.
struct ContactPoint {
  std::pair<std::size_t, std::size_t> order;  // sort key of the pair
  const Grain* grain1;
  const Grain* grain2;
  dGeomID geom2;
  Vector3 centre1, centre2, position, normal, force;
  double overlap;
};

/// Numbers walls in the order in which the step processed them.
class WallNumbers {
 public:
  std::size_t number_of(dGeomID wall) {
    const auto found = std::ranges::find(walls_, wall);
    const auto number = static_cast<std::size_t>(found - walls_.begin());
    if (found == walls_.end()) walls_.push_back(wall);
    return number;
  }

 private:
  std::vector<dGeomID> walls_;
};

/// The centre before the step.
Vector3 centre_before(dGeomID geom, double step) { return position_before(dGeomGetBody(geom), step); }

ContactPoint point_of(const MeasuredContact& contact, const World& world, WallNumbers& walls, double step) {
  dGeomID geom1 = contact.geom.g1;
  dGeomID geom2 = contact.geom.g2;
  const auto index_of = [&world](const Grain* grain) { return static_cast<std::size_t>(grain - world.grains().data()); };
  const bool is_swapped =
      grain_of(geom1) == nullptr || (grain_of(geom2) != nullptr && index_of(grain_of(geom2)) < index_of(grain_of(geom1)));
  if (is_swapped) std::swap(geom1, geom2);
  const double sign = is_swapped ? -1 : 1;
  const Grain* grain1 = grain_of(geom1);
  const Grain* grain2 = grain_of(geom2);
  const Vector3 position = to_vector(contact.geom.pos);
  return {{index_of(grain1), grain2 != nullptr ? index_of(grain2) : world.grains().size() + walls.number_of(geom2)},
          grain1,
          grain2,
          geom2,
          centre_before(geom1, step),
          grain2 != nullptr ? centre_before(geom2, step) : position,
          position,
          sign * to_vector(contact.geom.normal),
          sign * to_vector(contact.force()),
          contact.geom.depth};
}

/// Whether two points belong to one contact: the same two images meet, or periodic copies of them.
bool is_same_contact(const ContactPoint& a, const ContactPoint& b) {
  if (a.order != b.order) return false;
  if (a.grain2 == nullptr) return true;
  constexpr double kShare = 1e-3;  // of the grain's radius; another meeting of the same grains is a cell away
  const double tolerance = kShare * a.grain1->bounding_radius();
  return ((a.centre1 - a.centre2) - (b.centre1 - b.centre2)).norm() < tolerance;
}

PairContact merge(const std::vector<ContactPoint>& points, std::size_t first, std::size_t end) {
  const ContactPoint& lead = points[first];
  PairContact pair{lead.grain1,     lead.grain2,     lead.geom2, lead.centre1, lead.centre2, Vector3::Zero(), Vector3::Zero(), 0,
                   Vector3::Zero(), Vector3::Zero(), 0};
  double pushing = 0;
  for (std::size_t i = first; i < end; ++i) pushing += std::max(0.0, points[i].force.dot(points[i].normal));
  for (std::size_t i = first; i < end; ++i) {
    const ContactPoint& point = points[i];
    const double weight =
        pushing > 0 ? std::max(0.0, point.force.dot(point.normal)) / pushing : 1 / static_cast<double>(end - first);
    const Vector3 position = point.position - (point.centre1 - lead.centre1);
    pair.position += weight * position;
    pair.normal += weight * point.normal;
    pair.overlap = std::max(pair.overlap, point.overlap);
    pair.force += point.force;
    pair.moment += position.cross(point.force);
    ++pair.points;
  }
  if (pair.normal.norm() > 0) {
    pair.normal.normalize();
  } else {
    pair.normal = lead.normal;  // opposite normals, of two walls of one mesh that face each other
  }
  if (pair.grain2 == nullptr) pair.centre2 = pair.position;
  return pair;
}

}  // namespace

std::vector<PairContact> gather_contacts(const std::deque<MeasuredContact>& measured, const World& world, double step) {
  std::vector<ContactPoint> points;
  points.reserve(measured.size());
  WallNumbers walls;
  for (const MeasuredContact& contact : measured) points.push_back(point_of(contact, world, walls, step));
  // Walls come last, each with its grains in order. A stable sort keeps the points of a pair in the step's order.
  const std::size_t grains = world.grains().size();
  const auto key = [grains](const ContactPoint& point) {
    const auto& [one, two] = point.order;
    return two < grains ? std::tuple(std::size_t{0}, one, two) : std::tuple(two, one, two);
  };
  std::ranges::stable_sort(points, [&key](const ContactPoint& a, const ContactPoint& b) { return key(a) < key(b); });
  std::vector<PairContact> pairs;
  for (std::size_t first = 0; first < points.size();) {
    // If two grains meet in several places of a periodic cell, each place is a contact. There are never more than a few.
    std::size_t end = first + 1;
    while (end < points.size() && points[end].order == points[first].order) ++end;
    while (first < end) {
      const auto begin = points.begin() + static_cast<std::ptrdiff_t>(first);
      const ContactPoint lead = *begin;
      const auto middle = std::stable_partition(begin, points.begin() + static_cast<std::ptrdiff_t>(end),
                                                [&lead](const ContactPoint& point) { return is_same_contact(lead, point); });
      const auto next = static_cast<std::size_t>(middle - points.begin());
      pairs.push_back(merge(points, first, next));
      first = next;
    }
  }
  return pairs;
}

}  // namespace falling_particles
