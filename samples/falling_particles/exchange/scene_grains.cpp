// The grains of a scene, as JSON on stdout, for programs that draw or compute with them (samples/explain_pair).
//   scene_grains FILE [KEY=VALUE...]      with the values of --set
// `kinds`: by name, the body (of a compound, its first), in the format of samples/explain_pair/pair_data.cpp; `scales`: the factors
// of the grains at the start, in the order in which a run draws them; empty if all grains of a kind are equal. Exit code: 0 done; 1
// failed; 2 bad input.
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/input_error.hpp"
#include "common/random.hpp"
#include "model/scene.hpp"
#include "world/placement.hpp"

namespace {

using falling_particles::ConvexBody;
using nlohmann::json;

const char* name_of(ConvexBody::Shape shape) {
  switch (shape) {
    case ConvexBody::Shape::Superovoid:
      return "superovoid";
    case ConvexBody::Shape::Capsule:
      return "capsule";
    case ConvexBody::Shape::Superellipsoid:
      break;
  }
  return "superellipsoid";
}

/// The lengths are those of the core, which the rounding sphere sweeps; of a capsule, its radius and half the length of its axis.
json json_of(const ConvexBody& body) {
  auto [a, b, c] = body.core_half_axes();
  if (body.shape == ConvexBody::Shape::Capsule) c -= a;
  return {{"kind", name_of(body.shape)}, {"lengths", {a, b, c}},    {"exponents", {body.delta, body.epsilon}},
          {"tapers", body.taper},        {"points", json::array()}, {"rounding", body.rounding},
          {"is_callback", false}};
}

json grains_of(const falling_particles::Scene& scene) {
  json scales = json::array(), kinds;
  if (scene.has_sizes()) {
    common::Random random(scene.seed);
    for (const auto& placement : place(scene, random)) scales.push_back(placement.scale);
  }
  for (const auto& entry : scene.kinds) {
    kinds[entry.kind.name] = {{"body", json_of(entry.kind.all_components().front().body)},
                              {"bounding_radius", entry.kind.bounding_radius()},
                              {"is_compound", !entry.kind.components.empty()},
                              {"has_sizes", entry.size.has_value()}};
  }
  return {{"name", scene.name}, {"scales", scales}, {"kinds", kinds}};
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty() || arguments[0] == "--help") {
    std::fputs("usage: scene_grains FILE [KEY=VALUE...]\n", arguments.empty() ? stderr : stdout);
    return arguments.empty() ? 2 : 0;
  }
  try {
    std::puts(grains_of(falling_particles::load_scene(arguments[0], {arguments.begin() + 1, arguments.end()})).dump().c_str());
    return 0;
  } catch (const common::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scene_grains: %s\n", error.what());
    return 1;
  }
}
