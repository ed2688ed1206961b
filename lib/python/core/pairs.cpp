#include "pairs.hpp"

#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

bool is_power_body(const Shape& shape) {
  return dynamic_cast<const Superellipsoid*>(&shape) != nullptr || dynamic_cast<const Ellipsoid*>(&shape) != nullptr;
}

}  // namespace

Pairs::Pairs(const py::object& shapes1, const py::object& poses1, const py::object& shapes2, const py::object& poses2,
             const std::optional<Doubles>& first_normals)
    : shapes1_("shapes1", shapes1, count_),
      poses1_("poses1", poses1, count_),
      shapes2_("shapes2", shapes2, count_),
      poses2_("poses2", poses2, count_) {
  if (first_normals) first_.emplace("first_normals", *first_normals, count_);
}

ProximityQuery Pairs::query(std::ptrdiff_t i, Vector3& first) const {
  if (first_) first = require_direction(first_->name(i), (*first_)[i]);
  return {&shapes1_[i], &poses1_[i], &shapes2_[i], &poses2_[i], first_ ? &first : nullptr};
}

bool Pairs::is_cheaper_together(const ProximityQuery& query) {
  return is_power_body(*query.shape1) && is_power_body(*query.shape2);
}

}  // namespace supernormal::python
