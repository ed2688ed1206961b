#include "values.hpp"

namespace py = pybind11;

namespace supernormal::python {

std::string call_text(const py::handle& self, const std::vector<const char*>& names, const py::tuple& arguments) {
  std::string text = py::type::of(self).attr("__name__").cast<std::string>() + "(";
  for (std::size_t k = 0; k < names.size(); ++k) {
    text += std::string(k > 0 ? ", " : "") + names[k] + "=" + py::repr(arguments[k]).cast<std::string>();
  }
  return text + ")";
}

std::string call_text(const py::handle& self, std::size_t count, const char* what) {
  return py::type::of(self).attr("__name__").cast<std::string>() + "(of " + std::to_string(count) + " " + what + ")";
}

py::dict attributes_of(const py::handle& self) { return py::getattr(self, "__dict__", py::dict()); }

}  // namespace supernormal::python
