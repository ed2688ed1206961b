#include "columns.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <supernormal/shapes/description.hpp>
#include <variant>

#include "model/grain_shape.hpp"
#include "world/to_vector.hpp"

namespace py = pybind11;

namespace falling_particles::python {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// An array of `count` rows of kWidth numbers each, or of `count` numbers.
template <typename Number, std::size_t kWidth = 1>
class Column {
 public:
  explicit Column(std::size_t count) : array_(shape_of(count)) {}

  Number& operator[](std::size_t row) { return array_.mutable_data()[row]; }
  template <typename Values>
  void set(std::size_t row, const Values& values) {
    for (std::size_t k = 0; k < kWidth; ++k) array_.mutable_data()[row * kWidth + k] = values[k];
  }
  void set_none(std::size_t row) { std::fill_n(array_.mutable_data() + row * kWidth, kWidth, kNone); }
  const py::array_t<Number>& array() const { return array_; }

 private:
  static std::vector<py::ssize_t> shape_of(std::size_t count) {
    std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(count)};
    if (kWidth > 1) shape.push_back(kWidth);
    return shape;
  }
  py::array_t<Number> array_;
};
using Indices = Column<std::int64_t>;
using Flags = Column<bool>;
using Scalars = Column<double>;
using Vectors3 = Column<double, 3>;
using Quaternions = Column<double, 4>;

Point values_of(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

struct ContactColumns {
  explicit ContactColumns(std::size_t count)
      : grain1(count), grain2(count), wall(count), position(count), normal(count), depth(count), force(count) {}

  void set(std::size_t row, const dContactGeom& contact, const Point* measured, const World& world) {
    const bool is_swapped = grain_of(contact.g1) == nullptr;
    const double sign = is_swapped ? -1 : 1;
    const dGeomID other = is_swapped ? contact.g1 : contact.g2;
    const Wall* const solid = world.walls().wall_of(other);
    grain1[row] = static_cast<std::int64_t>(world.index_of(*grain_of(is_swapped ? contact.g2 : contact.g1)));
    grain2[row] = solid != nullptr ? -1 : static_cast<std::int64_t>(world.index_of(*grain_of(other)));
    wall[row] = solid == nullptr ? -1 : solid - world.scene().walls.data();
    position.set(row, contact.pos);
    normal.set(row, values_of(sign * to_vector(contact.normal)));
    depth[row] = contact.depth;
    if (measured == nullptr) {
      force.set_none(row);
    } else {
      force.set(row, Point{sign * (*measured)[0], sign * (*measured)[1], sign * (*measured)[2]});
    }
  }

  Indices grain1, grain2, wall;
  Vectors3 position, normal;
  Scalars depth;
  Vectors3 force;
};

py::dict in_a_dictionary(const ContactColumns& columns) {
  py::dict fields;
  fields["grain1"] = columns.grain1.array();
  fields["grain2"] = columns.grain2.array();
  fields["wall"] = columns.wall.array();
  fields["position"] = columns.position.array();
  fields["normal"] = columns.normal.array();
  fields["depth"] = columns.depth.array();
  fields["force"] = columns.force.array();
  return fields;
}

}  // namespace

py::dict grains_of(const StepwiseRun& run) {
  const World& world = run.simulation().world;
  const std::vector<Grain>& grains = world.grains();
  const std::size_t count = grains.size();
  Indices kind(count);
  Flags is_present(count), is_awake(count);
  Scalars scale(count), mass(count), volume(count);
  Vectors3 position(count), velocity(count), angular_velocity(count);
  Quaternions quaternion(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Grain& grain = grains[i];
    kind[i] = static_cast<std::int64_t>(run.scene().kind_of(*grain.kind));
    scale[i] = grain.scale;
    mass[i] = grain.mass.mass;
    volume[i] = grain.volume();
    is_present[i] = grain.is_present();
    is_awake[i] = grain.is_present() && dBodyIsEnabled(grain.body) != 0;
    if (!grain.is_present()) {
      for (Vectors3* column : {&position, &velocity, &angular_velocity}) column->set_none(i);
      quaternion.set_none(i);
      continue;
    }
    position.set(i, grain.position());
    quaternion.set(i, grain.quaternion());
    velocity.set(i, dBodyGetLinearVel(grain.body));
    angular_velocity.set(i, dBodyGetAngularVel(grain.body));
  }
  py::dict fields;
  fields["kind"] = kind.array();
  fields["is_present"] = is_present.array();
  fields["is_awake"] = is_awake.array();
  fields["scale"] = scale.array();
  fields["mass"] = mass.array();
  fields["volume"] = volume.array();
  fields["position"] = position.array();
  fields["quaternion"] = quaternion.array();
  fields["velocity"] = velocity.array();
  fields["angular_velocity"] = angular_velocity.array();
  return fields;
}

py::dict contacts_of(const StepwiseRun& run) {
  const World& world = run.simulation().world;
  const Stepper& stepper = run.simulation().stepper;
  if (!run.measures_forces()) {
    const std::vector<dContactGeom>& contacts = stepper.contact_geoms();
    ContactColumns columns(contacts.size());
    for (std::size_t i = 0; i < contacts.size(); ++i) columns.set(i, contacts[i], nullptr, world);
    return in_a_dictionary(columns);
  }
  ContactColumns columns(stepper.measured_contacts().size());
  std::size_t row = 0;
  for (const MeasuredContact& contact : stepper.measured_contacts()) {
    const Point force = contact.force();
    columns.set(row++, contact.geom, &force, world);
  }
  return in_a_dictionary(columns);
}

py::dict walls_of(const StepwiseRun& run) {
  const WallBodies& walls = run.simulation().world.walls();
  py::list names;
  Vectors3 position(walls.count()), normal(walls.count()), velocity(walls.count()), angular_velocity(walls.count());
  Quaternions quaternion(walls.count());
  for (std::size_t i = 0; i < walls.count(); ++i) {
    const WallState state = walls.state(i);
    const Eigen::Quaterniond& q = state.pose.rotation;
    names.append(walls.wall(i).name);
    position.set(i, values_of(state.pose.position));
    quaternion.set(i, std::array{q.w(), q.x(), q.y(), q.z()});
    if (const auto* const plane = std::get_if<PlaneShape>(&walls.wall(i).shape)) {
      normal.set(i, values_of(q * plane->normal));
    } else {
      normal.set_none(i);
    }
    velocity.set(i, values_of(state.velocity.linear));
    angular_velocity.set(i, values_of(state.velocity.angular));
  }
  py::dict fields;
  fields["name"] = py::tuple(names);
  fields["position"] = position.array();
  fields["quaternion"] = quaternion.array();
  fields["normal"] = normal.array();
  fields["velocity"] = velocity.array();
  fields["angular_velocity"] = angular_velocity.array();
  return fields;
}

py::list kinds_of(const Scene& scene) {
  py::list kinds;
  for (const GrainCount& entry : scene.kinds) {
    py::list components;
    for (const Component& component : entry.kind.all_components()) {
      components.append(py::make_tuple(supernormal::describe(*shape_of(component.body)), component.position, component.quaternion));
    }
    py::dict fields;
    fields["name"] = entry.kind.name;
    fields["count"] = entry.count;
    fields["density"] = entry.kind.density;
    fields["mass"] = mass_of(entry.kind);
    fields["bounding_radius"] = entry.kind.bounding_radius();
    fields["components"] = components;
    kinds.append(fields);
  }
  return kinds;
}

}  // namespace falling_particles::python
