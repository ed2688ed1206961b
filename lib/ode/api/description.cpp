// Bodies as text, and copies.
#include "supernormal/shapes/description.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "ode/api/registration.hpp"
#include "ode/geom/body.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {
namespace {

void copy_geom(dGeomID from, dGeomID to) {
  const dReal* const position = dGeomGetPosition(from);
  dGeomSetPosition(to, position[0], position[1], position[2]);
  dGeomSetRotation(to, dGeomGetRotation(from));
  dGeomSetCategoryBits(to, dGeomGetCategoryBits(from));
  dGeomSetCollideBits(to, dGeomGetCollideBits(from));
  if (dGeomIsEnabled(from) == 0) dGeomDisable(to);
}

}  // namespace
}  // namespace supernormal::ode

using namespace supernormal;
using namespace supernormal::ode;

extern "C" int snGeomDescribe(dGeomID geom, char* text, int capacity) {
  return guarded("snGeomDescribe", -1, [&] {
    const std::string whole = describe(require_body(geom).shape());
    if (whole.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      throw std::length_error("the text has more characters than an int counts");
    }
    const int length = static_cast<int>(whole.size());
    if (capacity < 0) throw std::invalid_argument("capacity = " + std::to_string(capacity) + ", but must be at least 0");
    if (capacity == 0) return length;
    require_not_null("text", text);
    *std::copy_n(whole.data(), std::min(length, capacity - 1), text) = '\0';
    return length;
  });
}

extern "C" dGeomID snCreateFromDescription(dSpaceID space, const char* text) {
  return guarded("snCreateFromDescription", dGeomID{}, [&] {
    require_not_null("text", text);
    return create_geom(space, Body::of(read_shape(text)));
  });
}

extern "C" dGeomID snGeomCopy(dSpaceID space, dGeomID geom) {
  return guarded("snGeomCopy", dGeomID{}, [&] {
    require_space(space);
    const dGeomID copy = create_geom(nullptr, require_body(geom).copy());
    copy_geom(geom, copy);
    if (space != nullptr) dSpaceAdd(space, copy);
    return copy;
  });
}
