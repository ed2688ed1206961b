#include "shape.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "numbers.hpp"

namespace robot_model {

struct ShapeKind {
  const char* element;
  std::array<const char*, 2> keys;
  dGeomID (*create)(dSpaceID space, const double* size);
  void (*set_mass)(dMass* mass, double density, const double* size, dGeomID geom);
};

namespace {

void set_our_mass(dMass* mass, double density, const double* /*size*/, dGeomID geom) {
  if (snMassSet(mass, density, geom) == 0) throw std::runtime_error(snLastError());
}

// Both formats name the sizes alike.
constexpr std::array<ShapeKind, 7> kKinds = {{
    {"sphere",
     {"radius"},
     [](dSpaceID space, const double* size) { return dCreateSphere(space, size[0]); },
     [](dMass* mass, double density, const double* size, dGeomID) { dMassSetSphere(mass, density, size[0]); }},
    {"box",
     {"size"},
     [](dSpaceID space, const double* size) { return dCreateBox(space, size[0], size[1], size[2]); },
     [](dMass* mass, double density, const double* size, dGeomID) { dMassSetBox(mass, density, size[0], size[1], size[2]); }},
    {"cylinder",
     {"radius", "length"},
     [](dSpaceID space, const double* size) { return dCreateCylinder(space, size[0], size[1]); },
     [](dMass* mass, double density, const double* size, dGeomID) { dMassSetCylinder(mass, density, 3, size[0], size[1]); }},
    {"capsule",
     {"radius", "length"},
     [](dSpaceID space, const double* size) { return dCreateCapsule(space, size[0], size[1]); },
     [](dMass* mass, double density, const double* size, dGeomID) { dMassSetCapsule(mass, density, 3, size[0], size[1]); }},
    {"ellipsoid",
     {"radii"},
     [](dSpaceID space, const double* size) { return snCreateEllipsoid(space, size[0], size[1], size[2]); },
     set_our_mass},
    {"superellipsoid",
     {"radii", "exponents"},
     [](dSpaceID space, const double* size) { return snCreateSuperellipsoid(space, size[0], size[1], size[2], size[3], size[4]); },
     set_our_mass},
    {"plane", {"normal"}, nullptr, nullptr},
}};

std::string known_elements() {
  std::string names;
  for (const ShapeKind& kind : kKinds) names += (names.empty() ? "" : ", ") + std::string(kind.element);
  return names;
}

/// Null for an element that is not known.
const ShapeKind* find_kind(const std::string& element) {
  const std::string name = element.starts_with(kOurPrefix) ? element.substr(kOurPrefix.size()) : element;
  const auto* const found = std::ranges::find(kKinds, name, &ShapeKind::element);
  return found == kKinds.end() ? nullptr : found;
}

}  // namespace

Shape read_shape(const std::string& element, const TextOf& text_of, const std::string& where) {
  const ShapeKind* const kind = find_kind(element);
  if (kind == nullptr) throw std::runtime_error(where + ": <geometry> has <" + element + ">, must be one of " + known_elements());
  Shape shape{kind, {}};
  const std::string of_element = where + ": <" + element + ">";
  for (const char* const key : kind->keys) {
    if (key == nullptr) continue;
    const std::vector<double> numbers = read_numbers(key, text_of(key), of_element);
    shape.sizes.insert(shape.sizes.end(), numbers.begin(), numbers.end());
  }
  return shape;
}

bool is_known(const std::string& element) { return find_kind(element) != nullptr || element.starts_with(kOurPrefix); }

const char* name_of(const Shape& shape) { return shape.kind->element; }

bool is_plane(const Shape& shape) { return shape.kind->create == nullptr; }

dGeomID create(const Shape& shape, dSpaceID space, const std::string& where) {
  dGeomID geom = shape.kind->create(space, shape.sizes.data());
  if (geom == nullptr) throw std::runtime_error(where + ": " + snLastError());
  return geom;
}

dMass mass_of(const Shape& shape, dGeomID geom, double density) {
  dMass mass;
  shape.kind->set_mass(&mass, density, shape.sizes.data(), geom);
  return mass;
}

}  // namespace robot_model
