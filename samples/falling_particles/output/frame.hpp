// The data of a run that pictures show.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "model/geometry.hpp"
#include "model/scene.hpp"
#include "observe/energy.hpp"
#include "observe/measurement.hpp"
#include "observe/wall_mesh.hpp"

namespace falling_particles {

class Stepper;
class World;

/// A grain at one time, in the world's frame.
struct GrainState {
  Point position;                    ///< m, of the centre
  std::array<double, 4> quaternion;  ///< w, x, y, z; unit: from the grain's frame to the world's
  Point velocity;                    ///< m/s
  Point angular_velocity;            ///< rad/s
  bool is_present = true;            ///< false for a removed grain, whose other numbers are 0

  void serialize(auto& archive) { archive(position, quaternion, velocity, angular_velocity, is_present); }
};

/// A contact of the last step, in the world's frame.
struct ContactState {
  Point position;  ///< m
  Point normal;    ///< unit, towards grain 1, as in dContactGeom
  double depth;    ///< m
  int grain1;      ///< index of the grain; kWall for a wall
  int grain2;
  std::optional<Point> force = {};  ///< N, on grain 1, if the scene requests forces

  void serialize(auto& archive) { archive(position, normal, depth, grain1, grain2, force); }
};

inline constexpr int kWall = -1;

/// The pose and scale of a wall's mesh: it is scaled, rotated and moved.
struct WallPlace {
  Point position = {};                              ///< m
  std::array<double, 4> quaternion = {1, 0, 0, 0};  ///< w, x, y, z; unit
  double scale = 1;                                 ///< 0: the wall was removed

  Point operator()(const std::array<float, 3>& vertex) const;
  bool operator==(const WallPlace&) const = default;

  void serialize(auto& archive) { archive(position, quaternion, scale); }
};

/// A run at one time. The grains are all grains so far, by index, removed ones included.
struct Frame {
  double time = 0;  ///< s
  Energy energy{};
  std::vector<GrainState> grains;
  std::vector<ContactState> contacts;  ///< of the last step; none at the start. The contacts of a pair are consecutive
  std::vector<WallPlace> wall_places;  ///< of Contents::walls
  std::vector<TriangleField> fields;   ///< on Contents::walls

  void serialize(auto& archive) { archive(time, energy, grains, contacts, wall_places, fields); }
};

/// A box with sides along the axes.
struct Extent {
  Point least, most;  ///< m
};

/// The smallest box around spheres of `radius` (m) about the present grains; about the origin if there are none.
Extent extent_of(const Frame& frame, double radius);

/// A bond of two grains: a line between their centres.
struct BondPicture {
  std::size_t first, second;                               ///< indices of the grains
  double until = std::numeric_limits<double>::infinity();  ///< s, when it broke
};

/// The data of a run that do not change from frame to frame, except that inserted grains are appended and bonds break. The scene
/// must outlive it.
struct Contents {
  const Scene* scene;
  std::vector<std::size_t> kind_of_grain;   ///< index into scene->kinds, for all grains so far
  std::vector<WallPicture> walls = {};      ///< of the container, then of Scene::parts()
  std::vector<double> scale_of_grain = {};  ///< factors on the grains' lengths; empty if all are 1
  std::vector<BondPicture> bonds = {};      ///< of grains with grains

  const GrainKind& kind(std::size_t grain) const { return scene->kinds[kind_of_grain[grain]].kind; }
  double scale(std::size_t grain) const { return scale_of_grain.empty() ? 1 : scale_of_grain[grain]; }
};

/// m, above all grains of a run that has not started, and above its feeders. Walls of infinite height are shown up to it.
double top_of(const World& world, const Scene& scene);

Contents contents_of(const World& world, const Scene& scene, double top);
/// Of a run that has not started.
Contents contents_of(const World& world, const Scene& scene);

/// Appends the grains that were inserted since the last call, and says which bonds have broken.
void add_new_grains(Contents& contents, const World& world);

/// `stepper`: null before the first step. `with_forces`: shows the contacts with their forces, if the step measured them.
Frame frame_of(double time, const Energy& energy, const Contents& contents, const World& world, const Stepper* stepper,
               bool with_forces = true);

/// The fields of a measurement, on the walls of the contents instead of those of the scene.
std::vector<TriangleField> fields_on(const Contents& contents, std::vector<TriangleField> fields);

/// A convex body of a grain at one time, in the world's frame, at its true size.
struct ShownComponent {
  std::size_t index;                 ///< unique in a run: counted over the components of all grains, removed ones included
  std::size_t grain;                 ///< index of the grain in the frame
  ConvexBody body;                   ///< scaled
  Point position;                    ///< m, of the body's origin
  std::array<double, 4> quaternion;  ///< w, x, y, z; unit
  Point velocity;                    ///< m/s, of the body's origin
  Point angular_velocity;            ///< rad/s
};

/// In the order of the present grains: one body of each, but all components of a compound.
std::vector<ShownComponent> shown_components(const Frame& frame, const Contents& contents);

/// Red, green and blue in [0, 1] for a screen (sRGB).
using Colour = std::array<double, 3>;

/// The colour of a kind: from Okabe and Ito's palette, which people with any colour vision can distinguish; then the same colours
/// darker, then lighter, repeatedly.
inline Colour colour_of_kind(std::size_t kind) {
  constexpr std::array<Colour, 7> kPalette = {{{0.90, 0.62, 0.00},
                                               {0.34, 0.71, 0.91},
                                               {0.00, 0.62, 0.45},
                                               {0.94, 0.89, 0.26},
                                               {0.00, 0.45, 0.70},
                                               {0.84, 0.37, 0.00},
                                               {0.80, 0.47, 0.65}}};
  constexpr std::array kWhite = {0.0, 0.0, 0.55}, kStrength = {1.0, 0.5, 0.45};
  const std::size_t round = kind / kPalette.size() % kStrength.size();
  Colour colour = kPalette[kind % kPalette.size()];
  for (double& part : colour) part = kWhite[round] + kStrength[round] * part;
  return colour;
}

}  // namespace falling_particles
