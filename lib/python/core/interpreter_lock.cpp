#include "interpreter_lock.hpp"

#include <chrono>
#include <thread>

namespace supernormal::python {

void wait_for_the_end_of_the_process() noexcept {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

}  // namespace supernormal::python
