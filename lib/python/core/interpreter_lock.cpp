#include "interpreter_lock.hpp"

#include <chrono>
#include <thread>

namespace supernormal::python {
namespace {

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

  PyThreadState* state() const { return state_; }

 private:
  PyThreadState* state_;
};

}  // namespace

PyThreadState* state_of_this_thread() {
  if (PyThreadState* const own = PyGILState_GetThisThreadState()) return own;
  thread_local const ForeignThread thread;
  return thread.state();
}

void wait_for_the_end_of_the_process() noexcept {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

}  // namespace supernormal::python
