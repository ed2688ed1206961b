#include "pyode_slots.hpp"

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

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

/// The offset of the one word of `object`, behind the header of all objects, that is `word`.
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

/// `geom`: one of PyODE's own, in `space`, with the number `number`. Returns the offsets of the geom's number and of the space.
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

}  // namespace

void bind_slots(py::module_& m) {
  m.def("find_slots", &find_slots);
  m.def("adopt", &adopt);
  m.def("number_of",
        [](const py::handle& geom, std::pair<py::ssize_t, py::ssize_t> slots) { return read_word(geom, slots.first); });
}

}  // namespace supernormal::python
