// The collision shapes of a file.
#pragma once

#include <supernormal/supernormal.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace robot_model {

struct ShapeKind;

/// The prefix of our elements in both formats. Such an element replaces a shape of the format beside it.
constexpr std::string_view kOurPrefix = "supernormal:";

struct Shape {
  const ShapeKind* kind;
  std::vector<double> sizes;  ///< m, and exponents; in the order of the kind's keys
};

/// The text of a size in the file: of the child element `key` in SDF, of the attribute `key` in URDF.
using TextOf = std::function<std::optional<std::string>(const std::string& key)>;

/// Reads the sizes of <element>. Throws std::runtime_error, which begins with `where`, if the element is unknown, or as
/// read_numbers().
Shape read_shape(const std::string& element, const TextOf& text_of, const std::string& where);

/// Whether the element is a shape of ours or one that read_shape() knows.
bool is_known(const std::string& element);

/// The name of the element without a prefix: "sphere" or "superellipsoid".
const char* name_of(const Shape& shape);

/// A plane has a normal instead of sizes, and no mass.
bool is_plane(const Shape& shape);

/// Makes the geom: spheres, boxes, capsules and cylinders are ODE's own, ellipsoids and superellipsoids ours. Throws
/// std::runtime_error if ours refuse the sizes. The shape is no plane.
dGeomID create(const Shape& shape, dSpaceID space, const std::string& where);

/// The mass of the homogeneous body in the frame of its geom; density in kg/m^3.
dMass mass_of(const Shape& shape, dGeomID geom, double density);

}  // namespace robot_model
