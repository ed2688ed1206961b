// A run as files for ParaView.

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "base/write_file.hpp"
#include "common/interval.hpp"
#include "frame.hpp"
#include "picture.hpp"

namespace falling_particles {
namespace {

/// grains.pvd, contacts.pvd, container.pvd and, in a scene with bonds, bonds.pvd list the files of every frame in the folder vtk.
/// These are in VTK's XML format for points, lines and polygons, as text.
///
/// A grain is a point with its kind (from 0, in the order of the scene file), quaternion (w, x, y, z), half-axes (m), exponents
/// (delta, epsilon), rounding (m), velocity (m/s) and angular velocity (rad/s). A compound has a point per component. A capsule
/// is the ellipsoid of its size. In scenes with compounds, feeders or sinks, `grain` is the index of the point's grain. Absent
/// grains are left out. A contact is a point with its normal (unit, towards grain 1), depth (m) and the two grains (-1: a wall). If
/// the scene requests forces, it has the force on grain 1 (N). The container's triangles face the grains, and have the
/// fields of measurements; there is a new file whenever a wall has changed. A bond is a line between the centres of its grains.
class VtkSeries final : public Picture {
 public:
  VtkSeries(const OutputFolder& folder, const Contents& contents);
  void add(const Frame& frame) override;
  void finish(const std::string& summary) override;

 private:
  /// Writes a file of this frame and returns its name.
  std::string write(std::string_view what, const std::string& text) const;
  static void list(std::string& entries, double time, const std::string& name);
  std::string grains_of(const Frame& frame) const;

  std::filesystem::path grains_file_, contacts_file_, container_file_, bonds_file_, frames_folder_;
  const Contents& contents_;
  std::string grains_, contacts_, containers_, bonds_;  // entries of the lists
  std::string container_;                               // the latest file of the container
  std::vector<WallPlace> wall_places_;                  // of the walls in this file
  std::vector<TriangleField> fields_;                   // on the walls in this file
  int frames_ = 0;
};

/// An array with the value numbers(k), a std::array, for each of `count` points.
std::string array(std::string_view name, std::string_view type, std::size_t count, const auto& numbers) {
  constexpr std::size_t kComponents = std::tuple_size_v<std::remove_cvref_t<decltype(numbers(0))>>;
  std::string text = "<DataArray type=\"" + std::string(type) + "\" Name=\"" + std::string(name) + "\" NumberOfComponents=\"" +
                     std::to_string(kComponents) + "\" format=\"ascii\">\n";
  for (std::size_t k = 0; k < count; ++k) {
    for (const auto number : numbers(k)) text += shortest(number) + ' ';
    text += '\n';
  }
  return text + "</DataArray>\n";
}

/// Cells of one kind, each with N vertices.
template <std::size_t N>
std::string cells(std::string_view kind, const std::vector<std::array<unsigned int, N>>& corners) {
  const std::string tag(kind);
  const auto corner = [&](std::size_t k) { return std::array{static_cast<double>(corners[k / N][k % N])}; };
  const auto end = [](std::size_t k) { return std::array{static_cast<double>(N * (k + 1))}; };
  return '<' + tag + ">\n" + array("connectivity", "Int64", N * corners.size(), corner) +
         array("offsets", "Int64", corners.size(), end) + "</" + tag + ">\n";
}

struct CellCounts {
  std::size_t verts, lines, polys;
};

std::string poly_data(std::size_t points, CellCounts counts, const std::string& content) {
  const auto number = [](const char* of, std::size_t count) { return std::string(of) + "=\"" + std::to_string(count) + "\" "; };
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n<Piece " +
         number("NumberOfPoints", points) + number("NumberOfVerts", counts.verts) + number("NumberOfLines", counts.lines) +
         number("NumberOfStrips", 0) + number("NumberOfPolys", counts.polys) + ">\n" + content +
         "</Piece>\n</PolyData>\n</VTKFile>\n";
}

/// Points with data. Each is a cell of its own, so that filters for cells also work.
std::string cloud(std::size_t count, const std::string& points, const std::string& data) {
  std::vector<std::array<unsigned int, 1>> corners(count);
  for (std::size_t k = 0; k < count; ++k) corners[k] = {static_cast<unsigned int>(k)};
  return poly_data(count, {count, 0, 0},
                   "<PointData>\n" + data + "</PointData>\n<Points>\n" + points + "</Points>\n" + cells("Verts", corners));
}

/// The present walls, as one piece. Fields are 0 on edges, which come before the triangles, and on walls without numbers.
std::string container_of(const std::vector<WallPicture>& walls, const Frame& frame) {
  const std::vector<WallPlace>& places = frame.wall_places;
  std::vector<Point> points;
  std::vector<std::array<unsigned int, 2>> edges;
  std::vector<std::array<unsigned int, 3>> triangles;
  for (std::size_t wall = 0; wall < walls.size(); ++wall) {
    if (places[wall].scale == 0) continue;
    const auto first = static_cast<unsigned int>(points.size());
    for (const auto& vertex : walls[wall].mesh.vertices) points.push_back(places[wall](vertex));
    for (const auto& [a, b] : walls[wall].edges) edges.push_back({first + a, first + b});
    for (const auto& [a, b, c] : walls[wall].mesh.triangles) triangles.push_back({first + a, first + b, first + c});
  }
  std::string data;
  for (const TriangleField& field : frame.fields) {
    std::vector<double> numbers(edges.size());
    for (std::size_t wall = 0; wall < walls.size(); ++wall) {
      if (places[wall].scale == 0) continue;
      numbers.insert(numbers.end(), field.of_walls[wall].begin(), field.of_walls[wall].end());
      if (field.of_walls[wall].empty()) numbers.resize(numbers.size() + walls[wall].mesh.triangles.size());
    }
    data += array(field.name, "Float64", numbers.size(), [&](std::size_t k) { return std::array{numbers[k]}; });
  }
  return poly_data(points.size(), {0, edges.size(), triangles.size()},
                   (data.empty() ? "" : "<CellData>\n" + data + "</CellData>\n") + "<Points>\n" +
                       array("position", "Float64", points.size(), [&](std::size_t k) { return points[k]; }) + "</Points>\n" +
                       cells("Lines", edges) + cells("Polys", triangles));
}

/// The bonds that are not broken.
std::string bonds_of(const Frame& frame, const std::vector<BondPicture>& bonds) {
  std::vector<Point> points;
  std::vector<std::array<unsigned int, 2>> lines;
  for (const auto& [first, second, until] : bonds) {
    if (until <= frame.time) continue;
    const auto next = static_cast<unsigned int>(points.size());
    lines.push_back({next, next + 1});
    points.insert(points.end(), {frame.grains[first].position, frame.grains[second].position});
  }
  return poly_data(points.size(), {0, lines.size(), 0},
                   "<Points>\n" + array("position", "Float64", points.size(), [&](std::size_t k) { return points[k]; }) +
                       "</Points>\n" + cells("Lines", lines));
}

std::string contacts_of(const Frame& frame, bool has_forces) {
  const std::size_t count = frame.contacts.size();
  const auto& contacts = frame.contacts;
  const auto bodies = [&](std::size_t k) {
    return std::array{static_cast<double>(contacts[k].grain1), static_cast<double>(contacts[k].grain2)};
  };
  const auto force = [&](std::size_t k) { return contacts[k].force.value_or(Point{}); };
  return cloud(count, array("position", "Float64", count, [&](std::size_t k) { return contacts[k].position; }),
               array("normal", "Float64", count, [&](std::size_t k) { return contacts[k].normal; }) +
                   array("depth", "Float64", count, [&](std::size_t k) { return std::array{contacts[k].depth}; }) +
                   array("bodies", "Int32", count, bodies) + (has_forces ? array("force", "Float64", count, force) : ""));
}

void write_list(const std::filesystem::path& path, const std::string& entries) {
  write_file(path, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n" + entries +
                       "</Collection>\n</VTKFile>\n");
}

}  // namespace

VtkSeries::VtkSeries(const OutputFolder& folder, const Contents& contents)
    : grains_file_(folder.file("grains.pvd")),
      contacts_file_(folder.file("contacts.pvd")),
      container_file_(folder.file("container.pvd")),
      bonds_file_(folder.file("bonds.pvd")),
      frames_folder_(folder.file(std::string(kVtkFolder))),
      contents_(contents) {
  create_folder(frames_folder_);
}

void VtkSeries::add(const Frame& frame) {
  list(grains_, frame.time, write("grains", grains_of(frame)));
  list(contacts_, frame.time, write("contacts", contacts_of(frame, contents_.scene->forces)));
  if (!contents_.bonds.empty()) list(bonds_, frame.time, write("bonds", bonds_of(frame, contents_.bonds)));
  if (frames_ == 0 || frame.wall_places != wall_places_ || frame.fields != fields_) {
    container_ = write("container", container_of(contents_.walls, frame));
  }
  wall_places_ = frame.wall_places;
  fields_ = frame.fields;
  list(containers_, frame.time, container_);
  ++frames_;
}

void VtkSeries::finish(const std::string& /*summary*/) {
  write_list(grains_file_, grains_);
  write_list(contacts_file_, contacts_);
  write_list(container_file_, containers_);
  if (!bonds_.empty()) write_list(bonds_file_, bonds_);
}

std::string VtkSeries::write(std::string_view what, const std::string& text) const {
  std::array<char, 16> number{};
  std::snprintf(number.data(), number.size(), "_%06d.vtp", frames_);
  std::string name = std::string(what) + number.data();
  write_file(frames_folder_ / name, text);
  return name;
}

void VtkSeries::list(std::string& entries, double time, const std::string& name) {
  entries += "<DataSet timestep=\"" + shortest(time) + "\" file=\"" + std::string(kVtkFolder) + '/' + name + "\"/>\n";
}

std::string VtkSeries::grains_of(const Frame& frame) const {
  const std::vector<ShownComponent> components = shown_components(frame, contents_);
  const std::size_t count = components.size();
  const auto body = [&](std::size_t k) -> const ConvexBody& { return components[k].body; };
  const auto kind = [&](std::size_t k) { return std::array{static_cast<double>(contents_.kind_of_grain[components[k].grain])}; };
  const auto grain = [&](std::size_t k) { return std::array{static_cast<double>(components[k].grain)}; };
  const auto exponents = [&](std::size_t k) { return std::array{body(k).delta, body(k).epsilon}; };
  const auto numbers = [&](std::string_view name, const auto& of) { return array(name, "Float64", count, of); };
  const bool needs_index = contents_.scene->changes_population() || contents_.scene->has_compounds();
  return cloud(count, numbers("position", [&](std::size_t k) { return components[k].position; }),
               array("kind", "Int32", count, kind) + (needs_index ? array("grain", "Int32", count, grain) : "") +
                   numbers("quaternion", [&](std::size_t k) { return components[k].quaternion; }) +
                   numbers("half_axes", [&](std::size_t k) { return body(k).half_axes; }) + numbers("exponents", exponents) +
                   numbers("rounding", [&](std::size_t k) { return std::array{body(k).rounding}; }) +
                   numbers("velocity", [&](std::size_t k) { return components[k].velocity; }) +
                   numbers("angular_velocity", [&](std::size_t k) { return components[k].angular_velocity; }));
}

PictureFormat vtk_format() {
  return {"vtk",
          {"grains.pvd", "contacts.pvd", "container.pvd", "bonds.pvd", kVtkFolder},
          [](const OutputFolder& folder, const PictureFormat&, const Contents& contents) -> std::unique_ptr<Picture> {
            return std::make_unique<VtkSeries>(folder, contents);
          }};
}

}  // namespace falling_particles
