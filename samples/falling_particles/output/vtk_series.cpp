#include "output/vtk_series.hpp"

#include <array>
#include <cstdio>
#include <tuple>
#include <type_traits>

#include "output/write_file.hpp"
#include "scene/interval.hpp"

namespace falling_particles {
namespace {

constexpr std::string_view kFramesFolder = "vtk";

/// An array with a value for each of `count` points, which numbers(k) gives as a std::array.
template <typename Numbers>
std::string array(std::string_view name, std::string_view type, std::size_t count, const Numbers& numbers) {
  constexpr std::size_t kComponents = std::tuple_size_v<std::remove_cvref_t<decltype(numbers(0))>>;
  std::string text = "<DataArray type=\"" + std::string(type) + "\" Name=\"" + std::string(name) + "\" NumberOfComponents=\"" +
                     std::to_string(kComponents) + "\" format=\"ascii\">\n";
  for (std::size_t k = 0; k < count; ++k) {
    for (const auto number : numbers(k)) text += shortest(number) + ' ';
    text += '\n';
  }
  return text + "</DataArray>\n";
}

/// Points, each a cell of its own, so that filters for cells see them, too.
std::string poly_data(std::size_t count, const std::string& points, const std::string& data) {
  const auto self = [](std::size_t k) { return std::array{static_cast<double>(k)}; };
  const auto next = [](std::size_t k) { return std::array{static_cast<double>(k + 1)}; };
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n"
         "<Piece NumberOfPoints=\"" +
         std::to_string(count) + "\" NumberOfVerts=\"" + std::to_string(count) +
         "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<PointData>\n" + data + "</PointData>\n<Points>\n" +
         points + "</Points>\n<Verts>\n" + array("connectivity", "Int64", count, self) + array("offsets", "Int64", count, next) +
         "</Verts>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

std::string contacts_of(const Frame& frame) {
  const std::size_t count = frame.contacts.size();
  const auto& contacts = frame.contacts;
  const auto bodies = [&](std::size_t k) {
    return std::array{static_cast<double>(contacts[k].body1), static_cast<double>(contacts[k].body2)};
  };
  return poly_data(count, array("position", "Float64", count, [&](std::size_t k) { return contacts[k].position; }),
                   array("normal", "Float64", count, [&](std::size_t k) { return contacts[k].normal; }) +
                       array("depth", "Float64", count, [&](std::size_t k) { return std::array{contacts[k].depth}; }) +
                       array("bodies", "Int32", count, bodies));
}

void write_list(const std::filesystem::path& path, const std::string& entries) {
  write_file(path, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n" + entries +
                       "</Collection>\n</VTKFile>\n");
}

}  // namespace

VtkSeries::VtkSeries(const OutputFolder& folder, const Contents& contents)
    : grains_file_(folder.file("grains.pvd")),
      contacts_file_(folder.file("contacts.pvd")),
      frames_folder_(folder.file(std::string(kFramesFolder))),
      contents_(contents) {
  std::filesystem::create_directory(frames_folder_);
}

void VtkSeries::add(const Frame& frame) {
  write_frame("grains", frame.time, grains_of(frame), grains_);
  write_frame("contacts", frame.time, contacts_of(frame), contacts_);
  ++frames_;
}

void VtkSeries::finish(const std::string& /*summary*/) {
  write_list(grains_file_, grains_);
  write_list(contacts_file_, contacts_);
}

void VtkSeries::write_frame(std::string_view what, double time, const std::string& text, std::string& list) const {
  std::array<char, 16> number{};
  std::snprintf(number.data(), number.size(), "_%06d.vtp", frames_);
  const std::string name = std::string(what) + number.data();
  write_file(frames_folder_ / name, text);
  list += "<DataSet timestep=\"" + shortest(time) + "\" file=\"" + std::string(kFramesFolder) + '/' + name + "\"/>\n";
}

std::string VtkSeries::grains_of(const Frame& frame) const {
  const std::size_t count = frame.bodies.size();
  const auto grain = [&](std::size_t k) -> const Grain& { return contents_.grain(k); };
  const auto numbers = [&](std::string_view name, const auto& of) { return array(name, "Float64", count, of); };
  return poly_data(
      count, numbers("position", [&](std::size_t k) { return frame.bodies[k].position; }),
      array("kind", "Int32", count, [&](std::size_t k) { return std::array{static_cast<double>(contents_.kind_of_body[k])}; }) +
          numbers("quaternion", [&](std::size_t k) { return frame.bodies[k].quaternion; }) +
          numbers("half_axes", [&](std::size_t k) { return grain(k).half_axes; }) +
          numbers("exponents",
                  [&](std::size_t k) {
                    return std::array{grain(k).delta, grain(k).epsilon};
                  }) +
          numbers("rounding", [&](std::size_t k) { return std::array{grain(k).rounding}; }) +
          numbers("velocity", [&](std::size_t k) { return frame.bodies[k].velocity; }) +
          numbers("angular_velocity", [&](std::size_t k) { return frame.bodies[k].angular_velocity; }));
}

}  // namespace falling_particles
