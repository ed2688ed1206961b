// The library's query defaults during the lifetime of a world.
#pragma once

#include <optional>

#include "model/query.hpp"

namespace falling_particles {

/// Sets the library's defaults, which hold for the process, to the scene's, and resets them at the end of its lifetime. Without a
/// section [query] it does nothing. Throws std::runtime_error when the library refuses the values.
class QueryDefaults {
 public:
  explicit QueryDefaults(const std::optional<Query>& query);
  ~QueryDefaults();
  QueryDefaults(const QueryDefaults&) = delete;
  QueryDefaults& operator=(const QueryDefaults&) = delete;

 private:
  bool are_changed_;
};

}  // namespace falling_particles
