// Contacts of bodies whose motion without contact forces does not bring them together.
#pragma once

#include <optional>

#include "supernormal/contact/contacts_ahead.hpp"

namespace supernormal {

/// The contacts at the end of the free motion, the motion within `time` (s) without contact forces. Empty if the contacts `ahead`
/// leave this motion as it is, or if the bodies meet during it. `share` is the share of body 1 in the mobilities.
///
/// A row of contact forces is linear in the motion and has one normal. The free motion bends: gravity bends the path of a body,
/// and the points of a rotating body move on circles. So contacts along the present velocity may forbid a motion that meets
/// nothing. At the end of this motion the bodies are apart by a gap. Rows with the normals of this place, and with this gap left
/// over by the free motion, forbid nothing of it. They keep the bodies apart if other forces change it.
std::optional<ContactManifold> find_contacts_after_free_motion(const BodyAhead& body1, const BodyAhead& body2, double time,
                                                               double share, const Settings& settings, const Proximity& now,
                                                               const ContactManifold& ahead);

/// The same for a body and a plane at rest.
std::optional<ContactManifold> find_plane_contacts_after_free_motion(const BodyAhead& body, double time, const Proximity& now,
                                                                     const ContactManifold& ahead);

}  // namespace supernormal
