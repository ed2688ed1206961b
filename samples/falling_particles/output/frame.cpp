#include "frame.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "observe/wall_mesh.hpp"
#include "world/bonds.hpp"
#include "world/grain.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

namespace falling_particles {
namespace {

int index_of(dGeomID geom, const World& world) {
  const Grain* grain = grain_of(geom);
  return grain == nullptr ? kWall : static_cast<int>(grain - world.grains().data());
}

/// The factor by which the mesh of a wall is scaled.
double scale_of(const WallPicture& wall, const World& world) {
  switch (wall.role) {
    case WallPicture::Role::Lid:
      return world.walls().has_lid() ? 1 : 0;
    case WallPicture::Role::Cell:
      return world.cell()->side();
    case WallPicture::Role::Still:
    case WallPicture::Role::Moving:
      break;
  }
  return 1;
}

WallPlace place_of(const WallPose& pose) {
  const auto& [p, q] = pose;
  return {{p.x(), p.y(), p.z()}, {q.w(), q.x(), q.y(), q.z()}, 1};
}

/// The container's plan up to `top` (m), the feeders, and the parts that are not infinite. A resumed run finds the same.
Box3 contents_box(const Scene& scene, double top) {
  const Rectangle plan = plan_of(scene.container);
  const double floor = lowest_start(scene.container);
  Box3 box(Vector3(plan.corner[0], plan.corner[1], std::min(floor, top)));
  box.extend(Vector3(plan.corner[0] + plan.width[0], plan.corner[1] + plan.width[1], std::max(floor, top)));
  for (const Feeder& feeder : scene.feeders) {
    const Vector3 corner(feeder.region.corner.data());
    box.extend(corner).extend(Vector3(corner + Vector3(feeder.region.size.data())));
  }
  for (const Wall& wall : scene.parts()) {
    const Vector3 radius = Vector3::Constant(bounding_radius(wall.shape));
    if (radius.allFinite()) box.extend(Vector3(wall.start.position - radius)).extend(Vector3(wall.start.position + radius));
  }
  return box;
}

ContactState state_of(const dContactGeom& contact, const World& world) {
  return {to_point(contact.pos),       to_point(contact.normal),    contact.depth,
          index_of(contact.g1, world), index_of(contact.g2, world), {}};
}

/// Adds the contacts of the last step. With forces these are the contacts that the effects have kept.
void add_contacts(Frame& frame, const World& world, const Stepper& stepper, bool with_forces) {
  if (with_forces) {
    for (const MeasuredContact& contact : stepper.measured_contacts()) {
      frame.contacts.push_back(state_of(contact.geom, world));
      frame.contacts.back().force = contact.force();
    }
  }
  if (!frame.contacts.empty()) return;
  frame.contacts.reserve(stepper.contact_geoms().size());
  for (const dContactGeom& contact : stepper.contact_geoms()) frame.contacts.push_back(state_of(contact, world));
}

/// Null for a picture of several walls.
const Wall* wall_of(std::size_t picture, const Contents& contents) {
  const std::span<const Wall> parts = contents.scene->parts();
  const std::size_t sides = contents.walls.size() - parts.size();
  if (picture >= sides) return &parts[picture - sides];
  const auto found = std::ranges::find(contents.scene->walls, contents.walls[picture].name, &Wall::name);
  return found == contents.scene->walls.end() || found->is_part() ? nullptr : &*found;
}

using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond to_quaternion(const std::array<double, 4>& q) { return {q[0], q[1], q[2], q[3]}; }

ConvexBody scaled(ConvexBody body, double scale) {
  for (double& half_axis : body.half_axes) half_axis *= scale;
  body.rounding *= scale;
  return body;
}

}  // namespace

Point WallPlace::operator()(const std::array<float, 3>& vertex) const {
  const auto& [w, x, y, z] = quaternion;
  const Vector3 turned = Eigen::Quaterniond(w, x, y, z) * (scale * Vector3(vertex[0], vertex[1], vertex[2]));
  return {position[0] + turned.x(), position[1] + turned.y(), position[2] + turned.z()};
}

Extent extent_of(const Frame& frame, double radius) {
  if (std::ranges::none_of(frame.grains, &GrainState::is_present)) return {{-radius, -radius, -radius}, {radius, radius, radius}};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Extent extent{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const GrainState& grain : frame.grains) {
    if (!grain.is_present) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent.least[axis] = std::min(extent.least[axis], grain.position[axis] - radius);
      extent.most[axis] = std::max(extent.most[axis], grain.position[axis] + radius);
    }
  }
  return extent;
}

double top_of(const World& world, const Scene& scene) {
  double top = 0;
  for (const Grain& grain : world.present()) top = std::max(top, grain.position()[2] + grain.bounding_radius());
  for (const Feeder& feeder : scene.feeders) top = std::max(top, feeder.region.corner[2] + feeder.region.size[2]);
  return top;
}

Contents contents_of(const World& world, const Scene& scene) { return contents_of(world, scene, top_of(world, scene)); }

Contents contents_of(const World& world, const Scene& scene, double top) {
  Contents contents{&scene, {}, {}};
  add_new_grains(contents, world);
  contents.walls = pictures_of(scene.container, top, scene.periodic);
  const Box3 region = region_of_planes(contents_box(scene, top), scene.walls);
  for (const Wall& wall : scene.parts()) contents.walls.push_back(picture_of(wall, region));
  return contents;
}

void add_new_grains(Contents& contents, const World& world) {
  contents.kind_of_grain.reserve(world.grains().capacity());
  for (std::size_t i = contents.kind_of_grain.size(); i < world.grains().size(); ++i) {
    contents.kind_of_grain.push_back(contents.scene->kind_of(*world.grains()[i].kind));
    if (contents.scene->has_sizes()) contents.scale_of_grain.push_back(world.grains()[i].scale);
  }
  if (world.bonds() == nullptr) return;
  std::vector<BondPicture> all;
  for (const Bond& bond : world.bonds()->all()) all.push_back({bond.first, bond.second});
  for (const BondBreak& failure : world.bonds()->breaks()) all[failure.bond].until = failure.time;
  std::erase_if(all, [](const BondPicture& bond) { return bond.first == Bond::kPart || bond.second == Bond::kPart; });
  contents.bonds = std::move(all);
}

Frame frame_of(double time, const Energy& energy, const Contents& contents, const World& world, const Stepper* stepper,
               bool with_forces) {
  Frame frame;
  frame.time = time;
  frame.energy = energy;
  const std::size_t drawn = contents.walls.size(), all = contents.scene->walls.size();  // both lists end with the parts
  for (std::size_t i = 0; i < contents.walls.size(); ++i) {
    const WallPicture& wall = contents.walls[i];
    frame.wall_places.push_back(wall.role == WallPicture::Role::Moving ? place_of(world.walls().state(i + all - drawn).pose)
                                                                       : WallPlace{.scale = scale_of(wall, world)});
  }
  frame.grains.reserve(world.grains().size());
  for (const Grain& grain : world.grains()) {
    if (!grain.is_present()) {
      frame.grains.push_back({{}, {1, 0, 0, 0}, {}, {}, false});
      continue;
    }
    frame.grains.push_back({grain.position(), grain.quaternion(), grain.velocity(), grain.angular_velocity()});
  }
  if (stepper != nullptr) add_contacts(frame, world, *stepper, with_forces);
  return frame;
}

std::vector<TriangleField> fields_on(const Contents& contents, std::vector<TriangleField> fields) {
  for (TriangleField& field : fields) {
    std::vector<std::vector<double>> of_walls;
    for (std::size_t i = 0; i < contents.walls.size(); ++i) {
      const Wall* const wall = wall_of(i, contents);
      const auto index = wall == nullptr ? field.of_walls.size() : static_cast<std::size_t>(wall - contents.scene->walls.data());
      of_walls.push_back(index < field.of_walls.size() ? field.of_walls[index] : std::vector<double>());
    }
    field.of_walls = std::move(of_walls);
  }
  return fields;
}

std::vector<ShownComponent> shown_components(const Frame& frame, const Contents& contents) {
  std::vector<std::vector<Component>> components_of_kind;
  components_of_kind.reserve(contents.scene->kinds.size());
  for (const GrainCount& entry : contents.scene->kinds) components_of_kind.push_back(entry.kind.all_components());
  std::vector<ShownComponent> shown;
  shown.reserve(frame.grains.size());
  std::size_t index = 0;
  for (std::size_t k = 0; k < frame.grains.size(); ++k) {
    const GrainState& state = frame.grains[k];
    const std::vector<Component>& components = components_of_kind[contents.kind_of_grain[k]];
    if (!state.is_present) {
      index += components.size();
      continue;
    }
    const double scale = contents.scale(k);
    for (const Component& component : components) {
      ShownComponent& shown_component = shown.emplace_back(ShownComponent{
          index++, k, scaled(component.body, scale), state.position, state.quaternion, state.velocity, state.angular_velocity});
      if (contents.kind(k).components.empty()) continue;  // exactly the state of the grain
      const Quaterniond orientation = to_quaternion(state.quaternion);
      const Vector3d offset = orientation * (scale * to_vector(component.position));
      const Quaterniond rotation = orientation * to_quaternion(component.quaternion);
      shown_component.position = to_point(to_vector(state.position) + offset);
      shown_component.quaternion = {rotation.w(), rotation.x(), rotation.y(), rotation.z()};
      shown_component.velocity = to_point(to_vector(state.velocity) + to_vector(state.angular_velocity).cross(offset));
    }
  }
  return shown;
}

}  // namespace falling_particles
