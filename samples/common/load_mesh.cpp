#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "common/mesh.hpp"
#include "common/read_file.hpp"

#ifdef COMMON_ASSIMP
#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <utility>
#endif

namespace common {

#ifdef COMMON_ASSIMP

namespace {

/// Refuses coordinates that are not finite, because equal vertices are found by sorting and a NaN has no order.
std::array<float, 3> scaled(const aiVector3D& vertex, double unit) {
  const auto metres = [unit](double x) {
    const auto length = static_cast<float>(unit * x);
    if (!std::isfinite(length)) throw std::runtime_error("has a coordinate that is not finite");
    return length;
  };
  return {metres(vertex.x), metres(vertex.y), metres(vertex.z)};
}

/// Opens the file of the mesh only. The file may name others, such as the materials of an OBJ (mtllib). They have no triangles, and
/// messages would quote their lines.
class OneFile : public Assimp::DefaultIOSystem {
 public:
  explicit OneFile(std::string path) : path_(std::move(path)) {}
  bool Exists(const char* file) const override { return file == path_ && DefaultIOSystem::Exists(file); }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    return file == path_ ? DefaultIOSystem::Open(file, mode) : nullptr;
  }

 private:
  std::string path_;
};

/// Adds the triangles of a mesh, without degenerate ones.
void append(const aiMesh& added, double unit, std::map<std::array<float, 3>, unsigned int>& index_of, Mesh& mesh) {
  for (unsigned k = 0; k < added.mNumFaces; ++k) {
    const aiFace& face = added.mFaces[k];
    if (face.mNumIndices != 3) continue;  // points and lines, which an OBJ may contain
    std::array<unsigned int, 3> triangle{};
    for (unsigned corner = 0; corner < 3; ++corner) {
      const std::array<float, 3> vertex = scaled(added.mVertices[face.mIndices[corner]], unit);
      const auto [entry, is_new] = index_of.try_emplace(vertex, static_cast<unsigned int>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back(vertex);
      triangle.at(corner) = entry->second;
    }
    if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0]) mesh.triangles.push_back(triangle);
  }
}

}  // namespace

bool can_load_meshes() { return true; }

Mesh load_mesh(const std::string& path, double unit) {
  if (const std::string other = what_is_no_file(path); !other.empty()) {
    throw std::runtime_error('"' + path + "\" is " + other + ", and no file");
  }
  if (!std::filesystem::is_regular_file(path)) throw std::runtime_error("there is no file \"" + path + "\"");
  Assimp::Importer importer;
  importer.SetIOHandler(new OneFile(path));  // the importer deletes the handler
  // The two formats have no transformations, so the tree of nodes is ignored.
  const aiScene* const scene = importer.ReadFile(path, aiProcess_Triangulate);
  if (scene == nullptr) throw std::runtime_error("\"" + path + "\" cannot be read: " + importer.GetErrorString());
  Mesh mesh;
  std::map<std::array<float, 3>, unsigned int> index_of;
  try {
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) append(*scene->mMeshes[i], unit, index_of, mesh);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("\"" + path + "\" " + error.what());
  }
  if (mesh.triangles.empty()) throw std::runtime_error("\"" + path + "\" has no triangles");
  return mesh;
}

#else

bool can_load_meshes() { return false; }

Mesh load_mesh(const std::string& path, double /*unit*/) {
  throw std::runtime_error("\"" + path +
                           "\" cannot be read: this build has no assimp (sudo apt install libassimp-dev, and build again)");
}

#endif

}  // namespace common
