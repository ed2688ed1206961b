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
  std::string note;                 ///< the repairs and what else the reader noted, for the user; "": none
  bool is_single = false;           ///< whether coordinates were rounded to single precision
};

/// Reads vertices, normals and polygons of a .ply file: text, or binary of either byte order. Each coordinate type is converted
/// exactly to double. Polygons are triangulated. `is_single`: whether the file has 32-bit coordinates. Throws InputError with the
/// line of a text file, or the index of the vertex or face.
Data read_ply(const std::string& path);

/// Reads vertices and polygons of a text .off file, or vertices with normals alone (NOFF). A line has one vertex or one polygon;
/// the numbers behind them, such as colours, are not read. Throws InputError with the line.
Data read_off(const std::string& path);

/// Removes mesh vertices without a triangle. Returns how many.
std::size_t remove_stray_vertices(Data& data);

/// Whether read_data() knows the extension of this path.
bool is_scan(const std::string& path);

/// Reads a mesh (.stl, .obj, .off, .glb, .gltf, .ply) or points (.ply, .obj, .off, .xyz). `group` names one of several objects of
/// the file (a group of an .obj, a node or mesh of a .glb); "": all of them. A line of an .xyz is x y z, or x y z nx ny nz; #
/// starts a comment. Multiplies lengths by `scale`. Removes mesh vertices without a triangle.
///
/// Throws InputError for a missing or empty file, an unknown extension or group, a number that is not finite, decimal commas,
/// invalid normals, a header that promises more or less than the file has, a face with a vertex that does not exist, or coordinates
/// that lose too many digits in single precision.
Data read_data(const std::string& path, double scale, const std::string& group = "");

}  // namespace fit
