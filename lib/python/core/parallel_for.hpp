// A parallel loop without the interpreter's lock.
#pragma once

#include <cstddef>
#include <functional>

namespace supernormal::python {

/// The message for Status::InvalidInput. Poses and settings have been checked before.
inline constexpr const char* kNotFinite = "what a shape delivers is not finite, or too large to compute with";

/// Calls body(i) for each i in [0, count) on `threads` threads, the calling one included. `threads` is in [0, 256]; 0: up to one
/// for each core, each with at least 256 of the calls. The interpreter's lock is released during the loop. The calling thread
/// handles signals, so Ctrl-C ends the loop.
///
/// If calls throw, rethrows the exception of the smallest i, whatever the number of threads. "i: " precedes the text of an
/// exception from the library. Throws std::invalid_argument when `threads` is out of range.
void parallel_for(std::ptrdiff_t count, int threads, const std::function<void(std::ptrdiff_t)>& body);

/// The same for whole ranges: calls body(i, end) for ranges that cover [0, count), where body advances i to `end`. When it throws,
/// i is at fault.
void parallel_for_ranges(std::ptrdiff_t count, int threads, const std::function<void(std::ptrdiff_t& i, std::ptrdiff_t end)>& body);

}  // namespace supernormal::python
