#include "kernel/pair_contact.hpp"

#include <algorithm>
#include <optional>

namespace granular {
namespace {

NormalForce elastic_force(const ContactMaterial& material, const supernormal::ContactCurvature& curvature, double width,
                          double depth) {
  return material.law == NormalLaw::Hooke ? hooke_force(material, depth) : hertz_force(material, depth, curvature, width);
}

}  // namespace

PairContact find_pair_contact(const Body& body1, const Body& body2, const ContactMaterial& material,
                              const supernormal::Settings& settings, double step, ContactHistory& history) {
  PairQuery query;
  query.set(body1, body2, history);
  supernormal::Proximity found;
  supernormal::ContactCurvature curvature;
  supernormal::find_proximities({&query.query, 1}, settings, {&found, 1}, {&curvature, 1});
  return contact_of(found, curvature, body1, body2, material, step, history);
}

PairContact contact_of(const supernormal::Proximity& found, const supernormal::ContactCurvature& curvature, const Body& body1,
                       const Body& body2, const ContactMaterial& material, double step, ContactHistory& history) {
  PairContact pair;
  pair.evaluations = found.evaluations;
  if (found.status == supernormal::Status::InvalidInput) {
    pair.state = PairState::Failed;
    return pair;
  }
  const double gap = found.gap;
  const std::optional<FaceContact> faces =
      gap < body1.bulge + body2.bulge ? find_face_contact(body1, body2, found.normal) : std::nullopt;
  if (faces) {
    pair.share_of_faces = faces->share;
    pair.corners = faces->count;
  }
  if (gap >= 0 && pair.corners == 0) {
    if (step > 0) {
      history.release_springs();
      // A normal that still proves the separation stays as it is, to the bit. So queries may be skipped while it does.
      const bool is_proved_by_last = found.status == supernormal::Status::Apart && found.evaluations == 1 && history.has_normal();
      if (!is_proved_by_last) history.normal = found.normal;
    }
    return pair;
  }
  pair.state = PairState::Touching;
  pair.contact = {found.normal, found.contact - body1.pose.position, found.contact - body2.pose.position, std::max(0.0, -gap)};
  const double width = std::min(body1.width, body2.width);
  const NormalForce elastic = gap < 0 ? elastic_force(material, curvature, width, -gap) : NormalForce();
  if (faces) {
    pair.force =
        face_contact_force(*faces, face_stiffness(material, width), elastic, material, body1, body2, step, pair.contact, history);
  } else {
    if (step > 0 && body1.is_flat() && body2.is_flat()) history.release_twist();
    pair.force = contact_force(pair.contact, elastic, material, body1, body2, step, history);
  }
  if (step > 0) history.normal = found.normal;
  return pair;
}

}  // namespace granular
