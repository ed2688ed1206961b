#include "lammps_walls.hpp"

#include <sstream>
#include <variant>

#include "base/input_error.hpp"

namespace falling_particles {
namespace {

std::string to_obj(const Mesh& mesh) {
  std::ostringstream out;
  out.precision(9);
  for (const auto& [x, y, z] : mesh.vertices) out << "v " << x << ' ' << y << ' ' << z << '\n';
  for (const auto& [a, b, c] : mesh.triangles) out << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  return out.str();
}

class WallsWriter {
 public:
  WallsWriter(const Scene& scene, const std::string& law) : scene_(scene), law_(law) {
    const Rectangle plan = plan_of(scene.container);
    walls_.bounds = {{{plan.corner[0], plan.corner[0] + plan.width[0]},
                      {plan.corner[1], plan.corner[1] + plan.width[1]},
                      {lowest_start(scene.container), lowest_start(scene.container)}}};
    out_.precision(9);
  }

  LammpsWalls write() {
    std::visit(*this, scene_.container);
    walls_.commands = out_.str();
    return walls_;
  }

  void operator()(const Box& box) {
    add("container") << "box 0 0 0 " << box.width[0] << ' ' << box.width[1] << " 1e3 " << law_ << '\n';
  }

  void operator()(const Drum& drum) {
    const double z = drum.radius();
    std::ostringstream turning;
    turning << law_ << " move rotate 0 1 0 0 0 " << z << ' ' << drum.rpm << " from " << drum.turns_at << '\n';
    add("container") << "cylinder 0 0 " << z << " 0 1 0 " << drum.radius() << ' ' << turning.str();
    add("end1") << "plane 0 0 " << z << " 0 1 0 " << turning.str();
    add("end2") << "plane 0 " << drum.length << ' ' << z << " 0 -1 0 " << turning.str();
  }

  void operator()(const Hopper& hopper) {
    const double half = hopper.tray_width / 2;
    walls_.bounds = {{{-half, half}, {-half, half}, {0, 0}}};
    add("tray") << "box " << -half << ' ' << -half << " 0 " << half << ' ' << half << " 1e3 " << law_ << '\n';
    if (hopper.opens_at > 0) {
      add("lid") << "plane 0 0 " << hopper.clearance << " 0 0 1 " << law_ << '\n';
      walls_.change = LammpsChange{hopper.opens_at, "unfix lid\n"};
    }
    add_mesh("hopper", make_mesh(hopper));
    if (hopper.dish) add_mesh("dish", make_mesh(*hopper.dish, hopper.segments));
  }

  template <typename Other>
  void operator()(const Other& /*container*/) {
    throw InputError(scene_.name + ": a container of kind " + kind_of(scene_.container) +
                     " has no counterpart in LAMMPS' input; allowed: box, drum, hopper");
  }

 private:
  std::ostream& add(const char* name) { return out_ << "fix " << name << " all wall/supernormal "; }

  void add_mesh(const char* name, const Mesh& mesh) {
    const std::string file = scene_.name + '.' + name + ".obj";
    add(name) << "mesh " << file << " 1 " << law_ << '\n';
    walls_.files.push_back({file, to_obj(mesh)});
  }

  const Scene& scene_;
  const std::string& law_;
  LammpsWalls walls_{};
  std::ostringstream out_;
};

}  // namespace

LammpsWalls lammps_walls(const Scene& scene, const std::string& law) { return WallsWriter(scene, law).write(); }

}  // namespace falling_particles
