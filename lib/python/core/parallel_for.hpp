// A loop on all cores, without the interpreter's lock.
#pragma once

#include <cstddef>
#include <functional>

namespace supernormal::python {

/// What is said where the core returns Status::InvalidInput: poses and settings have been checked by then.
inline constexpr const char* kNotFinite = "what a shape delivers is not finite, or too large to compute with";

/// Calls body(i) for each i in [0, count), on `threads` threads in [0, 256], the calling one among them; 0 is as many as the
/// machine has. The interpreter's lock is released meanwhile; the calling thread looks for signals, so that Ctrl-C ends the loop.
/// When calls throw, the exception of the smallest i is thrown again, whatever the number of threads; "i: " precedes the text of
/// one that comes from the library. Throws std::invalid_argument when `threads` is out of range.
void parallel_for(std::ptrdiff_t count, int threads, const std::function<void(std::ptrdiff_t)>& body);

}  // namespace supernormal::python
