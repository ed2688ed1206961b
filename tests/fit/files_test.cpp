#include <dlfcn.h>
#include <doctest/doctest.h>
#include <supernormal/supernormal.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <supernormal/shapes/tessellation.hpp>

#include "input/read_data.hpp"
#include "model/fit_error.hpp"
#include "output/paste.hpp"
#include "output/picture.hpp"
#include "samples/temporary_folder.hpp"
#include "scene/catalogue.hpp"
#include "study/truth.hpp"

using namespace fit;

namespace {

std::string complaint(const std::string& path) {
  try {
    read_data(path, 1);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

FittedBody fitted_of(const Body& body) {
  FittedBody fitted;
  fitted.body = body;
  return fitted;
}

Body make_small_body(Family family, double delta, double epsilon, double taper = 0) {
  return {family, {0.3, -0.2, 0.5}, Eigen::Quaterniond(0.7, 0.3, -0.2, 0.5).normalized(), {0.03, 0.02, 0.01}, delta, epsilon,
          taper};
}

/// A mesh of the body as an .obj.
std::string obj_of(const Body& body) {
  const auto mesh = supernormal::tessellate(*make_shape(body), 1e-3 * body.half_axes.minCoeff());
  std::ostringstream text;
  text.precision(9);
  for (const Vector3& r : mesh.points) {
    const Vector3 x = body.position + body.rotation() * r;
    text << "v " << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
  }
  for (const auto& t : mesh.triangles) text << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return text.str();
}

}  // namespace

TEST_CASE("files that are of no use are refused with a reason") {
  const TemporaryFolder folder;
  const std::string none = (folder.path() / "none.ply").string();
  CHECK(complaint(none) == none + ": no such file");
  const std::string text = folder.write("points.txt", "1 2 3\n");
  CHECK(complaint(text) == text + ": unknown extension \".txt\"; allowed: .stl, .obj, .ply (meshes or points), .xyz (points)");
  const std::string empty = folder.write("empty.xyz", "# nothing\n\n");
  CHECK(complaint(empty) == empty + ": no points");
  for (const char* name : {"empty.ply", "empty.stl", "empty.obj"}) {
    CHECK(complaint(folder.write(name, "")).find(std::string(name) + ": cannot be read: ") != std::string::npos);
  }
  const std::string nan = folder.write("nan.xyz", "1 2 3\n1 nan 3\n");
  CHECK(complaint(nan) == nan + ": point 2 has a coordinate that is not finite");
  const std::string infinite = folder.write("inf.xyz", "1 2 1e999\n");
  CHECK(complaint(infinite) == infinite + ": point 1 has a coordinate that is not finite");
  const std::string word = folder.write("word.xyz", "1 2 3\n1 two 3\n");
  CHECK(complaint(word) == word + ":2: a line holds x y z, or x y z nx ny nz");
  const std::string mixed = folder.write("mixed.xyz", "1 2 3\n1 2 3 0 0 1\n");
  CHECK(complaint(mixed) == mixed + ":2: either all points have normals or none");
}

TEST_CASE("points are read from .xyz, .obj and .ply alike") {
  const TemporaryFolder folder;
  const Data xyz = read_data(folder.write("a.xyz", "# x y z and the normal\n1, 2, 3, 0, 0, 2\n4 5 6 1 0 0 # more\n"), 0.5);
  REQUIRE(xyz.vertices.points.size() == 2);
  CHECK(xyz.vertices.points[1] == Vector3(2, 2.5, 3));
  CHECK(xyz.vertices.normals[0] == Vector3(0, 0, 1));
  const Data obj = read_data(folder.write("a.obj", "v 1 2 3\nv 4 5 6\n"), 0.5);
  REQUIRE(obj.vertices.points.size() == 2);
  CHECK(obj.vertices.points[1] == Vector3(2, 2.5, 3));
  const Data ply =
      read_data(folder.write("a.ply",
                             "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                             "end_header\n1 2 3\n4 5 6\n"),
                0.5);
  REQUIRE(ply.vertices.points.size() == 2);
  CHECK(ply.vertices.points[1] == Vector3(2, 2.5, 3));
  CHECK(ply.triangles.empty());
}

TEST_CASE("a mesh gives its body back, and volume and inertia agree") {
  const TemporaryFolder folder;
  const Body body = make_small_body(Family::Superellipsoid, 3, 2.5);
  const Data data = read_data(folder.write("body.obj", obj_of(body)), 1);
  REQUIRE_FALSE(data.triangles.empty());
  const FittedBody fitted = fit_body(data.vertices, {.family = Family::Superellipsoid, .noise = Noise::AlongNormal});
  // Assimp keeps coordinates in single precision: 3e-8 of 0.5 m.
  CHECK((fitted.body.half_axes - body.half_axes).cwiseAbs().maxCoeff() < 1e-7);
  const FitError error = find_error(std::vector<Body>{fitted.body}, data);
  CHECK_FALSE(error.is_hull);
  CHECK(error.body.volume == doctest::Approx(error.data.volume).epsilon(2e-3));
  CHECK(error.body.inertia.trace() == doctest::Approx(error.data.inertia.trace()).epsilon(3e-3));
  CHECK((error.body.centroid - error.data.centroid).norm() < 1e-5);
  CHECK(error.to_body < 1.1e-3 * 0.01);
  CHECK(error.to_data < 1.1e-3 * 0.01);
}

TEST_CASE("a catalogue of grains takes the lines of TOML") {
  const TemporaryFolder folder;
  const std::vector<FittedBody> fitted = {fitted_of(make_small_body(Family::Superellipsoid, 3, 2.5)),
                                          fitted_of(make_small_body(Family::Ellipsoid, 2, 2)),
                                          fitted_of(make_small_body(Family::Superovoid, 2, 2, -0.3))};
  const auto grains =
      falling_particles::load_catalogue(folder.write("grains.toml", toml_lines(fitted, "thing", 1200, "a \"scan\"")));
  REQUIRE(grains.size() == 2);  // there is no superovoid in a catalogue
  CHECK(grains[0].name == "thing_1");
  CHECK(grains[0].half_axes == std::array<double, 3>{0.03, 0.02, 0.01});
  CHECK(grains[0].delta == 3);
  CHECK(grains[0].epsilon == 2.5);
  CHECK(grains[1].delta == 2);
  CHECK(grains[1].density == 1200);
  CHECK(grains[1].source == "a \"scan\"");
}

TEST_CASE("the lines of C compile, and make the bodies") {
  const TemporaryFolder folder;
  const std::vector<FittedBody> fitted = {fitted_of(make_small_body(Family::Superellipsoid, 3, 2.5)),
                                          fitted_of(make_small_body(Family::Ellipsoid, 2, 2)),
                                          fitted_of(make_small_body(Family::Superovoid, 2, 2, -0.3))};
  const std::string source =
      folder.write("thing.c",
                   "#include <supernormal/supernormal.h>\nvoid make(dSpaceID space, dGeomID *out);\n"
                   "void make(dSpaceID space, dGeomID *out) {\n" +
                       c_lines(fitted, "thing", "a */ scan") + "out[0] = thing_1; out[1] = thing_2; out[2] = thing_3;\n}\n");
  const std::string library = (folder.path() / "thing.so").string();
  const std::string command = std::string(SUPERNORMAL_CXX) +
                              " -x c -Wall -Wextra -Werror -shared -fPIC -I" SUPERNORMAL_INCLUDE " " + source + " -o " + library;
  REQUIRE(std::system(command.c_str()) == 0);
  void* const handle = dlopen(library.c_str(), RTLD_NOW);
  REQUIRE_MESSAGE(handle != nullptr, dlerror());
  using Make = void (*)(dSpaceID, dGeomID*);
  const auto make = reinterpret_cast<Make>(dlsym(handle, "make"));
  REQUIRE((make != nullptr));
  dInitODE2(0);
  dGeomID geoms[3] = {};
  make(nullptr, geoms);
  dReal a = 0, b = 0, c = 0, delta = 0, epsilon = 0;
  REQUIRE(snGeomSuperellipsoidGetParams(geoms[0], &a, &b, &c, &delta, &epsilon) == 1);
  CHECK(double{delta} == doctest::Approx(3));
  // The boundary of the geom is where that of the body is.
  for (std::size_t k = 0; k < 3; ++k) {
    const Cloud cloud = scatter(fitted[k].body, {.points = 20});
    for (const Vector3& x : cloud.points) {
      CHECK(std::abs(double{snGeomPointDepth(geoms[k], static_cast<dReal>(x.x()), static_cast<dReal>(x.y()),
                                             static_cast<dReal>(x.z()))}) < 1e-7);
    }
    dGeomDestroy(geoms[k]);
  }
  snClose();
  dCloseODE();
  dlclose(handle);
}

TEST_CASE("names fit into C and catalogues") {
  CHECK(identifier("bunny.bin") == "bunny_bin");
  CHECK(identifier("3 stones") == "fit_3_stones");
  CHECK(identifier("") == "fit_");
}

TEST_CASE("a picture is an SVG with every view") {
  const Body body = make_small_body(Family::Superellipsoid, 3, 2.5);
  const std::string svg = draw(std::vector<Body>{body}, scatter(body, {.points = 100}), 1e-5, "a < b & c");
  CHECK(svg.find("a &lt; b &amp; c") != std::string::npos);
  std::size_t outlines = 0;
  for (std::size_t at = svg.find("<polygon"); at != std::string::npos; at = svg.find("<polygon", at + 1)) ++outlines;
  CHECK(outlines == 3);
  CHECK(svg.find("nan") == std::string::npos);
}
