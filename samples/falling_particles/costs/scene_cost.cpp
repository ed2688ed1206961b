// Times a step of a settled bed of grains: of smooth bodies, and of the same grains as boxes and meshes of ODE. Prints a Markdown
// table.
//   scene_cost SCENE      of superellipsoids in a container (samples/scenes/pile.toml)

#include <ode/ode.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <deque>
#include <exception>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/ode_geom.hpp"
#include "common/random.hpp"
#include "common/stopwatch.hpp"
#include "model/scene.hpp"
#include "world/placement.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

namespace {

using namespace falling_particles;
using common::OdeGeom;

enum class Form { Smooth, Box, Mesh };
constexpr std::array kNames = {"Supernormal, 1e-9", "`dBox`", "`dTriMesh`, 960 triangles"};

/// Boxes have the half-axes of their grains. Meshes have their vertices on them, and fit into the bed of the smooth grains.
common::GeomMaker maker_of(const GrainKind& kind, Form form) {
  if (kind.is_capsule || !kind.components.empty()) throw std::invalid_argument('"' + kind.name + "\" is no superellipsoid");
  const ConvexBody body = kind.all_components().front().body;
  if (form == Form::Smooth) return [=] { return OdeGeom(create_geom(nullptr, body)); };
  if (form == Form::Box) return [s = body.half_axes] { return OdeGeom(dCreateBox(nullptr, 2 * s[0], 2 * s[1], 2 * s[2])); };
  const auto [x, y, z] = body.core_half_axes();
  return common::trimesh_maker(common::superellipsoid_mesh({x, y, z}, body.delta, body.epsilon, body.rounding, {24, 20}));
}

/// A bed whose grains have one form, with the masses of the smooth ones.
class Bed {
 public:
  Bed(const Scene& scene, std::vector<Placement> start, Form form)
      : form_(form), scene_(scene), places_(std::move(start)), world_(scene, places_), joints_(world_) {
    std::vector<common::GeomMaker> makers;
    makers.reserve(scene.kinds.size());
    geoms_.reserve(places_.size());
    for (const GrainCount& entry : scene.kinds) makers.push_back(maker_of(entry.kind, form));
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Grain& grain = world_.grains()[i];
      const dGeomID geom = geoms_.emplace_back(makers[places_[i].kind]()).id();
      dGeomSetBody(geom, grain.body);
      dGeomSetData(geom, dGeomGetData(grain.geom));  // the effects find the grain through it
      dGeomSetBody(grain.geom, nullptr);             // the geom of the world stays behind: moving it would cost time
      dGeomSetCategoryBits(geom, kGrainBit);
      dGeomSetCollideBits(geom, kGrainBit | kWallBit);
      dSpaceAdd(space_, geom);
    }
    for (const dGeomID wall : world_.walls().geoms()) dSpaceAdd(space_, wall);
    // Each grain is in cells of its own size.
    dHashSpaceSetLevels(space_, static_cast<int>(std::floor(std::log2(2 * scene.smallest_half_axis()))),
                        static_cast<int>(std::ceil(std::log2(2 * scene.largest_bounding_radius()))));
  }
  ~Bed() {
    for (const dGeomID wall : world_.walls().geoms()) dSpaceRemove(space_, wall);
    geoms_.clear();
    dSpaceDestroy(space_);
  }
  Bed(const Bed&) = delete;
  Bed& operator=(const Bed&) = delete;

  void step() {
    pairs_.clear();
    contacts_.clear();
    {
      const common::Stopwatch::Lap lap(step_);
      dSpaceCollide(space_, &pairs_, [](void* pairs, dGeomID one, dGeomID other) {
        static_cast<std::vector<std::pair<dGeomID, dGeomID>>*>(pairs)->emplace_back(one, other);
      });
      find_contacts();
      joints_.replace(contacts_);
      const common::Stopwatch::Lap solving(solver_);
      dWorldQuickStep(world_.id(), scene_.time.step);
    }
    ++steps_;
    all_contacts_ += contacts_.size();
  }
  void forget_costs() {
    narrow_ = solver_ = step_ = {};
    steps_ = all_contacts_ = 0;
  }
  std::vector<Placement> places() const {
    std::vector<Placement> now = places_;
    for (std::size_t i = 0; i < now.size(); ++i) {
      const Grain& grain = world_.grains()[i];
      now[i] = {now[i].kind, grain.position(), grain.quaternion(), 1, grain.velocity(), grain.angular_velocity()};
    }
    return now;
  }
  double seconds() const { return step_.seconds() / static_cast<double>(steps_); }  ///< of a step
  /// `ours`: s, of a step.
  void print(double ours) const {
    const double to_milli = 1e3 / static_cast<double>(steps_);
    std::printf("| %s | %.0f | %.1f | %.1f | %.1f | %.2f |\n", kNames[static_cast<std::size_t>(form_)],
                static_cast<double>(all_contacts_) / static_cast<double>(steps_), to_milli * narrow_.seconds(),
                to_milli * solver_.seconds(), to_milli * step_.seconds(), seconds() / ours);
  }

 private:
  void find_contacts() {
    const common::Stopwatch::Lap lap(narrow_);
    std::array<dContactGeom, kContactsPerPair> found;
    for (const auto& [one, other] : pairs_) {
      const int count = dCollide(one, other, kContactsPerPair, found.data(), sizeof(dContactGeom));
      contacts_.insert(contacts_.end(), found.begin(), found.begin() + count);
    }
  }

  Form form_;
  const Scene& scene_;
  std::vector<Placement> places_;
  World world_;
  ContactJoints joints_;
  dSpaceID space_ = dHashSpaceCreate(nullptr);
  std::vector<OdeGeom> geoms_;
  std::vector<std::pair<dGeomID, dGeomID>> pairs_;
  std::vector<dContactGeom> contacts_;
  common::Stopwatch narrow_, solver_, step_;
  std::size_t steps_ = 0, all_contacts_ = 0;
};

std::vector<Placement> settle(const Scene& scene, Form form) {
  constexpr double kSettlingTime = 0.6;  // s; a bed of pile.toml is at rest after a third of it
  common::Random random(scene.seed);
  Bed bed(scene, place(scene, random), form);
  for (int step = 0; step * scene.time.step < kSettlingTime; ++step) bed.step();
  return bed.places();
}

/// All forms take turns, so that other work of the machine affects each of them.
void compare(const Scene& scene) {
  const std::vector<Placement> of_smooth = settle(scene, Form::Smooth), of_boxes = settle(scene, Form::Box);
  std::deque<Bed> beds;
  for (const Form form : {Form::Smooth, Form::Box, Form::Mesh}) {
    beds.emplace_back(scene, form == Form::Box ? of_boxes : of_smooth, form);
    for (int step = 0; step < 5; ++step) beds.back().step();
    beds.back().forget_costs();
  }
  for (int round = 0; round < 8; ++round) {
    for (Bed& bed : beds) {
      for (int step = 0; step < 4; ++step) bed.step();
    }
  }
  std::puts("| one thread, ms | contacts | narrow phase | quickstep | step | step / ours |\n|---|---:|---:|---:|---:|---:|");
  for (const Bed& bed : beds) bed.print(beds.front().seconds());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: scene_cost SCENE\n", stderr);
    return 2;
  }
  try {
    compare(load_scene(argv[1]));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scene_cost: %s\n", error.what());
    return 1;
  }
}
