// The Python module supernormal._scenes: runs of falling_particles.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <supernormal/shapes/description.hpp>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "advise/doubts.hpp"
#include "advise/forecast.hpp"
#include "advise/refusals.hpp"
#include "common/input_error.hpp"
#include "model/grain_shape.hpp"
#include "observe/energy.hpp"
#include "observe/measuring.hpp"
#include "open_world.hpp"
#include "supernormal/python/argument_errors.hpp"
#include "world/grain.hpp"

namespace py = pybind11;

namespace falling_particles::python {
namespace {

constexpr Point kNone = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(),
                         std::numeric_limits<double>::quiet_NaN()};

/// An array of of(row), a number or a std::array of numbers, for each row.
template <typename Rows, typename Of>
py::array column(const Rows& rows, const Of& of) {
  using Value = std::decay_t<std::invoke_result_t<Of, std::ranges::range_value_t<const Rows&>>>;
  const auto count = static_cast<py::ssize_t>(std::ranges::size(rows));
  if constexpr (std::is_arithmetic_v<Value>) {
    py::array_t<Value> array(count);
    std::ranges::transform(rows, array.mutable_data(), of);
    return array;
  } else {
    py::array_t<double> array({count, static_cast<py::ssize_t>(std::tuple_size_v<Value>)});
    double* next = array.mutable_data();
    for (const auto& row : rows) next = std::ranges::copy(std::invoke(of, row), next).out;
    return array;
  }
}

std::array<double, 4> values_of(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

/// A contact whose first body is a grain.
struct ContactRow {
  std::int64_t grain1, grain2, wall;  // -1 for none
  Point position, normal;
  double depth;
  Point force;
};

ContactRow row_of(const dContactGeom& contact, const std::optional<Point>& force, const World& world) {
  const bool is_swapped = grain_of(contact.g1) == nullptr;
  const double sign = is_swapped ? -1 : 1;
  const auto [geom, other] = is_swapped ? std::pair(contact.g2, contact.g1) : std::pair(contact.g1, contact.g2);
  const Wall* const wall = world.walls().wall_of(other);
  return {static_cast<std::int64_t>(world.index_of(*grain_of(geom))),
          wall != nullptr ? -1 : static_cast<std::int64_t>(world.index_of(*grain_of(other))),
          wall == nullptr ? -1 : wall - world.scene().walls.data(),
          to_point(contact.pos),
          to_point(sign * to_vector(contact.normal)),
          contact.depth,
          force ? to_point(sign * to_vector(*force)) : kNone};
}

// Each function of a run returns arrays by the names of the fields of the classes in scenes.py, where units and frames are.

py::dict grains_of(const StepwiseRun& run) {
  const std::vector<Grain>& grains = run.simulation().world.grains();
  const auto vectors = [&](Point (Grain::*of)() const) {
    return column(grains, [of](const Grain& grain) { return grain.is_present() ? (grain.*of)() : kNone; });
  };
  py::dict fields;
  fields["kind"] = column(grains, [&](const Grain& grain) { return static_cast<std::int64_t>(run.scene().kind_of(*grain.kind)); });
  fields["is_present"] = column(grains, &Grain::is_present);
  fields["is_awake"] = column(grains, [](const Grain& grain) { return grain.is_present() && dBodyIsEnabled(grain.body) != 0; });
  fields["scale"] = column(grains, &Grain::scale);
  fields["mass"] = column(grains, [](const Grain& grain) { return double{grain.mass.mass}; });
  fields["volume"] = column(grains, &Grain::volume);
  fields["position"] = vectors(&Grain::position);
  fields["quaternion"] = column(grains, [](const Grain& grain) {
    return grain.is_present() ? grain.quaternion() : std::array{kNone[0], kNone[0], kNone[0], kNone[0]};
  });
  fields["velocity"] = vectors(&Grain::velocity);
  fields["angular_velocity"] = vectors(&Grain::angular_velocity);
  return fields;
}

py::dict contacts_of(const StepwiseRun& run) {
  const World& world = run.simulation().world;
  const Stepper& stepper = run.simulation().stepper;
  std::vector<ContactRow> rows;
  if (run.measures_forces()) {
    for (const MeasuredContact& contact : stepper.measured_contacts()) rows.push_back(row_of(contact.geom, contact.force(), world));
  } else {
    for (const dContactGeom& contact : stepper.contact_geoms()) rows.push_back(row_of(contact, std::nullopt, world));
  }
  py::dict fields;
  fields["grain1"] = column(rows, &ContactRow::grain1);
  fields["grain2"] = column(rows, &ContactRow::grain2);
  fields["wall"] = column(rows, &ContactRow::wall);
  fields["position"] = column(rows, &ContactRow::position);
  fields["normal"] = column(rows, &ContactRow::normal);
  fields["depth"] = column(rows, &ContactRow::depth);
  fields["force"] = column(rows, &ContactRow::force);
  return fields;
}

py::dict walls_of(const StepwiseRun& run) {
  const WallBodies& walls = run.simulation().world.walls();
  std::vector<std::size_t> indices(walls.count());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  const auto normal_of = [&](std::size_t i) {
    const auto* const plane = std::get_if<PlaneShape>(&walls.wall(i).shape);
    return plane == nullptr ? kNone : to_point(walls.state(i).pose.rotation * plane->normal);
  };
  py::list names;
  for (const std::size_t i : indices) names.append(walls.wall(i).name);
  py::dict fields;
  fields["name"] = py::tuple(names);
  fields["position"] = column(indices, [&](std::size_t i) { return to_point(walls.state(i).pose.position); });
  fields["quaternion"] = column(indices, [&](std::size_t i) { return values_of(walls.state(i).pose.rotation); });
  fields["normal"] = column(indices, normal_of);
  fields["velocity"] = column(indices, [&](std::size_t i) { return to_point(walls.state(i).velocity.linear); });
  fields["angular_velocity"] = column(indices, [&](std::size_t i) { return to_point(walls.state(i).velocity.angular); });
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

using Vectors = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Throws std::invalid_argument unless there is a vector for each grain.
void require_vectors(const std::string& name, const Vectors& vectors, std::size_t count) {
  if (vectors.ndim() != 2 || vectors.shape(1) != 3 || static_cast<std::size_t>(vectors.shape(0)) != count) {
    std::string shape;
    for (py::ssize_t axis = 0; axis < vectors.ndim(); ++axis) shape += (axis > 0 ? ", " : "") + std::to_string(vectors.shape(axis));
    throw std::invalid_argument(name + " has the shape (" + shape + "), but must have (" + std::to_string(count) +
                                ", 3): a row for each grain so far");
  }
}

void set_forces(OpenWorld& world, const Vectors& forces, const Vectors& torques) {
  const std::size_t count = world.run("set_forces").simulation().world.grains().size();
  require_vectors("forces", forces, count);
  require_vectors("torques", torques, count);
  std::vector<Push> pushes(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      pushes[i].force[k] = forces.data()[3 * i + k];
      pushes[i].torque[k] = torques.data()[3 * i + k];
    }
  }
  world.set_pushes(std::move(pushes));
}

auto energies_of(OpenWorld& world) {
  const StepwiseRun& run = world.run("energy");
  const Energy energy = measure_energy(run.simulation().world, run.scene());
  return py::make_tuple(energy.kinetic, energy.potential);
}

py::object first_leak(OpenWorld& world) {
  const LeakWatch& leaks = world.run("first_leak").simulation().watches.leaks;
  return leaks.first() ? py::object(py::str(describe(*leaks.first()))) : py::none();
}

py::dict fields_of(const Scene& scene) {
  py::dict fields;
  fields["name"] = scene.name;
  fields["seed"] = scene.seed;
  fields["time_step"] = scene.time.step;
  fields["steps"] = scene.time.steps();
  fields["kinds"] = kinds_of(scene);
  return fields;
}

void bind_source(py::module_& m) {
  py::class_<Source>(m, "Source")
      .def(py::init(&Source::of), py::arg("path"), py::arg("text"), py::arg("values"))
      .def("fields", [](const Source& source) { return fields_of(source.scene()); })
      .def("check",
           [](const Source& source) {
             return about(source.scene(), [](const Scene& scene) {
               refuse_bad_start(scene);
               return describe(scene, forecast(scene));
             });
           })
      .def("tables", [](const Source& source) { return about(source.scene(), &tables_of); })
      .def("doubts", [](const Source& source) {
        std::vector<std::string> doubts;
        about(source.scene(), [&doubts](const Scene& scene) {
          refuse_bad_start(scene);
          doubts = doubts_about(scene);
          return std::string();
        });
        return doubts;
      });
}

void bind_world(py::module_& m) {
  py::class_<OpenWorld>(m, "World")
      .def(py::init([](const Source& source, std::optional<std::string> out, int threads, bool pictures, int checkpoint_every,
                       bool resume) {
             return std::make_unique<OpenWorld>(source, Options{std::move(out), threads, pictures, checkpoint_every, resume});
           }),
           py::arg("source"), py::arg("out"), py::arg("threads"), py::arg("pictures"), py::arg("checkpoint_every"),
           py::arg("resume"))
      .def("step", &OpenWorld::step, py::arg("count"), py::arg("forces"))
      .def("change", &OpenWorld::change, py::arg("values"))
      .def("set_forces", &set_forces, py::arg("forces"), py::arg("torques"))
      .def("finish", &OpenWorld::finish, py::arg("draw"))
      .def("close", &OpenWorld::close)
      .def("grains", [](OpenWorld& world) { return grains_of(world.run("grains")); })
      .def("contacts", [](OpenWorld& world) { return contacts_of(world.run("contacts")); })
      .def("walls", [](OpenWorld& world) { return walls_of(world.run("walls")); })
      .def("energy", &energies_of)
      .def("steps_done", [](OpenWorld& world) { return world.run("steps_done").step(); })
      .def("time", [](OpenWorld& world) { return world.run("time").time(); })
      .def("first_leak", &first_leak)
      .def("summary", [](OpenWorld& world) { return world.run("summary").summary(); })
      .def("is_closed", &OpenWorld::is_closed)
      .def("is_finished", &OpenWorld::is_finished)
      .def("has_files", &OpenWorld::has_files);
}

}  // namespace
}  // namespace falling_particles::python

PYBIND11_MODULE(_scenes, m) {
  m.doc() = "Runs of falling_particles. Import `supernormal.scenes` instead; it has classes.";
  py::register_local_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(std::move(error));
    } catch (const falling_particles::InputError& input) {
      std::string text = input.what();
      if (text.starts_with("--set ")) text.replace(0, 6, "values: ");
      PyErr_SetString(PyExc_ValueError, text.c_str());
    }
  });
  falling_particles::python::bind_source(m);
  falling_particles::python::bind_world(m);
  supernormal::python::guard(m);
}
