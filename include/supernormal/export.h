/* Marks what the shared libraries export; everything else is hidden. */
#ifndef SUPERNORMAL_EXPORT_H
#define SUPERNORMAL_EXPORT_H

#define SUPERNORMAL_API __attribute__((visibility("default")))

/* A member of an exported class that programs do not call. */
#define SUPERNORMAL_LOCAL __attribute__((visibility("hidden")))

#endif
