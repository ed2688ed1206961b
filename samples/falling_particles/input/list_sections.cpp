#include "list_sections.hpp"

namespace falling_particles {

std::string list_sections() {
  return R"(at the top of the file
  seed             a whole number from 0; of all random numbers
  catalogue        the file with the grains, its path relative to the scene file
[time]
  duration         s, in (0, 3600]
  step             s, above 0, up to duration
  frame            s, from step to duration; between two lines of the tables
[solver]
  kind             "quickstep", ODE's, or "stepper", which remembers contact forces and takes sub-steps; "quickstep" without it
  iterations       a whole number from 1 to 100000; of quickstep
  erp              in [0, 1]; of quickstep: the part of an overlap that a step corrects
  cfm              s/kg, in [0, 1]; of quickstep: the softness of a contact
  sag              in [1e-12, 1]; of the stepper: largest overlap at rest, relative to the least radius of gyration; 0.002 without it
  sub_steps        two whole numbers from 1 to 1000000; of the stepper: the least and the most of a step; [8, 64] without it
[drop]
  height           m, in [0, 1000]; of the lowest grains above the floor at the start
  gap              in [0, 10]; between grains at the start, relative to their size
  total            a whole number from 1 to 1000000; of all grains, where they have fractions; without it, they have counts
[start]
  file             of the grains, in place of [drop] and counts: final_state.csv of a run, another CSV file, or a dump of LAMMPS
  overlap          in (0, 1], of the smallest half-axis: the deepest allowed overlap of the file's grains; 0.1 without it
[[bond]]
  name             letters, digits, _ and -
  kind             "beam" or "ball"; a ball resists neither bending nor twisting
  touching         in [0, 10], of the smallest half-axis: bonds all pairs of grains of the start whose gap is at most this
  chain            two numbers of grains of start.file; in place of touching, bonds each grain between them to the next one
  file             of pairs, in place of touching and chain: final_bonds.csv of a run, or another CSV file
  part             a part of the scene that is neither free nor driven, to which touching or file bonds grains; without it, to one another
  modulus          Pa, in (0, 1e15]; Young's, of the bond's beam
  poisson_ratio    in [0, 0.5]; of a beam
  radius           m, in (0, 1000]; of the beam; as relative_radius without it
  relative_radius  in (0, 10], of the smallest half-axis of the smaller grain; 1 without it
  tensile_strength  Pa, in (0, 1e15], of tension and bending; unbreakable without it
  shear_strength   Pa, in (0, 1e15], of shear and torsion; unbreakable without it
  damping          in [0, 1], of the critical damping; 0 without it
  contacts         true or false; whether bonded grains collide with one another; false without it
[[grain]]
  name             of the catalogue
  count            a whole number from 1 to 1000000, from 0 in scenes with feeders
  fraction         in (0, 1], of drop.total; in place of count, for all grains
  size             a table, below; without it, all have the size of the catalogue
[grain.size] distribution = "uniform"
  by               "number" or "mass", of which it is the distribution; "number" without it
  unit             "m" or "catalogue", relative to the size of the catalogue; "m" without it
  smallest         m, in (0, 2], or in (0, 100] of the catalogue's size
  largest          above smallest, up to 1000 times that
[grain.size] distribution = "normal"
  by, unit, smallest, largest  as above
  mean, deviation  m, in (0, 2], or in (0, 100] of the catalogue's size
[grain.size] distribution = "lognormal"
  by, unit, smallest, largest  as above
  median           m, in (0, 2], or in (0, 100] of the catalogue's size
  geometric_deviation  in (1, 100]
[grain.size] distribution = "sieve"
  by, unit         as above; "mass" without by
  openings         2 to 200 ascending numbers, m, in (0, 2], or in (0, 100] of the catalogue's size
  passing          as many, in [0, 1]; from 0 to 1
[container] kind = "box"
  width            m, two numbers in (0, 1000]; along x and y
[container] kind = "hopper"
  outlet           m, in (0, 1000]; its diameter
  diameter         m, above outlet, up to 1000
  wall_angle       degrees from the vertical, in [1, 89]
  cylinder_height  m, in (0, 1000]
  segments         a whole number from 3 to 10000; of its circumference
  clearance        m, in (0, 1000]; from the tray to the outlet
  tray_width       m, from the diameter around the segments to 2000
  opens_at         s, above 0, before time.duration; 0 with [start]: open from the start
  dish             a table, below; without it, there is none
[container.dish]
  diameter         m, above 0, as wide as its rim leaves room in the tray
  height           m, above 0, below the outlet
  rim              m, above 0, below the outlet
[container] kind = "terrain"
  width            m, two numbers in (0, 1000]; along x and y
  amplitude        m, in [0, 1000]; of its hills
  wavelength       m, in (0, 1000]
  ridge_height     m, in [0, 1000]
  samples          a whole number from 2 to 4096; along each axis
  seed             a whole number from 0; of the hills
[container] kind = "periodic"
  side             m, in (0, 1000]; at least two diameters of the largest grain
[container] kind = "none"
  start            a table: corner, m, three numbers in [-1000, 1000], and size, m, three in (0, 1000]; where grains start
  bounds           the same; grains beyond it have leaked
[container] kind = "drum"
  diameter         m, in (0, 1000]
  length           m, in (0, 1000]
  segments         a whole number from 8 to 10000; of its circumference
  rpm              revolutions a minute; up to a tenth of one in a step
  smooth           true or false; whether its flat sides stand and only their surface moves; false without it
  turns_at         s, from 0, before time.duration; 0 without it
[container] kind = "tray"
  width            m, two numbers in (0, 1000]; along x and y
  wall_height      m, in (0, 1000]
  thickness        m, in (0, 1000]; of its floor
  direction        three numbers, not all 0; along which it shakes
  amplitude        m, in (0, 1000]
  frequency        Hz, at least ten steps a period
  phase            degrees, in [-360, 360]; 0 without it
  shakes_at        s, from 0, before time.duration; 0 without it
[container] kind = "shear_cell"
  width            m, two numbers in (0, 1000]; along x and y
  height           m, in (0, 1000]
  cut              m, above 0, below height; between its halves
  lid              m, above cut, up to height; where the lid is at the start
  thickness        m, in (0, 1000]; of its walls
  speed            m/s, of its lower half, which moves by thickness at most
  pressure         Pa, in [0, 1000000000]; under the lid
  lid_mass         kg, in (0, 1000000]
  presses_at       s, from 0, before time.duration; 0 without it
  shears_at        s, from 0, before time.duration; 0 without it
[container] kind = "cell"
  corner           m, three numbers in [-1000, 1000]; of least x, y and z; the origin without it
  width            m, two numbers in (0, 1000]; along x and y
  height           m, in (0, 1000]; open above without it
  x_low, x_high    tables with motion, drive, friction and restitution of [[part]]; of the planes that are its sides
  y_low, y_high    the same; a drive pushes along the normal, and a servo acts between the other sides
  z_low, z_high    the same; z_high with height
[container] kind = "conveyor"
  length           m, in (0, 1000]
  width            m, in (0, 1000]
  height           m, in (0, 1000]; of the belt's top above the floor
  thickness        m, above 0, up to height; of the belt with its rollers
  wall_height      m, in (0, 1000]
  speed            m/s, above 0; up to a tenth of a revolution of a roller in a step
  drop_length      m, above half of thickness, up to 1000; beyond the last roller
  starts_at        s, from 0, before time.duration; 0 without it
[periodic]
  x, y             m, two numbers in [-1000, 1000]; the ends between which the scene repeats; one or both
[compression]
  overlap          in (0, 0.1]; of the grains that are pressed, relative to their distance
  final_overlap    above 0, up to overlap
  damping          in [0, 1]; the part of all velocities that a step takes away
[query]
  solver           "hybrid", "newton" or "fixed_point"; of two smooth bodies; "hybrid" without it
  tolerance        in [1e-15, 1]; of the gap, relative to the smallest half-extent; 1e-9 without it
  max_evaluations  a whole number from 1 to 1000000; of a query; 1000 without it
  warm_start       true or false; whether a pair starts from its last normal; true without it
[broad_phase]
  axis             "x", "y" or "z"; as the grains lie without it
[output]
  pictures         an array of "page", "glb", "lammps", "vtk", "povray", "plots"; ["page", "glb", "plots"] without it
  forces           true or false; whether pictures show forces; false without it
)";
}

std::string list_walls() {
  return R"([[part]]
  parameters  name: letters, digits, _ - and .
              position: m, each in [-1000, 1000]; the origin without it
              axis, angle: the orientation, a rotation by angle degrees in [-360, 360] about axis; none without them
              friction: in (0, 100], of grains on this part; as for walls without it
              restitution: in (0, 1], of grains on this part; as for walls without it
  cost        its contacts; a part that moves has a body more
[[part]] shape = "plane"
  is          the half-space below its xy-plane
[[part]] shape = "box"
  parameters  size: m, three lengths in (0, 1000], around position
[[part]] shape = "cylinder"
  parameters  radius, length: m, in (0, 1000]; along its z-axis, around position
[[part]] shape = "ellipsoid"
  parameters  half_axes: m, three in (0, 1000]
[[part]] shape = "superellipsoid"
  parameters  half_axes; delta, epsilon: exponents of the xy-section and along z, in [1.01, 1000]
[[part]] shape = "superovoid"
  parameters  half_axes, delta, epsilon; taper: along x and y, in [-1, 1], as long as it is convex
[[part]] shape = "mesh"
  parameters  file: an STL or OBJ file, its path relative to the scene file; unit: m, cm, mm or inch
              two_sided: true or false, whether it holds grains on both sides; false without it: what is behind a triangle is solid
[[part.motion]] kind = "velocity"
  parameters  velocity: m/s, each in [-1000, 1000]
              from, until: s, of this and every other kind of motion; the whole run without them
[[part.motion]] kind = "rotation"
  parameters  axis; point: m; rpm: revolutions a minute, anticlockwise as seen from the tip of axis, up to a tenth of one in a step
[[part.motion]] kind = "vibration"
  parameters  direction; amplitude: m, in (0, 1000]; frequency: Hz, at least ten steps a period; phase: degrees, 0 without it
[[part.motion]] kind = "conveyor"
  parameters  velocity: m/s, or axis, point, rpm: of the surface of a part that stands
[part.free]
  is          a part that flies: its weight and contacts move it in all directions; it meets grains and other walls
  parameters  mass: kg, in [1e-12, 1e6]
              inertia: kg m^2, three moments about the centre of mass, along the part's axes; those of its solid without it
              centre: m, of mass, in the part's frame; that of its solid without it
              velocity: m/s, each in [-1000, 1000]; angular_velocity: rad/s, three, up to a tenth of a revolution in a step; 0
              from: s; the part is held before; 0 without it
[part.drive]
  parameters  axis: along or about which it pushes, and the only way it can go; of a plane its normal without it
              one of force, pressure, torque, power and stress
              from, until: s; it is held before, and only its weight is left after; travel: least and most way, m, or degrees in [-170, 170]
  slides      force: N, in [-1e9, 1e9]; or pressure: Pa, and area: m^2, that of the part's shape without it
              or power: W, in (0, 1e9], and largest_force: N, in (0, 1e9], at rest; force is power / speed
              mass: kg, in [1e-12, 1e6]; damping: N s/m, in [0, 1e9], 0 without it
  turns       torque: N m, in [-1e9, 1e9], or power: W, and largest_torque: N m, in (0, 1e9], at rest
              point: m, on axis; moment: kg m^2, in [1e-12, 1e6], about axis; mass: kg, in [0, 1e6], 0 without it: its weight
              acts at position; damping: N m s, in [0, 1e9], 0 without it
  servo       stress: Pa, in (0, 1e9], target of the grains' force over the area; gain: m/(s Pa), in (0, 1e9]; its speed is gain
              times what is missing, up to largest_speed: m/s, in (0, 1000]; it is held after until
              area: m^2, that of the part's shape without it; or between: four names of walls that face each other two by two
)";
}

std::string list_population() {
  return R"([[feeder]]
  parameters  name: letters, digits, _ and -
              corner, size: m, of the region in which grains come wherever they touch nothing, wider than any of them
              grains_per_second or kg_per_second: in (0, 1e9]
              total_grains or total_kg: in (0, 1e9], after which it ends; endless without it
              from, until: s; the whole run without them
              velocity: m/s, of grains that come, each in [-1000, 1000]; 0 without it
              patience: s, in [0, 3600], for which the region may be too full for the rate before the run ends; 1 without it
              fractions_of: number or mass, of [[feeder.grain]]; number without it
  cost        a look at the neighbours of each grain that comes
[[feeder.grain]]
  parameters  name: a kind of the scene; fraction: in (0, 1], which sum to 1; without any, as the counts of the scene's grains
[[sink]]
  parameters  name: letters, digits, _ and -
              corner, size: m, of a box; or point, normal: of a plane, below which it is; it takes grains whose centre is inside
  cost        a look at each grain in a step
)";
}

}  // namespace falling_particles
