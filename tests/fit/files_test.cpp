#include <dlfcn.h>
#include <doctest/doctest.h>
#include <supernormal/supernormal.h>
#include <sys/stat.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <supernormal/shapes/tessellation.hpp>

#include "input/read_data.hpp"
#include "model/fit_error.hpp"
#include "model/fit_union.hpp"
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

Body placed_body(Family family, double delta, double epsilon, double taper = 0) {
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
  const std::string pipe = (folder.path() / "pipe.stl").string();
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(complaint(pipe) == pipe + ": a pipe or a socket, and no file");
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

TEST_CASE("decimal commas and colours are no numbers of a body") {
  const TemporaryFolder folder;
  for (const char* line : {"1,5 2,5 3,5", "1,5;2,5;3,5", "1,5, 2,5, 3,5", "1,5\t2\t3", "1 2,5 3"}) {
    const std::string path = folder.write("commas.xyz", std::string("1 2 3\n") + line + "\n");
    CHECK(complaint(path) == path + ":2: numbers are separated in more than one way; a decimal comma? Write decimal points");
  }
  for (const char* line : {"1,2,3", "1, 2, 3", "1;2;3", "1; 2; 3", "  1\t2  3 ", "1 2 3,"}) {
    CHECK(complaint(folder.write("fine.xyz", line)).empty());
  }
  for (const char* line : {"1 2 3 255 0 0", "1,2,3,0.2,0.4,0.1", "1 2 3 128 128 128"}) {
    const std::string message = complaint(folder.write("colours.xyz", line));
    CHECK(message.find(":1: the normal (") != std::string::npos);
    CHECK(message.find("is it a colour? Leave it out") != std::string::npos);
  }
}

TEST_CASE("a mesh is made to face outwards, however it is wound") {
  const TemporaryFolder folder;
  const Body body = placed_body(Family::Superellipsoid, 3, 2.5);
  const std::string text = obj_of(body);
  const double volume = make_shape(body)->mass_properties().volume;
  std::istringstream lines(text);
  std::string inside_out, mixed, two_sided = text, degenerate = text + "f 1 1 2\nf 5 6 5\n";
  int number = 0;
  for (std::string line; std::getline(lines, line); ++number) {
    int a = 0, b = 0, c = 0;
    const bool is_face = std::sscanf(line.c_str(), "f %d %d %d", &a, &b, &c) == 3;
    const std::string turned = "f " + std::to_string(a) + " " + std::to_string(c) + " " + std::to_string(b);
    inside_out += (is_face ? turned : line) + "\n";
    mixed += (is_face && number % 3 == 0 ? turned : line) + "\n";
    if (is_face) two_sided += turned + "\n";
  }
  const auto signed_volume = [](const Data& data) {
    double sum = 0;
    for (const Triangle& t : data.triangles) {
      const auto& x = data.vertices.points;
      sum += x[t[0]].dot(x[t[1]].cross(x[t[2]])) / 6;
    }
    return sum;
  };
  const Data whole = read_data(folder.write("whole.obj", text), 1);
  CHECK(whole.note.empty());
  for (const std::string& other : {inside_out, mixed, two_sided, degenerate}) {
    const Data data = read_data(folder.write("other.obj", other), 1);
    CHECK(data.triangles.size() == whole.triangles.size());
    CHECK(signed_volume(data) == doctest::Approx(volume).epsilon(0.01));
    CHECK_FALSE(data.note.empty());
    CHECK_FALSE(find_error(std::vector<Body>{body}, data).is_hull);
  }
}

TEST_CASE("a cavity faces inwards, also where all is inside out") {
  const TemporaryFolder folder;
  const auto cube = [](double size, double x, bool is_turned, int first) {
    std::ostringstream text;
    for (int i = 0; i < 8; ++i) {
      text << "v " << x + size * ((i & 1) != 0 ? 1 : -1) << ' ' << size * ((i & 2) != 0 ? 1 : -1) << ' '
           << size * ((i & 4) != 0 ? 1 : -1) << '\n';
    }
    constexpr int kFaces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (const auto& f : kFaces)
      text << "f " << first + f[0] << ' ' << first + f[is_turned ? 2 : 1] << ' ' << first + f[is_turned ? 1 : 2] << '\n';
    return text.str();
  };
  const auto turned = [&](bool outer, bool cavity, bool beside) {
    Data data = read_data(folder.write("cubes.obj", cube(2, 0, outer, 1) + cube(1, 0, cavity, 9) + cube(2, 9, beside, 17)), 1);
    return data.note;
  };
  CHECK(turned(false, true, false).empty());
  CHECK(turned(true, false, true) == "36 of 36 triangles faced inwards and are turned round");
  CHECK(turned(false, true, true) == "12 of 36 triangles faced inwards and are turned round");
}

TEST_CASE("coordinates that single precision spoils are refused") {
  const TemporaryFolder folder;
  const auto ply = [&](const char* x) {
    return folder.write("far.ply", std::string("ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\n"
                                               "property double z\nend_header\n") +
                                       x + ".25 5 6\n" + x + ".75 5 6\n");
  };
  CHECK(complaint(ply("500000")).find("are rounded by 0.0298") != std::string::npos);
  CHECK(complaint(ply("5")).empty());
  const std::string far = folder.write("far.xyz", "500000.25 5 6\n500000.26 5 6\n");
  CHECK(read_data(far, 1).vertices.points[1].x() == 500000.26);
}

TEST_CASE("points on a line or in a plane are refused at once") {
  for (const int dimensions : {1, 2}) {
    Cloud cloud;
    for (int i = 0; i < 100; ++i) cloud.points.emplace_back(i + 5.0, dimensions == 2 ? i * i : 2 * i, 3 * i);
    const std::string where = dimensions == 2 ? "in a plane" : "on a line";
    CHECK_THROWS_WITH_AS(fit_body(cloud), doctest::Contains(where.c_str()), std::invalid_argument);
    CHECK_THROWS_WITH_AS(fit_union(cloud, 2), doctest::Contains(where.c_str()), std::invalid_argument);
  }
}

TEST_CASE("points are read from .xyz, .obj and .ply alike") {
  const TemporaryFolder folder;
  const Data xyz = read_data(folder.write("a.xyz", "# x y z and the normal\n1, 2, 3, 0, 0, 1.001\n4 5 6 1 0 0 # more\n"), 0.5);
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
  const Body body = placed_body(Family::Superellipsoid, 3, 2.5);
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
  const std::vector<FittedBody> fitted = {fitted_of(placed_body(Family::Superellipsoid, 3, 2.5)),
                                          fitted_of(placed_body(Family::Ellipsoid, 2, 2)),
                                          fitted_of(placed_body(Family::Superovoid, 2, 2, -0.3))};
  const auto grain_of = [&](std::span<const FittedBody> bodies) {
    const auto grains =
        falling_particles::load_catalogue(folder.write("grains.toml", toml_lines(bodies, "thing", 1200, "a \"scan\"")));
    REQUIRE(grains.size() == 1);
    CHECK(grains[0].name == "thing");
    CHECK(grains[0].source == "a \"scan\"");
    return grains[0];
  };
  const auto grain = grain_of(std::span(fitted).first(1));
  CHECK(grain.half_axes == std::array<double, 3>{0.03, 0.02, 0.01});
  CHECK(grain.delta == 3);
  CHECK(grain.epsilon == 2.5);
  CHECK(grain.density == 1200);
  CHECK(grain_of(std::span(fitted).subspan(1, 1)).delta == 2);
  const auto egg = grain_of(std::span(fitted).subspan(2));
  REQUIRE(egg.parts.size() == 1);
  CHECK(egg.parts[0].body.taper == std::array<double, 2>{-0.3, -0.3});
}

TEST_CASE("a union is one grain, with its parts where they are to each other") {
  const TemporaryFolder folder;
  std::vector<FittedBody> fitted = {fitted_of(placed_body(Family::Superellipsoid, 3, 2.5)),
                                    fitted_of(placed_body(Family::Superovoid, 2, 2, -0.3))};
  fitted[0].body.position = {5000, 0, 0};  // far from the origin of a scanner
  fitted[1].body.position = {5000.02, 0.01, 0};
  fitted[1].body.attitude = Eigen::Quaterniond(-0.7, 0.3, 0.2, 0.5).normalized();
  const auto grains = falling_particles::load_catalogue(folder.write("grains.toml", toml_lines(fitted, "tooth", 1200, "a scan")));
  REQUIRE(grains.size() == 1);
  REQUIRE(grains[0].parts.size() == 2);
  const auto& parts = grains[0].parts;
  const auto at = [](const auto& part) { return Vector3(part.position[0], part.position[1], part.position[2]); };
  const auto turn = [](const auto& part) {
    return Eigen::Quaterniond(part.quaternion[0], part.quaternion[1], part.quaternion[2], part.quaternion[3]);
  };
  CHECK(((at(parts[1]) - at(parts[0])) - Vector3(0.02, 0.01, 0)).norm() < 1e-6);
  for (std::size_t k = 0; k < 2; ++k) CHECK(turn(parts[k]).angularDistance(fitted[k].body.attitude) < 1e-7);
}

TEST_CASE("the lines of C compile, and make the bodies") {
  const TemporaryFolder folder;
  const std::vector<FittedBody> fitted = {fitted_of(placed_body(Family::Superellipsoid, 3, 2.5)),
                                          fitted_of(placed_body(Family::Ellipsoid, 2, 2)),
                                          fitted_of(placed_body(Family::Superovoid, 2, 2, -0.3))};
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
  const Body body = placed_body(Family::Superellipsoid, 3, 2.5);
  const std::string svg = draw(std::vector<Body>{body}, scatter(body, {.points = 100}), 1e-5, "a < b & c");
  CHECK(svg.find("a &lt; b &amp; c") != std::string::npos);
  std::size_t outlines = 0;
  for (std::size_t at = svg.find("<polygon"); at != std::string::npos; at = svg.find("<polygon", at + 1)) ++outlines;
  CHECK(outlines == 3);
  CHECK(svg.find("nan") == std::string::npos);
}
