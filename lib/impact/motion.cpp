#include "supernormal/impact/motion.hpp"

#include "impact/body_rotation.hpp"

namespace supernormal {

Pose pose_at(const Motion& motion, double time) {
  const Matrix3 rotation = rotation_at(motion, time);
  const Vector3 centre = motion.pose.position + motion.pose.rotation * motion.centre + time * motion.velocity;
  return {centre - rotation * motion.centre, rotation};
}

}  // namespace supernormal
