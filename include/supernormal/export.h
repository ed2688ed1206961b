/* Marks what the shared library exports; everything else is hidden. */
#ifndef SUPERNORMAL_EXPORT_H
#define SUPERNORMAL_EXPORT_H

#if defined(_WIN32)
#ifdef SUPERNORMAL_BUILDING
#define SUPERNORMAL_API __declspec(dllexport)
#else
#define SUPERNORMAL_API __declspec(dllimport)
#endif
#else
#define SUPERNORMAL_API __attribute__((visibility("default")))
#endif

#endif
