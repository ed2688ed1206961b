#include "paste.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "common/toml_string.hpp"
#include "json.hpp"

namespace fit {
namespace {

constexpr int kDigits = 9;

std::string number(double value, int digits) {
  std::vector<char> text(32);
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

/// A literal of type double in C and TOML.
std::string literal(double value, int digits = kDigits) {
  const std::string text = number(value, digits);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string list(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += ", ";
    text += literal(value);
  }
  return text;
}

/// A position, accurate to 1e-9 of the body.
std::string list_of_place(const Body& body) {
  std::string text;
  for (const double x : body.position) {
    text += (text.empty() ? "" : ", ") + literal(x, digits_of(x, body.half_axes.minCoeff(), kDigits));
  }
  return text;
}

std::string name_of_part(const std::string& name, std::size_t parts, std::size_t i) {
  return parts == 1 ? name : name + "_" + std::to_string(i + 1);
}

/// Makes a text safe for a one-line comment in C.
std::string harmless(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return std::iscntrl(c) != 0 || c == '*' || c == '\\' || c == '?'; }, '_');
  return text;
}

std::string create_call(const Body& body) {
  const Vector3& axes = body.half_axes;
  switch (body.family) {
    case Family::Ellipsoid:
      return "snCreateEllipsoid(space, " + list({axes.x(), axes.y(), axes.z()}) + ")";
    case Family::Superellipsoid:
      return "snCreateSuperellipsoid(space, " + list({axes.x(), axes.y(), axes.z(), body.delta, body.epsilon}) + ")";
    case Family::Superovoid:
      break;
  }
  return "snCreateSuperovoid(space, " + list({axes.x(), axes.y(), axes.z(), body.delta, body.epsilon, body.taper, body.taper}) +
         ")";
}

/// The catalogue keys of the shape.
std::string shape_keys(const Body& body, const std::string& separator) {
  std::string text = "half_axes = [" + list({body.half_axes.x(), body.half_axes.y(), body.half_axes.z()}) + "]";
  text += separator + "delta = " + literal(body.delta) + separator + "epsilon = " + literal(body.epsilon);
  if (body.family == Family::Superovoid) text += separator + "taper = [" + list({body.taper, body.taper}) + "]";
  return text;
}

/// The catalogue keys of the pose in a compound.
std::string place_keys(const Body& body, const Vector3& origin) {
  const Vector3 at = body.position - origin;
  const Eigen::AngleAxisd turn(body.orientation);
  const Vector3& axis = turn.axis();
  return "position = [" + list({at.x(), at.y(), at.z()}) + "], axis = [" + list({axis.x(), axis.y(), axis.z()}) +
         "], angle = " + literal(turn.angle() * 180 / std::numbers::pi);
}

}  // namespace

int digits_of(double coordinate, double size, int digits) {
  const double ratio = std::abs(coordinate) / size;
  const int more = ratio > 1 ? static_cast<int>(std::ceil(std::log10(ratio))) : 0;
  return std::clamp(digits + more, digits, 17);
}

std::string identifier(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0) == 0x80) continue;  // of a character that has begun
    name += byte < 128 && std::isalnum(byte) != 0 ? c : '_';
  }
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) name = "fit_" + name;
  return name;
}

std::string toml_lines(std::span<const FittedBody> bodies, const std::string& name, double density, const std::string& source) {
  // The frame of a compound may have any origin. Take it near the bodies, so that no position is out of the catalogue's range.
  const Vector3 middle = grain_origin(bodies);
  const bool is_large = std::ranges::any_of(bodies, [](const FittedBody& each) { return each.body.half_axes.maxCoeff() > 1; });
  std::string text = is_large ? "# falling_particles takes half-axes up to 1 m: is the unit right (fit --unit)?\n" : "";
  text += "[" + name + "]\n";
  if (bodies.size() == 1) {
    text += shape_keys(bodies.front().body, "\n") + "\n";
  } else {
    text += "parts = [\n";
    for (const FittedBody& each : bodies) {
      text += "  { " + shape_keys(each.body, ", ") + ", " + place_keys(each.body, middle) + " },\n";
    }
    text += "]\n";
  }
  return text + "density = " + literal(density) + "\nsource = " + common::toml_string(source) + "\n";
}

std::string c_lines(std::span<const FittedBody> bodies, const std::string& name, const std::string& source, const Solid& solid,
                    double density) {
  const Vector3& c = solid.centroid;
  const double size = bodies.front().body.half_axes.minCoeff();
  std::string centre;
  for (const double x : c) centre += (centre.empty() ? "" : ", ") + literal(x, digits_of(x, size, kDigits));
  std::string text =
      "/* " + harmless(source) +
      "\n   The geoms lie in the frame of the scan. ODE wants the centre of mass of a body at its origin. For a body that moves:"
      "\n   dBodySetMass(body, &mass_" +
      name + ");\n   dBodySetPosition(body, " + centre +
      ");\n   and for each geom dGeomSetBody(geom, body), and then dGeomSetOffsetWorldPosition and"
      "\n   dGeomSetOffsetWorldQuaternion with the numbers below in place of dGeomSetPosition and dGeomSetQuaternion. */\n";
  const Matrix3 I = density * solid.inertia;
  text.append("dMass mass_").append(name).append(";\n");
  text.append("dMassSetParameters(&mass_").append(name).append(", ").append(list({density * solid.volume, 0, 0, 0})).append(", ");
  text.append(list({I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)})).append(");\n");
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& body = bodies[i].body;
    // The prefix keeps words of C, and names that these lines use, out of its way.
    const std::string part = "geom_" + name_of_part(name, bodies.size(), i);
    const Eigen::Quaterniond& q = body.orientation;
    const std::string orientation = part + "_orientation";
    const std::string place = list_of_place(body);
    text.append("const dQuaternion ").append(orientation).append(" = {").append(list({q.w(), q.x(), q.y(), q.z()})).append("};\n");
    text.append("dGeomID ").append(part).append(" = ").append(create_call(body)).append(";\n");
    text.append("dGeomSetPosition(").append(part).append(", ").append(place).append(");\n");
    text.append("dGeomSetQuaternion(").append(part).append(", ").append(orientation).append(");\n");
  }
  return text;
}

}  // namespace fit
