/* Marks what the shared libraries export; everything else is hidden. SUPERNORMAL_API is of the core, SUPERNORMAL_ODE_API of the ODE
 * layer. On Windows a program imports the names, and CMake defines SUPERNORMAL_STATIC for those who link the static libraries. */
#ifndef SUPERNORMAL_EXPORT_H
#define SUPERNORMAL_EXPORT_H

#if !defined(_WIN32)
#define SUPERNORMAL_API __attribute__((visibility("default")))
#define SUPERNORMAL_ODE_API __attribute__((visibility("default")))
/* A member of an exported class that programs do not call. */
#define SUPERNORMAL_LOCAL __attribute__((visibility("hidden")))
#else
#define SUPERNORMAL_LOCAL
#if defined(SUPERNORMAL_STATIC)
#define SUPERNORMAL_API
#elif defined(SUPERNORMAL_BUILDS_CORE)
#define SUPERNORMAL_API __declspec(dllexport)
#else
#define SUPERNORMAL_API __declspec(dllimport)
#endif
#if defined(SUPERNORMAL_STATIC)
#define SUPERNORMAL_ODE_API
#elif defined(SUPERNORMAL_BUILDS_ODE_LAYER)
#define SUPERNORMAL_ODE_API __declspec(dllexport)
#else
#define SUPERNORMAL_ODE_API __declspec(dllimport)
#endif
#endif

#endif
