// Simulates a robot or a world of an SDF or URDF file in ODE, and prints where each link comes to rest.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "world.hpp"

namespace {

using namespace robot_model;

std::string list(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

void print_scene(const Scene& scene, const World& world) {
  std::printf("%s: %zu links, %zu joints; gravity (%g, %g, %g) m/s^2, step %g s\n", scene.file.c_str(), scene.links.size(),
              scene.joints.size(), scene.gravity.x(), scene.gravity.y(), scene.gravity.z(), scene.step);
  if (!scene.not_read.empty()) std::printf("not read: %s\n", list(scene.not_read).c_str());
  if (!scene.has_world) std::puts("the file has no world: the model is on the plane z = 0");
  for (std::size_t i = 0; i < scene.links.size(); ++i) {
    const Link& link = scene.links[i];
    std::vector<std::string> shapes;
    for (const Collision& collision : link.collisions) shapes.emplace_back(name_of(collision.shape));
    std::printf("%-24s %s; ", link.name.c_str(), shapes.empty() ? "no shape" : list(shapes).c_str());
    std::size_t first = 0;  // of the links of this body
    while (world.body(first) != world.body(i)) ++first;
    if (world.body(i) == nullptr) {
      std::puts("fixed");
      continue;
    }
    if (first != i) {
      std::printf("one body with %s\n", scene.links[first].name.c_str());
      continue;
    }
    dMass mass;
    dBodyGetMass(world.body(i), &mass);
    std::printf("body of %.6g kg\n", mass.mass);
  }
  for (const Joint& joint : scene.joints) {
    const char* const types[] = {"fixed", "revolute", "prismatic"};
    std::printf("%-24s %s joint of %s and %s\n", joint.name.c_str(), types[static_cast<int>(joint.type)],
                joint.parent == kWorld ? "the world" : scene.links[joint.parent].name.c_str(),
                scene.links[joint.child].name.c_str());
  }
}

void print_rest(const Scene& scene, const World& world, double seconds) {
  std::printf("after %g s:\n%-24s %33s %9s %9s\n", seconds, "", "position, m", "height, m", "m/s");
  for (std::size_t i = 0; i < scene.links.size(); ++i) {
    dBodyID body = world.body(i);
    if (body == nullptr) continue;
    const Eigen::Vector3d position = world.pose(i).translation();
    const dReal* v = dBodyGetLinearVel(body);
    std::printf("%-24s %11.4f%11.4f%11.4f %9.4f %9.1e\n", scene.links[i].name.c_str(), position.x(), position.y(), position.z(),
                world.height(i), Eigen::Vector3d(v[0], v[1], v[2]).norm());
  }
}

int run(int argc, char** argv) {
  std::string path;
  double seconds = 10;
  double density = 1000;
  bool strict = false;
  CLI::App app{"Simulates the models of an SDF or URDF file in ODE"};
  app.add_option("FILE", path, "an SDF file with a world or a model, or a URDF file")->required();
  app.add_option("--seconds", seconds, "how long to simulate, s")->capture_default_str();
  app.add_option("--density", density, "of links without <inertial>, kg/m^3")->capture_default_str();
  app.add_flag("--strict", strict,
               "refuse a file with a collision whose shape is not known, such as a mesh; otherwise it is left out");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  const Scene scene = read_scene(path, strict);
  for (const std::string& element : scene.left_out) {
    std::fprintf(stderr, "robot_model: warning: %s is left out; --strict refuses the file\n", element.c_str());
  }
  World world(scene, density);
  print_scene(scene, world);
  world.simulate(seconds);
  print_rest(scene, world, seconds);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "robot_model: %s\n", error.what());
    return 2;
  }
}
