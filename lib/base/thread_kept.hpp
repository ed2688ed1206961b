// Objects that each thread keeps to reuse their memory.
#pragma once

#if defined(__MINGW32__) && !defined(__clang__)
#include "base/kept_by_key.hpp"
#endif

namespace supernormal {

/// An object of each thread, destroyed at the end of the thread. Declare it `thread_local`.
#if defined(__MINGW32__) && !defined(__clang__)
// GCC for Windows frees the `thread_local` objects of a thread before it calls their destructors.
template <typename Object>
using ThreadKept = KeptByKey<Object>;
#else
template <typename Object>
class ThreadKept {
 public:
  Object& operator*() { return object_; }

 private:
  Object object_;
};
#endif

}  // namespace supernormal
