#include "world.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "numbers.hpp"

namespace robot_model {

namespace {

constexpr int kMaxContacts = 8;

Eigen::Vector3d vector_of(const dReal* v) { return {v[0], v[1], v[2]}; }

/// ODE's layout of a rotation.
std::array<dReal, 12> rotation_of(const Eigen::Isometry3d& pose) {
  std::array<dReal, 12> out{};
  Eigen::Map<Eigen::Matrix<dReal, 3, 4, Eigen::RowMajor>>(out.data()).leftCols<3>() = pose.linear();
  return out;
}

std::string text_of(const auto& value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

void require(bool is_valid, const std::string& message) {
  if (!is_valid) throw std::runtime_error(message);
}

/// The inertia of one body, in the axes of the world. ODE moves the centre of a dMass only by way of the origin, where a small body
/// far away loses its moments to rounding.
struct Part {
  double mass;
  Eigen::Vector3d centre;
  Eigen::Matrix3d moment;  // about the centre
};

Part part_of(double mass, const Eigen::Isometry3d& pose, const Eigen::Matrix3d& moment) {
  return {mass, pose.translation(), pose.linear() * moment * pose.linear().transpose()};
}

/// A homogeneous body that is symmetric about its origin.
Part part_of(const dMass& mass, const Eigen::Isometry3d& pose) {
  return part_of(mass.mass, pose, Eigen::Map<const Eigen::Matrix<dReal, 3, 4, Eigen::RowMajor>>(mass.I).leftCols<3>());
}

/// The three principal moments must be those of a body, and ODE must be able to invert them.
void check_moments(const Eigen::Matrix3d& moment, const std::string& where) {
  constexpr double kLeastRatio = 1e-9;  // of the moments, as of a rod that is 80 000 times as long as thick
  const Eigen::Vector3d principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moment).eigenvalues();
  require(principal[0] >= kLeastRatio * principal[2] && principal[0] + principal[1] >= (1 - 1e-6) * principal[2],
          where + ": the principal moments are " + text_of(principal.transpose()) + " kg m^2, must be at least " +
              text_of(kLeastRatio) + " of the largest, and none above the sum of the others");
  for (int axis = 0; axis < 3; ++axis) check_number("inertia/ixx", moment(axis, axis), where);
}

/// About the origin, which is the centre of mass.
dMass sum_of(const std::vector<Part>& parts, Eigen::Vector3d& centre, const std::string& where) {
  double mass = 0;
  for (const Part& part : parts) mass += part.mass;
  check_number("mass", mass, where);
  centre.setZero();
  for (const Part& part : parts) centre += part.mass / mass * part.centre;
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (const Part& part : parts) {
    const Eigen::Vector3d arm = part.centre - centre;
    moment += part.moment + part.mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
  }
  check_moments(moment, where);
  dMass out;
  dMassSetParameters(&out, mass, 0, 0, 0, moment(0, 0), moment(1, 1), moment(2, 2), moment(0, 1), moment(0, 2), moment(1, 2));
  return out;
}

/// Below this length a vector has no direction.
constexpr double kLeastLength = 1e-6;

void check_direction(const Eigen::Vector3d& vector, const std::string& where) {
  require(vector.norm() > kLeastLength,
          where + " is " + text_of(vector.transpose()) + ", must be longer than " + text_of(kLeastLength));
}

}  // namespace

World::World(const Scene& scene, double density) : scene_(scene) {
  check_number("density", density, scene_.file);
  check_joints();
  dWorldSetGravity(ode_.id(), scene.gravity.x(), scene.gravity.y(), scene.gravity.z());
  dWorldSetQuickStepNumIterations(ode_.id(), 50);  // Gazebo's default
  weld();
  make_bodies(density);
  place_geoms();
  lift();
  connect();
}

void World::check_joints() const {
  for (const Joint& joint : scene_.joints) {
    const std::string where = scene_.file + ": joint " + joint.name;
    check_direction(joint.axis, where + ": the axis");
    require(joint.lower <= joint.upper,
            where + ": the limits are " + text_of(joint.lower) + " and " + text_of(joint.upper) + ", must rise");
  }
}

/// Numbers the groups of links that move as one.
void World::weld() {
  const std::size_t world = scene_.links.size();
  group_.resize(world + 1);
  std::iota(group_.begin(), group_.end(), std::size_t{0});
  const auto join = [this](std::size_t a, std::size_t b) {
    // The world has the largest number and remains.
    const auto [lost, kept] = std::minmax(group_[a], group_[b]);
    std::replace(group_.begin(), group_.end(), std::size_t{lost}, std::size_t{kept});
  };
  for (std::size_t i = 0; i < world; ++i) {
    if (scene_.links[i].is_fixed) join(i, world);
  }
  for (const Joint& joint : scene_.joints) {
    if (joint.type == Joint::Type::Fixed) join(std::min(joint.parent, world), joint.child);
  }
}

void World::make_bodies(double density) {
  const std::size_t world = scene_.links.size();
  std::vector<std::vector<Part>> parts(world + 1);
  for (std::size_t i = 0; i < world; ++i) {
    const Link& link = scene_.links[i];
    const std::string where = scene_.file + ": link " + link.name;
    const bool has_body = group_[i] != world;
    if (link.inertial && has_body) {
      check_moments(link.inertial->moment, where + ": <inertia>");
      parts[group_[i]].push_back(part_of(link.inertial->mass, link.inertial->pose, link.inertial->moment));
    }
    for (const Collision& collision : link.collisions) {
      const std::string of_collision = where + ", collision " + collision.name;
      require(!is_plane(collision.shape) || !has_body, of_collision + ": a <plane> must belong to a static model");
      if (is_plane(collision.shape)) {
        pieces_.push_back({nullptr, &collision, group_[i]});
        continue;
      }
      dGeomID geom = create(collision.shape, ode_.space(), of_collision);
      pieces_.push_back({geom, &collision, group_[i]});
      if (link.inertial || !has_body) continue;
      parts[group_[i]].push_back(part_of(mass_of(collision.shape, geom, density), collision.pose));
    }
  }
  bodies_.assign(world + 1, nullptr);
  centres_.assign(world + 1, Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < world; ++i) {
    const Link& link = scene_.links[i];
    const std::size_t group = group_[i];
    if (group == world) continue;
    const std::string where = scene_.file + ": link " + link.name;
    if (bodies_[group] != nullptr) {
      require((dBodyGetGravityMode(bodies_[group]) != 0) == link.has_gravity,
              where + ": its <gravity> differs from the links' that are one body with it, must be the same");
      dBodySetLinearDamping(bodies_[group], std::max(dBodyGetLinearDamping(bodies_[group]), link.linear_decay));
      dBodySetAngularDamping(bodies_[group], std::max(dBodyGetAngularDamping(bodies_[group]), link.angular_decay));
      continue;
    }
    require(!parts[group].empty(), where + " has no mass: no <inertial> and no <collision>");
    const dMass mass = sum_of(parts[group], centres_[group], where);
    dBodyID body = bodies_[group] = dBodyCreate(ode_.id());
    dBodySetMass(body, &mass);
    dBodySetGravityMode(body, link.has_gravity ? 1 : 0);
    dBodySetPosition(body, centres_[group].x(), centres_[group].y(), centres_[group].z());
    dBodySetLinearDamping(body, link.linear_decay);
    dBodySetAngularDamping(body, link.angular_decay);
  }
}

void World::place_geoms() {
  bool has_plane = false;
  for (Piece& piece : pieces_) {
    const Eigen::Isometry3d& pose = piece.collision->pose;
    const Eigen::Vector3d& position = pose.translation();
    if (is_plane(piece.collision->shape)) {
      const std::vector<double>& normal = piece.collision->shape.sizes;
      const Eigen::Vector3d given(normal[0], normal[1], normal[2]);
      check_direction(given, scene_.file + ": collision " + piece.collision->name + ": the normal of <plane>");
      const Eigen::Vector3d n = (pose.linear() * given).normalized();
      piece.geom = dCreatePlane(ode_.space(), n.x(), n.y(), n.z(), n.dot(position));
      if (!has_plane) plane_ << n, n.dot(position);
      has_plane = true;
    } else if (bodies_[piece.group] == nullptr) {
      dGeomSetPosition(piece.geom, position.x(), position.y(), position.z());
      dGeomSetRotation(piece.geom, rotation_of(pose).data());
    } else {
      dGeomSetBody(piece.geom, bodies_[piece.group]);
      dGeomSetOffsetWorldPosition(piece.geom, position.x(), position.y(), position.z());
      dGeomSetOffsetWorldRotation(piece.geom, rotation_of(pose).data());
    }
    dGeomSetData(piece.geom, const_cast<Collision*>(piece.collision));
  }
  if (!scene_.has_world && !has_plane) dCreatePlane(ode_.space(), 0, 0, 1, 0);
}

/// Puts a model without a world on the ground, unless it is fixed.
void World::lift() {
  if (scene_.has_world || std::count(group_.begin(), group_.end(), scene_.links.size()) > 1) return;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Piece& piece : pieces_) {
    std::array<dReal, 6> box{};
    dGeomGetAABB(piece.geom, box.data());
    lowest = std::min(lowest, box[4]);
  }
  if (!std::isfinite(lowest)) return;
  lift_ = -lowest;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i] != nullptr) dBodySetPosition(bodies_[i], centres_[i].x(), centres_[i].y(), centres_[i].z() + lift_);
  }
}

void World::connect() {
  const std::size_t world = scene_.links.size();
  for (const Joint& joint : scene_.joints) {
    const std::size_t parent = group_[std::min(joint.parent, world)];
    const std::size_t child = group_[joint.child];
    if (joint.type == Joint::Type::Fixed || (parent == world && child == world)) continue;
    require(parent != child, scene_.file + ": joint " + joint.name + " connects two links that fixed joints connect");
    const bool is_revolute = joint.type == Joint::Type::Revolute;
    dJointID id = is_revolute ? dJointCreateHinge(ode_.id(), nullptr) : dJointCreateSlider(ode_.id(), nullptr);
    dJointAttach(id, bodies_[child], bodies_[parent]);  // so the position rises when the child moves along the axis
    const auto set = is_revolute ? dJointSetHingeParam : dJointSetSliderParam;
    if (is_revolute) dJointSetHingeAnchor(id, joint.position.x(), joint.position.y(), joint.position.z() + lift_);
    (is_revolute ? dJointSetHingeAxis : dJointSetSliderAxis)(id, joint.axis.x(), joint.axis.y(), joint.axis.z());
    set(id, dParamLoStop, joint.lower);
    set(id, dParamHiStop, joint.upper);
    joints_.push_back(id);
  }
}

void World::collide(dGeomID geom1, dGeomID geom2) {
  dBodyID body1 = dGeomGetBody(geom1);
  dBodyID body2 = dGeomGetBody(geom2);
  if (body1 == body2) return;
  const auto* const one = static_cast<const Collision*>(dGeomGetData(geom1));
  const auto* const two = static_cast<const Collision*>(dGeomGetData(geom2));
  const bool are_of_file = one != nullptr && two != nullptr;  // the plane z = 0 may not be
  if (are_of_file && one->model == two->model && !one->self_collides) return;
  if (body1 != nullptr && body2 != nullptr && dAreConnectedExcluding(body1, body2, dJointTypeContact) != 0) return;
  std::array<dContact, kMaxContacts> contacts;
  const int count = dCollide(geom1, geom2, kMaxContacts, &contacts[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    dContact& contact = contacts[static_cast<std::size_t>(i)];
    contact.surface = {};
    contact.surface.mode = dContactApprox1;
    contact.surface.mu = std::min(one == nullptr ? 1 : one->friction, two == nullptr ? 1 : two->friction);  // Gazebo's rule
    ode_.join(contact, body1, body2);
  }
}

void World::simulate(double seconds) {
  check_number("seconds", seconds, scene_.file);
  const std::int64_t steps = std::llround(seconds / scene_.step);
  for (std::int64_t i = 0; i < steps; ++i) {
    ode_.collide([this](dGeomID geom1, dGeomID geom2) { collide(geom1, geom2); });
    ode_.step(scene_.step);
    check_motion(static_cast<double>(i + 1) * scene_.step);
  }
}

/// A step that is too long for a stiff model makes it fly apart, until numbers overflow in ODE.
void World::check_motion(double time) const {
  constexpr double kMost = 1e12;  // m, m/s, rad/s
  for (std::size_t i = 0; i < scene_.links.size(); ++i) {
    if (body(i) == nullptr) continue;
    const dReal* const all[] = {dBodyGetPosition(body(i)), dBodyGetLinearVel(body(i)), dBodyGetAngularVel(body(i))};
    const bool is_near = std::all_of(std::begin(all), std::end(all), [](const dReal* v) { return vector_of(v).norm() <= kMost; });
    require(is_near, scene_.file + ": link " + scene_.links[i].name + " is farther than " + text_of(kMost) + " m or faster than " +
                         text_of(kMost) + " m/s or rad/s after " + text_of(time) + " s, with max_step_size " +
                         text_of(scene_.step) + " s");
  }
}

Eigen::Isometry3d World::pose(std::size_t link) const {
  dBodyID id = body(link);
  if (id == nullptr) return scene_.links[link].pose;
  Eigen::Isometry3d body_pose = Eigen::Isometry3d::Identity();
  body_pose.translation() = vector_of(dBodyGetPosition(id));
  body_pose.linear() = Eigen::Map<const Eigen::Matrix<dReal, 3, 4, Eigen::RowMajor>>(dBodyGetRotation(id)).leftCols<3>();
  return body_pose * Eigen::Translation3d(-centres_[group_[link]]) * scene_.links[link].pose;
}

double World::height(std::size_t link) const { return plane_.head<3>().dot(pose(link).translation()) - plane_[3]; }

}  // namespace robot_model
