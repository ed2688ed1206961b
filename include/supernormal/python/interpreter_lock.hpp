// Acquires and releases the interpreter's lock in threads that may outlive the interpreter.
//
// A daemon thread may ask for the lock while the interpreter ends. Python before 3.14 then calls pthread_exit(), which unwinds the
// stack. Destructors and `catch (...)` turn this into abort(). Here such a thread waits for the end of the process, as in Python
// 3.14. For extension modules that use pybind11: those of this library, and others that call it from threads of their own.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>
#include <thread>

namespace supernormal::python {

/// Never returns.
[[noreturn]] inline void wait_for_the_end_of_the_process() noexcept {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

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

/// The state of a thread that Python did not start.
class ForeignThread {
 public:
  ForeignThread() {
    if (Py_IsInitialized() == 0) wait_for_the_end_of_the_process();
    outlive_the_interpreter([] { PyGILState_Ensure(); });
    state_ = PyEval_SaveThread();
  }
  ForeignThread(const ForeignThread&) = delete;
  ForeignThread& operator=(const ForeignThread&) = delete;
  ForeignThread(ForeignThread&&) = delete;
  ForeignThread& operator=(ForeignThread&&) = delete;
  ~ForeignThread() {
    if (Py_IsInitialized() == 0) return;  // the state is gone with the interpreter
    outlive_the_interpreter([this] { PyEval_RestoreThread(state_); });
    PyGILState_Release(PyGILState_UNLOCKED);
  }

  PyThreadState* state() const { return state_; }  ///< without the lock; valid as long as this object

 private:
  PyThreadState* state_;
};

/// Python's state of this thread. A thread that Python did not start gets one at its first call and keeps it: each creation is a
/// risk while the interpreter ends.
inline PyThreadState* state_of_this_thread() {
  if (PyThreadState* const own = PyGILState_GetThisThreadState()) return own;
  thread_local const ForeignThread thread;
  return thread.state();
}

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
