// Meshes and point clouds from files.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "sampling.hpp"

namespace fit {

/// Thrown when the user's file is of no use. what() is the whole message for the user.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a file holds: triangles, which face outwards, or points alone.
struct Data {
  Cloud vertices;                   ///< all points of the file, with the normals that it gives (points only)
  std::vector<Triangle> triangles;  ///< none: a point cloud
  std::string note;                 ///< what was mended in the file, for the user; "": nothing
  bool is_single = false;           ///< whether coordinates were rounded to single precision
};

/// Reads a mesh (.stl, .obj, .ply) or points (.ply, .obj, .xyz: lines of x y z, or x y z nx ny nz, with # for comments), and
/// multiplies lengths by `scale`. Vertices of a mesh that no triangle has are left out. Throws InputError: no such file, unknown
/// extension, nothing in it, a number that is not finite, decimal commas, normals that are none, coordinates that lose their digits
/// in single precision.
Data read_data(const std::string& path, double scale);

}  // namespace fit
