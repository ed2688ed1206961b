// The part of a body below a plane.
#pragma once

#include <array>
#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The submerged part of a body.
struct Submerged {
  double volume = 0;                 ///< m^3
  Vector3 centre = Vector3::Zero();  ///< m; centre of the submerged volume, in the body's frame
};

/// Computes the submerged part of a body from a mesh of 512 triangles between boundary points, which is made once. Exact for a body
/// that is wholly in or out. For a body that the plane cuts, accurate to 0.5 % of the volume of an ellipsoid.
class SUPERNORMAL_API SubmergedVolume {
 public:
  /// Builds the mesh; the shape is not kept.
  explicit SubmergedVolume(const Shape& shape);

  double volume() const { return whole_.volume; }  ///< m^3; of the whole body

  /// The part with up.x <= level; `up` is a unit vector in the body's frame, `level` in m.
  Submerged below(const Vector3& up, double level) const;

 private:
  const Vector3& vertex(int k) const { return points_[static_cast<std::size_t>(k)]; }

  Submerged whole_;
  double enlargement_ = 1;  // volume of the body over the volume of the mesh, which lies inside it
  std::vector<Vector3> points_;
  std::vector<std::array<int, 3>> triangles_;
};

}  // namespace supernormal
