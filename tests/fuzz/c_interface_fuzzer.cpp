// The C interface with numbers of every kind. The bytes say how two bodies of ours and one of ODE's are made, changed, moved and
// queried. Whatever an ODE program may legally do, the library does not crash, a refusal has a message, and an answer is finite
// with unit normals.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>

#include "bodies.hpp"
#include "byte_reader.hpp"
#include "supernormal/supernormal.h"
#include "support/expect.hpp"

namespace supernormal::fuzz {
namespace {

constexpr int kMostOperations = 24;
constexpr int kRoom = 8;
constexpr double kUnit = 1e-12;  // how far a normal's square may be from 1

bool is_finite(const dReal* v) {
  return std::all_of(v, v + 3, [](dReal x) { return std::isfinite(x); });
}
bool is_unit(const dReal* v) { return std::abs(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - 1) <= kUnit; }

double largest(const dReal* v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); }

/// Compares including the padding: memory that was not written has changed in no byte.
template <typename T>
bool is_same(const T& a, const T& b) {
  const auto* const bytes = reinterpret_cast<const unsigned char*>(&a);
  return std::equal(bytes, bytes + sizeof(T), reinterpret_cast<const unsigned char*>(&b));
}

/// Whether the pose is finite, as far as the geom has one. A plane has none, a sphere has no rotation, a ray only a direction.
bool is_placed(dGeomID geom) {
  const int geom_class = dGeomGetClass(geom);
  if (geom_class == dPlaneClass) return true;
  if (!is_finite(dGeomGetPosition(geom))) return false;
  if (geom_class == dSphereClass) return true;
  const dReal* const R = dGeomGetRotation(geom);
  const dVector3 z = {R[2], R[6], R[10]};
  return is_finite(z) && (geom_class == dRayClass || (is_finite(R) && is_finite(R + 4) && is_finite(R + 8)));
}

/// The contacts of a pair. Memory beyond the counted contacts must stay unchanged.
struct Contacts {
  dContactGeom all[kRoom + 1];
  int count;

  Contacts(dGeomID g1, dGeomID g2, int room, bool any_will_do) {
    std::memset(all, 0x5a, sizeof all);
    const dContactGeom untouched = all[kRoom];
    count = dCollide(g1, g2, room | (any_will_do ? static_cast<int>(CONTACTS_UNIMPORTANT) : 0), all, sizeof(dContactGeom));
    expect(count >= 0 && count <= room, "no more contacts than there is room for");
    for (int k = count; k <= kRoom; ++k) {
      expect(is_same(all[k], untouched), "nothing is written beyond the contacts");
    }
    for (int k = 0; k < count; ++k) {
      const dContactGeom& contact = all[k];
      expect(is_finite(contact.pos) && std::isfinite(contact.depth), "contacts are finite");
      expect(contact.depth >= 0, "no contact has a negative depth");
      expect(is_unit(contact.normal), "the normal of a contact is of unit length");
      expect(contact.g1 == g1 && contact.g2 == g2, "contacts name their geoms in the order of the call");
    }
  }

  double depth() const {
    double deepest = 0;
    for (int k = 0; k < count; ++k) deepest = std::max(deepest, double{all[k].depth});
    return deepest;
  }
};

class Session {
 public:
  explicit Session(ByteReader& bytes) : bytes_(bytes) {
    for (FuzzedBody& body : bodies_) {
      body.create(bytes);
      place(body.geom(), bytes);
    }
    new_collider();
  }
  ~Session() {
    if (collider_ != nullptr) dGeomDestroy(collider_);
    snSetWarmStart(1);
  }
  Session(const Session&) = delete;
  Session(Session&&) = delete;
  Session& operator=(const Session&) = delete;
  Session& operator=(Session&&) = delete;

  void run() {
    for (int k = 0; k < kMostOperations && !bytes_.is_empty(); ++k) operate(bytes_.byte());
    ask_pair(bodies_[0].geom(), bodies_[1].geom());
    ask_pair(bodies_[0].geom(), collider_);
  }

 private:
  void operate(unsigned code) {
    FuzzedBody& body = bodies_[code & 1U];
    const dGeomID geom = body.geom();
    switch ((code >> 1U) % 12) {
      case 0:
        return place(geom, bytes_);
      case 1:
        return place(collider_, bytes_);
      case 2:
        return body.set_parameters(bytes_);
      case 3:
        return body.set_rounding(bytes_);
      case 4:
        return body.set_solver(bytes_);
      case 5:
        return ask_mass(geom);
      case 6:
        return ask_depth(body);
      case 7:
        return ask_support(body);
      case 8:
        return new_collider();
      case 9:
        return change_warm_start();
      case 10:
        return ask_pair(geom, bytes_.flag() ? collider_ : bodies_[1 - (code & 1U)].geom());
      default:
        body.create(bytes_);
        return place(body.geom(), bytes_);
    }
  }

  void new_collider() {
    if (collider_ != nullptr) dGeomDestroy(collider_);
    collider_ = create_collider(bytes_);
    if (dGeomGetClass(collider_) != dRayClass) place(collider_, bytes_);  // a ray already has its place
  }

  void change_warm_start() {
    is_warm_ = bytes_.flag();
    snSetWarmStart(is_warm_ ? 1 : 0);
  }

  void ask_mass(dGeomID geom) {
    if (has_asked_mass_) return;  // the mass of a user's very slender body takes a second
    has_asked_mass_ = true;
    const double value = bytes_.number();
    dMass mass;
    dMassSetSphereTotal(&mass, 3, 1);
    const dMass untouched = mass;
    const bool is_total = bytes_.flag();
    forget_last_error();
    const bool done = (is_total ? snMassSetTotal(&mass, value, geom) : snMassSet(&mass, value, geom)) == 1;
    if (!done) {
      expect_refusal(is_total ? "snMassSetTotal" : "snMassSet");
      expect(is_same(mass, untouched), "a refusal leaves the mass as it was");
      return;
    }
    expect(value > 0 && std::isfinite(value), "an invalid density or mass is refused");
    expect(mass.mass > 0 && std::isfinite(mass.mass) && is_finite(mass.c), "mass and centre are finite");
    for (int row = 0; row < 3; ++row) expect(is_finite(mass.I + 4 * row) && mass.I[5 * row] > 0, "inertia is finite and positive");
  }

  void ask_depth(const FuzzedBody& body) {
    const double x = bytes_.number(), y = bytes_.number(), z = bytes_.number();
    forget_last_error();
    const double depth = snGeomPointDepth(body.geom(), x, y, z);
    if (std::isnan(depth)) return expect_refusal("snGeomPointDepth");
    expect(std::isfinite(depth), "the depth of a point is finite");
    expect(std::isfinite(x) && std::isfinite(y) && std::isfinite(z) && is_placed(body.geom()), "what is not finite is refused");
  }

  void ask_support(const FuzzedBody& body) {
    const dVector3 direction = {bytes_.number(), bytes_.number(), bytes_.number(), 0};
    dVector3 point = {7, 7, 7, 7};
    forget_last_error();
    const bool done = snGeomSupport(body.geom(), direction, point) == 1;
    if (!done) return expect_refusal("snGeomSupport");
    expect(is_finite(direction) && largest(direction) > 0, "directions without a length are refused");
    if (is_placed(body.geom()) && body.is_sound()) {
      const bool may_overflow = largest(dGeomGetPosition(body.geom())) > std::numeric_limits<dReal>::max() / 2;
      expect(is_finite(point) || may_overflow, "the point of a direction is finite");
    }
    dReal aabb[6];
    dGeomGetAABB(body.geom(), aabb);
    for (int axis = 0; axis < 3; ++axis) {
      expect(aabb[2 * axis] <= aabb[2 * axis + 1], "the bounding box is one");
      if (!body.is_sound() || !is_finite(point)) continue;
      expect(aabb[2 * axis] <= point[axis] && point[axis] <= aabb[2 * axis + 1], "the bounding box contains the body");
    }
  }

  /// Whether the gap of a pair is answered. If not, there must be a reason.
  bool ask_gap(dGeomID g1, dGeomID g2, snProximity& answer) {
    forget_last_error();
    if (snGeomProximity(g1, g2, &answer) == 0) {
      expect_refusal("snGeomProximity");
      return false;
    }
    expect(is_placed(g1) && is_placed(g2), "what is not finite is refused");
    expect(std::isfinite(answer.gap), "the gap is finite");
    // The error may be infinite if nothing is known, and then the query has not converged.
    expect(answer.error >= 0 && (std::isfinite(answer.error) || answer.converged == 0), "the error of the gap is a bound");
    expect(is_finite(answer.normal) && is_unit(answer.normal), "the normal is of unit length");
    expect(is_finite(answer.point1) && is_finite(answer.point2), "the witness points are finite");
    expect(answer.evaluations >= 0, "evaluations are counted");
    return true;
  }

  bool is_sound(dGeomID geom) const {
    return std::all_of(std::begin(bodies_), std::end(bodies_),
                       [&](const FuzzedBody& body) { return body.geom() != geom || body.is_sound(); });
  }

  void ask_pair(dGeomID g1, dGeomID g2) {
    const unsigned how = bytes_.byte();
    if ((how & 1U) != 0) std::swap(g1, g2);
    const int room = 1 + static_cast<int>((how >> 1U) % kRoom);
    snProximity answer{}, swapped{};
    const bool is_told = ask_gap(g1, g2, answer);
    expect(ask_gap(g2, g1, swapped) == is_told, "a pair is refused in both orders or in none");
    const Contacts contacts(g1, g2, room, (how & 0x80U) != 0);
    const Contacts turned(g2, g1, room, (how & 0x80U) != 0);
    const bool is_ray = dGeomGetClass(g1) == dRayClass || dGeomGetClass(g2) == dRayClass;
    if (!is_told) {
      // A ray may be longer than any body: it has hits, but no gap.
      expect(is_ray || contacts.count == 0, "no contacts where there is no gap");
      return;
    }
    if (!is_warm_) {
      expect(answer.gap == swapped.gap, "without warm start the gap is the same in both orders");
      expect(contacts.count == turned.count, "without warm start the contacts are the same in both orders");
    }
    // The depth of a ray's contact is no overlap.
    if (!is_ray && is_sound(g1) && is_sound(g2) && answer.converged == 1) compare(answer, contacts);
  }

  /// Contacts exist where the gap is negative, and have its depth.
  void compare(const snProximity& answer, const Contacts& contacts) const {
    const double slack = 2 * answer.error + 1e-13 * std::max(largest(answer.point1), largest(answer.point2));
    if (answer.gap > slack) expect(contacts.count == 0, "separated bodies have no contacts");
    if (answer.gap < -slack) expect(contacts.count > 0, "overlapping bodies have a contact");
    if (answer.gap >= 0 || is_warm_) return;
    expect(std::abs(contacts.depth() + answer.gap) <= slack, "the deepest contact is as deep as the overlap");
  }

  ByteReader& bytes_;
  FuzzedBody bodies_[2];
  dGeomID collider_ = nullptr;
  bool is_warm_ = true;
  bool has_asked_mass_ = false;
};

}  // namespace
}  // namespace supernormal::fuzz

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool is_ready = dInitODE2(0) != 0 && dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll)) != 0;
  supernormal::fuzz::expect(is_ready, "ODE is initialised");
  supernormal::fuzz::ByteReader bytes(data, size);
  supernormal::fuzz::Session(bytes).run();
  return 0;
}
