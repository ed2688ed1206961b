/// @namespace supernormal::effects
/// Effects for ODE worlds: a program lists those that its scene calls for, and effects that are not listed cost nothing.
///
///     namespace fx = supernormal::effects;
///     fx::Effects effects({fx::Gravity{{0, 0, -9.81}}, fx::Friction{.coefficient = 0.4}}, step);   // throws on bad parameters
///     effects.set_up(world);                                   // once
///     … in the near callback, with the contacts of one pair:
///         n = effects.set_up_contacts({contacts, n});           // fills surface and fdir1; attach the first n
///     … before each step, and after its near callbacks:
///         effects.apply_forces();                               // visits the added bodies if a listed effect is a force
///
/// The list is compiled once: each pair of materials gets the surface parameters that all its contacts start from, and the passes
/// that each contact needs besides. Friction limits hold for dWorldQuickStep, which takes them from the normal force of the same
/// step.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "supernormal/export.h"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::effects {

/// A number from 0 on that a program gives to each body or wall; all 0 where it does not care.
using Material = int;
constexpr Material kLastMaterial = 63;  ///< the largest number of a material

/// Selects the contacts that an effect applies to. A pair of materials takes the values listed for the pair; if there are none,
/// the values of both materials, combined; a material without values of its own takes those listed for all. How values combine is
/// said with each effect. Without a value for one of the two the effect is absent, except where its comment says otherwise.
class MaterialSelector {
 public:
  constexpr MaterialSelector() = default;  ///< selects all contacts
  /// Selects the contacts of one material with any other, or with itself.
  static constexpr MaterialSelector of(Material material) { return MaterialSelector(material, kAll); }
  /// Selects the contacts of two materials with each other; they may be the same one.
  static constexpr MaterialSelector between(Material first, Material second) { return MaterialSelector(first, second); }

  constexpr bool is_all() const { return first_ == kAll; }             ///< whether it selects all contacts
  constexpr bool is_pair() const { return second_ != kAll; }           ///< whether it selects those of a pair of materials
  constexpr Material first() const { return first_; }                  ///< the material, or one of the pair; -1 when it selects all
  constexpr Material second() const { return second_; }                ///< the other one of the pair; -1 when there is none
  constexpr bool operator==(const MaterialSelector&) const = default;  ///< whether both select the same

 private:
  static constexpr Material kAll = -1;
  constexpr MaterialSelector(Material first, Material second) : first_(first), second_(second) {}
  Material first_ = kAll;
  Material second_ = kAll;
};

// --- contact -----------------------------------------------------------------------------------------------------------------

/// Coulomb's friction: the force along the surface is at most `coefficient` times the normal force, and opposes the slip.
/// Coefficients of two materials combine by the geometric mean. Costs two constraint rows. The cone is never exceeded: ODE limits
/// the two friction forces separately, to a square, which is inscribed in the cone with a corner towards the slip that the step
/// would bring without friction, so that a body slides and starts to slide at the cone in every direction; across that direction
/// the square holds 1/sqrt(2) of it.
struct Friction {
  double coefficient = 0;  ///< (0, 100]
  MaterialSelector on;     ///< the contacts that it applies to
};

/// Friction that depends on the direction of the slip on the body that carries the material: `along` is the coefficient for slip
/// along `direction`, projected onto the surface, `across` perpendicular to it. The force is the one in the ellipse of these
/// half-axes that dissipates most (Goyal, Ruina and Papadopoulos, Wear 143, 1991). As with Friction, ODE's limits form a
/// rectangle in the ellipse, with a corner at that force and at least a tenth of each coefficient wide. It replaces Friction for
/// the contacts that it selects. Costs two rows, one if a coefficient is 0. Values are not combined: between two materials that
/// have it, the one with the smaller number counts; within one, that of geom g1.
struct AnisotropicFriction {
  double along = 0;                      ///< [0, 100]
  double across = 0;                     ///< [0, 100]; not both 0
  Vector3 direction = Vector3::UnitX();  ///< in the frame of the body (of the geom, where it has no body); not 0
  MaterialSelector on;                   ///< the contacts that it applies to
};

/// Resistance to rolling and to spinning: torques of at most the given lengths times the normal force, against the relative
/// angular velocity in the tangent plane and about the normal. Lengths combine by the geometric mean. Costs two rows for rolling
/// and one for spinning; a length of 0 costs none. (Ai et al., Powder Technology 206, 2011, model A.)
struct RollingResistance {
  double rolling = 0;   ///< m, [0, 1e3]
  double spinning = 0;  ///< m, [0, 1e3]; not both 0
  MaterialSelector on;  ///< the contacts that it applies to
};

/// Newton's restitution of rigid contacts: separating velocity over approach velocity where that is above `threshold`.
/// Coefficients combine by the geometric mean, and the larger threshold counts. Costs no row.
struct Restitution {
  double coefficient = 0;  ///< (0, 1]
  double threshold = 0;    ///< m/s, [0, 100]
  MaterialSelector on;     ///< the contacts that it applies to
};

/// A linear spring and damper for each pair that touches, in place of rigid contact: the force is k depth + c approach velocity,
/// and never pulls. Springs and dampers of two materials are in series, also where both are the same; a material without them is
/// rigid. Values listed for all materials are those of the pair. The spring follows the deepest contact, and all contacts with
/// the same normal share its force in proportion to their depths; the force of the damper acts in the middle of their region.
/// Costs no row. It is integrated as a leapfrog, which is of second order and adds no damping down to ten steps a contact. With
/// fewer steps it is made implicit as far as stability asks, and loses energy: costs().coarse counts those contacts. (ODE's own
/// soft ERP and CFM are the implicit Euler method, which loses a part 2 pi / steps of the energy of every contact.)
struct Compliance {
  double stiffness = 0;  ///< k, N/m, (0, 1e15]
  double damping = 0;    ///< c, N s/m, [0, 1e15]
  MaterialSelector on;   ///< the contacts that it applies to
};

/// Hertz's elastic contact in place of rigid contact: 4/3 E* sqrt(R) depth^(3/2) for a round contact, with elliptic integrals for
/// others (Johnson, Contact Mechanics, 1985, section 4.2), from the curvatures of the bodies at the contact. 1/E* is the sum of
/// (1 - nu^2)/E; a material without values is rigid. The force is at most 2 E* L depth, that of a flat punch as wide as the
/// smaller body (L is the mean of its half-extents), which is what flat faces have. A restitution below 1 adds a damper, 2 b
/// sqrt(5/6 m dF/ddepth) (Tsuji, Tanaka and Ishida, Powder Technology 71, 1992), with b such that an impact of any velocity has
/// this restitution; coefficients combine by the geometric mean. The force is shared by contacts and integrated as for
/// Compliance. Costs no row.
struct Hertz {
  double youngs_modulus = 0;  ///< E, Pa, (0, 1e15]
  double poisson_ratio = 0;   ///< nu, [0, 0.5]
  double restitution = 1;     ///< [0.05, 1]
  MaterialSelector on;        ///< the contacts that it applies to
};

/// An attraction of constant force while in contact: to pull a pair apart takes `pull_off` newtons, for each of the normals that
/// their contacts have. Values combine by the geometric mean. The force acts in the middle of the region of contact: the centre of
/// a rectangle, the middle of an edge. It adds to the normal force, and so to what friction may hold (DMT). Rigid bodies stick with
/// an overlap of 1e-4 of the smaller mean half-extent. Costs no row: it is an external force.
struct Adhesion {
  double pull_off = 0;  ///< N, (0, 1e9]
  MaterialSelector on;  ///< the contacts that it applies to
};

// --- bodies: forces on those that were added with add_body --------------------------------------------------------------------

/// A uniform field. ODE applies it, so it costs no pass of ours.
struct Gravity {
  Vector3 acceleration = Vector3::Zero();  ///< m/s^2, each component in [-1e4, 1e4]
};

/// Drag at high Reynolds number in a fluid at rest: density C A v^2 / 2 against v, where A is the area that the body shows to the
/// flow. It acts at the centre of mass and is integrated implicitly: it never turns a velocity around.
struct QuadraticDrag {
  double density = 0;      ///< density of the fluid, kg/m^3, (0, 1e5]
  double coefficient = 0;  ///< C, (0, 100]; 0.47 for a sphere between Re 1e3 and 2e5
};

/// Drag at low Reynolds number in a fluid at rest: 3 pi viscosity (d_n / 3 + 2 d_s / 3) v against v, where d_n is the diameter of
/// the circle whose area the body shows to the flow and d_s that of the sphere with the body's surface area (Leith, Aerosol
/// Science and Technology 6, 1987): exact for spheres, to 4 % for spheroids of aspect ratio 1/2 to 2, to 10 % for 1/4 to 4. It
/// acts at the centre of mass and is integrated implicitly.
struct StokesDrag {
  double viscosity = 0;  ///< of the fluid, Pa s, (0, 1e6]
};

/// Buoyancy: the weight of the displaced fluid, at the centre of the submerged volume. The fluid is at rest below the plane at
/// `level` metres from the origin, measured against gravity. Needs Gravity.
struct Buoyancy {
  double density = 0;  ///< of the fluid, kg/m^3, (0, 1e5]
  double level = 0;    ///< m, [-1e6, 1e6]
};

/// Exponential decay of velocities: v exp(-rate t). ODE applies it, so it costs no pass of ours.
struct Damping {
  double linear = 0;   ///< 1/s, [0, 1e6]
  double angular = 0;  ///< 1/s, [0, 1e6]; not both 0
};

// --- world: settings of ODE -----------------------------------------------------------------------------------------------------

/// Bodies that are slower than both thresholds on average over `samples` steps, for `time`, fall asleep until something touches
/// them.
struct AutoDisable {
  double linear = 0.01;   ///< m/s, (0, 1e3]
  double angular = 0.01;  ///< rad/s, (0, 1e6]
  double time = 0;        ///< s, [0, 1e6]
  int samples = 10;       ///< [1, 1000]
};

/// The largest velocity with which rigid contacts push overlaps out. Excludes Compliance and Hertz, which push as hard as their
/// laws say.
struct MaxCorrectingVelocity {
  double velocity = 0;  ///< m/s, (0, 1e6]
};

/// The depth that rigid contacts leave alone, so that touching bodies stay in touch.
struct SurfaceLayer {
  double depth = 0;  ///< m, (0, 1e3]
};

/// Speculative contacts: bodies that were added with add_body are met before they overlap, so that none tunnels and what rests
/// comes in by next to nothing, at longer steps (lib/guide.md, "Contacts before overlap"). add_body lets their geoms look ahead by
/// the step (snGeomSetLookAhead); a contact with a negative depth may then close its gap within the step, and no more. Friction and
/// resistance to rolling act with it. A body with restitution that will touch within the step is brought to touch, and leaves with
/// e times the velocity of that moment; the centre of mass of two bodies stays where it is. Springs and adhesion are not felt
/// before touch: there a contact ahead is left out. Without this effect all are. Costs no row.
struct SpeculativeContacts {
  MaterialSelector on;  ///< the contacts that it applies to
};

/// Any effect.
using Effect =
    std::variant<Friction, AnisotropicFriction, RollingResistance, Restitution, Compliance, Hertz, Adhesion, Gravity, QuadraticDrag,
                 StokesDrag, Buoyancy, Damping, AutoDisable, MaxCorrectingVelocity, SurfaceLayer, SpeculativeContacts>;

/// Tells why a list was refused, and where. The text names effect, parameter, value and range, or the two effects that exclude
/// each other.
class SUPERNORMAL_API BadEffect : public std::invalid_argument {
 public:
  /// `effect` and `parameter` are what the members below return, `text` is what().
  BadEffect(std::string effect, std::string parameter, const std::string& text)
      : std::invalid_argument(text), effect_(std::move(effect)), parameter_(std::move(parameter)) {}
  const std::string& effect() const { return effect_; }        ///< its name as in descriptions()
  const std::string& parameter() const { return parameter_; }  ///< "" where the refusal is about the effect as a whole

 private:
  std::string effect_;
  std::string parameter_;
};

/// Describes an effect in words; there is one entry for each alternative of Effect, in its order.
struct Description {
  const char* name;        ///< "rolling_resistance"
  const char* parameters;  ///< with units and ranges
  int rows;                ///< constraint rows added to a contact, at most
  const char* passes;      ///< the work that a step does for it
  const char* source;      ///< where the law is from
};
/// The descriptions of all effects.
SUPERNORMAL_API std::span<const Description> descriptions();

/// One of the two sides of a contact.
struct Side {
  Material material = 0;   ///< of the body or the wall
  dBodyID body = nullptr;  ///< whose velocity the contact feels and to which its joint will be attached; 0: a wall at rest
};

/// Counts the work done for an effect so far.
struct Cost {
  const char* name;                 ///< its name as in descriptions()
  unsigned long long rows = 0;      ///< constraint rows added
  unsigned long long contacts = 0;  ///< contacts that the effect took part in; of speculative_contacts those ahead of touch
  unsigned long long coarse = 0;    ///< those among them that are compliant and last fewer than ten steps
  unsigned long long bodies = 0;    ///< bodies visited
  double seconds = 0;               ///< time in its passes, if measured; the solver's time for the rows is not in it
};

/// A compiled list of effects.
class SUPERNORMAL_API Effects {
 public:
  /// Compiles the list for steps of `step` seconds. BadEffect (a std::invalid_argument) names the effect, the parameter, its
  /// value and the range, or the two effects that exclude each other.
  Effects(const std::vector<Effect>& list, double step);
  ~Effects();
  Effects(Effects&&) noexcept;             ///< takes over the list, the bodies and the costs
  Effects& operator=(Effects&&) noexcept;  ///< takes over the list, the bodies and the costs

  /// Applies the effects of the world to ODE's parameters; parameters of effects that are not listed keep their values.
  void set_up(dWorldID world) const;

  /// Sets surface and fdir1 of the contacts that dCollide found for one pair, in any order. Returns how many to attach:
  /// those that can carry no force (of depth 0, on an undamped spring; of negative depth, without SpeculativeContacts) are moved
  /// behind them. The materials are those of geom.g1 and geom.g2. Call it when the bodies' velocities are those at the start of the
  /// step; adhesion adds its force to the bodies here.
  int set_up_contacts(std::span<dContact> contacts, Material material1 = 0, Material material2 = 0);

  /// The same where a contact's bodies are not those of its geoms: a plane of ODE has no body, but may be a wall that moves, and a
  /// kinematic body may give its velocity to geoms that stand, a conveyor. The sides are those of geom.g1 and geom.g2; attach the
  /// joints to their bodies.
  int set_up_contacts(std::span<dContact> contacts, const Side& side1, const Side& side2);

  /// Whether apply_forces does anything.
  bool visits_bodies() const;

  /// Adds a body with geoms of ours. The properties of their geometry that the effects need are computed here: add the body again
  /// after changing a geom. With SpeculativeContacts its geoms look ahead from now on. Nothing happens if no listed effect is a
  /// force, nor SpeculativeContacts. std::invalid_argument for a body without a geom of ours.
  void add_body(dBodyID body);
  /// Forgets a body. Call it before dBodyDestroy; nothing happens for a body that was not added.
  void remove_body(dBodyID body);

  /// Adds the forces of the coming step to all added bodies that are awake, and brings bodies to touch that will bounce ahead of an
  /// overlap. Call it after the last set_up_contacts of the step: the bodies' places are others then.
  void apply_forces();

  /// Measures seconds from now on, at the cost of two readings of the clock (50 ns) a pass.
  void measure();

  /// One entry for each listed effect, in the order of Effect; rigid contact itself (1 row) comes first.
  std::vector<Cost> costs() const;

 private:
  struct SUPERNORMAL_LOCAL State;
  std::unique_ptr<State> state_;
};

}  // namespace supernormal::effects
