#include "read_data.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "common/read_file.hpp"
#include "triangles.hpp"

namespace fit {
namespace {

constexpr const char* kExtensions = ".stl, .glb, .gltf (meshes), .obj, .off, .ply (meshes or points), .xyz (points)";

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// The separator between two numbers: "" for spaces, or the mark, followed by a space if there is one.
std::string separator_at(const char*& at) {
  std::string separator;
  for (; std::isspace(static_cast<unsigned char>(*at)) != 0 || *at == ',' || *at == ';'; ++at) {
    const bool is_mark = *at == ',' || *at == ';';
    if (is_mark) separator += *at;
    if (!is_mark && !separator.empty() && separator.back() != ' ') separator += ' ';
  }
  return separator;
}

/// The numbers of a line, at most `values.size()`. Returns -1 if the line has anything else, or more. Throws InputError when a line
/// has several separators: in "1,5 2,5 3,5" the commas are decimal commas.
int parse_numbers(const std::string& where, const std::string& line, std::array<double, 6>& values) {
  const char* at = line.c_str();
  int count = 0;
  std::string first;
  separator_at(at);
  while (*at != '\0') {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at || count == 6) return -1;
    values[static_cast<std::size_t>(count++)] = value;
    at = end;
    const std::string separator = separator_at(at);
    if (*at == '\0') break;
    if (count == 1) first = separator;
    if (separator == first) continue;
    throw InputError(where + "numbers are separated in more than one way; a decimal comma? Write decimal points");
  }
  return count;
}

/// The last three numbers of a line as a normal. A colour is refused.
Eigen::Vector3d read_normal(const std::string& where, const std::array<double, 6>& values) {
  constexpr double kUnit = 1e-2;
  const Eigen::Vector3d normal(values[3], values[4], values[5]);
  const double length = normal.norm();
  if (!std::isfinite(length) || length == 0 || std::abs(length - 1) <= kUnit) return normal;
  std::ostringstream text;
  text << where << "the normal (" << values[3] << ", " << values[4] << ", " << values[5] << ") has the length " << length
       << ", but must have 1 to within " << kUnit << "; is it a colour? Leave it out";
  throw InputError(text.str());
}

/// The beginning of a line, quoted for a message.
std::string in_quotes(const std::string& line) {
  constexpr std::size_t kLongest = 40;
  std::string text = line.substr(0, std::min(kLongest, line.find_last_not_of("\r\n") + 1));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 32 || c > 126; }, '?');
  return "\"" + text + (line.size() > kLongest ? "…\"" : "\"");
}

Data read_text(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError(path + ": cannot be opened");
  Data data;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (number == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);  // the byte order mark of UTF-8
    line.erase(std::min(line.find('#'), line.size()));
    std::array<double, 6> values{};
    const std::string where = path + ":" + std::to_string(number) + ": ";
    const int count = parse_numbers(where, line, values);
    if (count == 0) continue;
    if (count != 3 && count != 6) throw InputError(where + "a line holds x y z, or x y z nx ny nz, not " + in_quotes(line));
    const bool has_normal = count == 6;
    if (!data.vertices.points.empty() && has_normal == data.vertices.normals.empty()) {
      throw InputError(where + "either all points have normals or none");
    }
    data.vertices.points.emplace_back(values[0], values[1], values[2]);
    if (!data.vertices.points.back().allFinite()) throw InputError(where + "a coordinate is not finite: " + in_quotes(line));
    if (has_normal) data.vertices.normals.push_back(read_normal(where, values));
  }
  return data;
}

Eigen::Vector3d vector_of(const aiVector3D& v) { return {double{v.x}, double{v.y}, double{v.z}}; }

void append(const aiMesh& mesh, const aiMatrix4x4& place, Data& data) {
  const auto first = static_cast<std::uint32_t>(data.vertices.points.size());
  // Assimp does not report whether vertex normals of triangles come from the file. The triangles have exact normals of their own.
  const bool has_triangles = (mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) != 0;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    data.vertices.points.push_back(vector_of(place * mesh.mVertices[i]));
    if (mesh.HasNormals() && !has_triangles) data.vertices.normals.push_back(vector_of(mesh.mNormals[i]));
  }
  for (unsigned k = 0; k < mesh.mNumFaces; ++k) {
    const aiFace& face = mesh.mFaces[k];
    if (face.mNumIndices == 3)
      data.triangles.push_back({first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
  }
}

/// Appends the meshes of a node and of its children that belong to the group, and collects the names of all groups.
void append(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, const std::string& group, bool is_chosen,
            Data& data, std::set<std::string>& names) {
  const aiMatrix4x4 place = parent * node.mTransformation;
  const auto matches = [&](const aiString& name) {
    if (name.length > 0) names.insert(name.C_Str());
    return group == name.C_Str();
  };
  is_chosen = (&node != scene.mRootNode && matches(node.mName)) || is_chosen;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
    if (matches(mesh.mName) || is_chosen) append(mesh, place, data);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) append(scene, *node.mChildren[i], place, group, is_chosen, data, names);
}

/// The warnings and errors of Assimp while this object lives. A file that it repairs in silence has only these.
class Complaints {
 public:
  Complaints() {
    Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
    Assimp::DefaultLogger::get()->attachStream(&stream_, Assimp::Logger::Warn | Assimp::Logger::Err);
  }
  ~Complaints() {
    Assimp::DefaultLogger::get()->detachStream(&stream_, Assimp::Logger::Warn | Assimp::Logger::Err);
    Assimp::DefaultLogger::kill();
  }
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;

  /// Each one once.
  const std::set<std::string>& lines() const { return stream_.lines; }

 private:
  struct Stream : Assimp::LogStream {
    void write(const char* message) override {
      const std::string text = message;  // "Warn,  T0: …", with the end of a line
      const std::size_t first = text.find(": ");
      lines.insert(text.substr(first == std::string::npos ? 0 : first + 2, text.find_last_not_of('\n') + 1 - (first + 2)));
    }
    std::set<std::string> lines;
  };
  Stream stream_;
};

Data read_by_assimp(const std::string& path, const std::string& group) {
  const Complaints complaints;
  Assimp::Importer importer;
  const aiScene* const scene = importer.ReadFile(path, aiProcess_Triangulate);
  if (scene == nullptr) throw InputError(path + ": cannot be read: " + importer.GetErrorString());
  Data data;
  const std::set<std::string>& lines = complaints.lines();
  // Assimp drops a face whose vertex does not exist, which opens a closed mesh.
  const auto dropped = std::ranges::find_if(lines, [](const std::string& line) { return line.find("out-of-range") != line.npos; });
  if (dropped != lines.end()) throw InputError(path + ": cannot be read: " + *dropped);
  for (const std::string& line : lines) data.note.append(data.note.empty() ? "" : "; ").append(line);
  data.is_single = true;  // Assimp stores single precision
  std::set<std::string> names;
  append(*scene, *scene->mRootNode, {}, group, group.empty(), data, names);
  if (data.vertices.points.empty() && !group.empty()) {
    std::string allowed;
    for (const std::string& name : names) allowed += (allowed.empty() ? "" : ", ") + name;
    throw InputError(path + ": no group \"" + group +
                     "\"; allowed: " + (allowed.empty() ? "none, the file has no groups" : allowed));
  }
  if (data.vertices.normals.size() != data.vertices.points.size()) data.vertices.normals.clear();
  return data;
}

/// Far from the origin, coordinates in single precision lose the shape.
void require_precision(const std::string& path, const std::vector<Eigen::Vector3d>& points) {
  constexpr double kMostRounding = 1e-4;  // relative to the extent; 1e-3 changes exponents by several per cent
  double largest = 0;
  for (const Eigen::Vector3d& x : points) largest = std::max(largest, x.cwiseAbs().maxCoeff());
  const double rounding = largest * double{std::numeric_limits<float>::epsilon()} / 2;
  const double extent = extent_of(points).size;
  if (!(rounding > kMostRounding * extent) || extent == 0) return;
  std::ostringstream text;
  text << path << ": coordinates are in single precision: those up to " << largest << " are rounded by " << rounding << ", "
       << 100 * rounding / extent << " % of the data's extent of " << extent
       << "; allowed: 0.01 %. Move the data near the origin, or give a .ply with coordinates of type double, or points as .xyz";
  throw InputError(text.str());
}

/// Adds the changes to a mesh to what its reader noted.
std::string note_of(std::string note, const Oriented& done, std::size_t triangles, std::size_t stray) {
  const auto add = [&](const std::string& text) { note += (note.empty() ? "" : "; ") + text; };
  if (done.removed > 0) add(std::to_string(done.removed) + " triangles that repeat others or have no three corners are left out");
  if (done.turned > 0) {
    add(std::to_string(done.turned) + " of " + std::to_string(triangles) + " triangles faced inwards and are turned round");
  }
  if (stray > 0) add(std::to_string(stray) + " vertices that no triangle has are left out");
  return note;
}

/// Merges coincident vertices: an .stl file repeats them for every triangle.
void weld(Data& data) {
  std::map<std::array<double, 3>, std::uint32_t> number_of;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint32_t> welded;
  for (const Eigen::Vector3d& x : data.vertices.points) {
    const auto [entry, is_new] = number_of.try_emplace({x.x(), x.y(), x.z()}, static_cast<std::uint32_t>(points.size()));
    if (is_new) points.push_back(x);
    welded.push_back(entry->second);
  }
  data.vertices.points = std::move(points);
  for (Triangle& triangle : data.triangles) {
    for (std::uint32_t& corner : triangle) corner = welded[corner];
  }
}

void check(const std::string& path, Data& data) {
  if (data.vertices.points.empty()) throw InputError(path + ": no points");
  // If one normal is 0 or not finite, all normals of the file are ignored.
  bool has_normals = !data.vertices.normals.empty();
  for (std::size_t i = 0; i < data.vertices.points.size(); ++i) {
    if (!data.vertices.points[i].allFinite()) {
      throw InputError(path + ": point " + std::to_string(i + 1) + " has a coordinate that is not finite");
    }
    if (!has_normals) continue;
    const double length = data.vertices.normals[i].norm();
    has_normals = std::isfinite(length) && length > 0;
    if (has_normals) data.vertices.normals[i] /= length;
  }
  if (!has_normals) data.vertices.normals.clear();
}

}  // namespace

bool is_scan(const std::string& path) {
  constexpr std::array kKnown = {".stl", ".obj", ".off", ".glb", ".gltf", ".ply", ".xyz"};
  return std::ranges::find(kKnown, lower_extension(path)) != kKnown.end();
}

// They are not on the surface.
std::size_t remove_stray_vertices(Data& data) {
  constexpr auto kStray = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(data.vertices.points.size(), kStray);
  std::vector<Eigen::Vector3d> points;
  for (Triangle& triangle : data.triangles) {
    for (std::uint32_t& corner : triangle) {
      if (number[corner] == kStray) {
        number[corner] = static_cast<std::uint32_t>(points.size());
        points.push_back(data.vertices.points[corner]);
      }
      corner = number[corner];
    }
  }
  const std::size_t stray = data.vertices.points.size() - points.size();
  data.vertices.points = std::move(points);
  return stray;
}

Data read_data(const std::string& path, double scale, const std::string& group) {
  const std::string extension = lower_extension(path);
  if (!is_scan(path)) throw InputError(path + ": unknown extension \"" + extension + "\"; allowed: " + kExtensions);
  if (const std::string other = common::what_is_no_file(path); !other.empty()) {
    throw InputError(path + ": " + other + ", and no file");
  }
  if (!std::filesystem::is_regular_file(path)) throw InputError(path + ": no such file");
  const std::map<std::string, Data (*)(const std::string&)> readers = {{".off", read_off}, {".ply", read_ply}, {".xyz", read_text}};
  const auto reader = readers.find(extension);
  const bool has_groups = reader == readers.end();
  if (!has_groups && !group.empty()) throw InputError(path + ": group \"" + group + "\"; a " + extension + " has no groups");
  Data data = has_groups ? read_by_assimp(path, group) : reader->second(path);
  check(path, data);
  if (data.is_single) require_precision(path, data.vertices.points);
  if (!data.triangles.empty()) {
    weld(data);
    const Oriented done = orient(data);
    if (data.triangles.empty()) throw InputError(path + ": no triangle has three corners");
    const std::size_t stray = remove_stray_vertices(data);
    data.note = note_of(std::move(data.note), done, data.triangles.size(), stray);
  }
  for (Eigen::Vector3d& x : data.vertices.points) x *= scale;
  return data;
}

}  // namespace fit
