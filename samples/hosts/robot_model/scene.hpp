// What a file describes. All poses are in the world, at the start.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "shape.hpp"

namespace robot_model {

struct Inertial {
  double mass;             ///< kg
  Eigen::Isometry3d pose;  ///< its origin is the centre of mass
  Eigen::Matrix3d moment;  ///< kg m^2, about the centre of mass, in the axes of `pose`
};

struct Collision {
  std::string name;
  Shape shape;
  Eigen::Isometry3d pose;
  double friction = 1;  ///< Coulomb's coefficient; SDF's default
  std::size_t model = 0;
  bool self_collides = false;  ///< with the other links of its model
};

struct Link {
  std::string name;
  Eigen::Isometry3d pose;
  bool is_fixed = false;             ///< it is of a static model, or URDF's link "world"
  std::optional<Inertial> inertial;  ///< none: the mass follows from the shapes
  std::vector<Collision> collisions;
  bool has_gravity = true;
  double linear_decay = 0;  ///< the fraction of the velocity that each step takes away, as in Gazebo on ODE
  double angular_decay = 0;
};

/// A link that no file has: the world, as the parent of a joint.
constexpr std::size_t kWorld = std::numeric_limits<std::size_t>::max();

struct Joint {
  enum class Type { Fixed, Revolute, Prismatic };
  std::string name;
  Type type;
  std::size_t parent;  ///< index of a link, or kWorld
  std::size_t child;
  Eigen::Vector3d position;  ///< m
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double lower = -std::numeric_limits<double>::infinity();  ///< rad or m
  double upper = std::numeric_limits<double>::infinity();
};

struct Scene {
  std::string file;
  std::vector<Link> links;
  std::vector<Joint> joints;
  double step = 1e-3;                   ///< s; SDF's default
  Eigen::Vector3d gravity{0, 0, -9.8};  ///< m/s^2; SDF's default
  bool has_world = false;               ///< false: a model alone, which is put on the plane z = 0
  std::vector<std::string> not_read;    ///< elements that would act on the motion
  std::vector<std::string> left_out;    ///< collisions with a mesh or another shape that is not known, each in words
};

/// Reads SDF by sdformat and URDF by urdfdom. Throws std::runtime_error with the file and the element; with `strict` also for a
/// shape that is not known, which is left out otherwise.
Scene read_scene(const std::string& path, bool strict = false);

}  // namespace robot_model
