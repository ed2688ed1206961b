// A page that plays a run in a browser.

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <supernormal/shapes/tessellation.hpp>
#include <vector>

#include "base/write_file.hpp"
#include "frame.hpp"
#include "model/grain_shape.hpp"
#include "packed_frames.hpp"
#include "picture.hpp"

// The page that `npm run build` makes in page/ (view_page_html.S).
extern "C" const char kViewPageHtml[], kViewPageHtmlEnd[];

namespace falling_particles {
namespace {

/// view.html: the page of `page/` with the run in it, without other files. It is written at the end of a run; until then a grain
/// needs up to 45 bytes per frame.
class ViewPage final : public Picture {
 public:
  ViewPage(const std::filesystem::path& path, const Contents& contents);
  void add(const Frame& frame) override;
  void finish(const std::string& summary) override;

 private:
  std::filesystem::path path_;
  const Contents& contents_;
  std::vector<double> times_, kinetic_, potential_;
  std::vector<std::vector<double>> wall_scales_;  // of each frame
  std::vector<std::vector<double>> wall_poses_;   // of each frame: x, y, z of the position and x, y, z, w of each moving wall
  PackedGrains grains_;
  std::vector<std::size_t> grain_counts_;  // of each frame
  PackedContacts contacts_;
};

using nlohmann::json;

// The placeholder of the run in the page.
constexpr std::string_view kPlace = "<!-- the run -->";

// Bytes: with this budget the page of 1000 grains and 150 frames is smaller than 8 MB.
constexpr std::size_t kContactBudget = 2'500'000;

// Relative to the smallest half-axis of a grain. The first mesh shows no edges. While the page moves, it uses the coarser meshes if
// the finer ones are too slow.
constexpr std::array kChordErrors = {0.02, 0.1, 0.4};

template <typename Number>
std::string packed(const std::vector<Number>& numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  if (!numbers.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return to_base64(bytes);
}

std::vector<float> coordinates(const std::vector<supernormal::Vector3>& vectors) {
  std::vector<float> numbers;
  for (const supernormal::Vector3& vector : vectors) {
    for (const double x : vector) numbers.push_back(static_cast<float>(x));
  }
  return numbers;
}

template <typename Item, std::size_t N>
std::vector<std::uint32_t> indices(const std::vector<std::array<Item, N>>& tuples) {
  std::vector<std::uint32_t> numbers;
  for (const auto& tuple : tuples) numbers.insert(numbers.end(), tuple.begin(), tuple.end());
  return numbers;
}

json meshes_of(const GrainKind& kind) {
  json meshes;
  for (const double chord_error : kChordErrors) {
    const supernormal::Tessellation body = mesh_of(kind, chord_error);
    meshes.push_back({{"points", packed(coordinates(body.points))},
                      {"normals", packed(coordinates(body.normals))},
                      {"triangles", packed(indices(body.triangles))}});
  }
  return meshes;
}

const char* shape_name(const GrainKind& kind) {
  if (!kind.components.empty()) return "compound";
  return kind.is_capsule ? "capsule" : "superellipsoid";
}

json describe(const GrainKind& kind, std::size_t index) {
  return {{"shape", shape_name(kind)},
          {"parts", kind.all_components().size()},
          {"name", kind.name},
          {"halfAxes", kind.half_axes},
          {"exponents", {kind.delta, kind.epsilon}},
          {"rounding", kind.rounding},
          {"radius", kind.bounding_radius()},
          {"density", kind.density},
          {"source", kind.source},
          {"colour", colour_of_kind(index)},
          {"meshes", meshes_of(kind)}};
}

json describe(const WallPicture& wall) {
  std::vector<float> points;
  for (const auto& vertex : wall.mesh.vertices) points.insert(points.end(), vertex.begin(), vertex.end());
  return {{"name", wall.name},
          {"points", packed(points)},
          {"triangles", packed(indices(wall.mesh.triangles))},
          {"edges", packed(indices(wall.edges))},
          {"moves", wall.role == WallPicture::Role::Moving}};
}

/// A script element with data for another script. In JSON a '<', which might end the element, is escaped.
void write_json(std::ostream& stream, const json& value) {
  std::string text = value.dump();
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) text.replace(at, 1, "\\u003c");
  stream << R"(<script type="application/json" id="run">)" << text << "</script>\n";
}

void write_lines(std::ostream& stream, const char* id, const auto& texts) {
  stream << R"(<script type="text/plain" id=")" << id << "\">\n";
  for (const std::string& text : texts) stream << text << '\n';
  stream << "</script>\n";
}

}  // namespace

ViewPage::ViewPage(const std::filesystem::path& path, const Contents& contents)
    : path_(path), contents_(contents), contacts_(kContactBudget) {}

void ViewPage::add(const Frame& frame) {
  times_.push_back(frame.time);
  kinetic_.push_back(frame.energy.kinetic);
  potential_.push_back(frame.energy.potential);
  std::vector<double>& scales = wall_scales_.emplace_back();
  std::vector<double>& poses = wall_poses_.emplace_back();
  for (std::size_t i = 0; i < contents_.walls.size(); ++i) {
    const WallPlace& place = frame.wall_places[i];
    scales.push_back(place.scale);
    if (contents_.walls[i].role != WallPicture::Role::Moving) continue;
    const auto& [w, x, y, z] = place.quaternion;
    poses.insert(poses.end(), place.position.begin(), place.position.end());
    poses.insert(poses.end(), {x, y, z, w});
  }
  grains_.add(frame);
  grain_counts_.push_back(frame.grains.size());
  contacts_.add(frame);
}

void ViewPage::finish(const std::string& summary) {
  const Scene& scene = *contents_.scene;
  json run = {{"scene", scene.name},      {"container", kind_of(scene.container)},
              {"times", times_},          {"kinetic", kinetic_},
              {"potential", potential_},  {"partScales", wall_scales_},
              {"partPoses", wall_poses_}, {"forces", scene.forces},
              {"summary", summary}};
  if (is_any(scene.periodic)) {
    for (const std::optional<Period>& period : scene.periodic) run["periods"].push_back(period ? period->length : 0);
  }
  if (scene.changes_population()) run["bodyCounts"] = grain_counts_;
  for (std::size_t kind = 0; kind < scene.kinds.size(); ++kind) run["kinds"].push_back(describe(scene.kinds[kind].kind, kind));
  run["kindOfBody"] = packed(std::vector<std::uint16_t>(contents_.kind_of_grain.begin(), contents_.kind_of_grain.end()));
  if (!contents_.scale_of_grain.empty()) {
    run["scales"] = packed(std::vector<float>(contents_.scale_of_grain.begin(), contents_.scale_of_grain.end()));
  }
  std::vector<std::uint32_t> bonded;
  std::vector<float> until;
  for (const BondPicture& bond : contents_.bonds) {
    bonded.insert(bonded.end(), {static_cast<std::uint32_t>(bond.first), static_cast<std::uint32_t>(bond.second)});
    until.push_back(static_cast<float>(bond.until));
  }
  run["bonds"] = {{"bodies", packed(bonded)}, {"until", packed(until)}};
  for (const WallPicture& wall : contents_.walls) run["parts"].push_back(describe(wall));
  std::vector<std::string> contacts;
  for (PackedContacts::Packed& packed : contacts_.texts()) {
    run["contacts"].push_back({{"frame", packed.frame}, {"count", packed.count}, {"length", packed.length}});
    contacts.push_back(std::move(packed.text));
  }

  const std::string_view page(kViewPageHtml, static_cast<std::size_t>(kViewPageHtmlEnd - kViewPageHtml));
  const std::size_t place = page.find(kPlace);
  std::ofstream stream(path_, std::ios::binary);
  stream << page.substr(0, place);
  write_json(stream, run);
  write_lines(stream, "bodies", grains_.texts());
  write_lines(stream, "contacts", contacts);
  stream << page.substr(place + kPlace.size());
  close_or_throw(stream, path_);
}

PictureFormat page_format() { return {"page", {"view.html"}, make_file<ViewPage>}; }

}  // namespace falling_particles
