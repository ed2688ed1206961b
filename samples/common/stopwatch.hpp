// Wall-clock time of sections of a program.
#pragma once

#include <chrono>

namespace common {

/// Sums wall-clock time over many intervals. Reading the clock costs about 25 ns (vDSO), a few per cent of a pair query.
class Stopwatch {
  using Clock = std::chrono::steady_clock;

 public:
  /// Adds the time from construction to destruction.
  class Lap {
   public:
    explicit Lap(Stopwatch& watch) : watch_(watch), start_(Clock::now()) {}
    ~Lap() { watch_.total_ += Clock::now() - start_; }
    Lap(const Lap&) = delete;
    Lap& operator=(const Lap&) = delete;

   private:
    Stopwatch& watch_;
    Clock::time_point start_;
  };

  /// Starts an interval whose end is not known in advance. Each lap() adds the time since start() or the last lap().
  void start() { last_ = Clock::now(); }
  void start_where_ended(const Stopwatch& other) { last_ = other.last_; }
  void lap() {
    const Clock::time_point now = Clock::now();
    total_ += now - last_;
    last_ = now;
  }

  template <typename Archive>
  void serialize(Archive& archive) {
    Clock::rep ticks = total_.count();
    archive(ticks);
    total_ = Clock::duration(ticks);
  }

  double seconds() const { return std::chrono::duration<double>(total_).count(); }

 private:
  Clock::duration total_{};
  Clock::time_point last_{};
};

}  // namespace common
