// Taking the interpreter's lock, and giving it back meanwhile, in threads that may outlive the interpreter.
//
// Python before 3.14 ends a daemon thread that asks for the lock while the interpreter ends: by pthread_exit(), which unwinds the
// stack. Destructors and `catch (...)` on the way turn that into abort(). Here such a thread waits for the end of the process, as
// it does from Python 3.14 on.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <optional>

namespace supernormal::python {

/// Never returns.
[[noreturn]] void wait_for_the_end_of_the_process() noexcept;

/// Calls `work`, which needs the interpreter's lock or asks for it.
template <typename Work>
auto outlive_the_interpreter(const Work& work) {
  try {
    return work();
  } catch (const std::exception&) {
    throw;  // Python's exceptions too
  } catch (...) {
    wait_for_the_end_of_the_process();
  }
}

/// Whether this thread has the lock: also while it ends the interpreter.
inline bool has_the_lock() {
  PyThreadState* const own = PyGILState_GetThisThreadState();
  return own != nullptr && own == pybind11::detail::get_thread_state_unchecked();
}

/// pybind11::gil_scoped_acquire: has the lock while it lives.
class HoldingTheLock {
 public:
  HoldingTheLock() {
    // What the program still has when it ends is destroyed by the thread that ends the interpreter.
    if (has_the_lock()) return;
    // Where a thread has no state yet, pybind11 makes one in an interpreter that may be gone.
    if (Py_IsInitialized() == 0) wait_for_the_end_of_the_process();
    outlive_the_interpreter([this] { lock_.emplace(); });
  }

 private:
  std::optional<pybind11::gil_scoped_acquire> lock_;
};

/// pybind11::gil_scoped_release: gives the lock away while it lives.
class WithoutTheLock {
 public:
  WithoutTheLock() : state_(PyEval_SaveThread()) {}
  WithoutTheLock(const WithoutTheLock&) = delete;
  WithoutTheLock& operator=(const WithoutTheLock&) = delete;
  WithoutTheLock(WithoutTheLock&&) = delete;
  WithoutTheLock& operator=(WithoutTheLock&&) = delete;
  ~WithoutTheLock() {
    if (Py_IsInitialized() == 0) wait_for_the_end_of_the_process();
    outlive_the_interpreter([this] { PyEval_RestoreThread(state_); });
  }

 private:
  PyThreadState* state_;
};

}  // namespace supernormal::python
