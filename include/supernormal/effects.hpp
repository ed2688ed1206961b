/// @namespace supernormal::effects
/// Effects for ODE worlds. A program lists the effects that its scene needs; effects that are not listed cost nothing.
///
///     namespace fx = supernormal::effects;
///     fx::Effects effects({fx::Gravity{{0, 0, -9.81}}, fx::Friction{.coefficient = 0.4}}, step);   // throws on bad parameters
///     effects.set_up(world);                                   // once
///     … in the near callback, with the contacts of one pair:
///         n = effects.set_up_contacts(std::span(contacts, n));  // fills surface and fdir1; attach the first n
///     … before each step, and after its near callbacks:
///         effects.apply_forces();                               // visits the added bodies if a listed effect is a force
///
/// The list is compiled once. Each pair of materials gets the surface parameters that all its contacts start from, and the passes
/// that each contact also needs. Friction limits are right for dWorldQuickStep, which takes them from the normal force of the same
/// step.
#pragma once

#include <ode/ode.h>

#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "supernormal/export.h"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::effects {

/// A number from 0 on that the program gives to each body or wall. Use 0 everywhere if materials do not matter.
using Material = int;
constexpr Material kLastMaterial = 63;  ///< the largest number of a material

/// Selects the contacts that an effect applies to. A pair of materials takes the values listed for the pair. Without these it takes
/// the combined values of both materials. A material without values of its own takes the values listed for all. Each effect
/// documents how values combine. If one of the two materials has no value, the effect is absent, unless the effect documents
/// otherwise.
class MaterialSelector {
 public:
  constexpr MaterialSelector() = default;  ///< selects all contacts
  /// Selects the contacts of one material with any other, or with itself.
  static constexpr MaterialSelector of(Material material) { return MaterialSelector(material, kAll); }
  /// Selects the contacts of two materials with each other; they may be the same.
  static constexpr MaterialSelector between(Material first, Material second) { return MaterialSelector(first, second); }

  constexpr bool is_all() const { return first_ == kAll; }             ///< whether it selects all contacts
  constexpr bool is_pair() const { return second_ != kAll; }           ///< whether it selects the contacts of a pair of materials
  constexpr Material first() const { return first_; }                  ///< the material, or one of the pair; -1 if it selects all
  constexpr Material second() const { return second_; }                ///< the other material of the pair; -1 if there is none
  constexpr bool operator==(const MaterialSelector&) const = default;  ///< whether both select the same contacts

 private:
  static constexpr Material kAll = -1;
  constexpr MaterialSelector(Material first, Material second) : first_(first), second_(second) {}
  Material first_ = kAll;
  Material second_ = kAll;
};

// --- contact -----------------------------------------------------------------------------------------------------------------

/// Coulomb friction: the force along the surface is at most `coefficient` times the normal force, and opposes the slip.
/// Coefficients of two materials combine by the geometric mean. Costs two constraint rows.
///
/// The force never exceeds the friction cone. ODE limits the two friction forces separately, to a square. The square is inscribed
/// in the cone, and one vertex is in the direction of the slip that a step without friction would bring. So in every direction a
/// body starts to slide, and slides, at the cone. At 45 degrees to this direction the limit is 1/sqrt(2) of the cone.
struct Friction {
  double coefficient = 0;  ///< in (0, 100]
  MaterialSelector on;     ///< the contacts that it applies to
};

/// Friction that depends on the direction of the slip on the body of the material. `along` is the coefficient for slip along
/// `direction`, projected onto the surface, and `across` the coefficient perpendicular to it. The limit is an ellipse with these
/// half-axes, and the force is the one in it that dissipates most (Goyal, Ruina and Papadopoulos, Wear 143, 1991). As with
/// Friction, ODE's limits form a rectangle in the ellipse. One of its vertices is at this force, and its half-sides are at least a
/// tenth of each coefficient.
///
/// It replaces Friction for the selected contacts. Costs two rows, or one if a coefficient is 0. Values are not combined. Between
/// two materials that have the effect, the material with the smaller number counts; within one material, geom g1.
struct AnisotropicFriction {
  double along = 0;                      ///< in [0, 100]
  double across = 0;                     ///< in [0, 100]; not both 0
  Vector3 direction = Vector3::UnitX();  ///< in the frame of the body, or of the geom if it has no body; not 0
  MaterialSelector on;                   ///< the contacts that it applies to
};

/// Resistance to rolling and to spinning. It consists of torques against the relative angular velocity in the tangent plane and
/// about the normal. They are at most the given lengths times the normal force. Lengths combine by the geometric mean. Costs two
/// rows for rolling and one for spinning; a length of 0 costs none. (Ai et al., Powder Technology 206, 2011, model A.)
struct RollingResistance {
  double rolling = 0;   ///< m; in [0, 1e3]
  double spinning = 0;  ///< m; in [0, 1e3]; not both 0
  MaterialSelector on;  ///< the contacts that it applies to
};

/// Newton's restitution of rigid contacts: separating velocity over approach velocity, if the approach velocity is above
/// `threshold`. Coefficients combine by the geometric mean; of two thresholds the larger counts. Costs no row.
struct Restitution {
  double coefficient = 0;  ///< in (0, 1]
  double threshold = 0;    ///< m/s; in [0, 100]
  MaterialSelector on;     ///< the contacts that it applies to
};

/// A linear spring and damper for each touching pair, in place of rigid contact. The force is k depth + c approach velocity, and
/// never pulls. The springs and dampers of two materials are in series, also if both materials are the same. A material without
/// values is rigid. Values listed for all materials are the values of the pair.
///
/// The spring acts by the depth of the deepest contact. All contacts with the same normal share its force in proportion to their
/// depths. The damper's force acts in the middle of their region. Costs no row. The integration is the leapfrog method, which is of
/// second order and adds no damping, down to ten steps per contact. With fewer steps it becomes as implicit as stability requires,
/// and loses energy; costs().coarse counts these contacts. (ODE's own soft ERP and CFM are the implicit Euler method, which loses
/// the fraction 2 pi / steps of the energy in every contact.)
struct Compliance {
  double stiffness = 0;  ///< k, N/m; in (0, 1e15]
  double damping = 0;    ///< c, N s/m; in [0, 1e15]
  MaterialSelector on;   ///< the contacts that it applies to
};

/// Hertz's elastic contact in place of rigid contact. The force of a round contact is 4/3 E* sqrt(R) depth^(3/2). Other contacts
/// take elliptic integrals (Johnson, Contact Mechanics, 1985, section 4.2), with the curvatures of the bodies at the contact. 1/E*
/// is the sum of (1 - nu^2)/E over both materials; a material without values is rigid. The force is at most 2 E* L depth, the force
/// of a flat punch as wide as the smaller body, where L is the mean of its half-extents. Flat faces have this force.
///
/// A restitution below 1 adds a damper, 2 b sqrt(5/6 m dF/ddepth) (Tsuji, Tanaka and Ishida, Powder Technology 71, 1992). Its b
/// gives an impact of any velocity this restitution. Restitutions combine by the geometric mean. The force is divided among
/// contacts and integrated as for Compliance. Costs no row.
struct Hertz {
  double youngs_modulus = 0;  ///< E, Pa; in (0, 1e15]
  double poisson_ratio = 0;   ///< nu; in [0, 0.5]
  double restitution = 1;     ///< in [0.05, 1]
  MaterialSelector on;        ///< the contacts that it applies to
};

/// An attraction of constant force between touching bodies. Pulling a pair apart takes `pull_off` newtons for each normal of its
/// contacts. Values combine by the geometric mean. The force acts in the middle of the region of contact: the centre of a
/// rectangle, the middle of an edge. It adds to the normal force, and so to the limit of friction (DMT). Rigid bodies stick with an
/// overlap of 1e-4 of the smaller mean half-extent. Costs no row, because it is an external force.
struct Adhesion {
  double pull_off = 0;  ///< N; in (0, 1e9]
  MaterialSelector on;  ///< the contacts that it applies to
};

// --- bodies: forces on those that were added with add_body --------------------------------------------------------------------

/// A uniform field. ODE applies it, so it costs no pass of ours.
struct Gravity {
  Vector3 acceleration = Vector3::Zero();  ///< m/s^2; each component in [-1e4, 1e4]
};

/// Drag at high Reynolds number in a fluid at rest. The force is density C A v^2 / 2 against v, where A is the body's area
/// projected along v. It acts at the centre of mass. It is integrated implicitly, so it never reverses a velocity.
struct QuadraticDrag {
  double density = 0;      ///< density of the fluid, kg/m^3; in (0, 1e5]
  double coefficient = 0;  ///< C; in (0, 100]; 0.47 for a sphere between Re 1e3 and 2e5
};

/// Drag at low Reynolds number in a fluid at rest. The force is 3 pi viscosity (d_n / 3 + 2 d_s / 3) v against v. d_n is the
/// diameter of the circle with the body's area projected along v; d_s is the diameter of the sphere with the body's surface area
/// (Leith, Aerosol Science and Technology 6, 1987). Exact for spheres, to 4 % for spheroids of aspect ratio 1/2 to 2, to 10 % for
/// 1/4 to 4. It acts at the centre of mass and is integrated implicitly.
struct StokesDrag {
  double viscosity = 0;  ///< of the fluid, Pa s; in (0, 1e6]
};

/// Buoyancy: the weight of the displaced fluid, at the centre of the submerged volume. The fluid is at rest below a plane
/// perpendicular to gravity. `level` is the plane's height above the origin, measured against gravity. Needs Gravity.
struct Buoyancy {
  double density = 0;  ///< of the fluid, kg/m^3; in (0, 1e5]
  double level = 0;    ///< m; in [-1e6, 1e6]
};

/// Exponential decay of velocities: v exp(-rate t). ODE applies it, so it costs no pass of ours.
struct Damping {
  double linear = 0;   ///< 1/s; in [0, 1e6]
  double angular = 0;  ///< 1/s; in [0, 1e6]; not both 0
};

// --- world: settings of ODE -----------------------------------------------------------------------------------------------------

/// Puts a body to sleep if it is slower than both thresholds, on average over `samples` steps, for `time`. It sleeps until
/// something touches it.
struct AutoDisable {
  double linear = 0.01;   ///< m/s; in (0, 1e3]
  double angular = 0.01;  ///< rad/s; in (0, 1e6]
  double time = 0;        ///< s; in [0, 1e6]
  int samples = 10;       ///< in [1, 1000]
};

/// The largest velocity with which rigid contacts push overlaps out. It excludes Compliance and Hertz, because it would limit their
/// forces.
struct MaxCorrectingVelocity {
  double velocity = 0;  ///< m/s; in (0, 1e6]
};

/// The depth that rigid contacts do not correct, so that touching bodies stay in touch.
struct SurfaceLayer {
  double depth = 0;  ///< m; in (0, 1e3]
};

/// Speculative contacts: contacts of the added bodies before they overlap. So no body tunnels, and resting bodies hardly overlap,
/// at longer steps (lib/guide.md, "Contacts before overlap"). add_body makes their geoms look ahead by the step
/// (snGeomSetLookAhead). A contact with a negative depth may then close its gap within the step, and no more.
///
/// Friction and resistance to rolling act in these contacts. A body with restitution that will touch within the step is moved until
/// it touches, and leaves with e times the velocity of that moment. The centre of mass of two bodies stays where it is. Several
/// impacts of a body in a step happen one after the other, if the program attaches the contacts as set_up_contacts returns them.
/// Springs and adhesion do not act before touch: for them contacts ahead are left out. Without this effect all contacts ahead are
/// left out. Costs no row.
struct SpeculativeContacts {
  MaterialSelector on;  ///< the contacts that it applies to
};

/// Any effect. A class of its own, so that names of functions do not contain all effects.
struct Effect : std::variant<Friction, AnisotropicFriction, RollingResistance, Restitution, Compliance, Hertz, Adhesion, Gravity,
                             QuadraticDrag, StokesDrag, Buoyancy, Damping, AutoDisable, MaxCorrectingVelocity, SurfaceLayer,
                             SpeculativeContacts> {
  using variant::variant;
};

/// Reports why and where a list was refused. The text contains the effect, the parameter, its value and range, or the two effects
/// that exclude each other.
class SUPERNORMAL_ODE_API BadEffect : public std::invalid_argument {
 public:
  /// The arguments are the results of the members below. what() is `reason`, behind `where` if the effect is refused for some
  /// contacts only.
  BadEffect(std::string effect, std::string parameter, const std::string& reason, const std::string& where = {})
      : std::invalid_argument(where.empty() ? reason : where + "; " + reason),
        effect_(std::move(effect)),
        parameter_(std::move(parameter)),
        reason_(reason) {}
  const std::string& effect() const { return effect_; }        ///< its name as in descriptions()
  const std::string& parameter() const { return parameter_; }  ///< "" if the effect as a whole is refused
  const std::string& reason() const { return reason_; }        ///< what() without the contacts that the effect is refused for

 private:
  std::string effect_;
  std::string parameter_;
  std::string reason_;
};

/// Describes an effect in words. There is one description for each alternative of Effect, in its order.
struct Description {
  const char* name;        ///< "rolling_resistance"
  const char* parameters;  ///< with units and ranges
  int rows;                ///< the largest number of constraint rows that it adds to a contact
  const char* passes;      ///< the work that a step does for it
  const char* source;      ///< the source of the law
};
/// The descriptions of all effects.
SUPERNORMAL_ODE_API std::span<const Description> descriptions();

/// A parameter that read_effect() asks for.
struct Parameter {
  /// A number, a whole number, or three numbers.
  enum class Kind { Number, Whole, Vector };
  const char* name;  ///< as in Description::parameters
  Kind kind;         ///< what it is
  bool has_default;  ///< whether it may be left out
};
/// Makes an effect for all contacts, whose name is one of descriptions(). `read` returns the numbers of each parameter, or none,
/// which leaves the default. The constructor of Effects checks the ranges. Throws std::invalid_argument for another name, or
/// another count of numbers.
SUPERNORMAL_ODE_API Effect read_effect(std::string_view name, const std::function<std::vector<double>(const Parameter&)>& read);

/// Who solves the contacts. A stepper (supernormal/stepper.hpp) knows gaps, impacts and the circle of friction by itself. So
/// contacts ahead stay, with their negative depths, and the added bodies look ahead by the step. Pass all contacts to
/// Stepper::add_contact. Effects that act on contacts once a step are refused: Compliance, Hertz, Adhesion and SpeculativeContacts.
enum class Solver { QuickStep, Stepper };

/// One of the two sides of a contact.
struct Side {
  Material material = 0;   ///< of the body or the wall
  dBodyID body = nullptr;  ///< the body whose velocity counts, and to which the joint will be attached; 0: a wall at rest
};

/// Steps that a contact of Compliance or Hertz should last. With fewer it is implicit in part, and loses energy.
inline constexpr double kLeastContactSteps = 10;

/// Counts the work for an effect so far.
struct Cost {
  const char* name;                 ///< its name as in descriptions()
  unsigned long long rows = 0;      ///< constraint rows added
  unsigned long long contacts = 0;  ///< contacts that the effect applied to; for speculative_contacts the contacts ahead of touch
  unsigned long long coarse = 0;    ///< compliant contacts among them that last fewer than kLeastContactSteps
  unsigned long long bodies = 0;    ///< bodies visited
  double seconds = 0;               ///< s; time in its passes, if measured, without the solver's time for the rows
};

/// A compiled list of effects. With Restitution and SpeculativeContacts there may be one for each world: two would not know of each
/// other's impacts.
class SUPERNORMAL_ODE_API Effects {
 public:
  /// Compiles the list for steps of `step` seconds. Throws BadEffect (a std::invalid_argument) with the effect, the parameter, its
  /// value and the range, or with the two effects that exclude each other.
  Effects(const std::vector<Effect>& list, double step);
  /// The same for contacts that `solver` solves.
  Effects(const std::vector<Effect>& list, double step, Solver solver);
  ~Effects();                   ///< Destroy it before the world. Otherwise ODE may print a message about joints, and all is well.
  Effects(Effects&&) noexcept;  ///< takes over the list, the bodies and the costs
  Effects& operator=(Effects&&) noexcept;  ///< takes over the list, the bodies and the costs

  /// Sets ODE's parameters for the effects of the world. Parameters of effects that are not listed keep their values.
  void set_up(dWorldID world) const;

  /// Sets surface and fdir1 of the contacts of one pair from dCollide, in any order. Returns how many to attach: contacts without a
  /// force are moved behind these. A contact has no force if its depth is 0 and its spring undamped, or if its depth is negative
  /// without SpeculativeContacts. The materials belong to geom.g1 and geom.g2. Call it while the bodies have the velocities of the
  /// start of the step, because adhesion adds its force to the bodies here.
  int set_up_contacts(std::span<dContact> contacts, Material material1 = 0, Material material2 = 0);

  /// The same for contacts whose bodies are not the bodies of the geoms. For example, ODE's plane has no body, but may be a moving
  /// wall; a conveyor is a kinematic body that gives its velocity to fixed geoms. The sides belong to geom.g1 and geom.g2. Attach
  /// the joints to the sides' bodies.
  int set_up_contacts(std::span<dContact> contacts, const Side& side1, const Side& side2);

  /// Whether apply_forces does anything.
  bool visits_bodies() const;

  /// Adds a body with geoms of ours, and computes the geometric properties that the effects need. Add the body again after changing
  /// a geom. With SpeculativeContacts its geoms look ahead from now on. Does nothing if no listed effect is a force or
  /// SpeculativeContacts. Throws std::invalid_argument for a body without a geom of ours, and with Restitution and
  /// SpeculativeContacts for one that another such Effects has.
  void add_body(dBodyID body);
  /// Removes a body. Call it before dBodyDestroy. Does nothing for a body that was not added.
  void remove_body(dBodyID body);

  /// Adds the forces of the coming step to all added bodies that are awake. Moves bodies until they touch that will bounce, and
  /// disables contact joints of bodies with several impacts: others take their places until the next call, with their feedback,
  /// as set_up_contacts set them up. Call it after the last set_up_contacts of the step, and after its contacts have been attached
  /// in their order.
  void apply_forces();

  /// Measures seconds from now on, at the cost of two readings of the clock (50 ns) per pass.
  void measure();

  /// The costs of each listed effect, in the order of Effect. Rigid contact itself (1 row) comes first.
  std::vector<Cost> costs() const;

 private:
  struct SUPERNORMAL_LOCAL State;
  std::unique_ptr<State> state_;
};

}  // namespace supernormal::effects
