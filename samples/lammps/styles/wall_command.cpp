#include "styles/wall_command.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "common/mesh.hpp"
#include "kernel/refuse.hpp"
#include "kernel/walls/box_wall.hpp"
#include "kernel/walls/cylinder_wall.hpp"
#include "kernel/walls/mesh_wall.hpp"
#include "kernel/walls/plane_wall.hpp"
#include "styles/coefficients.hpp"

namespace granular {
namespace {

std::vector<supernormal::MeshTriangle> load_triangles(const std::string& file, double unit) {
  const common::Mesh mesh = common::load_mesh(file, unit);
  std::vector<supernormal::MeshTriangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& corners : mesh.triangles) {
    supernormal::MeshTriangle triangle;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto& vertex = mesh.vertices.at(corners.at(k));
      triangle.vertices.at(k) = Eigen::Vector3f(vertex[0], vertex[1], vertex[2]).cast<double>();
    }
    triangle.index = static_cast<int>(triangles.size());
    triangles.push_back(triangle);
  }
  return triangles;
}

/// Each wall is created around its anchor, the reference point of its torque.
void read_shape(Words& words, WallCommand& command) {
  const std::string kind = words.next("wall/supernormal");
  if (kind == "plane") {
    command.anchor = words.vector(kind);
    command.normal = words.direction("plane: normal");
    command.wall = std::make_unique<PlaneWall>(Vector3::Zero(), *command.normal);
  } else if (kind == "box") {
    const Vector3 low = words.vector(kind), high = words.vector(kind);
    command.anchor = 0.5 * (low + high);
    command.wall = std::make_unique<BoxWall>(low - command.anchor, high - command.anchor);
  } else if (kind == "cylinder") {
    command.anchor = words.vector(kind);
    const Vector3 axis = words.direction("cylinder: axis");
    command.wall = std::make_unique<CylinderWall>(Vector3::Zero(), axis, words.number(kind));
  } else if (kind == "mesh") {
    const std::string file = words.next(kind);
    const double unit = words.number("mesh: unit");
    if (!(unit > 0)) refuse("mesh: unit", unit, "(0, inf)");
    command.wall = std::make_unique<MeshWall>(load_triangles(file, unit));
  } else {
    throw std::invalid_argument(kind + " is none of plane, box, cylinder, mesh");
  }
}

common::WallMotion read_motion(Words& words) {
  const std::string kind = words.next("move");
  if (kind == "linear") return {common::Translation{words.vector(kind)}};
  if (kind == "conveyor") return {common::Conveyor{words.vector(kind), {Vector3::UnitZ(), Vector3::Zero(), 0}}};
  if (kind == "rotate") {
    const Vector3 axis = words.direction("move rotate: axis"), point = words.vector(kind);
    return {common::Rotation{axis, point, words.number(kind)}};
  }
  if (kind == "vibrate") {
    const Vector3 amplitude = words.vector(kind);
    const double frequency = words.number(kind);
    if (!(frequency > 0)) refuse("move vibrate: frequency", frequency, "(0, inf)");
    return {common::Vibration{amplitude, frequency, words.number(kind)}};
  }
  throw std::invalid_argument("move " + kind + " is none of linear, rotate, vibrate, conveyor");
}

}  // namespace

WallCommand read_wall_command(Words words) {
  WallCommand command;
  read_shape(words, command);
  if (words.accept("type")) {
    command.type = words.integer("type");
  } else {
    const Coefficients coefficients = read_coefficients(words.take_until({"move", "drive"}));
    if (!coefficients.has_material) throw std::invalid_argument("the law is missing: hooke, hertz or type");
    if (coefficients.has_exponents) throw std::invalid_argument("exponents belong to the particles' types: pair_coeff");
    command.material = coefficients.material;
  }
  while (!words.is_empty()) {
    const std::string keyword = words.next("move");
    if (keyword == "drive") {
      command.drive = read_drive(words);
      break;
    }
    if (keyword != "move") throw std::invalid_argument(keyword + " is none of move, drive");
    command.motions.push_back(read_motion(words));
    if (words.accept("from")) command.motions.back().from = words.number("from");
    if (words.accept("until")) command.motions.back().until = words.number("until");
    const auto& [ignored, from, until] = command.motions.back();
    if (until <= from) refuse("move: until", until, "(from, inf)");
  }
  const auto moves_surface = [](const common::WallMotion& motion) { return std::holds_alternative<common::Conveyor>(motion.kind); };
  if (command.drive && std::ranges::any_of(command.motions, moves_surface)) {
    throw std::invalid_argument("drive besides move conveyor; allowed: with the other motions");
  }
  return command;
}

}  // namespace granular
