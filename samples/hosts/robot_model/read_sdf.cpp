// SDF, by Gazebo's own parser. It resolves frames, includes and older versions of the format.
#include <array>
#include <cmath>
#include <map>
#include <sdf/sdf.hh>
#include <stdexcept>
#include <utility>

#include "formats.hpp"
#include "numbers.hpp"

namespace robot_model {

namespace {

// What is read, besides numbers, and what moves nothing: its children are not looked at.
constexpr std::array kRead = {"sdf",   "world",    "physics", "model",   "static",    "frame",         "self_collide",
                              "link",  "inertial", "inertia", "surface", "collision", "friction",      "ode",
                              "joint", "parent",   "child",   "axis",    "limit",     "velocity_decay"};
constexpr std::array kNoMotion = {"geometry", "visual", "light", "gui", "scene", "real_time_factor", "real_time_update_rate"};

// sdformat would take 0,3 for 0. An empty pose is the pose of its frame.
void check_numbers(sdf::Element& element, const std::string& path, const std::string& where) {
  const std::string text = element.GetValue()->GetAsString();
  if (element.GetName() != "pose") {
    read_numbers(path, text, where);
  } else if (text.find_first_not_of(" \t\r\n") != std::string::npos) {
    const bool is_quaternion = element.Get<std::string>("rotation_format") == "quat_xyzw";
    const std::vector<double> pose = read_numbers(is_quaternion ? "pose of a quaternion" : "pose", text, where);
    if (is_quaternion && Eigen::Map<const Eigen::Vector4d>(pose.data() + 3).norm() < 1e-6)
      throw std::runtime_error(where + ": the quaternion of pose \"" + text + "\" is 0 0 0 0, must have a direction");
  }
}

/// Checks the numbers below an element, and lists the children that are not read.
void examine(const sdf::ElementPtr& parent, const std::string& of_parent, std::vector<std::string>& not_read) {
  const auto has = [](const auto& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  const std::string called = parent->HasAttribute("name") ? " " + parent->Get<std::string>("name") : "";
  const std::string where = of_parent + ": " + parent->GetName() + called;
  for (sdf::ElementPtr element = parent->GetFirstElement(); element; element = element->GetNextElement()) {
    const std::string& name = element->GetName();
    const std::string path = parent->GetName() + "/" + name;
    if (!element->GetExplicitlySetInFile() || has(kNoMotion, name) || path == "link/gravity") continue;
    if (has(kRead, name)) {
      examine(element, where, not_read);
    } else if (takes_numbers(path)) {
      check_numbers(*element, path, where);
    } else {
      add_once(not_read, name);
    }
  }
}

class Reader {
 public:
  Reader(const std::string& path, bool strict) : strict_(strict) { scene_.file = path; }

  Scene read() {
    sdf::Root root;
    const sdf::Errors errors = root.Load(scene_.file);
    if (root.Element()) examine(root.Element(), scene_.file, scene_.not_read);  // its messages say more
    check(errors);
    if (root.WorldCount() > 1) refuse("has " + std::to_string(root.WorldCount()) + " worlds, must have one");
    if (root.WorldCount() == 1) {
      const sdf::World& world = *root.WorldByIndex(0);
      scene_.has_world = true;
      scene_.step = world.PhysicsDefault()->MaxStepSize();
      scene_.gravity = vector_of(world.Gravity());
      for (uint64_t i = 0; i < world.ModelCount(); ++i) add(*world.ModelByIndex(i), resolve(world.ModelByIndex(i)->SemanticPose()));
    } else if (root.Model() != nullptr) {
      add(*root.Model(), pose_of(root.Model()->RawPose()));
    } else {
      refuse("has neither a world nor a model");
    }
    return scene_;
  }

 private:
  [[noreturn]] void refuse(const std::string& reason) const { throw std::runtime_error(scene_.file + ": " + reason); }

  // The first error is the innermost; sdformat has printed the value.
  void check(const sdf::Errors& errors) const {
    if (errors.empty()) return;
    const sdf::Error& error = errors.front();
    std::string where = error.XmlPath().value_or("");
    if (error.LineNumber()) where += (where.empty() ? "line " : ", line ") + std::to_string(*error.LineNumber());
    refuse(where + (where.empty() ? "" : ": ") + error.Message());
  }

  static Eigen::Vector3d vector_of(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

  static Eigen::Isometry3d pose_of(const ignition::math::Pose3d& pose) {
    const auto& q = pose.Rot();
    return Eigen::Translation3d(vector_of(pose.Pos())) * Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()).normalized();
  }

  Eigen::Isometry3d resolve(const sdf::SemanticPose& pose, const std::string& frame = "") const {
    ignition::math::Pose3d out;
    check(pose.Resolve(out, frame));
    return pose_of(out);
  }

  void add(const sdf::Model& model, const Eigen::Isometry3d& pose) {
    if (model.ModelCount() > 0) refuse("model " + model.Name() + " contains other models, which are not supported");
    std::map<std::string, std::size_t> indices = {{"world", kWorld}};
    for (uint64_t i = 0; i < model.LinkCount(); ++i) {
      indices[model.LinkByIndex(i)->Name()] = scene_.links.size();
      add(*model.LinkByIndex(i), model, pose);
    }
    for (uint64_t i = 0; i < model.JointCount(); ++i) add(*model.JointByIndex(i), indices, pose);
    ++models_;
  }

  void add(const sdf::Link& link, const sdf::Model& model, const Eigen::Isometry3d& model_pose) {
    Link out;
    out.name = model.Name() + "::" + link.Name();
    out.pose = model_pose * resolve(link.SemanticPose(), "__model__");
    out.is_fixed = model.Static();
    out.has_gravity = link.Element()->Get<bool>("gravity", true).first;
    if (link.Element()->HasElement("inertial")) {
      const sdf::ElementPtr inertial = link.Element()->GetElement("inertial");
      for (const char* part : {"mass", "inertia"}) {
        // SDF's own defaults, 1 kg and 1 kg m^2, suit no body.
        if (!inertial->HasElement(part))
          refuse("link " + out.name + ": <inertial> has no <" + part + ">; without <inertial> both follow from the shapes");
      }
      const auto& matrix = link.Inertial().MassMatrix();
      const auto moment = matrix.Moi();
      Inertial& body = out.inertial.emplace(Inertial{matrix.Mass(), out.pose * pose_of(link.Inertial().Pose()), {}});
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
          body.moment(row, column) = moment(static_cast<size_t>(row), static_cast<size_t>(column));
      }
    }
    if (const sdf::ElementConstPtr decay = std::as_const(*link.Element()).FindElement("velocity_decay")) {
      out.linear_decay = decay->Get<double>("linear", 0.0).first;
      out.angular_decay = decay->Get<double>("angular", 0.0).first;
    }
    for (uint64_t i = 0; i < link.CollisionCount(); ++i) {
      const sdf::Collision& collision = *link.CollisionByIndex(i);
      const std::string where = scene_.file + ": link " + out.name + ", collision " + collision.Name();
      const std::optional<Shape> shape = shape_of(*collision.Geom(), where);
      if (!shape) continue;
      Collision piece{collision.Name(), *shape, out.pose * resolve(collision.SemanticPose())};
      piece.friction = friction_of(*collision.Element());
      piece.model = models_;
      piece.self_collides = model.SelfCollide();
      out.collisions.push_back(piece);
    }
    scene_.links.push_back(out);
  }

  std::optional<Shape> shape_of(const sdf::Geometry& geometry, const std::string& where) {
    sdf::ElementPtr shape = geometry.Element()->GetFirstElement();
    if (!shape) throw std::runtime_error(where + ": <geometry> is empty");
    for (sdf::ElementPtr other = shape; other; other = other->GetNextElement()) {
      if (other->GetName().starts_with(kOurPrefix)) shape = other;
    }
    const TextOf text_of = [&shape](const std::string& key) -> std::optional<std::string> {
      if (!shape->HasElement(key) || !shape->GetElement(key)->GetExplicitlySetInFile()) return std::nullopt;
      return shape->GetElement(key)->GetValue()->GetAsString();  // the text of the file
    };
    return shape_in(scene_, strict_, shape->GetName(), text_of, where);
  }

  static double friction_of(const sdf::Element& collision) {
    sdf::ElementConstPtr element = collision.FindElement("surface");
    for (const char* name : {"friction", "ode"}) {
      if (element) element = element->FindElement(name);
    }
    return element ? element->Get<double>("mu", 1.0).first : 1.0;
  }

  void add(const sdf::Joint& joint, const std::map<std::string, std::size_t>& links, const Eigen::Isometry3d& model_pose) {
    const std::string where = "joint " + joint.Name() + ": ";
    std::string parent;
    std::string child;
    check(joint.ResolveParentLink(parent));
    check(joint.ResolveChildLink(child));
    Joint out{joint.Name(), Joint::Type::Fixed, links.at(parent), links.at(child), {}};
    out.position = (model_pose * resolve(joint.SemanticPose(), "__model__")).translation();
    const bool is_revolute = joint.Type() == sdf::JointType::REVOLUTE || joint.Type() == sdf::JointType::CONTINUOUS;
    if (!is_revolute && joint.Type() != sdf::JointType::PRISMATIC && joint.Type() != sdf::JointType::FIXED) {
      refuse(where + "type is " + joint.Element()->Get<std::string>("type") + ", must be fixed, revolute, continuous or prismatic");
    }
    if (joint.Type() != sdf::JointType::FIXED) {
      if (joint.Axis() == nullptr) refuse(where + "has no <axis>");
      out.type = is_revolute ? Joint::Type::Revolute : Joint::Type::Prismatic;
      ignition::math::Vector3d axis;
      check(joint.Axis()->ResolveXyz(axis, "__model__"));
      out.axis = model_pose.linear() * vector_of(axis);
      if (joint.Type() != sdf::JointType::CONTINUOUS) {
        out.lower = joint.Axis()->Lower();
        out.upper = joint.Axis()->Upper();
      }
    }
    scene_.joints.push_back(out);
  }

  const bool strict_;
  Scene scene_;
  std::size_t models_ = 0;
};

}  // namespace

Scene read_sdf(const std::string& path, bool strict) { return Reader(path, strict).read(); }

}  // namespace robot_model
