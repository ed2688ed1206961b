/* Included before ODE's demos by the compiler (-include): the names of ODE's functions for spheres and boxes become those of
 * headless.cpp, in the demo and in ODE's headers alike, so that the source of the demo stays as it is. */
#define dCreateSphere demo_create_sphere
#define dCreateBox demo_create_box
#define dGeomDestroy demo_geom_destroy
#define dGeomGetClass demo_geom_get_class
#define dGeomSphereSetRadius demo_sphere_set_radius
#define dGeomSphereGetRadius demo_sphere_get_radius
#define dGeomSpherePointDepth demo_sphere_point_depth
#define dGeomBoxGetLengths demo_box_get_lengths
#define dCollide demo_collide
#define dWorldSetStepThreadingImplementation demo_set_threading
