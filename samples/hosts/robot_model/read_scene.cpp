// Chooses the reader of a file, and reads URDF by urdfdom. It knows spheres, boxes and cylinders only, and reads the first shape of
// a <geometry>. Others stand beside it, with our prefix, and are read from its XML. Other programs then use the first shape.
#include <console_bridge/console.h>
#include <tinyxml.h>
#include <urdf_parser/urdf_parser.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>

#include "formats.hpp"
#include "numbers.hpp"

namespace robot_model {

namespace {

constexpr std::array kRead = {"robot",    "link",  "inertial", "origin", "mass", "inertia", "collision",
                              "geometry", "joint", "parent",   "child",  "axis", "limit"};
constexpr std::array kNoMotion = {"visual", "material"};

/// urdfdom would take 0,3 for 0.
void check_numbers(const TiXmlElement& element, const std::string& where) {
  for (const TiXmlAttribute* one = element.FirstAttribute(); one != nullptr; one = one->Next()) {
    const std::string path = element.ValueStr() + "/" + one->Name();
    if (takes_numbers(path)) read_numbers(path, one->Value(), where + ": " + element.Value());
  }
}

/// Checks the numbers below an element, and lists the children that are not read.
void examine(const TiXmlElement& parent, const std::string& of_parent, std::vector<std::string>& not_read) {
  const auto has = [](const auto& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  const char* const called = parent.Attribute("name");
  const std::string where = of_parent + ": " + parent.Value() + (called == nullptr ? "" : " " + std::string(called));
  const bool has_shapes = parent.ValueStr() == "geometry";
  for (const TiXmlElement* element = parent.FirstChildElement(); element != nullptr; element = element->NextSiblingElement()) {
    if (has(kNoMotion, element->Value())) continue;
    if (!has_shapes && !has(kRead, element->Value())) {
      add_once(not_read, element->Value());
      continue;
    }
    check_numbers(*element, where);
    examine(*element, where, not_read);
  }
}

/// urdfdom reports a link that it could not read, and goes on without the rest of it.
class Complaints : public console_bridge::OutputHandler {
 public:
  Complaints() { console_bridge::useOutputHandler(this); }
  ~Complaints() override { console_bridge::restorePreviousOutputHandler(); }
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char* /*file*/, int /*line*/) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) text_ += (text_.empty() ? "" : "; ") + text;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

Eigen::Vector3d vector_of(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Eigen::Isometry3d pose_of(const urdf::Pose& pose) {
  const urdf::Rotation& q = pose.rotation;
  return Eigen::Translation3d(vector_of(pose.position)) * Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized();
}

/// urdfdom finds one link without a parent; the others may still be no tree.
void check_tree(const urdf::ModelInterface& robot, const std::string& file) {
  if (robot.joints_.size() >= robot.links_.size())
    throw std::runtime_error(file + ": a link is the child of several joints, must be of one");
  const std::string loop = file + ": the joints form a loop, must form a tree, at link ";
  for (const auto& [name, link] : robot.links_) {
    std::size_t depth = 0;
    for (urdf::LinkSharedPtr above = link->getParent(); above; above = above->getParent()) {
      if (++depth > robot.links_.size()) throw std::runtime_error(loop + name);
    }
  }
}

/// The root link is the origin of the world.
Eigen::Isometry3d pose_of(const urdf::Link& link) {
  if (!link.parent_joint) return Eigen::Isometry3d::Identity();
  return pose_of(*link.getParent()) * pose_of(link.parent_joint->parent_to_joint_origin_transform);
}

std::optional<Shape> shape_of(Scene& scene, bool strict, const TiXmlElement& collision, const std::string& where) {
  const TiXmlElement* shape = collision.FirstChildElement("geometry")->FirstChildElement();  // urdfdom has seen both
  for (const TiXmlElement* other = shape; other != nullptr; other = other->NextSiblingElement()) {
    if (other->ValueStr().starts_with(kOurPrefix)) shape = other;
  }
  const TextOf text_of = [shape](const std::string& key) -> std::optional<std::string> {
    const char* text = shape->Attribute(key.c_str());
    return text == nullptr ? std::nullopt : std::optional<std::string>(text);
  };
  return shape_in(scene, strict, shape->Value(), text_of, where);
}

Link link_of(Scene& scene, bool strict, const urdf::Link& link, const TiXmlElement& element) {
  Link out;
  out.name = link.name;
  out.pose = pose_of(link);
  out.is_fixed = link.name == "world" && !link.parent_joint;  // Gazebo's convention
  if (link.inertial) {
    const urdf::Inertial& body = *link.inertial;
    Eigen::Matrix3d moment;
    moment << body.ixx, body.ixy, body.ixz, body.ixy, body.iyy, body.iyz, body.ixz, body.iyz, body.izz;
    out.inertial = Inertial{body.mass, out.pose * pose_of(body.origin), moment};
  }
  const std::string of_link = scene.file + ": link " + link.name + ", collision ";
  const TiXmlElement* collision = element.FirstChildElement("collision");
  for (std::size_t k = 0; k < link.collision_array.size(); ++k) {
    const urdf::Collision& parsed = *link.collision_array[k];
    const std::string name = parsed.name.empty() ? std::to_string(k + 1) : parsed.name;
    const std::optional<Shape> shape = shape_of(scene, strict, *collision, of_link + name);
    if (shape) out.collisions.push_back({name, *shape, out.pose * pose_of(parsed.origin)});
    collision = collision->NextSiblingElement("collision");
  }
  return out;
}

Joint joint_of(const urdf::Joint& joint, const std::map<std::string, std::size_t>& links, const urdf::ModelInterface& robot,
               const std::string& file) {
  const std::string where = file + ": joint " + joint.name;
  if (joint.mimic) throw std::runtime_error(where + ": <mimic> is not supported");
  const Eigen::Isometry3d pose = pose_of(*robot.getLink(joint.child_link_name));
  Joint out{joint.name, Joint::Type::Fixed, links.at(joint.parent_link_name), links.at(joint.child_link_name), pose.translation()};
  if (joint.type != urdf::Joint::FIXED) out.axis = pose.linear() * vector_of(joint.axis);
  switch (joint.type) {
    case urdf::Joint::FIXED:
      break;
    case urdf::Joint::REVOLUTE:
    case urdf::Joint::CONTINUOUS:
      out.type = Joint::Type::Revolute;
      break;
    case urdf::Joint::PRISMATIC:
      out.type = Joint::Type::Prismatic;
      break;
    default:
      throw std::runtime_error(where + ": type is floating or planar, must be fixed, revolute, continuous or prismatic");
  }
  if (joint.limits && (joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::PRISMATIC)) {
    out.lower = joint.limits->lower;
    out.upper = joint.limits->upper;
  }
  return out;
}

Scene read_urdf(const std::string& path, const TiXmlDocument& document, bool strict) {
  const TiXmlElement& root = *document.RootElement();
  Scene scene;
  scene.file = path;
  examine(root, path, scene.not_read);
  TiXmlPrinter text;
  document.Accept(&text);
  const Complaints complaints;
  const urdf::ModelInterfaceSharedPtr robot = urdf::parseURDF(text.CStr());
  if (!robot || !complaints.text().empty()) throw std::runtime_error(path + ": " + complaints.text());
  check_tree(*robot, path);
  std::map<std::string, std::size_t> indices;
  for (const TiXmlElement* element = root.FirstChildElement("link"); element != nullptr;
       element = element->NextSiblingElement("link")) {
    const urdf::LinkConstSharedPtr link = robot->getLink(element->Attribute("name"));
    indices[link->name] = scene.links.size();
    scene.links.push_back(link_of(scene, strict, *link, *element));
  }
  for (const auto& [name, joint] : robot->joints_) scene.joints.push_back(joint_of(*joint, indices, *robot, path));
  return scene;
}

/// Stops from kNoLimit on are none, infinity and the largest double among them. ODE has no stops of a hinge beyond half a
/// revolution.
Scene without_far_stops(Scene scene) {
  for (Joint& joint : scene.joints) {
    for (double* stop : {&joint.lower, &joint.upper}) {
      if (std::abs(*stop) >= kNoLimit) *stop = std::copysign(std::numeric_limits<double>::infinity(), *stop);
    }
    if (joint.type != Joint::Type::Revolute) continue;
    for (double* stop : {&joint.lower, &joint.upper}) {
      if (!std::isfinite(*stop) || std::abs(*stop) < std::numbers::pi) continue;
      *stop = std::copysign(std::numeric_limits<double>::infinity(), *stop);
      add_once(scene.not_read, "limits of " + joint.name + " beyond pi");
    }
  }
  return scene;
}

}  // namespace

Scene read_scene(const std::string& path, bool strict) {
  TiXmlDocument document;
  if (!document.LoadFile(path.c_str())) {
    throw std::runtime_error(path + ": line " + std::to_string(document.ErrorRow()) + ": " + document.ErrorDesc());
  }
  const std::string root = document.RootElement() == nullptr ? "" : document.RootElement()->ValueStr();
  // sdformat would also read URDF, but leaves out links without <inertial>.
  if (root == "robot") return without_far_stops(read_urdf(path, document, strict));
  if (root == "sdf") return without_far_stops(read_sdf(path, strict));
  throw std::runtime_error(path + ": the root element is <" + root + ">, must be <sdf> or <robot>");
}

}  // namespace robot_model
