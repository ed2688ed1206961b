// The Python module supernormal._ode: the C interface. Geoms are numbers, as returned by _id() of PyODE.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "pyode_slots.hpp"
#include "python/core/numbers.hpp"
#include "supernormal/python/argument_errors.hpp"
#include "supernormal/shapes/description.hpp"
#include "supernormal/shapes/shape.hpp"
#include "supernormal/stepper.hpp"
#include "supernormal/supernormal.h"

namespace py = pybind11;

namespace supernormal::python {
namespace {

// PyODE returns pointers as integers.
using Number = std::uintptr_t;

// NOLINTBEGIN(performance-no-int-to-ptr): the integers were pointers
dGeomID geom(Number number) { return reinterpret_cast<dGeomID>(number); }
dSpaceID space(Number number) { return reinterpret_cast<dSpaceID>(number); }
dBodyID body(Number number) { return reinterpret_cast<dBodyID>(number); }
// NOLINTEND(performance-no-int-to-ptr)
Number number(dGeomID geom) { return reinterpret_cast<Number>(geom); }

dReal real(double value) { return static_cast<dReal>(value); }

/// Raises each error of the C interface as an exception with its message.
template <typename Result>
Result accepted(Result result) {
  if (result == Result{}) throw std::invalid_argument(snLastError());
  return result;
}

Vector3 to_vector(const dReal* v) { return {v[0], v[1], v[2]}; }

Number create_ellipsoid(Number s, const Vector3& axes) {
  return number(accepted(snCreateEllipsoid(space(s), real(axes.x()), real(axes.y()), real(axes.z()))));
}

Number create_superellipsoid(Number s, const Vector3& axes, double delta, double epsilon) {
  return number(
      accepted(snCreateSuperellipsoid(space(s), real(axes.x()), real(axes.y()), real(axes.z()), real(delta), real(epsilon))));
}

Number create_superovoid(Number s, const Vector3& axes, double delta, double epsilon, double taper_x, double taper_y) {
  return number(accepted(snCreateSuperovoid(space(s), real(axes.x()), real(axes.y()), real(axes.z()), real(delta), real(epsilon),
                                            real(taper_x), real(taper_y))));
}

using SharedShape = std::shared_ptr<Shape>;

const Shape& shape_of(const void* user) { return **static_cast<const SharedShape*>(user); }

dReal support(const void* user, const dReal* n) { return real(shape_of(user).support(to_vector(n))); }

void point(const void* user, const dReal* n, dReal* out) {
  const Vector3 r = shape_of(user).point(to_vector(n));
  for (int k = 0; k < 3; ++k) out[k] = real(r[k]);
}

void hessian(const void* user, const dReal* n, dReal* out) {
  const Matrix3 H = shape_of(user).jet(to_vector(n)).H;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) out[3 * row + column] = real(H(row, column));
  }
}

void release(void* user) { delete static_cast<SharedShape*>(user); }

/// Empty for a shape that is made of functions or of a program's class.
std::string text_of(const Shape& shape) {
  try {
    return describe(shape);
  } catch (const std::invalid_argument&) {
    return {};
  }
}

/// A shape that has a text keeps what it knows, such as its mass, which callbacks do not tell.
Number create_convex(Number s, const SharedShape& shape) {
  if (const std::string text = text_of(*shape); !text.empty()) {
    return number(accepted(snCreateFromDescription(space(s), text.c_str())));
  }
  auto user = std::make_unique<SharedShape>(shape);
  const snShape callbacks{&support, &point, shape->traits().has_hessian ? &hessian : nullptr, user.get(), &release};
  const dGeomID created = accepted(snCreateConvex(space(s), &callbacks));
  [[maybe_unused]] const SharedShape* const given_to_the_geom = user.release();
  return number(created);
}

void set_superellipsoid(Number g, const Vector3& axes, double delta, double epsilon) {
  accepted(snGeomSuperellipsoidSetParams(geom(g), real(axes.x()), real(axes.y()), real(axes.z()), real(delta), real(epsilon)));
}

auto get_superellipsoid(Number g) {
  std::array<dReal, 5> p{};
  accepted(snGeomSuperellipsoidGetParams(geom(g), &p[0], &p[1], &p[2], &p[3], &p[4]));
  return std::tuple(std::tuple(p[0], p[1], p[2]), p[3], p[4]);
}

void set_superovoid(Number g, const Vector3& axes, double delta, double epsilon, double taper_x, double taper_y) {
  accepted(snGeomSuperovoidSetParams(geom(g), real(axes.x()), real(axes.y()), real(axes.z()), real(delta), real(epsilon),
                                     real(taper_x), real(taper_y)));
}

auto get_superovoid(Number g) {
  std::array<dReal, 7> p{};
  accepted(snGeomSuperovoidGetParams(geom(g), &p[0], &p[1], &p[2], &p[3], &p[4], &p[5], &p[6]));
  return std::tuple(std::tuple(p[0], p[1], p[2]), p[3], p[4], p[5], p[6]);
}

double point_depth(Number g, const Vector3& p) {
  const double depth = snGeomPointDepth(geom(g), real(p.x()), real(p.y()), real(p.z()));
  if (std::isnan(depth)) throw std::invalid_argument(snLastError());
  return depth;
}

auto support_point(Number g, const Vector3& direction) {
  const dVector3 along = {real(direction.x()), real(direction.y()), real(direction.z()), 0};
  dVector3 found = {};
  accepted(snGeomSupport(geom(g), along, found));
  return std::tuple(found[0], found[1], found[2]);
}

/// Whether a new geom is unchanged: everything that a program can set is still as after dCreate….
bool is_untouched(Number g) {
  const dReal* const p = dGeomGetPosition(geom(g));
  const dReal* const R = dGeomGetRotation(geom(g));
  const bool is_placed = p[0] != 0 || p[1] != 0 || p[2] != 0 || R[0] != 1 || R[5] != 1 || R[10] != 1;
  const bool is_filtered =
      ~dGeomGetCategoryBits(geom(g)) != 0 || ~dGeomGetCollideBits(geom(g)) != 0 || dGeomIsEnabled(geom(g)) == 0;
  return !is_placed && !is_filtered && dGeomGetBody(geom(g)) == nullptr && dGeomGetSpace(geom(g)) == nullptr;
}

/// (mass, centre, (I11, I22, I33, I12, I13, I23)), in the order of ode.Mass.setParameters().
auto mass(Number g, double amount, bool is_total) {
  dMass m;
  accepted(is_total ? snMassSetTotal(&m, real(amount), geom(g)) : snMassSet(&m, real(amount), geom(g)));
  return std::tuple(m.mass, std::tuple(m.c[0], m.c[1], m.c[2]), std::tuple(m.I[0], m.I[5], m.I[10], m.I[1], m.I[2], m.I[6]));
}

/// The mesh of a geom; releases it in its destructor.
struct Mesh : snMesh {
  Mesh(Number g, double chord_error) : snMesh{} { accepted(snGeomTessellate(geom(g), real(chord_error), this)); }
  Mesh(const Mesh&) = delete;
  Mesh& operator=(const Mesh&) = delete;
  Mesh(Mesh&&) = delete;
  Mesh& operator=(Mesh&&) = delete;
  ~Mesh() { snMeshRelease(this); }
};

template <typename Number, typename Source>
py::array_t<Number> triples(const Source* from, int count) {
  py::array_t<Number> out({py::ssize_t{count}, py::ssize_t{3}});
  std::transform(from, from + 3 * count, out.mutable_data(), [](Source value) { return static_cast<Number>(value); });
  return out;
}

auto tessellation(Number g, double chord_error) {
  const Mesh mesh(g, chord_error);
  return std::tuple(triples<double>(mesh.position, mesh.points), triples<double>(mesh.normal, mesh.points),
                    triples<std::uint32_t>(mesh.index, mesh.triangles));
}

auto proximity(Number g1, Number g2, bool certified) {
  snProximity p{};
  accepted(certified ? snGeomProximityCertified(geom(g1), geom(g2), &p) : snGeomProximity(geom(g1), geom(g2), &p));
  const auto triple = [](const dReal* v) { return std::tuple(v[0], v[1], v[2]); };
  return std::tuple(p.gap, p.error, triple(p.normal), triple(p.point1), triple(p.point2), p.evaluations, p.converged != 0,
                    p.is_global != 0);
}

auto statistics() {
  snStatistics s{};
  snGetStatistics(&s);
  return std::tuple(s.queries_cold, s.queries_warm, s.evaluations_cold, s.evaluations_warm, s.closed_forms, s.contacts,
                    s.not_converged, s.stalled, s.out_of_evaluations, s.diverged, s.contacts_not_converged);
}

void bind_geoms(py::module_& m) {
  m.def("create_ellipsoid", &create_ellipsoid);
  m.def("create_superellipsoid", &create_superellipsoid);
  m.def("create_superovoid", &create_superovoid);
  m.def("create_convex", &create_convex);
  m.def("destroy", [](Number g) { dGeomDestroy(geom(g)); });
  m.def("is_untouched", &is_untouched);
  m.def("set_superellipsoid", &set_superellipsoid);
  m.def("get_superellipsoid", &get_superellipsoid);
  m.def("set_superovoid", &set_superovoid);
  m.def("get_superovoid", &get_superovoid);
  m.def("set_rounding", [](Number g, double radius) { accepted(snGeomSetRounding(geom(g), real(radius))); });
  m.def("point_depth", &point_depth);
  m.def("support_point", &support_point);
  m.def("mass", &mass);
  m.def("tessellate", &tessellation);
  m.def("proximity", &proximity);
}

std::vector<dGeomID> all_geoms(const std::vector<Number>& numbers) {
  std::vector<dGeomID> geoms;
  std::ranges::transform(numbers, std::back_inserter(geoms), geom);
  return geoms;
}

void bind_stepper(py::module_& m) {
  using ode::Stepper;
  m.def("body_of", [](Number g) { return reinterpret_cast<Number>(dGeomGetBody(geom(g))); });
  py::class_<Stepper>(m, "Stepper")
      .def(py::init([](Number of_the_world) { return Stepper(dBodyGetWorld(body(of_the_world))); }))
      .def("add_body", [](Stepper& stepper, Number b) { stepper.add_body(body(b)); })
      .def("remove_body", [](Stepper& stepper, Number b) { stepper.remove_body(body(b)); })
      .def("add_contact", [](Stepper& stepper, const py::handle& contact, py::ssize_t slot, Number body1,
                             Number body2) { stepper.add_contact(read_contact(contact, slot), body(body1), body(body2)); })
      .def("step", [](Stepper& stepper, double time) { return stepper.step(real(time)); })
      .def("moves", [](const Stepper& stepper, Number b) { return stepper.moves(body(b)); })
      .def("set_accuracy", [](Stepper& stepper, double sag, int least, int most) { stepper.set_accuracy(real(sag), least, most); })
      .def("save", [](const Stepper& stepper, const std::vector<Number>& geoms) { return stepper.save(all_geoms(geoms)); })
      .def("load", [](Stepper& stepper, const std::vector<Number>& geoms,
                      const std::vector<double>& numbers) { stepper.load(all_geoms(geoms), numbers); })
      .def("contact_force", [](const Stepper& stepper, int contact) {
        const Vector3 force = stepper.contact_force(contact);
        return std::tuple(force.x(), force.y(), force.z());
      });
}

void bind_library(py::module_& m) {
  m.def("geom_class", [] {
    accepted(snInit());
    return snGeomClass();
  });
  m.def("last_error", [] { return std::string(snLastError()); });
  m.def("set_solver", [](Number g, int solver, double tolerance, int max_evaluations) {
    accepted(snGeomSetSolver(geom(g), static_cast<snSolver>(solver), real(tolerance), max_evaluations));
  });
  m.def("set_default_solver", [](int solver, double tolerance, int max_evaluations) {
    accepted(snSetDefaultSolver(static_cast<snSolver>(solver), real(tolerance), max_evaluations));
  });
  m.def("set_look_ahead", [](Number g, double time) { accepted(snGeomSetLookAhead(geom(g), real(time))); });
  m.def("set_default_look_ahead", [](double time) { accepted(snSetDefaultLookAhead(real(time))); });
  m.def("set_warm_start", [](bool on) { snSetWarmStart(on ? 1 : 0); });
  m.def("statistics", &statistics);
  m.def("reset_statistics", &snResetStatistics);
}

}  // namespace
}  // namespace supernormal::python

PYBIND11_MODULE(_ode, m) {
  m.doc() = "The C interface, with geoms and spaces as numbers. Import `supernormal.ode` instead; it has classes.";
  py::module_::import("supernormal._core");  // registers Shape
  supernormal::python::bind_geoms(m);
  supernormal::python::bind_library(m);
  supernormal::python::bind_stepper(m);
  supernormal::python::bind_slots(m);
  supernormal::python::guard(m);
}
