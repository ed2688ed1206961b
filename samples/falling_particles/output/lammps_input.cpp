#include "lammps_input.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <supernormal/supernormal.hpp>
#include <utility>
#include <variant>
#include <vector>

#include "base/write_file.hpp"
#include "common/input_error.hpp"
#include "common/interval.hpp"
#include "common/random.hpp"
#include "model/container.hpp"
#include "model/grain_shape.hpp"
#include "model/wall.hpp"
#include "world/placement.hpp"

namespace falling_particles {
namespace {

namespace fx = supernormal::effects;

/// A change of the walls during a run.
struct LammpsChange {
  double time;           ///< s
  std::string commands;  ///< between two runs
};

constexpr const char* kGravityFix = "fall";  ///< the name of fix gravity

struct LammpsWalls {
  std::array<std::array<double, 2>, 3> bounds;  ///< m; along x, y, z: of the space between the walls, open upwards
  const char* boundary = "f f m";               ///< of LAMMPS' box; shrink-wrapped around grains whose walls move
  std::string commands;
  std::optional<LammpsChange> change = {};  ///< the outlet of a hopper opens
  std::vector<LammpsFile> files = {};       ///< meshes, as OBJ
};

constexpr double kOverlap = 0.01;  // of the smallest half-axis, in the fastest impact
constexpr double kStepsPerImpact = 50;
constexpr double kRigidRestitution = 0.1;   // of contacts that do not bounce
constexpr double kLeastRestitution = 0.05;  // the least that pair_style supernormal accepts
constexpr double kHertzImpact = 2.9432675;  // duration of an impact of two balls, in largest depth / speed (Johnson 1985, 11.24)

[[noreturn]] void refuse(const Scene& scene, const std::string& what) {
  throw InputError(scene.name + ": " + what + " has no counterpart in LAMMPS' input: leave it out");
}

/// The contact law of all surfaces, collected from the effects.
struct Law {
  double friction = 0, rolling = 0, spinning = 0, adhesion = 0, restitution = kRigidRestitution;
  const fx::Hertz* hertz = nullptr;
  const fx::Compliance* compliance = nullptr;
};

/// Reads the effects one after the other. Effects that only serve ODE's solver are left out.
struct LawReader {
  const Scene& scene;
  Law law = {};            // of grains
  std::vector<Law> walls;  // of Scene::walls

  explicit LawReader(const Scene& of) : scene(of), walls(of.walls.size()) {}

  void require_all(const fx::MaterialSelector& on, const char* name) const {
    if (!on.is_all()) refuse(scene, std::string("[") + name + "] of a material");
  }
  /// All laws between the materials of an effect.
  std::vector<Law*> laws_on(const fx::MaterialSelector& on, const char* name) {
    std::vector<Law*> found;
    if (on.is_all()) found.push_back(&law);
    for (std::size_t i = 0; i < walls.size(); ++i) {
      const auto of_wall = fx::MaterialSelector::between(kGrainMaterial, material_of_wall(scene.walls, i));
      if (on.is_all() || on == of_wall) found.push_back(&walls[i]);
    }
    if (found.empty() && !(on == kGrainOnWall)) require_all(on, name);
    return found;
  }
  void operator()(const fx::Friction& friction) {
    for (Law* one : laws_on(friction.on, "friction")) one->friction = friction.coefficient;
  }
  void operator()(const fx::RollingResistance& resistance) {
    for (Law* one : laws_on(resistance.on, "rolling_resistance")) {
      one->rolling = resistance.rolling;
      one->spinning = resistance.spinning;
    }
  }
  void operator()(const fx::Restitution& restitution) {
    for (Law* one : laws_on(restitution.on, "restitution")) one->restitution = std::max(restitution.coefficient, kLeastRestitution);
  }
  void operator()(const fx::Hertz& hertz) {
    require_all(hertz.on, "hertz");
    law.hertz = &hertz;
    for (Law* one : laws_on(hertz.on, "hertz")) one->restitution = std::max(hertz.restitution, kLeastRestitution);
  }
  void operator()(const fx::Compliance& compliance) {
    require_all(compliance.on, "compliance");
    law.compliance = &compliance;
    for (Law* one : laws_on(compliance.on, "compliance")) one->restitution = compliance.damping == 0 ? 1 : one->restitution;
  }
  void operator()(const fx::Adhesion& adhesion) {
    require_all(adhesion.on, "adhesion");
    for (Law* one : laws_on(adhesion.on, "adhesion")) one->adhesion = adhesion.pull_off;
  }
  void operator()(const fx::Gravity& /*gravity*/) {}
  void operator()(const fx::AutoDisable& /*solver*/) {}
  void operator()(const fx::MaxCorrectingVelocity& /*solver*/) {}
  void operator()(const fx::SurfaceLayer& /*solver*/) {}
  void operator()(const fx::SpeculativeContacts& /*solver*/) {}
  void operator()(const auto& effect) { refuse(scene, fx::descriptions()[fx::Effect(effect).index()].name); }
};

double volume_of(const GrainKind& kind) {
  const supernormal::Vector3 axes(kind.half_axes[0], kind.half_axes[1], kind.half_axes[2]);
  return supernormal::Superellipsoid(axes, kind.delta, kind.epsilon).mass_properties().volume;
}

/// The quantities on which springs and steps depend.
struct Extremes {
  double lightest = INFINITY, heaviest = 0;  // kg
  double smallest = INFINITY;                // m; half-axis
  double fall = 0;                           // m; from the highest start
};

Extremes find_extremes(const Scene& scene, const std::vector<Placement>& grains) {
  Extremes found;
  for (const Placement& grain : grains) {
    const GrainKind& kind = scene.kinds[grain.kind].kind;
    const double mass = kind.density * volume_of(kind) * std::pow(grain.scale, 3);
    found.lightest = std::min(found.lightest, mass);
    found.heaviest = std::max(found.heaviest, mass);
    found.smallest = std::min(found.smallest, grain.scale * kind.smallest_half_axis());
    found.fall = std::max(found.fall, grain.position[2] - lowest_start(scene.container));
  }
  return found;
}

/// The words of springs, and the step that they need.
struct Contacts {
  std::string springs;
  double step;       // s
  double stiffness;  // N/m; 0 of hertz
};

Contacts find_contacts(const Scene& scene, const Law& law, const Extremes& extremes) {
  const auto& [lightest, heaviest, smallest, fall] = extremes;
  const double speed = std::sqrt(2 * fall * (scene.gravity() != nullptr ? scene.gravity()->acceleration.norm() : 0));
  std::ostringstream words;
  words.precision(9);
  double impact = 0, stiffness = 0;  // s, of the lightest pair; N/m
  if (law.hertz != nullptr) {
    words << "hertz " << law.hertz->youngs_modulus << ' ' << law.hertz->poisson_ratio;
    const double k = 4.0 / 3 * contact_modulus(*law.hertz) * std::sqrt(smallest / 2);
    const double fastest = std::max(speed, 0.1);
    impact = kHertzImpact * std::pow(1.25 * lightest / 2 * fastest * fastest / k, 0.4) / fastest;
  } else {
    const double depth = kOverlap * smallest;
    stiffness = law.compliance != nullptr ? law.compliance->stiffness : heaviest * speed * speed / (depth * depth);
    if (!(stiffness > 0)) refuse(scene, "a scene without gravity, and with neither [hertz] nor [compliance],");
    words << "hooke " << stiffness;
    impact = std::numbers::pi * std::sqrt(lightest / 2 / stiffness);
  }
  return {words.str(), impact / kStepsPerImpact, stiffness};
}

std::string words_of(const std::string& springs, const Law& law) {
  std::ostringstream words;
  words.precision(9);
  words << springs << " restitution " << law.restitution;
  if (law.friction > 0) words << " friction " << law.friction;
  if (law.rolling > 0) words << " rolling " << law.rolling;
  if (law.spinning > 0) words << " spinning " << law.spinning;
  if (law.adhesion > 0) words << " adhesion " << law.adhesion;
  return words.str();
}

/// Warnings about servos that rattle. In LAMMPS they take the force of the step before, so N contacts of the stiffness k and the
/// damper c are stable below area / (N (c + k step / 2)). Contacts of hertz have no stiffness that is known before.
std::vector<std::string> find_rattling(const Scene& scene, const LawReader& laws, const Contacts& contacts,
                                       const Extremes& extremes) {
  std::vector<std::string> warnings;
  if (contacts.stiffness == 0) return warnings;
  WallDoubts of_walls;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const Wall& wall = scene.walls[i];
    if (!wall.drive || !wall.drive->servo) continue;
    const double loss = -std::log(laws.walls[i].restitution);
    const double damper = 2 * loss / std::hypot(std::numbers::pi, loss) * std::sqrt(contacts.stiffness * extremes.heaviest);
    const double most = 4 * extremes.smallest * extremes.smallest / (damper + contacts.stiffness * contacts.step / 2);
    const double gain = wall.drive->servo->gain;
    if (gain <= most) continue;
    of_walls.add("gain", wall, gain / most,
                 " may rattle in LAMMPS, with a contact on each square of the smallest diameter: " + wall.key() +
                     ".drive.gain is " + shortest(gain) + " m/(s Pa), and up to " + rounded(most) +
                     " would do (samples/lammps/README.md)");
  }
  of_walls.tell(warnings);
  return warnings;
}

/// Velocities and angular momenta.
void write_velocities(std::ostream& out, const Scene& scene, const std::vector<Placement>& grains) {
  out << "\nVelocities # ellipsoid\n\n";
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const auto& [x, y, z] = grains[i].angular_velocity;
    const supernormal::Vector3 momentum =
        lammps_inertia(scene.kinds[grains[i].kind].kind, grains[i].scale, grains[i].quaternion) * supernormal::Vector3(x, y, z);
    out << i + 1;
    for (const double component : grains[i].velocity) out << ' ' << component;
    out << ' ' << momentum.x() << ' ' << momentum.y() << ' ' << momentum.z() << '\n';
  }
}

std::string write_data(const Scene& scene, const std::vector<Placement>& grains, const LammpsWalls& walls) {
  std::ostringstream out;
  out.precision(17);
  out << scene.name << "\n\n"
      << grains.size() << " atoms\n"
      << grains.size() << " ellipsoids\n"
      << scene.kinds.size() << " atom types\n\n";
  std::array<std::array<double, 2>, 3> bounds = walls.bounds;
  for (const Placement& grain : grains) bounds[2][1] = std::max(bounds[2][1], grain.position[2]);
  const double margin = 2 * scene.largest_bounding_radius();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const char name = "xyz"[axis];
    out << bounds.at(axis)[0] - margin << ' ' << bounds.at(axis)[1] + margin << ' ' << name << "lo " << name << "hi\n";
  }
  out << "\nAtoms # ellipsoid\n\n";
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const GrainKind& kind = scene.kinds[grains[i].kind].kind;
    // LAMMPS multiplies the density by the volume of the ellipsoid.
    const double ellipsoid = 4.0 / 3 * std::numbers::pi * kind.half_axes[0] * kind.half_axes[1] * kind.half_axes[2];
    out << i + 1 << ' ' << grains[i].kind + 1 << " 1 " << kind.density * volume_of(kind) / ellipsoid;
    for (const double coordinate : grains[i].position) out << ' ' << coordinate;
    out << '\n';
  }
  out << "\nEllipsoids\n\n";
  for (std::size_t i = 0; i < grains.size(); ++i) {
    out << i + 1;
    for (const double half_axis : scene.kinds[grains[i].kind].kind.half_axes) out << ' ' << 2 * grains[i].scale * half_axis;
    for (const double component : grains[i].quaternion) out << ' ' << component;
    out << '\n';
  }
  if (scene.start && scene.start->has_velocities) write_velocities(out, scene, grains);
  return out.str();
}

void refuse_what_has_no_counterpart(const Scene& scene) {
  if (!scene.bonds.empty()) refuse(scene, "[[bond]]");
  if (scene.parts().size() > static_cast<std::size_t>(std::ranges::count_if(walls_in(scene.container), &Wall::is_part)))
    refuse(scene, "[[part]]");
  if (scene.query) refuse(scene, "[query]");
  if (scene.changes_population()) refuse(scene, "a feeder or a sink");
  if (is_any(scene.periodic)) refuse(scene, "periodic");
  for (const GrainCount& entry : scene.kinds) {
    if (!entry.kind.components.empty() || entry.kind.is_capsule) refuse(scene, entry.kind.name + ", a compound or capsule,");
  }
}

std::string to_obj(const Mesh& mesh) {
  std::ostringstream out;
  out.precision(9);
  for (const auto& [x, y, z] : mesh.vertices) out << "v " << x << ' ' << y << ' ' << z << '\n';
  for (const auto& [a, b, c] : mesh.triangles) out << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  return out.str();
}

/// Writes walls. `laws`: the contact laws of the scene's walls, in the words of the fix. Throws InputError, which names the
/// container, unless it is a box, a cell, a drum or a hopper.
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

  void operator()(const auto& /*container*/) {
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

LammpsInput lammps_input(const Scene& scene) {
  refuse_what_has_no_counterpart(scene);
  LawReader reader(scene);
  for (const fx::Effect& effect : scene.effects) std::visit(reader, effect);
  Random random(scene.seed);
  const std::vector<Placement> grains = place(scene, random);
  const Extremes extremes = find_extremes(scene, grains);
  const Contacts contacts = find_contacts(scene, reader.law, extremes);

  std::vector<std::string> laws;
  laws.reserve(reader.walls.size());
  for (const Law& law : reader.walls) laws.push_back(words_of(contacts.springs, law));
  LammpsWalls walls = WallsWriter(scene, laws).write();

  std::ostringstream out;
  out.precision(9);
  out << "# " << scene.name << ", converted by falling_particles --to-lammps for samples/lammps. What differs:\n"
      << "# contacts are springs, which overlap; a step is " << kStepsPerImpact
      << " times shorter than an impact; contacts without\n"
      << "# restitution have " << kRigidRestitution << ", and none has less than " << kLeastRestitution
      << "; it holds at every velocity; sides\n# of cans, and faces on meshes and in drums, rest on one point; grains are not "
         "rounded; nothing sleeps.\n"
      << "units si\natom_style ellipsoid\ncomm_modify vel yes\nboundary " << walls.boundary << "\nread_data " << scene.name
      << ".data\n"
      << "pair_style supernormal\npair_coeff * * " << words_of(contacts.springs, reader.law) << '\n';
  for (std::size_t k = 0; k < scene.kinds.size(); ++k) {
    const GrainKind& kind = scene.kinds[k].kind;
    out << "pair_coeff " << k + 1 << ' ' << k + 1 << " exponents " << kind.delta << ' ' << kind.epsilon << "  # " << kind.name
        << '\n';
  }
  out << "neighbor " << 0.5 * extremes.smallest << " bin\nneigh_modify delay 0 every 1 check yes\ntimestep " << contacts.step
      << "\nfix move all nve/supernormal\n";
  if (const fx::Gravity* gravity = scene.gravity()) {
    const supernormal::Vector3& g = gravity->acceleration;
    out << "fix " << kGravityFix << " all gravity " << g.norm() << " vector " << g.x() << ' ' << g.y() << ' ' << g.z() << '\n';
  }
  out << walls.commands;
  const auto steps = [&](double seconds) { return std::max(0LL, std::llround(seconds / contacts.step)); };
  const long long frame = std::max(1LL, steps(scene.time.frame));
  out << "compute shape all property/atom shapex shapey shapez quati quatj quatk quatw\n"
      << "dump grains all custom " << frame << ' ' << scene.name
      << ".lammpstrj id type x y z c_shape[1] c_shape[2] c_shape[3] c_shape[4] c_shape[5] c_shape[6] c_shape[7] vx vy vz angmomx "
      << "angmomy angmomz\n"
      << "thermo " << frame << '\n';
  const long long all = steps(scene.time.duration);
  const bool changes = walls.change && walls.change->time < scene.time.duration;
  const long long before = changes ? steps(walls.change->time) : 0;
  if (changes) out << "run " << before << '\n' << walls.change->commands;
  out << "run " << all - before << '\n';
  return {out.str(), write_data(scene, grains, walls), std::move(walls.files), find_rattling(scene, reader, contacts, extremes)};
}

std::vector<std::string> write_lammps_input(const Scene& scene, const std::filesystem::path& folder) {
  const LammpsInput input = lammps_input(scene);
  create_folder(folder);
  replace_file(folder / (scene.name + ".data"), input.data);
  for (const LammpsFile& file : input.files) replace_file(folder / file.name, file.text);
  replace_file(folder / (scene.name + ".in"), input.commands);
  return input.warnings;
}

}  // namespace falling_particles
