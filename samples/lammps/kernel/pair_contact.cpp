#include "kernel/pair_contact.hpp"

#include <algorithm>

#include "supernormal/contact/contact_curvature.hpp"

namespace granular {
namespace {

NormalForce elastic_force(const ContactMaterial& material, const Body& body1, const Body& body2, const Vector3& n, double depth) {
  if (material.law == NormalLaw::Hooke) return hooke_force(material, depth);
  const Matrix3 sum =
      supernormal::find_curvature(*body1.shape, body1.pose, n) + supernormal::find_curvature(*body2.shape, body2.pose, -n);
  return hertz_force(material, depth, supernormal::find_contact_curvature(sum, n), std::min(body1.width, body2.width));
}

}  // namespace

PairContact find_pair_contact(const Body& body1, const Body& body2, const ContactMaterial& material,
                              const supernormal::Settings& settings, double step, ContactHistory& history) {
  PairQuery query;
  query.set(body1, body2, history);
  return contact_of(supernormal::find_proximity(query.query, settings), body1, body2, material, step, history);
}

PairContact contact_of(const supernormal::Proximity& found, const Body& body1, const Body& body2, const ContactMaterial& material,
                       double step, ContactHistory& history) {
  PairContact pair;
  pair.evaluations = found.evaluations;
  if (found.status == supernormal::Status::InvalidInput) {
    pair.state = PairState::Failed;
    return pair;
  }
  if (found.gap >= 0) {
    if (step > 0) {
      history.release_springs();
      history.normal = found.normal;
    }
    return pair;
  }
  pair.state = PairState::Touching;
  pair.contact = {found.normal, found.contact - body1.pose.position, found.contact - body2.pose.position, -found.gap};
  const NormalForce elastic = elastic_force(material, body1, body2, found.normal, -found.gap);
  pair.force = contact_force(pair.contact, elastic, material, body1, body2, step, history);
  if (step > 0) history.normal = found.normal;
  return pair;
}

}  // namespace granular
