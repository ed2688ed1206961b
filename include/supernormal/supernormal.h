/** @file
 * Supernormal: smooth convex bodies for the Open Dynamics Engine. The C interface.
 *
 * Lengths in metres (or whatever unit the ODE world uses, consistently), directions as unit vectors. A body is an ordinary
 * placeable dGeomID: dGeomSetBody, dGeomSetOffset…, dSpaceAdd, dCollide and dGeomDestroy work as for the built-in classes.
 * Rotations are orthonormal as ODE keeps them, or nearly so: where they are not to rounding, the nearest one is taken, and a geom
 * whose rotation is 1 % off has no contacts and no answers (snLastError says so). The library may be used from several threads
 * wherever ODE itself may; see lib/README.md.
 */
#ifndef SUPERNORMAL_SUPERNORMAL_H
#define SUPERNORMAL_SUPERNORMAL_H

#include <ode/ode.h>

#include "supernormal/export.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- the library ------------------------------------------------------------------------------------------------------- */

/** Takes a reference on ODE (dInitODE2) and registers the geometry class. Optional: every snCreate… does it; any thread may.
 * Returns 1 on success; 0 when ODE cannot be initialised, has another precision than this library, or has none of its four user
 * classes free (see snLastError). Other clients' balanced dInitODE2 and dCloseODE leave the class alone. */
SUPERNORMAL_API int snInit(void);

/** Gives the reference back; however often snInit was called. Destroy the geoms first: while one of ours is alive nothing happens
 * but snLastError. A later snCreate… or snInit starts afresh. */
SUPERNORMAL_API void snClose(void);

/** The class number of all our geoms, as dGeomGetClass returns it; -1 before the first snInit or snCreate… */
SUPERNORMAL_API int snGeomClass(void);

/** Why the last refused call of this thread was refused: the parameter, its value and the valid range. "" if none was. */
SUPERNORMAL_API const char* snLastError(void);

/* --- bodies ------------------------------------------------------------------------------------------------------------ */
/* Every create call adds the geom to `space` unless that is 0, and refuses bad parameters: it then returns 0 and sets
 * snLastError. As with ODE's own geoms, create, set and destroy are not for near callbacks: ODE aborts when the space is locked.
 *
 * dCollide knows our geoms among themselves and with all of ODE's own: dSphere, dBox, dCapsule, dCylinder, dPlane, dConvex, dRay,
 * dTriMesh and dHeightfield; inside spaces and dGeomTransform as everywhere. With a user class of another program it asks that
 * class. A geom with a length that is not finite, or above 1e30 (but for a dRay), makes no contacts, and snLastError says so.
 * Contacts: the first is the deepest, with the depth of the overlap. Round bodies make one contact, and so does everything with
 * room for one. Flat bodies have the two to four corners of the region on which they rest, deepest first, each as deep as the faces
 * overlap there, or 0 (lib/contact/README.md); with room for two or three, neighbours are united.
 *  - dConvex: only the vertices count, not the planes and polygons that it was made with; after dGeomSetConvex call dGeomMoved.
 *  - dTriMesh: single-sided, what is behind a triangle (seen from there its corners run clockwise) is solid; a contact's
 *    side of the mesh is the number of the triangle. snGeomProximity takes a mesh that is met from behind as two-sided.
 *  - dHeightfield: what is below its triangles is solid.
 *  - dRay: as for ODE's convex classes: `depth` is the distance along the ray to the first point of the boundary, the normal
 *    opposes the ray, from inside too; a ray that is wholly inside, or of no length, hits nothing. */

/** (x/a)^2 + (y/b)^2 + (z/c)^2 = 1 with half-axes a, b, c in [1e-30, 1e30]. */
SUPERNORMAL_API dGeomID snCreateEllipsoid(dSpaceID space, dReal a, dReal b, dReal c);

/** (|x/a|^delta + |y/b|^delta)^(epsilon/delta) + |z/c|^epsilon = 1 with half-axes in [1e-30, 1e30], exponents in [1.01, 1000]. */
SUPERNORMAL_API dGeomID snCreateSuperellipsoid(dSpaceID space, dReal a, dReal b, dReal c, dReal delta, dReal epsilon);

/** A superellipsoid whose section grows or shrinks linearly along z: the equation above with x/(1 + taper_x z/c) for x and
 * y/(1 + taper_y z/c) for y. It must be convex: |taper| <= 2^(1/epsilon) (epsilon - 1)/epsilon, which is 0.707 for epsilon = 2; for
 * epsilon > 2 the two tapers must be equal; for epsilon <= 2 different tapers are refused when both together are too much. Its
 * centre of mass is not its origin but (0, 0, z): see snMassSet. */
SUPERNORMAL_API dGeomID snCreateSuperovoid(dSpaceID space, dReal a, dReal b, dReal c, dReal delta, dReal epsilon, dReal taper_x,
                                           dReal taper_y);

/** The points within `radius` of a segment of `length` along z, both in m, in [1e-30, 1e30] and [0, 1e30]: what dCreateCapsule
 * makes, as a body of ours. Its rounding is `radius` already: snGeomSetRounding adds to it. */
SUPERNORMAL_API dGeomID snCreateCapsule(dSpaceID space, dReal radius, dReal length);

/** A body that the program itself describes, by its support function and the boundary point of a normal. Directions are unit
 * vectors in the body's frame. The callbacks must be pure; they are called from whatever thread collides. */
typedef struct snShape {
  dReal (*support)(const void* user, const dReal direction[3]);                  /**< h(n), m */
  void (*point)(const void* user, const dReal direction[3], dReal point[3]);     /**< r(n), m */
  void (*hessian)(const void* user, const dReal direction[3], dReal hessian[9]); /**< m, row-major; may be NULL */
  void* user;                                                                    /**< handed to each call */
  void (*release)(void* user); /**< called when the geom dies; may be NULL; not called when the create call refuses */
} snShape;

/** The callbacks are tried in 26 directions: results must be finite and the size in [1e-30, 1e30]; to 1e-6 of the size,
 * point(n).n = support(n) and no point lies outside the tangent plane of another; support(n) + support(-n) >= 2e-30 m; the Hessian
 * is symmetric, has n in its kernel and no negative eigenvalue. Otherwise refused: 0, and snLastError names the direction. Flat
 * faces and sharp edges are allowed (any point of the face will do); smooth bodies are solved with fewer evaluations. `shape`
 * itself is copied. samples/user_shape shows an egg and a lens. */
SUPERNORMAL_API dGeomID snCreateConvex(dSpaceID space, const snShape* shape);

/** Set and get refuse (return 0, set snLastError) when the geom is not an ellipsoid or superellipsoid. Set keeps the rounding;
 * on a refusal the geom stays as it was. */
SUPERNORMAL_API int snGeomSuperellipsoidSetParams(dGeomID geom, dReal a, dReal b, dReal c, dReal delta, dReal epsilon);
/** Reads the half-axes and exponents; none of the pointers may be NULL. */
SUPERNORMAL_API int snGeomSuperellipsoidGetParams(dGeomID geom, dReal* a, dReal* b, dReal* c, dReal* delta, dReal* epsilon);

/** The same for superovoids. */
SUPERNORMAL_API int snGeomSuperovoidSetParams(dGeomID geom, dReal a, dReal b, dReal c, dReal delta, dReal epsilon, dReal taper_x,
                                              dReal taper_y);
/** Reads the parameters; none of the pointers may be NULL. */
SUPERNORMAL_API int snGeomSuperovoidGetParams(dGeomID geom, dReal* a, dReal* b, dReal* c, dReal* delta, dReal* epsilon,
                                              dReal* taper_x, dReal* taper_y);

/** Sweeps the body by a sphere of `radius` in [0, 1e30]: the body grows by it and its edges become round. Replaces an earlier
 * rounding; 0 takes it away. */
SUPERNORMAL_API int snGeomSetRounding(dGeomID geom, dReal radius);

/* --- queries of one body ----------------------------------------------------------------------------------------------- */

/** Returns the distance of a point in world coordinates from the boundary, m, to the tolerance of the geom's solver settings:
 * positive inside, 0 on it, negative outside. NaN (and snLastError) when the point is not finite or the geom is not ours. */
SUPERNORMAL_API dReal snGeomPointDepth(dGeomID geom, dReal x, dReal y, dReal z);

/** Finds the boundary point whose outward normal is `direction` (world frame, any length but 0); `point` in world coordinates. */
SUPERNORMAL_API int snGeomSupport(dGeomID geom, const dVector3 direction, dVector3 point);

/** A closed mesh of a body, to draw it: corners on its boundary with the outward normals there, in the geom's frame. */
typedef struct snMesh {
  int points;             /**< number of corners */
  int triangles;          /**< number of triangles */
  const dReal* position;  /**< 3 * points, m */
  const dReal* normal;    /**< 3 * points, unit */
  const dTriIndex* index; /**< 3 * triangles: the corners of each, anticlockwise as seen from outside */
} snMesh;

/** Makes a mesh whose edges are no farther than chord_error (m) from the boundary, a millionth of the geom's largest half-extent or
 * more: 2 % of the smallest half-axis shows no corners. Flat faces take few triangles. Give the mesh back with snMeshRelease.
 * Returns 0 (and snLastError) when chord_error is out of range or the geom is not ours; `mesh` is then empty. */
SUPERNORMAL_API int snGeomTessellate(dGeomID geom, dReal chord_error, snMesh* mesh);
/** Frees the arrays and empties the mesh; an empty one, or NULL, is left as it is. */
SUPERNORMAL_API void snMeshRelease(snMesh* mesh);

/** Mass, centre of mass and inertia of the homogeneous body, in the geom's frame: exact for ellipsoids, superellipsoids
 * and superovoids, quadrature to 1e-9 with rounding or for a smooth user-defined body; one with faces or edges is refused when
 * their share of the volume, which quadrature does not see, is above 1 %. density (kg/m^3) and total_mass (kg) in (0, inf). A body
 * whose centre of mass is not its origin (a superovoid's is not) needs dMassTranslate and a geom offset before dBodySetMass, as
 * ever in ODE. */
SUPERNORMAL_API int snMassSet(dMass* mass, dReal density, dGeomID geom);
/** The same for a body of the given total mass. */
SUPERNORMAL_API int snMassSetTotal(dMass* mass, dReal total_mass, dGeomID geom);

/* --- solver settings --------------------------------------------------------------------------------------------------- */

/* In C++, too, every int is a value of the type: one that names no solver is refused, and passing it is no undefined behaviour. */
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
#undef SN_ENUM_BASE

/** tolerance: the largest error of the gap that a query may leave, relative to the smallest half-extent of the two bodies, in
 * [1e-15, 1]; default 1e-9. max_evaluations: how often a query may evaluate the gap function, in [1, 1000000]; default 1000. A pair
 * uses the tighter tolerance and the larger limit of its two geoms, and the hybrid solver unless both ask for the same other one.
 */
SUPERNORMAL_API int snGeomSetSolver(dGeomID geom, snSolver solver, dReal tolerance, int max_evaluations);

/** Sets the defaults for the geoms created from now on, in every thread. */
SUPERNORMAL_API int snSetDefaultSolver(snSolver solver, dReal tolerance, int max_evaluations);

/** Whether each pair starts from its last normal in this thread (default on). Off: results are a pure function of the two poses.
 * On: the same scene, built and run in the same order by one thread, gives the same digits in every run. */
SUPERNORMAL_API void snSetWarmStart(int on);

/* --- contacts before overlap ------------------------------------------------------------------------------------------- */

/** How far dCollide looks ahead for this geom: `time` in s, in [0, 1e6]. 0 (default): off, contacts are those of overlaps. Take the
 * step of the simulation. With a time > 0 dCollide also returns contacts of pairs that may meet within it, each with depth = -gap <
 * 0; hand them to snContactLookAhead before dJointCreateContact. So a body does not tunnel through what it would hit within a step,
 * and what rests comes in by next to nothing, at longer steps. lib/guide.md, "Contacts before overlap", names the exceptions:
 * bodies of several geoms, and two free bodies that meet off centre, where they go many sizes in a step.
 *
 * dCollide takes velocities and forces from the bodies of the geoms (dGeomGetBody); a geom without one stands still. It moves both
 * without rotation to where they meet, and takes the normals from there: what passes by has no contact. Rotation, gravity, forces
 * and one hundredth of the smallest half-extent are added to how near a pair must come. A pair uses the larger time of its two
 * geoms. All classes are met ahead but dRay; on a dTriMesh or dHeightfield the body slides on from face to face.
 *
 * The bounding box covers the motion of the geom's own body within its own time, so that spaces name the pair. A moving dBox or
 * other geom of ODE has the box of now, and is met ahead when it comes into ours. Inside a dGeomTransform nothing is covered. ODE
 * computes a box when its geom has moved, as every step moves it. After giving a velocity to a body that has not moved since the
 * last dSpaceCollide, call dGeomMoved or this function again. Like dGeomMoved it is not for near callbacks. Returns 1; 0 (and
 * snLastError) when refused. */
SUPERNORMAL_API int snGeomSetLookAhead(dGeomID geom, dReal time);

/** Sets the time for the geoms created from now on, in every thread. */
SUPERNORMAL_API int snSetDefaultLookAhead(dReal time);

/** Turns a contact with depth < 0 into ODE's constraint that lets the gap close within `step` (s, > 0; that of the next dWorldStep
 * or dWorldQuickStep) and no more: its depth becomes 0, its surface gets dContactMotionN, and -gap/step is added to the motionN
 * that it has by that flag. Other contacts are left as they are. Call it when contact->surface is set. dContactBounce does not suit
 * a contact ahead: ODE would throw the body back before it touches. Set dContactApprox1: without it mu is a force, which acts
 * before they touch. With a step that is refused (snLastError), or NULL, nothing is changed. */
SUPERNORMAL_API void snContactLookAhead(dContact* contact, dReal step);

/* --- queries of two bodies --------------------------------------------------------------------------------------------- */

/** The answer to a query of two geoms. */
typedef struct snProximity {
  dReal gap;       /**< m; < 0: overlap depth = -gap */
  dReal error;     /**< m; estimate of |gap - local maximum of s|; a bound where it is proved (is_global); 0 for closed forms */
  dVector3 normal; /**< unit, from g1 to g2, world frame */
  dVector3 point1; /**< m, world frame, on the boundary of g1 */
  dVector3 point2; /**< m, world frame, on the boundary of g2 */
  int evaluations; /**< evaluations of the gap function; 0 for closed forms */
  int converged;   /**< 1: the error is within the tolerance */
  int is_global; /**< 1: it is proved that no translation shorter than -gap separates the geoms; always 1 when apart or touching */
} snProximity;

/** Signed distance of two geoms, apart or overlapping, in either order; at least one is ours, the other ours or one of ODE's own
 * (not a space, not a dGeomTransform). The normal of faces and edges is that of the face or edge; point1 and point2 are then any of
 * those that touch. For a dTriMesh or dHeightfield it gives the gap of the deepest contact that dCollide makes; without contact,
 * the distance of the nearest triangle, from either side; negative without a contact only for a body that touches a sheet's border
 * from behind. Returns 1; 0 (and snLastError) when the pair is not supported or a pose or length is not finite. */
SUPERNORMAL_API int snGeomProximity(dGeomID g1, dGeomID g2, snProximity* out);

/** The same, but for overlapping geoms it searches on until the depth is proved the smallest, or the limit of evaluations is
 * reached: is_global tells which. Takes tens to hundreds of evaluations. There is no such proof for a dTriMesh or dHeightfield,
 * where it does what snGeomProximity does. */
SUPERNORMAL_API int snGeomProximityCertified(dGeomID g1, dGeomID g2, snProximity* out);

/** When two geoms will meet. */
typedef struct snImpact {
  dReal time;      /**< s from now; the horizon if there is no impact within it */
  int hits;        /**< 1: the gap comes within the tolerance at `time`; 0: no contact in [0, horizon], proved */
  dVector3 normal; /**< unit, from g1 to g2, at `time`, world frame; without an impact, one that separates the geoms, but for a
                    * surface of triangles, of which none may be near */
  dVector3
      point1; /**< m, world frame, on the boundary of g1 at `time`: of an impact where the geoms touch, to 1e-6 of their size */
  dVector3 point2; /**< m, world frame, on the boundary of g2; of an impact, it is point1 + gap * normal */
  int evaluations; /**< evaluations of the gap function; with a plane, of the support function */
  int converged;   /**< 0: a limit was reached; `hits` is then 1, and it is proved that there is no impact before `time` */
} snImpact;

/** Finds the first time in [0, horizon] (s, at most 1e30) at which two geoms meet that go on with the velocities of their bodies
 * now, linear and angular, about their centres of mass; a geom without body stands still. At `time` the gap is within the tolerance
 * of the geoms' solver settings. No impact is missed, however fast the geoms turn: that they are apart before is proved. Geoms that
 * overlap or touch now hit at time 0, but for those that touch and part. The geoms are those of snGeomProximity, in either order.
 * Of a dTriMesh or dHeightfield every triangle counts, from both sides, and nothing behind it; a dRay is a segment. Returns 1; 0
 * (and snLastError) when the pair is not supported, the horizon is out of range, or a pose, velocity or length is not finite. */
SUPERNORMAL_API int snGeomTimeOfImpact(dGeomID g1, dGeomID g2, dReal horizon, snImpact* out);

/* --- many pairs at once ------------------------------------------------------------------------------------------------ */

/** The memory and threads for colliding a space in parallel. A batch keeps them from one call to the next. */
typedef struct snBatch* snBatchID;

/** Creates a batch with `threads` in [1, 256], the calling one among them, or as many as the machine has when 0. Returns 0 (and
 * snLastError) when refused. */
SUPERNORMAL_API snBatchID snBatchCreate(int threads);

/** Calls task(context, i) once for every i in [0, count), on whatever threads, and returns when all calls have. */
typedef void snParallelFor(void* pool, int count, void (*task)(void* context, int i), void* context);

/** Creates a batch that uses the threads of the program: `run` is called with `pool`, once in every snBatchCollide. */
SUPERNORMAL_API snBatchID snBatchCreateOn(snParallelFor* run, void* pool);

/** Ends its threads and frees its memory; 0 is left as it is. */
SUPERNORMAL_API void snBatchDestroy(snBatchID batch);

/** Returns nonzero to collide these two, 0 for pairs that need no contacts: of bodies that sleep, or that a joint connects. */
typedef int snPairFilter(void* data, dGeomID g1, dGeomID g2);

/** Takes the contacts of a pair, as dCollide(g1, g2, …) would have written them; count > 0. */
typedef void snContactsCallback(void* data, dGeomID g1, dGeomID g2, const dContactGeom* contacts, int count);

/** Does what dSpaceCollide with a dCollide of every pair does, for max_contacts in [1, 65535], with the same contacts bit for bit.
 * First it collects the pairs that `wanted` (may be NULL: all) agrees to; then it solves those of two geoms of ours on all threads,
 * and the others, by dCollide, on the calling one; then it calls `contacts` for each pair that has some, in the order in which
 * dSpaceCollide named the pairs. Both callbacks are called on the calling thread, `contacts` with the space unlocked. Geoms of
 * spaces within the space meet those outside, as in dSpaceCollide2; for those among themselves call it for that space.
 *
 * Until it returns nothing may move or change a geom, and nobody may use the batch elsewhere. Callbacks of snCreateConvex are
 * called on all threads. Statistics count on the calling thread. A dSetColliderOverride for two geoms of our class is not called.
 * No memory is allocated unless there are more pairs than ever before. Returns the number of contacts; -1 (and snLastError)
 * when an argument is refused or memory has run out. */
SUPERNORMAL_API int snBatchCollide(snBatchID batch, dSpaceID space, int max_contacts, void* data, snPairFilter* wanted,
                                   snContactsCallback* contacts);

/* --- statistics --------------------------------------------------------------------------------------------------------- */

/** A number of 64 bits. C90 has no long long: there the compilers that know __extension__ take it without a warning. */
#ifdef __GNUC__
__extension__ typedef unsigned long long snCount;
#else
typedef unsigned long long snCount;
#endif

/** Counts of what the colliders and snGeomProximity did in this thread since the last reset. With meshes, heightfields and rays no
 * normal is remembered. */
typedef struct snStatistics {
  snCount queries_cold;     /**< pairs solved without a remembered normal */
  snCount queries_warm;     /**< pairs solved from a remembered one */
  snCount evaluations_cold; /**< evaluations of the gap function in the former */
  snCount evaluations_warm; /**< and in the latter */
  snCount closed_forms;     /**< pairs settled without iteration, such as body and plane */
  snCount contacts;         /**< contacts that dCollide was given */
  snCount not_converged; /**< queries whose error exceeds the tolerance: the following three, and those with a pose or shape that is
                            not finite */
  snCount stalled;       /**< no further ascent in double precision */
  snCount out_of_evaluations;     /**< the largest number of evaluations was reached */
  snCount diverged;               /**< SN_SOLVER_NEWTON or SN_SOLVER_FIXED_POINT left its domain */
  snCount contacts_not_converged; /**< contacts of all these queries: their normal and place are estimates, and their depth
                                     separates the bodies along that normal */
} snStatistics;
/** Copies the counts of this thread to `out`. */
SUPERNORMAL_API void snGetStatistics(snStatistics* out);
/** Sets the counts of this thread to 0. */
SUPERNORMAL_API void snResetStatistics(void);

#ifdef __cplusplus
}
#endif

#endif
