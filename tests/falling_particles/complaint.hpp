// The messages of the program about mistakes in its input.
#pragma once

#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "common/input_error.hpp"
#include "model/scene.hpp"
#include "scene_text.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

/// The message with which a call refuses its input; "" if it does not.
inline std::string refusal_by(const std::function<void()>& call) {
  return supernormal::test::refusal<falling_particles::InputError>(call);
}

inline std::string without_folder(std::string text, const TemporaryFolder& folder) {
  const std::string prefix = folder.path().string() + "/";
  for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix)) text.erase(at, prefix.size());
  return text;
}

/// The message from loading the scene, without the name of the temporary folder; "" if it is accepted.
inline std::string complaint(const std::string& scene, const std::string& catalogue = kCatalogueText,
                             const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  folder.write("grains.toml", catalogue);
  const std::string path = folder.write("scene.toml", scene);
  return without_folder(refusal_by([&] { falling_particles::load_scene(path, overrides); }), folder);
}

struct Mistake {
  const char* from;
  const char* to;
  std::vector<const char*> says;  // the place, the value and the valid range
};

inline void check_says(const std::string& text, const std::vector<const char*>& says) {
  CAPTURE(text);
  CHECK(text.find('\n') == std::string::npos);
  for (const std::string part : says) {
    CAPTURE(part);
    CHECK(text.find(part) != std::string::npos);
  }
}
