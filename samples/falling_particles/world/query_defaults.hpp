// The library's defaults for the time of a world.
#pragma once

#include <optional>

#include "model/query.hpp"

namespace falling_particles {

/// Sets the defaults of the library, which are the process', to those of a scene, and back to the library's own at the end. Without
/// a section [query] it does nothing. Throws std::runtime_error when the library refuses them.
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
