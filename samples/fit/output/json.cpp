#include "json.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace fit {
namespace {

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
