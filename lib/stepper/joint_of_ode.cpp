// What ODE tells about joints.
#include <algorithm>
#include <iterator>
#include <numbers>

#include "ode/geom/convert.hpp"
#include "ode/support/require.hpp"
#include "stepper/contact.hpp"
#include "stepper/joint.hpp"

namespace supernormal::stepper {
namespace {

/// How ODE tells about a type of joint.
struct Type {
  dJointType type;
  int linear, held, axes;  // numbers of rows
  dReal (*number)(dJointID, int);
  void (*axis1)(dJointID, dVector3);
  void (*place1)(dJointID, dVector3) = nullptr;
  void (*place2)(dJointID, dVector3) = nullptr;
  void (*axis2)(dJointID, dVector3) = nullptr;
};
constexpr Type kTypes[] = {
    {dJointTypeBall, 3, 3, 0, dJointGetBallParam, nullptr, dJointGetBallAnchor, dJointGetBallAnchor2},
    {dJointTypeHinge, 3, 5, 1, dJointGetHingeParam, dJointGetHingeAxis, dJointGetHingeAnchor, dJointGetHingeAnchor2},
    {dJointTypeSlider, 2, 5, 1, dJointGetSliderParam, dJointGetSliderAxis},
    {dJointTypeFixed, 3, 6, 0, dJointGetFixedParam, nullptr},
    {dJointTypeUniversal, 3, 4, 2, dJointGetUniversalParam, dJointGetUniversalAxis1, dJointGetUniversalAnchor,
     dJointGetUniversalAnchor2, dJointGetUniversalAxis2},
};

Vector3 told(void (*get)(dJointID, dVector3), dJointID id) {
  dVector3 result;
  get(id, result);
  return ode::to_vector(result);
}

/// Where a body without forces, or the world, is in ODE.
struct Frame {
  Vector3 origin = Vector3::Zero();
  Matrix3 rotation = Matrix3::Identity();

  explicit Frame(dBodyID body) {
    if (body == nullptr) return;
    origin = ode::to_vector(dBodyGetPosition(body));
    rotation = ode::to_rotation(dBodyGetRotation(body));
  }
};

/// The motor and the stops of an axis. False if the program wants the stops to bounce, or constraints to give way.
bool read_axis(const Type& type, dJointID id, int group, bool slides, double stiff, FreeAxis& axis) {
  const auto number = [&](int parameter) { return double{type.number(id, parameter + group)}; };
  axis.speed = require_in("dParamVel of a joint", number(dParamVel), -kLargest, kLargest);
  axis.strongest = require_in("dParamFMax of a joint", number(dParamFMax), 0, kAny);
  axis.low = require_in("dParamLoStop of a joint", number(dParamLoStop), -kAny, kAny);
  axis.high = require_in("dParamHiStop of a joint", number(dParamHiStop), -kAny, kAny);
  const double farthest = slides ? dInfinity : std::numbers::pi;  // as in ODE
  const bool is_empty = axis.low > axis.high;
  if (is_empty || axis.low < -farthest || axis.low == -dInfinity) axis.low = -kAny;
  if (is_empty || axis.high > farthest || axis.high == dInfinity) axis.high = kAny;
  const bool has_stop = axis.low > -kAny || axis.high < kAny;
  return !(has_stop && (number(dParamBounce) > 0 || number(dParamStopCFM) > stiff)) &&
         !(axis.strongest > 0 && number(dParamCFM) > stiff);
}

}  // namespace

bool Joint::read(dJointID id) {
  const dJointType kind = dJointGetType(id);
  const Type* const type = std::ranges::find(kTypes, kind, &Type::type);
  if (type == std::end(kTypes)) return false;
  const bool is_reversed = dJointGetBody(id, 0) == nullptr;
  dBodyID const first = dJointGetBody(id, is_reversed ? 1 : 0);
  dBodyID const second = dJointGetBody(id, is_reversed ? 0 : 1);
  const double stiff = dWorldGetCFM(dBodyGetWorld(first));
  slides_ = kind == dJointTypeSlider;
  linear_ = type->linear;
  held_ = type->held;
  count_ = held_ + type->axes;
  for (int k = 0; k < type->axes; ++k) {
    if (!read_axis(*type, id, k * dParamGroup, slides_, stiff, axes_[std::size_t(k)])) return false;
  }
  if (type->axes == 0 && type->number(id, dParamCFM) > stiff) return false;

  const Frame frame1(first);
  const Frame frame2(second);
  Vector3 axis1 = frame1.rotation.col(0);  // any that turns with body 1
  if (type->axis1 != nullptr) axis1 = told(is_reversed && type->axis2 != nullptr ? type->axis2 : type->axis1, id);
  if (slides_ && is_reversed) axis1 = -axis1;
  const Vector3 axis_in1 = frame1.rotation.transpose() * axis1;
  constexpr double kTurned = 1e-5;  // rad; above what a float loses
  const bool is_known = id == id_ && kind == type_ && first == sides_[0].body && second == sides_[1].body &&
                        (axis_in1 - sides_[0].axis).norm() < kTurned;
  if (!is_known) {  // ODE does not tell how the bodies were when the axis was set
    id_ = id;
    type_ = kind;
    sides_[0] = {first, Vector3::Zero(), axis_in1};
    sides_[1] = {second, frame2.rotation.transpose() * (frame1.origin - frame2.origin), frame2.rotation.transpose() * axis1};
    turned_ = frame2.rotation.transpose() * frame1.rotation;
    aim_.setZero(held_);
    forces_.setZero(count_);
  }
  if (type->place1 != nullptr) {
    const Vector3 place1 = told(is_reversed ? type->place2 : type->place1, id);
    const Vector3 place2 = told(is_reversed ? type->place1 : type->place2, id);
    sides_[0].place = frame1.rotation.transpose() * (place1 - frame1.origin);
    sides_[1].place = frame2.rotation.transpose() * (place2 - frame2.origin);
  }
  if (type->axis2 != nullptr) sides_[1].axis = frame2.rotation.transpose() * told(is_reversed ? type->axis1 : type->axis2, id);
  if (kind == dJointTypeHinge) axes_[0].position = (is_reversed ? -1 : 1) * dJointGetHingeAngle(id);
  if (kind == dJointTypeSlider) axes_[0].position = dJointGetSliderPosition(id);
  if (kind == dJointTypeUniversal) {
    axes_[0].position = is_reversed ? -dJointGetUniversalAngle2(id) : dJointGetUniversalAngle1(id);
    axes_[1].position = is_reversed ? dJointGetUniversalAngle1(id) : dJointGetUniversalAngle2(id);
  }
  return true;
}

void Joints::read(System& system, const std::unordered_map<dBodyID, int>& indices) {
  const auto index = [&](dBodyID body) {
    const auto found = indices.find(body);
    return body == nullptr ? 0 : found == indices.end() ? -1 : found->second;
  };
  system.joints.clear();
  for (auto& entry : known_) entry.second.is_present = false;
  for (Body& body : system.bodies) {
    const int count = body.id == nullptr ? 0 : dBodyGetNumJoints(body.id);
    for (int i = 0; i < count; ++i) {
      const dJointID id = dBodyGetJoint(body.id, i);
      if (dJointIsEnabled(id) == 0) continue;
      Known& known = known_[id];
      Joint& joint = known.joint;
      if (!known.is_present) {  // else its other body has it, too
        known.is_present = true;
        known.is_ours = joint.read(id);
        joint.body1 = index(joint.body(0));
        joint.body2 = index(joint.body(1));
        known.is_ours = known.is_ours && joint.body1 >= 0 && joint.body2 >= 0;
        if (known.is_ours) system.joints.push_back(&joint);
      }
      if (!known.is_ours) body.is_held = body.is_free;
    }
  }
  std::erase_if(known_, [](const auto& entry) { return !entry.second.is_present; });
}

}  // namespace supernormal::stepper
