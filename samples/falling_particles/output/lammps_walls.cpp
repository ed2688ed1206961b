#include "lammps_walls.hpp"

#include <cmath>
#include <numbers>
#include <sstream>
#include <variant>

#include "common/input_error.hpp"
#include "common/interval.hpp"

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
  WallsWriter(const Scene& scene, const std::vector<std::string>& laws)
      : scene_(scene), laws_(laws), law_(laws.empty() ? std::string() : laws.front()) {
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

  void operator()(const Cell& /*cell*/) {
    walls_.boundary = "m m m";
    for (std::size_t i = 0; i < scene_.walls.size(); ++i) {
      const Wall& side = scene_.walls[i];
      const Vector3 normal = side.start.rotation * std::get<PlaneShape>(side.shape).normal;
      add(side.name.c_str()) << "plane " << words(side.start.position) << ' ' << words(normal) << ' ' << laws_[i];
      for (const WallMotion& motion : side.motions) write(motion);
      if (side.drive) write(*side.drive);
      out_ << '\n';
    }
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
                     " has no counterpart in LAMMPS' input; allowed: box, cell, drum, hopper");
  }

 private:
  std::ostream& add(const char* name) { return out_ << "fix " << name << " all wall/supernormal "; }

  /// Without the sign of a zero.
  static std::string words(const Vector3& v) {
    return shortest(v.x() + 0.0) + ' ' + shortest(v.y() + 0.0) + ' ' + shortest(v.z() + 0.0);
  }

  void write_times(double from, double until) {
    if (from > 0) out_ << " from " << from;
    if (std::isfinite(until)) out_ << " until " << until;
  }

  void write(const WallMotion& motion) {
    out_ << " move ";
    if (const auto* translation = std::get_if<Translation>(&motion.kind)) {
      out_ << "linear " << words(translation->velocity);
    } else if (const auto* rotation = std::get_if<Rotation>(&motion.kind)) {
      out_ << "rotate " << words(rotation->axis) << ' ' << words(rotation->point) << ' ' << rotation->rpm;
    } else if (const auto* vibration = std::get_if<Vibration>(&motion.kind)) {
      out_ << "vibrate " << words(vibration->amplitude) << ' ' << vibration->frequency << ' ' << vibration->phase;
    } else {
      const auto& conveyor = std::get<Conveyor>(motion.kind);
      if (conveyor.turn.rpm != 0) {
        throw InputError(scene_.name + ": a motion of kind conveyor with rpm has no counterpart in LAMMPS' input: leave it out");
      }
      out_ << "conveyor " << words(conveyor.velocity);
    }
    write_times(motion.from, motion.until);
  }

  void write(const Drive& drive) {
    out_ << " drive axis " << words(drive.axis);
    if (drive.servo) {
      write(*drive.servo);
    } else {
      const char* const push = drive.turns() ? "torque " : "force ";
      drive.power > 0 ? out_ << " power " << drive.power << " largest_" << push << drive.force : out_ << ' ' << push << drive.force;
      if (drive.turns()) out_ << " point " << words(*drive.point) << " moment " << drive.mass;
      const double mass = drive.turns() ? drive.hung_mass : drive.mass;
      if (mass > 0) out_ << " mass " << mass;
      if (mass > 0 && scene_.gravity() != nullptr) out_ << " gravity " << kGravityFix;
      if (drive.damping > 0) out_ << " damping " << drive.damping;
    }
    const double unit = drive.turns() ? 180 / std::numbers::pi : 1;
    if (std::isfinite(drive.travel[0])) out_ << " travel " << unit * drive.travel[0] << ' ' << unit * drive.travel[1];
    write_times(drive.from, drive.until);
  }

  void write(const Servo& servo) {
    out_ << " stress " << servo.stress << " gain " << servo.gain << " largest_speed " << servo.largest_speed;
    if (servo.between.empty()) {
      out_ << " area " << servo.area;
      return;
    }
    out_ << " between";
    for (const FacingWalls& pair : servo.between) out_ << ' ' << pair[0] << ' ' << pair[1];
  }

  void add_mesh(const char* name, const Mesh& mesh) {
    const std::string file = scene_.name + '.' + name + ".obj";
    add(name) << "mesh " << file << " 1 " << law_ << '\n';
    walls_.files.push_back({file, to_obj(mesh)});
  }

  const Scene& scene_;
  const std::vector<std::string>& laws_;
  std::string law_;  // of walls without coefficients of their own
  LammpsWalls walls_{};
  std::ostringstream out_;
};

}  // namespace

LammpsWalls lammps_walls(const Scene& scene, const std::vector<std::string>& laws) { return WallsWriter(scene, laws).write(); }

}  // namespace falling_particles
