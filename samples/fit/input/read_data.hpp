// Meshes and point clouds from files.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "sampling.hpp"

namespace fit {

/// Thrown for an unusable file. what() is the complete message for the user.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The contents of a file: triangles that face outwards, or points alone.
struct Data {
  Cloud vertices;                   ///< all points of the file, with its normals (points only)
  std::vector<Triangle> triangles;  ///< empty for a point cloud
  std::string note;                 ///< the repairs, for the user; "": none
  bool is_single = false;           ///< whether coordinates were rounded to single precision
};

/// Reads a mesh (.stl, .obj, .ply) or points (.ply, .obj, .xyz). A line of an .xyz is x y z, or x y z nx ny nz; # starts a comment.
/// Multiplies lengths by `scale`. Removes mesh vertices without a triangle.
///
/// Throws InputError for a missing or empty file, an unknown extension, a number that is not finite, decimal commas, invalid
/// normals, or coordinates that lose too many digits in single precision.
Data read_data(const std::string& path, double scale);

}  // namespace fit
