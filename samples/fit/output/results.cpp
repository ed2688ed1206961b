#include "results.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "common/toml_string.hpp"

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

using Json = nlohmann::ordered_json;

Json list_of(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

Json error_of(const FittedBody& fitted, int parameter) {
  const auto i = static_cast<std::size_t>(parameter);
  if (fitted.uncertainty.is_fixed[i]) return 0;
  return fitted.uncertainty.is_determined[i] ? Json(fitted.uncertainty.standard_error[parameter]) : Json();
}

Json errors_of(const FittedBody& fitted, int first) {
  return {error_of(fitted, first), error_of(fitted, first + 1), error_of(fitted, first + 2)};
}

Json json_of(const FittedBody& fitted) {
  const Body& body = fitted.body;
  Json json = {{"family", name_of(body.family)},
               {"half_axes", list_of(body.half_axes)},
               {"half_axes_error", errors_of(fitted, kLogAxes)},
               {"delta", body.delta},
               {"epsilon", body.epsilon}};
  if (body.family != Family::Ellipsoid) {
    json["delta_error"] = error_of(fitted, kLogDelta);
    json["epsilon_error"] = error_of(fitted, kLogEpsilon);
  }
  if (body.family == Family::Superovoid) {
    json["taper"] = body.taper;
    json["taper_error"] = error_of(fitted, kTaper);
  }
  const Eigen::Quaterniond& q = body.orientation;
  json["position"] = list_of(body.position);
  json["position_error"] = errors_of(fitted, kPosition);
  json["orientation_wxyz"] = {q.w(), q.x(), q.y(), q.z()};
  json["rotation_error"] = errors_of(fitted, kRotation);
  json["points"] = fitted.inliers;
  json["outliers"] = fitted.outliers.size();
  json["sigma"] = fitted.uncertainty.sigma;
  json["lack_of_fit"] = fitted.uncertainty.lack_of_fit;
  return json;
}

Json moments_of(const Solid& solid) {
  return list_of(Eigen::SelfAdjointEigenSolver<Matrix3>(solid.inertia, Eigen::EigenvaluesOnly).eigenvalues());
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

std::string json_text(std::span<const FittedBody> fitted, const FitError& error, const std::vector<std::string>& warnings,
                      const Provenance& provenance) {
  Json json = {{"name", provenance.name},
               {"source", provenance.source},
               {"units",
                {{"lengths", "m"},
                 {"angles", "rad"},
                 {"volumes", "m^3"},
                 {"inertia", "m^5, for density 1: times density in kg m^2"},
                 {"density", "kg/m^3"},
                 {"exponents, tapers, lack_of_fit", "1"}}},
               {"frames",
                {{"position, centroid, grain_origin, inertia", "the axes of the file, in m; inertia about centroid"},
                 {"orientation_wxyz", "turns the axes of the body into the axes of the file"},
                 {"rotation_error", "about the x, y and z axis of the body"}}},
               {"metres_per_unit_of_file", provenance.scale},
               {"density", provenance.density},
               {"bodies", Json::array()}};
  for (const FittedBody& each : fitted) json["bodies"].push_back(json_of(each));
  json["grain_origin"] = list_of(grain_origin(fitted));
  json["volume"] = error.body.volume;
  json["volume_error"] = error.volume_error;
  json["moments_of_inertia"] = moments_of(error.body);
  json["moments_of_inertia_error"] = list_of(error.moment_errors);
  json["inertia"] = {list_of(error.body.inertia.row(0)), list_of(error.body.inertia.row(1)), list_of(error.body.inertia.row(2))};
  json["centroid"] = list_of(error.body.centroid);
  const char* const kind = !error.is_hull ? "closed mesh" : provenance.is_mesh ? "open mesh" : "points";
  json["data"] = {{"kind", kind},
                  {"is_closed", !error.is_hull},
                  {"edges_with_one_triangle", provenance.open.single},
                  {"edges_with_unpaired_triangles", provenance.open.other},
                  {"volume_of", error.is_hull ? "convex hull" : "closed mesh"},
                  {"volume", error.data.volume},
                  {"moments_of_inertia", moments_of(error.data)},
                  {"centroid", list_of(error.data.centroid)},
                  {"radius", error.radius}};
  json["distance_rms"] = error.rms;
  json["distance_largest"] = error.to_body;
  json["reach_beyond_data"] = error.reach;
  json["warnings"] = warnings;
  return json.dump(2) + "\n";
}

Vector3 grain_origin(std::span<const FittedBody> fitted) {
  Vector3 middle = Vector3::Zero();
  for (const FittedBody& each : fitted) middle += each.body.position / static_cast<double>(fitted.size());
  return middle;
}

std::string aligned_ply(const Data& data, std::span<const FittedBody> fitted) {
  const Vector3 origin = grain_origin(fitted);
  const Matrix3 axes = fitted.size() == 1 ? fitted.front().body.rotation() : Matrix3::Identity();
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(data.vertices.points.size()) +
                     "\nproperty double x\nproperty double y\nproperty double z\n";
  if (!data.triangles.empty())
    text += "element face " + std::to_string(data.triangles.size()) + "\nproperty list uchar uint vertex_indices\n";
  text += "end_header\n";
  std::array<char, 96> line{};
  for (const Eigen::Vector3d& point : data.vertices.points) {
    const Vector3 x = axes.transpose() * (point - origin);
    std::snprintf(line.data(), line.size(), "%.9g %.9g %.9g\n", x.x(), x.y(), x.z());
    text += line.data();
  }
  for (const auto& [a, b, c] : data.triangles) {
    text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  }
  return text;
}

}  // namespace fit
