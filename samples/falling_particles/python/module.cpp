// The Python module supernormal._scenes: runs of falling_particles.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "advise/doubts.hpp"
#include "advise/forecast.hpp"
#include "advise/refusals.hpp"
#include "columns.hpp"
#include "common/input_error.hpp"
#include "observe/energy.hpp"
#include "observe/measuring.hpp"
#include "open_world.hpp"
#include "supernormal/python/argument_errors.hpp"

namespace py = pybind11;

namespace falling_particles::python {
namespace {

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
