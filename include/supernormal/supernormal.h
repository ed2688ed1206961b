/** @file
 * Supernormal: smooth convex bodies for the Open Dynamics Engine. The C interface.
 *
 * Lengths are in metres, or in the unit that the ODE world uses throughout. Directions are unit vectors. A body is an ordinary
 * placeable dGeomID: dGeomSetBody, dGeomSetOffset…, dSpaceAdd, dCollide and dGeomDestroy work as for the built-in classes.
 * Rotations are orthonormal, as ODE keeps them. If a rotation is not orthonormal to rounding, the nearest rotation is used. A
 * geom whose rotation is 1 % off has no contacts and no answers, and snLastError reports it. The library may be used from
 * several threads wherever ODE itself may; see lib/README.md. */
#ifndef SUPERNORMAL_SUPERNORMAL_H
#define SUPERNORMAL_SUPERNORMAL_H

#include <ode/ode.h>

#include "supernormal/export.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- the library ------------------------------------------------------------------------------------------------------- */

/** Takes a reference on ODE (dInitODE2) and registers the geometry class. Optional: every snCreate… does it, in any thread.
 * Returns 1 on success. Returns 0 if ODE cannot be initialised, has another precision than this library, or has none of its four
 * user classes free (see snLastError). Balanced dInitODE2 and dCloseODE calls of others do not affect the class. */
SUPERNORMAL_ODE_API int snInit(void);

/** Gives the reference back, however often snInit was called. Destroy the geoms first: while one of ours exists, it only sets
 * snLastError. A later snCreate… or snInit starts afresh. */
SUPERNORMAL_ODE_API void snClose(void);

/** The class number of all our geoms, as dGeomGetClass returns it; -1 before the first snInit or snCreate… */
SUPERNORMAL_ODE_API int snGeomClass(void);

/** Why the last refused call of this thread was refused: the parameter, its value and the valid range. "" if there was none. */
SUPERNORMAL_ODE_API const char* snLastError(void);

/* --- bodies ------------------------------------------------------------------------------------------------------------ */
/* Every create call adds the geom to `space`, unless that is 0. It refuses bad parameters: it then returns 0 and sets
 * snLastError. As with ODE's own geoms, do not call create, set or destroy in near callbacks: ODE aborts if the space is locked.
 *
 * dCollide handles our geoms with each other and with all of ODE's own: dSphere, dBox, dCapsule, dCylinder, dPlane, dConvex,
 * dRay, dTriMesh and dHeightfield, also inside spaces and dGeomTransform. For a user class of another program it asks that
 * class. A geom with a length that is not finite, or above 1e30 (except for a dRay), makes no contacts, and snLastError reports
 * it. So does a geom that looks ahead with a velocity that is not finite or above 1e75.
 *
 * The first contact is the deepest, with the depth of the overlap. Round bodies make one contact, and so does every pair with
 * room for one. Flat bodies have the two to four manifold points of the region on which they rest, deepest first. Each is as
 * deep as the faces overlap there, or 0 (lib/contact/README.md). With room for two or three, neighbouring points are merged.
 *   - dConvex: only the vertices count, not its planes and polygons; after dGeomSetConvex call dGeomMoved.
 *   - dTriMesh: single-sided. The space behind a triangle is solid: seen from there its vertices run clockwise. A contact's side of
 * the mesh is the index of the triangle. snGeomProximity treats a mesh that is met from behind as two-sided.
 *   - dHeightfield: the space below its triangles is solid.
 *   - dRay: as for ODE's convex classes, `depth` is the distance along the ray to the first boundary point. The normal opposes the
 *     ray, from inside too. A ray that is wholly inside, or has no length, hits nothing. */

/** (x/a)^2 + (y/b)^2 + (z/c)^2 = 1 with half-axes a, b, c in [1e-30, 1e30]. */
SUPERNORMAL_ODE_API dGeomID snCreateEllipsoid(dSpaceID space, dReal a, dReal b, dReal c);

/** (|x/a|^delta + |y/b|^delta)^(epsilon/delta) + |z/c|^epsilon = 1 with half-axes in [1e-30, 1e30], exponents in [1.01, 1000]. */
SUPERNORMAL_ODE_API dGeomID snCreateSuperellipsoid(dSpaceID space, dReal a, dReal b, dReal c, dReal delta, dReal epsilon);

/** A superellipsoid whose section grows or shrinks linearly along z: the equation above with x/(1 + taper_x z/c) for x and y/(1 +
 * taper_y z/c) for y. It must be convex: |taper| <= 2^(1/epsilon) (epsilon - 1)/epsilon, which is 0.707 for epsilon = 2. For
 * epsilon > 2 the two tapers must be equal. For epsilon <= 2 different tapers are refused if both together are too large. Its
 * centre of mass is not its origin but (0, 0, z): see snMassSet. */
SUPERNORMAL_ODE_API dGeomID snCreateSuperovoid(dSpaceID space, dReal a, dReal b, dReal c, dReal delta, dReal epsilon, dReal taper_x,
                                               dReal taper_y);

/** The points within `radius` of a segment of `length` along z; both in m, in [1e-30, 1e30] and [0, 1e30]. The shape of
 * dCreateCapsule, as a body of ours. Its rounding is `radius` already: snGeomSetRounding adds to it. */
SUPERNORMAL_ODE_API dGeomID snCreateCapsule(dSpaceID space, dReal radius, dReal length);

/** A body that the program itself describes, by its support function and the boundary point of a normal. Directions are unit
 * vectors in the body's frame. The callbacks must be pure; any colliding thread may call them. */
typedef struct snShape {
  dReal (*support)(const void* user, const dReal direction[3]);                  /**< h(n), m */
  void (*point)(const void* user, const dReal direction[3], dReal point[3]);     /**< r(n), m */
  void (*hessian)(const void* user, const dReal direction[3], dReal hessian[9]); /**< m, row-major; may be NULL */
  void* user;                                                                    /**< passed to each call */
  void (*release)(void* user); /**< called when the geom and its copies have died; may be NULL; not called if the create call
                                  refuses */
} snShape;

/** The callbacks are tested in 26 directions. Results must be finite, and the size in [1e-30, 1e30]. To 1e-6 of the size,
 * point(n).n = support(n), and no point lies outside the tangent plane of another. support(n) + support(-n) >= 2e-30 m. The
 * Hessian is symmetric, has n in its kernel, and has no negative eigenvalue. Otherwise the call refuses: it returns 0, and
 * snLastError contains the direction. Flat faces and sharp edges are allowed, with any point of the face as boundary point.
 * Smooth bodies take fewer evaluations. `shape` itself is copied. samples/user_shape shows an egg and a lens. */
SUPERNORMAL_ODE_API dGeomID snCreateConvex(dSpaceID space, const snShape* shape);

/** Set and get refuse (return 0, set snLastError) if the geom is not an ellipsoid or superellipsoid. Set keeps the rounding. On a
 * refusal the geom stays unchanged. */
SUPERNORMAL_ODE_API int snGeomSuperellipsoidSetParams(dGeomID geom, dReal a, dReal b, dReal c, dReal delta, dReal epsilon);
/** Reads the half-axes and exponents; none of the pointers may be NULL. */
SUPERNORMAL_ODE_API int snGeomSuperellipsoidGetParams(dGeomID geom, dReal* a, dReal* b, dReal* c, dReal* delta, dReal* epsilon);

/** The same for superovoids. */
SUPERNORMAL_ODE_API int snGeomSuperovoidSetParams(dGeomID geom, dReal a, dReal b, dReal c, dReal delta, dReal epsilon,
                                                  dReal taper_x, dReal taper_y);
/** Reads the parameters; none of the pointers may be NULL. */
SUPERNORMAL_ODE_API int snGeomSuperovoidGetParams(dGeomID geom, dReal* a, dReal* b, dReal* c, dReal* delta, dReal* epsilon,
                                                  dReal* taper_x, dReal* taper_y);

/** Sweeps the body by a sphere of `radius` in [0, 1e30]: the body grows by it, and its edges become round. Replaces an earlier
 * rounding; 0 removes it. */
SUPERNORMAL_ODE_API int snGeomSetRounding(dGeomID geom, dReal radius);

/* --- bodies as text, and copies ---------------------------------------------------------------------------------------- */

/** Writes the text of the body's shape, rounding included, such as
 * Rounded(core=Superellipsoid(half_axes=(0.02, 0.015, 0.008), delta=8, epsilon=8), radius=0.001). Like snprintf, it writes at most
 * `capacity` - 1 characters and a 0, and returns the length of the whole text; with a capacity of 0, `text` may be NULL. The digits
 * read back as the same numbers. Returns -1 (and snLastError) for a body of snCreateConvex, whose callbacks have no text. */
SUPERNORMAL_ODE_API int snGeomDescribe(dGeomID geom, char* text, int capacity);

/** Creates the body of a text of snGeomDescribe, or of any other shape of the C++ core or of the Python package: Sphere, Ellipsoid,
 * Superellipsoid, Superovoid, Box, Capsule, Cylinder, Polytope, Rounded, MinkowskiSum, LinearImage; see
 * include/supernormal/shapes/description.hpp. Rounding, half-axes, exponents and tapers can be read and set as if they were set by
 * the functions above. The body must have a width of 2e-30 m or more along each axis. Refuses any other text with the place of the
 * mistake. */
SUPERNORMAL_ODE_API dGeomID snCreateFromDescription(dSpaceID space, const char* text);

/** Creates a copy of a body of ours, bodies of snCreateConvex included: shape, rounding, solver settings, look-ahead time, place
 * and orientation in the world, category and collide bits, and whether it is enabled. The copy has no dBodyID, no offset and no
 * data. Copies of a body of snCreateConvex share its callbacks; `release` is called when the last of them dies. */
SUPERNORMAL_ODE_API dGeomID snGeomCopy(dSpaceID space, dGeomID geom);

/* --- queries of one body ----------------------------------------------------------------------------------------------- */

/** The distance of a point in world coordinates from the boundary, m, to the tolerance of the geom's solver settings: positive
 * inside, 0 on it, negative outside. NaN (and snLastError) if the point is not finite or the geom is not ours. */
SUPERNORMAL_ODE_API dReal snGeomPointDepth(dGeomID geom, dReal x, dReal y, dReal z);

/** Finds the boundary point whose outward normal is `direction` (world frame, any length but 0); `point` is in world coordinates.
 */
SUPERNORMAL_ODE_API int snGeomSupport(dGeomID geom, const dVector3 direction, dVector3 point);

/** A closed mesh of a body, to draw it: vertices on its boundary with the outward normals there, in the geom's frame. */
typedef struct snMesh {
  int points;             /**< number of vertices */
  int triangles;          /**< number of triangles */
  const dReal* position;  /**< 3 * points, m */
  const dReal* normal;    /**< 3 * points, unit */
  const dTriIndex* index; /**< 3 * triangles: the vertices of each, counter-clockwise seen from outside */
} snMesh;

/** Makes a mesh whose edges are at most chord_error (m) away from the boundary. chord_error is at least a millionth of the geom's
 * largest half-extent; at 2 % of the smallest half-axis no vertices are visible. Flat faces take few triangles. Give the mesh
 * back with snMeshRelease. Returns 0 (and snLastError) if chord_error is out of range or the geom is not ours; `mesh` is then
 * empty. */
SUPERNORMAL_ODE_API int snGeomTessellate(dGeomID geom, dReal chord_error, snMesh* mesh);
/** Frees the arrays and empties the mesh. Leaves an empty mesh, or NULL, unchanged. */
SUPERNORMAL_ODE_API void snMeshRelease(snMesh* mesh);

/** Mass, centre of mass and inertia of the homogeneous body, in the geom's frame. Exact for ellipsoids, superellipsoids,
 * superovoids and bodies with faces, also when these are rounded. Other rounded bodies and smooth user-defined ones are to 1e-9, by
 * quadrature. Quadrature does not see the volume behind faces and edges: a body is refused if this is more than 1 % of its volume.
 * density (kg/m^3) and total_mass (kg) in (0, inf). A body whose centre of mass is not its origin, such as a superovoid, needs
 * dMassTranslate and a geom offset before dBodySetMass, as always in ODE. */
SUPERNORMAL_ODE_API int snMassSet(dMass* mass, dReal density, dGeomID geom);
/** The same for a body of the given total mass. */
SUPERNORMAL_ODE_API int snMassSetTotal(dMass* mass, dReal total_mass, dGeomID geom);

/* --- solver settings --------------------------------------------------------------------------------------------------- */

/* In C++, too, every int is a value of the type. A value that is no solver is refused, and passing it is not undefined
 * behaviour. */
#ifdef __cplusplus
#define SN_ENUM_BASE : int
#else
#define SN_ENUM_BASE
#endif
/** The methods that find the common normal of two bodies (lib/proximity/README.md). */
typedef enum snSolver SN_ENUM_BASE {
  SN_SOLVER_HYBRID,     /**< globally convergent; the default */
  SN_SOLVER_NEWTON,     /**< Newton's method as published, without safeguards; needs Hessians */
  SN_SOLVER_FIXED_POINT /**< the fixed point as published, without derivatives and safeguards */
} snSolver;

/** tolerance: the largest error of the gap, relative to the smallest half-extent of the two bodies, in [1e-15, 1]; default 1e-9.
 * max_evaluations: how often a query may evaluate the gap function, in [1, 1000000]; default 1000. A pair uses the tighter
 * tolerance and the larger limit of its two geoms. It uses the hybrid solver unless both geoms ask for the same other solver. */
SUPERNORMAL_ODE_API int snGeomSetSolver(dGeomID geom, snSolver solver, dReal tolerance, int max_evaluations);

/** Sets the defaults for the geoms created from now on, in every thread. */
SUPERNORMAL_ODE_API int snSetDefaultSolver(snSolver solver, dReal tolerance, int max_evaluations);

/** Whether each pair starts from its last normal in this thread (default on). Off: results are a pure function of the two poses.
 * On: the same scene, built and run in the same order by one thread, gives the same digits in every run. */
SUPERNORMAL_ODE_API void snSetWarmStart(int on);

/* --- contacts before overlap ------------------------------------------------------------------------------------------- */

/** How far dCollide looks ahead for this geom: `time` in s, in [0, 1e6]. 0 (default): off, only overlaps have contacts. Use the
 * step of the simulation. With a time > 0 dCollide also returns contacts of pairs that may meet within it. These have depth =
 * -gap < 0; pass them to snContactLookAhead before dJointCreateContact. So a body does not tunnel through what it would hit
 * within a step, and resting bodies hardly overlap, at longer steps. lib/guide.md, "Contacts before overlap", lists the
 * exceptions: bodies of several geoms, bodies that an impact rotates far in a step, and two free bodies that meet off centre and
 * move many sizes in a step.
 *
 * dCollide takes velocities and forces from the bodies of the geoms (dGeomGetBody). A geom without a body stands still. dCollide
 * moves both without rotation to where they meet, and takes the normals there. So a body that flies past another has no contact
 * with it. A contact leaves a motion as it is in which gravity, forces and rotation keep the bodies apart. A pair must come near
 * enough: rotation, gravity, forces and one hundredth of the smallest half-extent increase the distance that counts as near. A pair
 * uses the larger time of its two geoms. All classes except dRay have contacts ahead. On a dTriMesh or dHeightfield the body slides
 * from face to face.
 *
 * The bounding box covers the motion of the geom's own body within its own time, so that spaces report the pair. A moving dBox
 * or other geom of ODE has its present box, and has contacts ahead when it comes into ours. Inside a dGeomTransform nothing is
 * covered. ODE computes a box after its geom has moved, and every step moves it. If you give a velocity to a body that has not
 * moved since the last dSpaceCollide, call dGeomMoved or this function again. Like dGeomMoved, do not call it in near callbacks.
 * Returns 1; 0 (and snLastError) if refused. */
SUPERNORMAL_ODE_API int snGeomSetLookAhead(dGeomID geom, dReal time);

/** Sets the time for the geoms created from now on, in every thread. */
SUPERNORMAL_ODE_API int snSetDefaultLookAhead(dReal time);

/** Turns a contact with depth < 0 into a constraint of ODE that lets the gap close within `step`, and no more. `step` is in s, >
 * 0: the next dWorldStep's or dWorldQuickStep's. The contact's depth becomes 0, its surface gets dContactMotionN, and -gap/step
 * is added to the motionN that it has by this flag. A contact of geoms that look ahead gets a dContactSoftERP of 0.8, if it has
 * none: it corrects 0.8 of its overlap in a step, whatever the world's ERP. Other contacts stay unchanged. Call it after setting
 * contact->surface, and bodies' velocities and forces.
 *
 * dContactBounce acts as in ODE: bodies that approach faster than bounce_vel leave with `bounce` (in [0, 1]) times their
 * velocity. They turn back before they touch, in the step in which they would touch, because a contact moves no body. They get
 * the velocity that they would have there on their way back. So a body that falls rises to the square of `bounce` times its
 * height, at any step, if it hits faster than 2 g step / bounce^2. A slower one that would rise less than it is high at the
 * start of this step closes the gap first, and bounces in the next step with what is left of its velocity. Resting bodies do
 * not bounce, and overlapping bodies that part are not pushed apart. For this the call may change surface.mode, bounce and
 * motionN. The velocities and forces are those of the bodies of contact->geom.g1 and g2; a geom without a body, as one in a
 * dGeomTransform, stands still. The impacts of one step are simultaneous: for Newton's cradle take the effects of C++, which
 * move bodies until they touch.
 *
 * Set dContactApprox1: without it mu is a force, which acts before the bodies touch. With a step or a bounce that is refused
 * (snLastError), or NULL, nothing is changed. */
SUPERNORMAL_ODE_API void snContactLookAhead(dContact* contact, dReal step);

/* --- queries of two bodies --------------------------------------------------------------------------------------------- */

/** The answer to a query of two geoms. */
typedef struct snProximity {
  dReal gap;       /**< m; < 0: overlap depth = -gap */
  dReal error;     /**< m; estimate of |gap - local maximum of s|; a bound if proved (is_global); 0 for closed forms */
  dVector3 normal; /**< unit, from g1 to g2, world frame */
  dVector3 point1; /**< m, world frame, on the boundary of g1 */
  dVector3 point2; /**< m, world frame, on the boundary of g2 */
  int evaluations; /**< evaluations of the gap function; 0 for closed forms */
  int converged;   /**< 1: the error is within the tolerance */
  int is_global;   /**< 1: it is proved that no translation shorter than -gap separates the geoms; always 1 if apart or touching */
} snProximity;

/** Signed distance of two geoms, apart or overlapping, in either order. At least one is ours; the other is ours or one of ODE's
 * own, but not a space or a dGeomTransform. On faces and edges the normal is the face's or edge's, and point1 and point2 are any
 * of the touching points. For a dTriMesh or dHeightfield it returns the gap of the deepest contact of dCollide. Without a
 * contact, it returns the distance of the nearest triangle, from either side. Without a contact it is negative only for a body
 * that touches a sheet's border from behind. Returns 1; 0 (and snLastError) if the pair is not supported or a pose or length is
 * not finite. */
SUPERNORMAL_ODE_API int snGeomProximity(dGeomID g1, dGeomID g2, snProximity* out);

/** The same, but for overlapping geoms it searches until the depth is proved the smallest, or until the limit of evaluations;
 * is_global distinguishes the two. Takes tens to hundreds of evaluations. For a dTriMesh or dHeightfield there is no such proof,
 * and it does the same as snGeomProximity. */
SUPERNORMAL_ODE_API int snGeomProximityCertified(dGeomID g1, dGeomID g2, snProximity* out);

/** When two geoms will meet. */
typedef struct snImpact {
  dReal time;      /**< s from now; the horizon if there is no impact within it */
  int hits;        /**< 1: the gap comes within the tolerance at `time`; 0: no contact in [0, horizon], proved */
  dVector3 normal; /**< unit, from g1 to g2, at `time`, world frame; without an impact, one that separates the geoms, except for a
                      surface of triangles, of which none may be near */
  dVector3
      point1; /**< m, world frame, on the boundary of g1 at `time`; for an impact, where the geoms touch, to 1e-6 of their size */
  dVector3 point2; /**< m, world frame, on the boundary of g2; for an impact, it is point1 + gap * normal */
  int evaluations; /**< evaluations of the gap function; with a plane, of the support function */
  int converged;   /**< 0: a limit was reached; `hits` is then 1, and it is proved that there is no impact before `time` */
} snImpact;

/** Finds the first time in [0, horizon] (s, at most 1e30) at which two geoms meet if they keep the present velocities of their
 * bodies, linear and angular, about their centres of mass. A geom without a body stands still. At `time` the gap is within the
 * tolerance of the geoms' solver settings. No impact is missed, however fast the geoms rotate: it is proved that they are apart
 * before. Geoms that overlap or touch now hit at time 0, unless they touch and separate. The geoms are the geoms of
 * snGeomProximity, in either order. Every triangle of a dTriMesh or dHeightfield counts, from both sides, and nothing is solid
 * behind it. A dRay is a segment. Returns 1; 0 (and snLastError) if the pair is not supported, the horizon is out of range, or a
 * pose, velocity or length is not finite. */
SUPERNORMAL_ODE_API int snGeomTimeOfImpact(dGeomID g1, dGeomID g2, dReal horizon, snImpact* out);

/* --- how the answer changes -------------------------------------------------------------------------------------------- */

/** Why derivatives of a pair exist or not (lib/proximity/README.md, "How the answer changes"). */
typedef enum snDerivativeStatus SN_ENUM_BASE {
  SN_DERIVATIVES_SMOOTH,             /**< all derivatives are defined */
  SN_DERIVATIVES_ACTIVE_SET,         /**< all are defined while point1 and point2 stay on their face, edge or vertex */
  SN_DERIVATIVES_DEGENERATE,         /**< a point is at the border of its face or edge: only the gradient of the gap is defined */
  SN_DERIVATIVES_FREE_ON_FACE,       /**< faces or edges share more than a point: only derivatives by v of the gap are defined */
  SN_DERIVATIVES_SINGULAR_CURVATURE, /**< the normal may not be unique, as between two vertices */
  SN_DERIVATIVES_SEVERAL_MAXIMA,     /**< the opposite normal has the same gap */
  SN_DERIVATIVES_NO_HESSIAN,         /**< a body of snCreateConvex has no Hessian: only the gradient of the gap is known */
  SN_DERIVATIVES_NOT_CONVERGED       /**< the normal of the answer is not a common normal */
} snDerivativeStatus;
#undef SN_ENUM_BASE

/** The largest number of parameters of a geom. */
#define SN_MAX_PARAMETERS 16

/** A parameter of a geom, and the derivative of the gap by it. */
typedef struct snParameter {
  const char* name; /**< as of the C++ class: "a", "b", "c", "delta", "epsilon", "taper_x", "taper_y", "radius", "half_length"; for
                       a dBox, dCapsule and dCylinder half-lengths. A radius after other parameters is the rounding */
  dReal value;      /**< d gap / d parameter: m/m by a length, m by an exponent or a taper */
} snParameter;

/** Derivatives of the answer to a query of two geoms. The columns are the components of two twists, (v1, w1, v2, w2), three each,
 * in the world frame. A twist moves the geom by v (m) and rotates it by w (rad) about dGeomGetPosition(geom). So for a geom with
 * an offset this is not the centre of mass of its body. A dPlane moves and rotates about the origin of the world. What is not
 * defined is 0, and nothing is NaN. */
typedef struct snDerivatives {
  snDerivativeStatus status;                 /**< says why a flag is 0 */
  int has_gap;                               /**< 1: the gap is differentiable; otherwise `gap` is one of its subgradients */
  int has_normal;                            /**< 1: the normal is differentiable, and the gap twice */
  int has_points;                            /**< 1: point1 and point2 are differentiable */
  dReal gap[12];                             /**< m/m and m/rad; d gap / d v2 is the normal */
  dReal normal[3][12];                       /**< 1/m and 1/rad */
  dReal point1[3][12];                       /**< m/m and m/rad; the point of space, not of the material */
  dReal point2[3][12];                       /**< m/m and m/rad */
  dReal gap_hessian[12][12];                 /**< m/(m m), m/(m rad) and m/(rad rad); symmetric */
  int parameters1;                           /**< number of parameters of g1; 0 for a geom without any, such as a dConvex */
  int parameters2;                           /**< number of parameters of g2 */
  snParameter parameter1[SN_MAX_PARAMETERS]; /**< d gap / d parameter of g1 */
  snParameter parameter2[SN_MAX_PARAMETERS]; /**< d gap / d parameter of g2 */
  int evaluations;                           /**< evaluations of the gap function; 0 with a dPlane */
} snDerivatives;

/** The gradient of the gap by both twists of snGeomDerivatives, digit by digit, without the other derivatives:
 * (-n, -P1 x n, n, P2 x n) with the points P1 and P2 from the positions of the geoms. `at` is the answer of snGeomProximity or
 * snGeomProximityCertified for the same geoms in the same order and poses; its normal is first brought to rounding, with about two
 * evaluations. Where the gap has a kink it is one of the subgradients; snGeomDerivatives says where. For a dTriMesh or dHeightfield
 * the gradient is as exact as the normal and the points of `at`, and on a flat side its part by rotations may be off by the size of
 * the side. The geoms are the geoms of snGeomProximity. Returns 1; 0 (and snLastError) if an argument is refused, or a pose or a
 * length is not finite. */
SUPERNORMAL_ODE_API int snGeomGapGradient(dGeomID g1, dGeomID g2, const snProximity* at, dReal gradient[12]);

/** All derivatives at the answer `at`, in closed form: its normal is first brought to rounding, with about two evaluations. The
 * geoms are the geoms of snGeomProximity, without dTriMesh and dHeightfield. `at` as for snGeomGapGradient. Returns 1; 0 (and
 * snLastError) if the pair is not supported, or an argument, a pose or a length is not finite. */
SUPERNORMAL_ODE_API int snGeomDerivatives(dGeomID g1, dGeomID g2, const snProximity* at, snDerivatives* out);

/* --- whether there is room --------------------------------------------------------------------------------------------- */

/** A proved lower bound of the gap. */
typedef struct snClearance {
  dReal lower_bound; /**< m; the gap is at least this */
  dVector3 normal;   /**< unit, from g1 to g2, world frame; it gives the bound */
  int evaluations;   /**< evaluations of the gap function */
} snClearance;

/** A lower bound of the gap from at most max_evaluations evaluations, in [1, 3]. It ends at the first normal whose bound is above
 * `enough` (m; dInfinity: the best bound). Bounding spheres come first and take no evaluation. For a dPlane, dTriMesh or
 * dHeightfield the bound is the gap of snGeomProximity less its error, whatever max_evaluations is. Returns 1; 0 (and snLastError)
 * if refused. */
SUPERNORMAL_ODE_API int snGeomClearance(dGeomID g1, dGeomID g2, dReal enough, int max_evaluations, snClearance* out);

/** Returns 1 if it is proved that the gap is larger than `distance` (m, finite; negative: that they overlap by less), with one
 * evaluation as a rule. Otherwise returns 0: if the gap is not larger, to a tolerance of 1e-9 of the smallest half-extent, and if
 * the call is refused (snLastError). So geoms that were not examined count as near. `normal`, if not NULL, is the first normal to
 * try (from g1 to g2, world frame), unless it is 0. It receives the best normal for the next call. The geoms are the geoms
 * of snGeomProximity. */
SUPERNORMAL_ODE_API int snGeomIsFartherThan(dGeomID g1, dGeomID g2, dReal distance, dVector3 normal);

/* --- many pairs at once ------------------------------------------------------------------------------------------------ */

/** The memory and threads for colliding a space in parallel. A batch keeps them between calls. */
typedef struct snBatch* snBatchID;

/** Creates a batch with `threads` in [1, 256], including the calling thread, or one per core of the machine if 0. Returns 0 (and
 * snLastError) if refused. */
SUPERNORMAL_ODE_API snBatchID snBatchCreate(int threads);

/** Calls task(context, i) once for every i in [0, count), on any threads, and returns when all calls have returned. */
typedef void snParallelFor(void* pool, int count, void (*task)(void* context, int i), void* context);

/** Creates a batch that uses the threads of the program: `run` is called with `pool`, once in every snBatchCollide. snBatchCollide
 * refuses the pairs of a `run` that leaves out a call of `task`, or repeats one. */
SUPERNORMAL_ODE_API snBatchID snBatchCreateOn(snParallelFor* run, void* pool);

/** Ends its threads and frees its memory. Does nothing for 0. */
SUPERNORMAL_ODE_API void snBatchDestroy(snBatchID batch);

/** Returns nonzero to collide these two geoms, 0 for pairs that need no contacts: of sleeping bodies, or of bodies connected by a
 * joint. */
typedef int snPairFilter(void* data, dGeomID g1, dGeomID g2);

/** Takes the contacts of a pair, as dCollide(g1, g2, …) would have written them; count > 0. */
typedef void snContactsCallback(void* data, dGeomID g1, dGeomID g2, const dContactGeom* contacts, int count);

/** Does the same as dSpaceCollide with a dCollide of every pair, for max_contacts in [1, 65535], with the same contacts bit for
 * bit. First it collects the pairs that `wanted` accepts (may be NULL: all). Then it solves the pairs of two geoms of ours on
 * all threads, and the other pairs by dCollide on the calling thread. Then it calls `contacts` for each pair with contacts, in
 * the order of dSpaceCollide. Both callbacks are called on the calling thread, `contacts` with the space unlocked. Geoms of
 * spaces within the space meet the geoms outside, as in dSpaceCollide2. For pairs inside such a space, call it for that space.
 *
 * Until it returns, nothing may move or change a geom. A second call with the batch, from a callback or another thread, is refused
 * meanwhile. Callbacks of snCreateConvex are called on all threads. Statistics count on the calling thread. A
 * dSetColliderOverride for two geoms of our class is not called. No memory is allocated unless there are more pairs than ever
 * before. Returns the number of contacts; -1 (and snLastError) if an argument is refused, there is no more memory, or a callback
 * written in C++ throws. */
SUPERNORMAL_ODE_API int snBatchCollide(snBatchID batch, dSpaceID space, int max_contacts, void* data, snPairFilter* wanted,
                                       snContactsCallback* contacts);

/* --- a step that remembers its contact forces ---------------------------------------------------------------------------- */

/** Moves bodies in place of dWorldQuickStep: it starts from the contact forces of the last step, and takes sub-steps
 * (lib/stepper/README.md). It knows the flags of dSurfaceParameters, kinematic and disabled bodies, gravity modes, damping, the
 * largest angular speed and auto-disabling. A body rotates by finite steps, whatever its mode. The world's ERP and CFM count for
 * contacts with dContactSoftCFM only. ODE tells nobody the moved callback of a body, so it is not called. */
typedef struct snStepper* snStepperID;

/** Creates a stepper for bodies of `world`. A world has only one, because each calls dWorldQuickStep, which moves the other bodies:
 * a second one is refused until the first is destroyed. Destroy it before the world. Returns 0 (and snLastError) if refused. */
SUPERNORMAL_ODE_API snStepperID snStepperCreate(dWorldID world);

/** Destroys it; its bodies stay. Does nothing for 0. */
SUPERNORMAL_ODE_API void snStepperDestroy(snStepperID stepper);

/** The stepper moves this body from now on. ODE cannot list the bodies of a world. dWorldQuickStep moves the other bodies; the
 * stepper calls it. Refuses a body that was added before, or of another world. Returns 1; 0 (and snLastError) if refused.
 *
 * The stepper solves the enabled joints of its bodies with one another and with the world: ball, hinge, slider, universal and fixed
 * joints, with their motors, stops and feedback. ODE does not tell what a hinge, a slider or a fixed joint holds: that is how its
 * bodies are in the first step with it. They are taken anew if its axis or its bodies change, and if one
 * of its bodies is removed and added again. Do that after dJointSetFixed of bodies that were moved, and after a joint was destroyed
 * and another one made for the same bodies, which may have its address. ERP and the fudge factor are not used. A body is moved by
 * quickstep, with all that touch it or are joined to it, if it has another joint, or one whose CFM or stop CFM is above the
 * world's, that bounces, or that ties it to a body that was not added. */
SUPERNORMAL_ODE_API int snStepperAddBody(snStepperID stepper, dBodyID body);

/** The stepper leaves this body, and forgets the contacts that it was given with it. Call it before dBodyDestroy. Returns 1; 0 (and
 * snLastError) if it is none of its bodies. */
SUPERNORMAL_ODE_API int snStepperRemoveBody(snStepperID stepper, dBodyID body);

/** Adds a contact for the next step, in place of dJointCreateContact and dJointAttach. A depth < 0 is a gap, as of geoms that look
 * ahead; do not call snContactLookAhead. The bodies are bodies of the stepper; one may be 0, the world. Contacts of the same two
 * geoms are added one after the other. Returns 1; 0 (and snLastError) if a number is out of range. */
SUPERNORMAL_ODE_API int snStepperAddContact(snStepperID stepper, const dContact* contact, dBodyID body1, dBodyID body2);

/** Moves the bodies by `step` (s, > 0), keeps the contact forces for the next call, and forgets the contacts. Returns the time
 * done, s. It is less than `step` if bodies have left the paths for which their contacts were found, as after an impact: then
 * collide again, and call it with the rest. Forces and torques on bodies act for the whole step, and are removed as by a step of
 * ODE. In the call with the rest they act on, unless the body has been given a force or a torque since: then that acts in their
 * place. dWorldQuickStep moves what other joints hold (snStepperMoves). Returns a number < 0 (and snLastError) if it refuses; it
 * has then changed nothing. */
SUPERNORMAL_ODE_API dReal snStepperStep(snStepperID stepper, dReal step);

/** Who moved a body in the last snStepperStep: 1 the stepper; 0 dWorldQuickStep, because the body, or one that it is joined to or
 * touches, has a joint that the stepper does not solve (snStepperAddBody); -1 (and snLastError) if it is none of its bodies. */
SUPERNORMAL_ODE_API int snStepperMoves(snStepperID stepper, dBodyID body);

/** sag: the largest overlap of a contact at rest, relative to the least radius of gyration of its bodies, in [1e-12, 1]; default
 * 2e-3. Two free bodies of which neither looks ahead keep up to five times as much. least and most: sub-steps of a step, in [1,
 * 1000000]; default 8 and 64. The loads decide between them; loads that ask for more than `most` overlap by more. Returns 1; 0 (and
 * snLastError) if refused. */
SUPERNORMAL_ODE_API int snStepperSetAccuracy(snStepperID stepper, dReal sag, int least, int most);

/** The force (N) on body 1 of a contact, its mean over the time that the last snStepperStep returned. The contacts have the numbers
 * 0, 1, ... in the order in which they were added. Returns 1; 0 (and snLastError) if there is no such contact. */
SUPERNORMAL_ODE_API int snStepperContactForce(snStepperID stepper, int contact, dVector3 force);

/** Saves what the stepper remembers between two whole steps, for a world of the same geoms that goes on from there. Writes `room`
 * numbers at most, and none if there are more. Contacts have the places of their geoms among `geoms`; those with another geom or
 * with none, joints, and how long bodies have rested are left out. Returns how many numbers there are; -1 (and snLastError) if
 * refused. */
SUPERNORMAL_ODE_API int snStepperSave(snStepperID stepper, const dGeomID* geoms, int count, double* numbers, int room);

/** Gives a stepper what snStepperSave wrote, in place of what it remembers. The geoms have the same places among `geoms`. Returns
 * 1; 0 (and snLastError) if these are no such numbers; it has then changed nothing. */
SUPERNORMAL_ODE_API int snStepperLoad(snStepperID stepper, const dGeomID* geoms, int count, const double* numbers, int size);

/* --- statistics --------------------------------------------------------------------------------------------------------- */

/** A number of 64 bits. C90 has no long long; compilers that know __extension__ accept it there without a warning. */
#ifdef __GNUC__
__extension__ typedef unsigned long long snCount;
#else
typedef unsigned long long snCount;
#endif

/** Counts of the work of the colliders and snGeomProximity in this thread since the last reset. Meshes, heightfields and rays use
 * no earlier normals. */
typedef struct snStatistics {
  snCount queries_cold;     /**< pairs solved without an earlier normal */
  snCount queries_warm;     /**< pairs solved from an earlier normal */
  snCount evaluations_cold; /**< evaluations of the gap function in cold queries */
  snCount
      evaluations_warm;  /**< evaluations of the gap function in warm queries; 0 for a pair that cannot have met since the last */
  snCount closed_forms;  /**< pairs solved without iteration, such as body and plane */
  snCount contacts;      /**< contacts that dCollide was given */
  snCount not_converged; /**< queries whose error exceeds the tolerance: the following three, and queries with a pose or shape that
                            is not finite */
  snCount stalled;       /**< no further ascent in double precision */
  snCount out_of_evaluations;     /**< the largest number of evaluations was reached */
  snCount diverged;               /**< SN_SOLVER_NEWTON or SN_SOLVER_FIXED_POINT left its domain */
  snCount contacts_not_converged; /**< contacts of all these queries: their normal and place are estimates, and their depth
                                     separates the bodies along this normal */
} snStatistics;
/** Copies the counts of this thread to `out`. */
SUPERNORMAL_ODE_API void snGetStatistics(snStatistics* out);
/** Sets the counts of this thread to 0. */
SUPERNORMAL_ODE_API void snResetStatistics(void);

#ifdef __cplusplus
}
#endif

#endif
