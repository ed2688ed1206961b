// The part of a body that lies below a plane.
#pragma once

#include <array>
#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The part of a body that is under water.
struct Submerged {
  double volume = 0;                 ///< m^3
  Vector3 centre = Vector3::Zero();  ///< m; centre of the submerged volume, in the body's frame
};

/// Computes how much of a body is under water, from a mesh of 512 triangles between boundary points that is made once. Exact for
/// a body that is wholly in or out; a body that is cut is accurate to 0.5 % of the volume for ellipsoids.
class SUPERNORMAL_API SubmergedVolume {
 public:
  /// Builds the mesh; the shape is not kept.
  explicit SubmergedVolume(const Shape& shape);

  double volume() const { return whole_.volume; }  ///< m^3; of the whole body

  /// The part with up.x <= level; `up` is a unit vector in the body's frame, level in m.
  Submerged below(const Vector3& up, double level) const;

 private:
  const Vector3& corner(int k) const { return points_[static_cast<std::size_t>(k)]; }

  Submerged whole_;
  double enlargement_ = 1;  // volume of the body over that of the mesh, which lies inside it
  std::vector<Vector3> points_;
  std::vector<std::array<int, 3>> triangles_;
};

}  // namespace supernormal
