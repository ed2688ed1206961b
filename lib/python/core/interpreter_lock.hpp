// Acquires and releases the interpreter's lock in threads that may outlive the interpreter.
//
// A daemon thread may ask for the lock while the interpreter ends. Python before 3.14 then calls pthread_exit(), which unwinds the
// stack. Destructors and `catch (...)` turn this into abort(). Here such a thread waits for the end of the process, as in Python
// 3.14.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>

namespace supernormal::python {

/// Never returns.
[[noreturn]] void wait_for_the_end_of_the_process() noexcept;

/// Calls `work`, which needs or requests the interpreter's lock.
template <typename Work>
auto outlive_the_interpreter(const Work& work) {
  try {
    return work();
  } catch (const std::exception&) {
    throw;  // Python exceptions, too
  } catch (...) {
    wait_for_the_end_of_the_process();
  }
}

/// Whether this thread holds the lock, also while it ends the interpreter.
inline bool has_the_lock() {
  PyThreadState* const own = PyGILState_GetThisThreadState();
  return own != nullptr && own == pybind11::detail::get_thread_state_unchecked();
}

/// Python's state of this thread. A thread that Python did not start gets one at its first call and keeps it: each creation is a
/// risk while the interpreter ends.
PyThreadState* state_of_this_thread();

/// Like pybind11::gil_scoped_acquire: holds the lock during its lifetime.
class HoldingTheLock {
 public:
  HoldingTheLock() {
    // The thread that ends the interpreter already holds the lock when it destroys the program's objects.
    if (has_the_lock()) return;
    // The state comes first: once the interpreter has ended there is none. PyEval_RestoreThread() sees the end, and reads no state
    // then.
    PyThreadState* const state = state_of_this_thread();
    if (Py_IsInitialized() == 0) wait_for_the_end_of_the_process();
    outlive_the_interpreter([state] { PyEval_RestoreThread(state); });
    acquired_ = true;
  }
  HoldingTheLock(const HoldingTheLock&) = delete;
  HoldingTheLock& operator=(const HoldingTheLock&) = delete;
  HoldingTheLock(HoldingTheLock&&) = delete;
  HoldingTheLock& operator=(HoldingTheLock&&) = delete;
  ~HoldingTheLock() {
    if (acquired_) PyEval_SaveThread();
  }

 private:
  bool acquired_ = false;
};

/// Like pybind11::gil_scoped_release: releases the lock during its lifetime.
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
