#include "pyode_slots.hpp"

#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "supernormal/supernormal.h"

namespace py = pybind11;

namespace supernormal::python {
namespace {

using Word = std::uintptr_t;

Word read_word(const py::handle& object, py::ssize_t offset) {
  Word word = 0;
  std::memcpy(&word, reinterpret_cast<const char*>(object.ptr()) + offset, sizeof word);
  return word;
}

void write_word(const py::handle& object, py::ssize_t offset, Word word) {
  std::memcpy(reinterpret_cast<char*>(object.ptr()) + offset, &word, sizeof word);
}

/// The offset of `word` in `object`, after the object header. Throws unless it occurs exactly once.
py::ssize_t find_word(const py::handle& object, Word word, const char* what) {
  py::ssize_t found = 0;
  const py::ssize_t size = Py_TYPE(object.ptr())->tp_basicsize;
  for (auto offset = static_cast<py::ssize_t>(sizeof(PyObject)); offset + static_cast<py::ssize_t>(sizeof word) <= size;
       offset += static_cast<py::ssize_t>(sizeof word)) {
    if (read_word(object, offset) != word) continue;
    if (found != 0) throw py::import_error(std::string("this PyODE is unknown: a geom holds ") + what + " in two places");
    found = offset;
  }
  if (found == 0) throw py::import_error(std::string("this PyODE is unknown: a geom does not hold ") + what);
  return found;
}

/// `geom` is a PyODE geom in `space` with the number `number`. Returns the offsets of its number and of its space.
std::pair<py::ssize_t, py::ssize_t> find_slots(const py::handle& geom, Word number, const py::handle& space) {
  return {find_word(geom, number, "its dGeomID"), find_word(geom, reinterpret_cast<Word>(space.ptr()), "its space")};
}

void adopt(const py::handle& geom, std::pair<py::ssize_t, py::ssize_t> slots, Word number, const py::object& space) {
  const auto [number_slot, space_slot] = slots;
  write_word(geom, number_slot, number);
  const Word before = read_word(geom, space_slot);
  write_word(geom, space_slot, reinterpret_cast<Word>(py::object(space).release().ptr()));
  py::handle(reinterpret_cast<PyObject*>(before)).dec_ref();  // NOLINT(performance-no-int-to-ptr): a pointer was read as a word
}

/// `contact` has parameters that all differ, in `surface` and `geom`. Returns the offset of its dContact, which is its last member.
py::ssize_t find_contact(const py::handle& contact, double mu, double motion2, double depth, std::array<double, 3> fdir1) {
  const auto offset = Py_TYPE(contact.ptr())->tp_basicsize - static_cast<py::ssize_t>(sizeof(dContact));
  const auto is = [](dReal held, double wanted) { return held == static_cast<dReal>(wanted); };
  if (offset >= static_cast<py::ssize_t>(sizeof(PyObject))) {
    const dContact held = read_contact(contact, offset);
    if (is(held.surface.mu, mu) && is(held.surface.motion2, motion2) && is(held.geom.depth, depth) && is(held.fdir1[0], fdir1[0]) &&
        is(held.fdir1[1], fdir1[1]) && is(held.fdir1[2], fdir1[2])) {
      return offset;
    }
  }
  throw py::import_error("this PyODE is unknown: a contact does not hold its dContact last");
}

void look_ahead(const py::handle& contact, py::ssize_t offset, double step) {
  const auto duration = static_cast<dReal>(step);
  dContact held = read_contact(contact, offset);
  dContact probe{};
  probe.geom.depth = -1;
  probe.surface.mode = held.surface.mode & dContactBounce;
  probe.surface.bounce = held.surface.bounce;
  snContactLookAhead(&probe, duration);
  if (probe.geom.depth < 0) throw std::invalid_argument(snLastError());
  snContactLookAhead(&held, duration);
  std::memcpy(reinterpret_cast<char*>(contact.ptr()) + offset, &held, sizeof held);
}

}  // namespace

dContact read_contact(const py::handle& contact, py::ssize_t offset) {
  dContact held;
  std::memcpy(&held, reinterpret_cast<const char*>(contact.ptr()) + offset, sizeof held);
  return held;
}

void bind_slots(py::module_& m) {
  m.def("find_slots", &find_slots);
  m.def("adopt", &adopt);
  m.def("find_contact", &find_contact);
  m.def("contact_look_ahead", &look_ahead);
  m.def("number_of",
        [](const py::handle& geom, std::pair<py::ssize_t, py::ssize_t> slots) { return read_word(geom, slots.first); });
}

}  // namespace supernormal::python
