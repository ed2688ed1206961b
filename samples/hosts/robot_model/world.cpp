#include "world.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>

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

template <typename Value>
std::string text_of(const Value& value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

void require(bool is_valid, const std::string& message) {
  if (!is_valid) throw std::runtime_error(message);
}

/// Expresses a mass of the frame `pose` in the frame that `pose` refers to.
void transform(dMass& mass, const Eigen::Isometry3d& pose) {
  dMassRotate(&mass, rotation_of(pose).data());
  dMassTranslate(&mass, pose.translation().x(), pose.translation().y(), pose.translation().z());
}

dMass mass_of(const Inertial& inertial, const std::string& where) {
  const Eigen::Matrix3d& I = inertial.moment;
  require(inertial.mass > 0 && std::isfinite(inertial.mass),
          where + ": mass is " + text_of(inertial.mass) + " kg, must be in (0, inf)");
  require(I.allFinite(), where + ": <inertia> is not finite");
  const Eigen::Vector3d principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(I).eigenvalues();
  require(principal[0] > 0 && principal[0] + principal[1] >= (1 - 1e-6) * principal[2],
          where + ": the principal moments of <inertia> are " + text_of(principal.transpose()) +
              " kg m^2, must be positive, and none above the sum of the others");
  dMass mass;
  dMassSetParameters(&mass, inertial.mass, 0, 0, 0, I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2));
  return mass;
}

}  // namespace

Ode::Ode() {
  dInitODE2(0);
  world = dWorldCreate();
  space = dHashSpaceCreate(nullptr);
  contacts = dJointGroupCreate(0);
}

Ode::~Ode() {
  dJointGroupDestroy(contacts);
  dSpaceDestroy(space);
  dWorldDestroy(world);
  snClose();
  dCloseODE();
}

World::World(const Scene& scene, double density) : scene_(scene) {
  require(density > 0 && std::isfinite(density), "density is " + text_of(density) + " kg/m^3, must be in (0, inf)");
  check();
  dWorldSetGravity(ode_.world, scene.gravity.x(), scene.gravity.y(), scene.gravity.z());
  dWorldSetQuickStepNumIterations(ode_.world, 50);  // Gazebo's default
  weld();
  make_bodies(density);
  place_geoms();
  lift();
  connect();
}

/// ODE checks none of this.
void World::check() const {
  const auto in_file = [this](const std::string& what) { return scene_.file + ": " + what; };
  require(scene_.step > 0 && std::isfinite(scene_.step),
          in_file("max_step_size is " + text_of(scene_.step) + " s, must be in (0, inf)"));
  require(scene_.gravity.allFinite(), in_file("gravity is " + text_of(scene_.gravity.transpose()) + ", must be finite"));
  for (const Link& link : scene_.links) {
    require(link.pose.matrix().allFinite(), in_file("link " + link.name + ": the pose is not finite"));
    require(!link.inertial || link.inertial->pose.matrix().allFinite(),
            in_file("link " + link.name + ": the pose of <inertial> is not finite"));
    for (const double decay : {link.linear_decay, link.angular_decay}) {
      require(decay >= 0 && decay <= 1,
              in_file("link " + link.name + ": <velocity_decay> is " + text_of(decay) + ", must be in [0, 1]"));
    }
    for (const Collision& collision : link.collisions) {
      const std::string where = in_file("link " + link.name + ", collision " + collision.name);
      require(collision.pose.matrix().allFinite(), where + ": the pose is not finite");
      require(collision.friction >= 0, where + ": mu is " + text_of(collision.friction) + ", must be in [0, inf]");
    }
  }
  for (const Joint& joint : scene_.joints) {
    const std::string where = in_file("joint " + joint.name);
    require(joint.axis.allFinite() && joint.axis.norm() > 1e-6,
            where + ": the axis is " + text_of(joint.axis.transpose()) + ", must have a direction");
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

/// The masses are summed in the frame of the world.
void World::make_bodies(double density) {
  const std::size_t world = scene_.links.size();
  std::vector<dMass> masses(world + 1);
  for (dMass& mass : masses) dMassSetZero(&mass);
  for (std::size_t i = 0; i < world; ++i) {
    const Link& link = scene_.links[i];
    const std::string where = scene_.file + ": link " + link.name;
    const bool has_body = group_[i] != world;
    dMass& sum = masses[group_[i]];
    if (link.inertial && has_body) {
      dMass mass = mass_of(*link.inertial, where);
      transform(mass, link.inertial->pose);
      dMassAdd(&sum, &mass);
    }
    for (const Collision& collision : link.collisions) {
      const std::string of_collision = where + ", collision " + collision.name;
      require(!is_plane(collision.shape) || !has_body, of_collision + ": a <plane> must belong to a static model");
      if (is_plane(collision.shape)) {
        pieces_.push_back({nullptr, &collision, group_[i]});
        continue;
      }
      dGeomID geom = create(collision.shape, ode_.space, of_collision);
      pieces_.push_back({geom, &collision, group_[i]});
      if (link.inertial || !has_body) continue;
      dMass mass = mass_of(collision.shape, geom, density);
      transform(mass, collision.pose);
      dMassAdd(&sum, &mass);
    }
  }
  bodies_.assign(world + 1, nullptr);
  centres_.assign(world + 1, Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < world; ++i) {
    const Link& link = scene_.links[i];
    const std::size_t group = group_[i];
    if (group == world) continue;
    if (bodies_[group] != nullptr) {
      dBodySetLinearDamping(bodies_[group], std::max(dBodyGetLinearDamping(bodies_[group]), link.linear_decay));
      dBodySetAngularDamping(bodies_[group], std::max(dBodyGetAngularDamping(bodies_[group]), link.angular_decay));
      continue;
    }
    dMass& mass = masses[group];
    require(mass.mass > 0, scene_.file + ": link " + link.name + " has no mass: no <inertial> and no <collision>");
    centres_[group] = vector_of(mass.c);
    dMassTranslate(&mass, -mass.c[0], -mass.c[1], -mass.c[2]);
    dBodyID body = bodies_[group] = dBodyCreate(ode_.world);
    dBodySetMass(body, &mass);
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
      const Eigen::Vector3d n = (pose.linear() * Eigen::Vector3d(normal[0], normal[1], normal[2])).normalized();
      require(std::abs(n.norm() - 1) < 1e-6,
              scene_.file + ": collision " + piece.collision->name + ": the normal of <plane> must have a direction");
      piece.geom = dCreatePlane(ode_.space, n.x(), n.y(), n.z(), n.dot(position));
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
  if (!scene_.has_world && !has_plane) dCreatePlane(ode_.space, 0, 0, 1, 0);
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
    dJointID id = is_revolute ? dJointCreateHinge(ode_.world, nullptr) : dJointCreateSlider(ode_.world, nullptr);
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
    dJointAttach(dJointCreateContact(ode_.world, ode_.contacts, &contact), body1, body2);
  }
}

void World::simulate(double seconds) {
  require(seconds >= 0 && std::isfinite(seconds), "seconds is " + text_of(seconds) + ", must be in [0, inf)");
  const auto near = [](void* world, dGeomID geom1, dGeomID geom2) { static_cast<World*>(world)->collide(geom1, geom2); };
  double left = seconds;
  while (left > 0.5 * scene_.step) {
    dSpaceCollide(ode_.space, this, near);
    dWorldQuickStep(ode_.world, scene_.step);
    dJointGroupEmpty(ode_.contacts);
    left -= scene_.step;
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
