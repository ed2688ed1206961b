#include "shape.hpp"

#include <array>
#include <cstddef>
#include <sstream>
#include <stdexcept>

namespace robot_model {

struct Key {
  const char* name;
  std::size_t count;
};

struct ShapeKind {
  const char* element;
  std::array<Key, 2> keys;
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
     {{{"radius", 1}, {nullptr, 0}}},
     [](dSpaceID space, const double* size) { return dCreateSphere(space, size[0]); },
     [](dMass* mass, double density, const double* size, dGeomID) { dMassSetSphere(mass, density, size[0]); }},
    {"box",
     {{{"size", 3}, {nullptr, 0}}},
     [](dSpaceID space, const double* size) { return dCreateBox(space, size[0], size[1], size[2]); },
     [](dMass* mass, double density, const double* size, dGeomID) { dMassSetBox(mass, density, size[0], size[1], size[2]); }},
    {"cylinder",
     {{{"radius", 1}, {"length", 1}}},
     [](dSpaceID space, const double* size) { return dCreateCylinder(space, size[0], size[1]); },
     [](dMass* mass, double density, const double* size, dGeomID) { dMassSetCylinder(mass, density, 3, size[0], size[1]); }},
    {"capsule",
     {{{"radius", 1}, {"length", 1}}},
     [](dSpaceID space, const double* size) { return dCreateCapsule(space, size[0], size[1]); },
     [](dMass* mass, double density, const double* size, dGeomID) { dMassSetCapsule(mass, density, 3, size[0], size[1]); }},
    {"ellipsoid",
     {{{"radii", 3}, {nullptr, 0}}},
     [](dSpaceID space, const double* size) { return snCreateEllipsoid(space, size[0], size[1], size[2]); },
     set_our_mass},
    {"superellipsoid",
     {{{"radii", 3}, {"exponents", 2}}},
     [](dSpaceID space, const double* size) { return snCreateSuperellipsoid(space, size[0], size[1], size[2], size[3], size[4]); },
     set_our_mass},
    {"plane", {{{"normal", 3}, {nullptr, 0}}}, nullptr, nullptr},
}};

std::string known_elements() {
  std::string names;
  for (const ShapeKind& kind : kKinds) names += (names.empty() ? "" : ", ") + std::string(kind.element);
  return names;
}

/// All numbers of a text; none if there is anything else in it.
std::vector<double> numbers_in(const std::string& text) {
  std::istringstream in(text);
  std::vector<double> numbers;
  for (double number = 0; in >> number;) numbers.push_back(number);
  if (!in.eof()) numbers.clear();
  return numbers;
}

[[noreturn]] void refuse_size(const Key& key, const std::optional<std::string>& text, const std::string& where) {
  const std::string value = text ? "is \"" + *text + "\"" : "is missing";
  throw std::runtime_error(where + ": " + key.name + " " + value + ", must be " + std::to_string(key.count) +
                           (key.count == 1 ? " number" : " numbers"));
}

}  // namespace

Shape read_shape(const std::string& element, const TextOf& text_of, const std::string& where) {
  const std::string name = element.starts_with(kOurPrefix) ? element.substr(kOurPrefix.size()) : element;
  const std::string of_element = where + ": <" + element + ">";
  for (const ShapeKind& kind : kKinds) {
    if (name != kind.element) continue;
    Shape shape{&kind, {}};
    for (const Key& key : kind.keys) {
      if (key.count == 0) continue;
      const std::optional<std::string> text = text_of(key.name);
      const std::vector<double> numbers = text ? numbers_in(*text) : std::vector<double>();
      if (numbers.size() != key.count) refuse_size(key, text, of_element);
      shape.sizes.insert(shape.sizes.end(), numbers.begin(), numbers.end());
    }
    return shape;
  }
  throw std::runtime_error(where + ": <geometry> has <" + element + ">, must be one of " + known_elements());
}

const char* name_of(const Shape& shape) { return shape.kind->element; }

bool is_plane(const Shape& shape) { return shape.kind->create == nullptr; }

dGeomID create(const Shape& shape, dSpaceID space, const std::string& where) {
  // ODE's own create functions check nothing in a release build.
  for (const double size : shape.sizes) {
    if (size >= 1e-30 && size <= 1e30) continue;
    std::ostringstream message;
    message << where << ": a size of <" << shape.kind->element << "> is " << size << ", must be in [1e-30, 1e30]";
    throw std::runtime_error(message.str());
  }
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
