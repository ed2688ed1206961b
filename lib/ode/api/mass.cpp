// Computes a dMass from the volume integrals of the body.
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/validation.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {
namespace {

// Rounding error of a centre of mass by quadrature, in ulps of the largest half-extent. A few ulps are observed.
constexpr double kCentroidUnits = 64;

/// The volume integrals of a geom, which are accurate enough.
MassProperties usable_integrals(const Shape& shape) {
  const MassProperties properties = shape.mass_properties();
  require_known(properties, "the geom (give ODE the mass of such a body by dMassSetParameters)");
  const bool finite = properties.centroid.allFinite() && properties.second_moment.allFinite();
  if (finite && properties.volume > 0 && std::isfinite(properties.volume)) return properties;
  throw std::invalid_argument("the volume of the geom is " + to_text(properties.volume) + " m^3, but must be in (0, inf)");
}

// dBodySetMass aborts when the centre of mass is 2e-16 m from the origin, whatever the size of the body. A centre within rounding
// of the origin is therefore set to the origin.
Vector3 without_rounding(const Vector3& centroid, const Shape& shape) {
  const double rounding = kCentroidUnits * std::numeric_limits<double>::epsilon() * shape.half_extents().maxCoeff();
  return centroid.cwiseAbs().maxCoeff() <= rounding ? Vector3(0, 0, 0) : centroid;
}

// The inertia tensor of ODE is about the origin of the frame in which the centre of mass is given, not about the centre of mass
// (see dMassTranslate and dMassCheck). It is tr(S) 1 - S with the second moment S about the origin.
void set_mass(dMass* mass, const Shape& shape, const MassProperties& properties, double density) {
  const Matrix3& S = properties.second_moment;
  const Matrix3 inertia = density * (S.trace() * Matrix3::Identity() - S);
  const Vector3 c = without_rounding(properties.centroid, shape);
  dMass result;
  dMassSetParameters(&result, to_real(density * properties.volume), to_real(c.x()), to_real(c.y()), to_real(c.z()),
                     to_real(inertia(0, 0)), to_real(inertia(1, 1)), to_real(inertia(2, 2)), to_real(inertia(0, 1)),
                     to_real(inertia(0, 2)), to_real(inertia(1, 2)));
  // dMassCheck accepts infinite values; refuse them here.
  const bool is_finite =
      std::isfinite(result.mass) && std::isfinite(result.I[0]) && std::isfinite(result.I[5]) && std::isfinite(result.I[10]);
  if (!is_finite || dMassCheck(&result) == 0) {
    throw std::invalid_argument("mass = " + to_text(result.mass) +
                                " kg: ODE does not accept it (dMassCheck), or a moment of inertia is " +
                                "not finite: too small, too large or too heavy a body");
  }
  *mass = result;
}

}  // namespace
}  // namespace supernormal::ode

using namespace supernormal::ode;

extern "C" int snMassSet(dMass* mass, dReal density, dGeomID geom) {
  return succeeds("snMassSet", [&] {
    require_not_null("mass", mass);
    require_positive("density", density, "kg/m^3");
    const auto& shape = require_body(geom).shape();
    set_mass(mass, shape, usable_integrals(shape), density);
  });
}

extern "C" int snMassSetTotal(dMass* mass, dReal total_mass, dGeomID geom) {
  return succeeds("snMassSetTotal", [&] {
    require_not_null("mass", mass);
    require_positive("total_mass", total_mass, "kg");
    const auto& shape = require_body(geom).shape();
    const auto properties = usable_integrals(shape);
    set_mass(mass, shape, properties, total_mass / properties.volume);
  });
}
