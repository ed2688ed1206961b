#include <dlfcn.h>
#include <doctest/doctest.h>
#include <supernormal/supernormal.h>
#include <sys/stat.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <supernormal/shapes/tessellation.hpp>
#include <vector>

#include "input/read_data.hpp"
#include "input/triangles.hpp"
#include "model/fit_error.hpp"
#include "model/fit_union.hpp"
#include "output/picture.hpp"
#include "output/report.hpp"
#include "output/results.hpp"
#include "study/truth.hpp"
#include "support/refusal.hpp"
#include "support/temporary_folder.hpp"

using namespace fit;

namespace {

std::string complaint(const std::string& path) {
  return supernormal::test::refusal<InputError>([&] { read_data(path, 1); });
}

/// What the complaint says of the file, after its path.
std::string complaint_about(const std::string& path) {
  const std::string message = complaint(path);
  REQUIRE(message.rfind(path, 0) == 0);
  return message.substr(path.size());
}

FittedBody fitted_of(const Body& body) {
  FittedBody fitted;
  fitted.body = body;
  return fitted;
}

std::vector<double> numbers(const toml::table& table, std::string_view key) {
  std::vector<double> values;
  const toml::array* const array = table[key].as_array();
  REQUIRE(array != nullptr);
  for (const toml::node& node : *array) values.push_back(node.value_or(double{NAN}));
  return values;
}

/// The table of the grain, with no other one beside it.
toml::table only_grain(const std::string& lines, const std::string& name) {
  toml::table all = toml::parse(lines);
  CHECK(all.size() == 1);
  REQUIRE(all[name].is_table());
  return *all[name].as_table();
}

/// A library of C code, compiled with warnings as errors, and loaded.
void* compiled(const TemporaryFolder& folder, const std::string& source) {
  const std::string library = (folder.path() / "code.so").string();
  const std::string command = std::string(SUPERNORMAL_CXX) +
                              " -x c -Wall -Wextra -Werror -shared -fPIC -I" SUPERNORMAL_INCLUDE " " + source + " -o " + library;
  REQUIRE(std::system(command.c_str()) == 0);
  void* const handle = dlopen(library.c_str(), RTLD_NOW);
  REQUIRE_MESSAGE(handle != nullptr, dlerror());
  return handle;
}

Body placed_body(Family family, double delta, double epsilon, double taper = 0) {
  return {family, {0.3, -0.2, 0.5}, Eigen::Quaterniond(0.7, 0.3, -0.2, 0.5).normalized(), {0.03, 0.02, 0.01}, delta, epsilon,
          taper};
}

/// The points as a .ply with coordinates of this type, double, float or short.
std::string ply_of(const std::vector<Vector3>& points, const std::string& format, const std::string& type) {
  std::ostringstream text;
  text.precision(17);
  text << "ply\nformat " << format << " 1.0\nelement vertex " << points.size() << '\n';
  for (const char axis : {'x', 'y', 'z'}) text << "property " << type << ' ' << axis << '\n';
  text << "end_header\n";
  const auto write = [&](auto number) {
    std::array<char, sizeof number> bytes{};
    std::memcpy(bytes.data(), &number, sizeof number);
    if ((format == "binary_big_endian") == (std::endian::native == std::endian::little)) std::ranges::reverse(bytes);
    text.write(bytes.data(), sizeof number);
  };
  for (const Vector3& x : points) {
    for (int i = 0; i < 3; ++i) {
      if (format == "ascii") {
        text << x[i] << (i == 2 ? '\n' : ' ');
      } else if (type == "double") {
        write(x[i]);
      } else if (type == "float") {
        write(static_cast<float>(x[i]));
      } else {
        write(static_cast<std::int16_t>(x[i]));
      }
    }
  }
  return text.str();
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

/// A mesh as a binary glTF file.
std::string glb_of(std::span<const float> corners, std::span<const std::uint32_t> faces) {
  static_assert(std::endian::native == std::endian::little, "of glTF");
  std::ostringstream json;
  json << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
       << R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
       << R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" << corners.size() / 3
       << R"(},{"bufferView":1,"componentType":5125,"type":"SCALAR","count":)" << faces.size()
       << R"(}],"bufferViews":[{"buffer":0,"byteLength":)" << corners.size_bytes() << R"(},{"buffer":0,"byteOffset":)"
       << corners.size_bytes() << R"(,"byteLength":)" << faces.size_bytes() << R"(}],"buffers":[{"byteLength":)"
       << corners.size_bytes() + faces.size_bytes() << "}]}";
  while (json.tellp() % 4 != 0) json << ' ';
  std::ostringstream text;
  const auto write = [&](std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    text.write(reinterpret_cast<const char*>(&word), sizeof word);
  };
  const std::size_t bytes = corners.size_bytes() + faces.size_bytes();
  text << "glTF";
  for (const std::size_t word : {std::size_t{2}, 28 + json.str().size() + bytes, json.str().size()}) write(word);
  text << "JSON" << json.str();
  write(bytes);
  text.write("BIN", 4);
  text.write(reinterpret_cast<const char*>(corners.data()), static_cast<std::streamsize>(corners.size_bytes()));
  text.write(reinterpret_cast<const char*>(faces.data()), static_cast<std::streamsize>(faces.size_bytes()));
  return text.str();
}

}  // namespace

TEST_CASE_FIXTURE(TemporaryFolder, "unusable files are refused with a reason") {
  const std::string none = (path() / "none.ply").string();
  CHECK(complaint(none) == none + ": no such file");
  const std::string pipe = (path() / "pipe.stl").string();
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK(complaint(pipe) == pipe + ": a pipe or a socket, and no file");
  const std::string directory = (path() / "folder.ply").string();
  std::filesystem::create_directory(directory);
  CHECK(complaint(directory) == directory + ": a folder, and no file");
  for (const char* name : {"empty.stl", "empty.obj"}) {
    CHECK(complaint(write(name, "")).find(std::string(name) + ": cannot be read: ") != std::string::npos);
  }
  for (const auto& [name, text, expected] : std::to_array<std::array<const char*, 3>>(
           {{"points.txt", "1 2 3\n",
             ": unknown extension \".txt\"; allowed: .stl, .glb, .gltf (meshes), .obj, .off, .ply (meshes or points), .xyz "
             "(points)"},
            {"empty.xyz", "# nothing\n\n", ": no points"},
            {"nan.xyz", "1 2 3\n1 nan 3\n", ":2: a coordinate is not finite: \"1 nan 3\""},
            {"inf.xyz", "1 2 1e999\n", ":1: a coordinate is not finite: \"1 2 1e999\""},
            {"word.xyz", "1 2 3\n1 two 3\n", ":2: a line holds x y z, or x y z nx ny nz, not \"1 two 3\""},
            {"mixed.xyz", "1 2 3\n1 2 3 0 0 1\n", ":2: either all points have normals or none"}})) {
    CHECK(complaint_about(write(name, text)) == expected);
  }
  const std::string marked = write("marked.xyz",
                                   "\xef\xbb\xbf"
                                   "1 2 3\n");
  CHECK(read_data(marked, 1).vertices.points.size() == 1);
}

TEST_CASE_FIXTURE(TemporaryFolder, "decimal commas and colours in a file of points are refused") {
  for (const char* line : {"1,5 2,5 3,5", "1,5;2,5;3,5", "1,5, 2,5, 3,5", "1,5\t2\t3", "1 2,5 3"}) {
    const std::string path = write("commas.xyz", std::string("1 2 3\n") + line + "\n");
    CHECK(complaint(path) == path + ":2: numbers are separated in more than one way; a decimal comma? Write decimal points");
  }
  for (const char* line : {"1,2,3", "1, 2, 3", "1;2;3", "1; 2; 3", "  1\t2  3 ", "1 2 3,"}) {
    CHECK(complaint(write("fine.xyz", line)).empty());
  }
  for (const char* line : {"1 2 3 255 0 0", "1,2,3,0.2,0.4,0.1", "1 2 3 128 128 128"}) {
    const std::string message = complaint(write("colours.xyz", line));
    CHECK(message.find(":1: the normal (") != std::string::npos);
    CHECK(message.find("is it a colour? Leave it out") != std::string::npos);
  }
}

TEST_CASE_FIXTURE(TemporaryFolder, "a mesh with any winding is made to face outwards") {
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
  const Data whole = read_data(write("whole.obj", text), 1);
  CHECK(whole.note.empty());
  for (const std::string& other : {inside_out, mixed, two_sided, degenerate}) {
    const Data data = read_data(write("other.obj", other), 1);
    CHECK(data.triangles.size() == whole.triangles.size());
    CHECK(signed_volume(data) == doctest::Approx(volume).epsilon(0.01));
    CHECK_FALSE(data.note.empty());
    CHECK_FALSE(find_error(std::vector<Body>{body}, data).is_hull);
  }
}

TEST_CASE_FIXTURE(TemporaryFolder, "a cavity faces inwards, also in a mesh that is inside out") {
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
    Data data = read_data(write("cubes.obj", cube(2, 0, outer, 1) + cube(1, 0, cavity, 9) + cube(2, 9, beside, 17)), 1);
    return data.note;
  };
  CHECK(turned(false, true, false).empty());
  CHECK(turned(true, false, true) == "36 of 36 triangles faced inwards and are turned round");
  CHECK(turned(false, true, true) == "12 of 36 triangles faced inwards and are turned round");
}

TEST_CASE_FIXTURE(TemporaryFolder, "coordinates that have lost their digits in single precision are refused") {
  const std::string obj = write("far.obj", "v 500000.25 5 6\nv 500000.75 5 6\n");
  CHECK(complaint(obj).find("are rounded by 0.0298") != std::string::npos);
  const std::string single = write("far.ply", ply_of({{500000.25, 5, 6}, {500000.75, 5, 6}}, "binary_big_endian", "float"));
  CHECK(complaint(single).find("are rounded by 0.0298") != std::string::npos);
  CHECK(complaint(write("near.ply", ply_of({{5.25, 5, 6}, {5.75, 5, 6}}, "binary_big_endian", "float"))).empty());
  const std::string far = write("far.xyz", "500000.25 5 6\n500000.26 5 6\n");
  CHECK(read_data(far, 1).vertices.points[1].x() == 500000.26);
}

TEST_CASE_FIXTURE(TemporaryFolder, "a .ply is read in double precision, as text and in both byte orders") {
  const std::vector<Vector3> points = {{1e6 + 1.0 / 3, -2e6 - 1.0 / 7, 1e-300}, {-0.1, 1e300, 0.3}};
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    CHECK(read_data(write("double.ply", ply_of(points, format, "double")), 1).vertices.points == points);
  }
  const Data integers = read_data(write("int.ply", ply_of({{-3, 200, 5}, {1, 2, 3}}, "binary_big_endian", "short")), 1);
  CHECK(integers.vertices.points == std::vector<Vector3>{{-3, 200, 5}, {1, 2, 3}});
}

TEST_CASE_FIXTURE(TemporaryFolder, "a body is fitted equally well a million of its sizes from the origin") {
  const Body near{Family::Superellipsoid, Vector3::Zero(), Eigen::Quaterniond::Identity(), {1.5, 1.1, 0.8}, 4, 4, 0};
  Body far = near;
  far.position = {1e6, -1e6, 1e6};
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const Data data = read_data(write("far.ply", ply_of(scatter(far, {.points = 1000}).points, format, "double")), 1);
    const FittedBody fitted = fit_body(data.vertices);
    CHECK(fitted.body.family == Family::Superellipsoid);
    CHECK(std::abs(fitted.body.delta - 4) < 1e-6);
    CHECK(std::abs(fitted.body.epsilon - 4) < 1e-6);
    CHECK((fitted.body.position - far.position).norm() < 1e-8);
    // The printed position has as many digits as the body needs.
    CHECK(c_lines(std::vector<FittedBody>{fitted}, "far", "", {}, 1).find("dGeomSetPosition(geom_far, ") != std::string::npos);
  }
  CHECK(digits_of(1e6, 0.8, 9) == 16);
  CHECK(digits_of(0.1, 0.8, 9) == 9);
}

TEST_CASE_FIXTURE(TemporaryFolder, "polygons of a .ply are cut into triangles, and other elements are skipped") {
  const std::string header =
      "ply\r\nformat ascii 1.0\r\ncomment an arrowhead, concave at 2\r\nelement camera 1\r\nproperty list uchar float lens\r\n"
      "element vertex 5\r\nproperty float x\r\nproperty uchar red\r\nproperty float y\r\nproperty float z\r\nelement face 2\r\n"
      "property list uchar int vertex_indices\r\nproperty int flag\r\nend_header\r\n2 1 1\r\n";
  const Data data = read_data(
      write("arrow.ply", header + "0 9 0 0\r\n2 9 0 0\r\n0.5 9 1 0\r\n1 9 3 0\r\n0 9 0 1\r\n4 1 2 3 0 7\r\n3 0 1 4 7"), 1);
  CHECK(data.triangles.size() == 3);
  double area = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Triangle& t = data.triangles[k];
    const auto& x = data.vertices.points;
    const Vector3 twice = (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
    area += std::abs(twice.z()) / 2;
  }
  CHECK(area == doctest::Approx(
                    1.25));  // the area of the arrowhead: no part counts twice, and the third triangle has no area seen from above
}

TEST_CASE_FIXTURE(TemporaryFolder, "a broken .ply is refused with the place of the error") {
  const std::string start = "ply\nformat ascii 1.0\n", xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string two = start + "element vertex 2\n" + xyz + "end_header\n";
  const auto refusal = [&](const std::string& text) { return complaint_about(write("bad.ply", text)); };
  CHECK(refusal("") == ":1: the file ends within its header, which must end with end_header");
  CHECK(refusal("solid\n") == ":1: the first line of a .ply is \"ply\"");
  CHECK(refusal("ply\nformat ascii 2.0\n") ==
        ":2: unknown format \"ascii 2.0\"; allowed: ascii, binary_little_endian or binary_big_endian, 1.0");
  CHECK(refusal(start + "element vertex -1\n") == ":3: element vertex has the count \"-1\"; allowed: 0 to 1e18 - 1");
  CHECK(refusal(start + "property float x\n") == ":3: a property stands before the first element");
  CHECK(refusal(start + "element vertex 1\nproperty half x\n") == ":4: \"half\" is no type of a number");
  CHECK(refusal(start + "element vertex 900000000000000000\n" + xyz + "end_header\n1 2 3\n") ==
        ": the header says 900000000000000000 of element vertex, but the file has room for 1 at most: is it truncated?");
  CHECK(refusal(two + "1 2 3\n1.5 2.5\n") == ":10: vertex 2 of 2: the file ends here");
  CHECK(refusal(two + "1 2 3\n1 2,5 3\n") == ":9: vertex 2 of 2: \"2,5\" is no number");
  CHECK(refusal(two + "1 2 3\n1 nan 3\n") == ":9: vertex 2 of 2: y is nan, but must be finite");
  CHECK(refusal(start + "element vertex 1\nproperty float x\nend_header\n1\n") == ": vertices have no property \"y\"");
  const std::string face =
      start + "element vertex 1\n" + xyz + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  CHECK(refusal(face + "1 2 3\n3 0 0 7\n") == ":11: face 1 of 1: there is no vertex 7; allowed: 0 to 0");
  CHECK(refusal(face + "1 2 3\n4000000000 0\n") == ":11: face 1 of 1: a list has 4e+09 entries, but the file ends before");
  CHECK(refusal(face + "1 2 3\n3 0 0 -1\n") == ":11: face 1 of 1: there is no vertex -1; allowed: 0 to 0");
  CHECK(refusal(two + "1 2 3\n4 5 6\n7 8 9\n") == ":10: the file goes on after all that its header says");
  CHECK(refusal(ply_of({{1, 2, 3}, {4, 5, 6}}, "binary_little_endian", "double").substr(0, 150)).find("room for 1 at most") !=
        std::string::npos);
}

TEST_CASE_FIXTURE(TemporaryFolder,
                  "an .off is read in double precision, as a mesh or as points, with whatever stands behind its numbers") {
  const std::string corners = "1000000.3333333333 0 0 255 0 0\n1 0 0\n\n0 1 0  # the third\n0 0 1\n";
  const Data mesh = read_data(write("mesh.off", "# a comment\nOFF\n4 2 0\n" + corners + "4 0 1 2 3  0.5 0.5 0.5\n3 0 2 1\n"), 1);
  CHECK(std::ranges::any_of(mesh.vertices.points, [](const Vector3& x) { return x.x() == 1000000.3333333333; }));
  CHECK(mesh.triangles.size() == 3);
  const Data points = read_data(write("points.off", "OFF 4 0 0\n" + corners), 0.5);
  CHECK(points.triangles.empty());
  CHECK(points.vertices.points[2] == Vector3(0, 0.5, 0));
  const Data normals = read_data(write("normals.off", "NOFF\n2 0\n1 2 3 0 0 1\n4 5 6 1 0 0\n"), 1);
  CHECK(normals.vertices.normals == std::vector<Vector3>{{0, 0, 1}, {1, 0, 0}});
}

TEST_CASE_FIXTURE(TemporaryFolder, "a broken .off is refused with the place of the error") {
  const std::string three = "0 0 0\n1 0 0\n0 1 0\n";
  for (const auto& [text, expected] : std::to_array<std::array<std::string, 2>>(
           {{"", ": the file ends before the numbers of vertices and faces"},
            {"OFF\n", ": the file ends before the numbers of vertices and faces"},
            {"4OFF\n1 0 0\n", ":1: the file begins with \"4OFF\"; allowed: OFF, with ST, C or N before it, in three dimensions"},
            {"OFF BINARY\n", ":1: element vertex has the count \"BINARY\"; allowed: 0 to 1e18 - 1"},
            {"OFF\n30 10 0\n" + three,
             ": the header says 30 of element vertex, but the file has room for 4 at most: is it truncated?"},
            {"OFF\n3 2 0\n" + three + "3 0 1 2\n", ":7: face 2 of 2: the file ends here"},
            {"OFF\n3 1 0\n" + three + "3 0 1 2\n3 0 2 1\n", ":7: the file goes on after all that its header says"},
            {"OFF\n3 1 0\n" + three + "3 0 1 9999\n", ":6: face 1 of 1: there is no vertex 9999; allowed: 0 to 2"},
            {"OFF\n3 1 0\n" + three + "3 0 1 -1\n", ":6: face 1 of 1: there is no vertex -1; allowed: 0 to 2"},
            {"OFF\n3 1 0\n" + three + "4 0 1 2\n", ":7: face 1 of 1: the file ends here"},
            {"OFF\n3 1 0\n" + three + "-1 0 1 2\n", ":7: face 1 of 1: the file ends here"},
            {"OFF\n1 0 0\n1,5 2,5 3,5\n", ":3: vertex 1 of 1: \"1,5\" is no number"},
            {"OFF\n1 0 0\n1 2 nan\n", ":3: vertex 1 of 1: z is nan, but must be finite"}})) {
    CHECK(complaint_about(write("bad.off", text)) == expected);
  }
}

TEST_CASE_FIXTURE(TemporaryFolder, "a mesh with a face whose vertex does not exist is refused in every format") {
  const std::array<float, 12> corners = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (const std::uint32_t last : {3u, 4u, 9999u, 0xffffffffu}) {
    const std::array<std::uint32_t, 12> faces = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, last};
    const bool is_fine = last == 3;
    CHECK(complaint(write("a.glb", glb_of(corners, faces))).empty() == is_fine);
    std::ostringstream obj, off;
    off << "OFF\n4 4 0\n";
    for (std::size_t i = 0; i < 12; i += 3) {
      for (std::ostringstream* text : {&obj, &off}) {
        *text << (text == &obj ? "v " : "") << corners[i] << ' ' << corners[i + 1] << ' ' << corners[i + 2] << '\n';
      }
    }
    for (std::size_t i = 0; i < 12; i += 3) {
      obj << 'f';
      off << '3';
      for (std::size_t k = 0; k < 3; ++k) {
        const auto index = static_cast<std::int32_t>(faces[i + k]);
        obj << ' ' << (index < 0 ? -5 : index + 1);  // 1 is the first vertex, and -1 the last
        off << ' ' << index;
      }
      obj << '\n';
      off << '\n';
    }
    CHECK(complaint(write("a.obj", obj.str())).empty() == is_fine);
    CHECK(complaint(write("a.off", off.str())).empty() == is_fine);
  }
}

TEST_CASE_FIXTURE(TemporaryFolder, "the edges that keep a mesh open are counted") {
  const std::string corners = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n", three = "3 0 2 1\n3 0 1 3\n3 0 3 2\n";
  const auto edges_of = [&](int points, int faces, const std::string& text) {
    std::ostringstream all;
    all << "OFF\n" << points << ' ' << faces << " 0\n" << text;
    return open_edges(read_data(write("a.off", all.str()), 1).triangles);
  };
  const OpenEdges closed = edges_of(4, 4, corners + three + "3 1 2 3\n");
  CHECK(closed.single + closed.other == 0);
  const OpenEdges hole = edges_of(4, 3, corners + three);
  CHECK(hole.single == 3);
  CHECK(hole.other == 0);
  CHECK(describe(hole) == "the mesh is open: 3 edges have one triangle");
  const OpenEdges fin = edges_of(5, 5, corners + "2 2 0\n" + three + "3 1 2 3\n3 1 2 4\n");  // on a closed edge
  CHECK(fin.single == 2);
  CHECK(fin.other == 1);
  CHECK(describe(fin) == "the mesh is open: 2 edges have one triangle, 1 edge has several triangles that do not pair up");
}

TEST_CASE_FIXTURE(TemporaryFolder, "unused vertices and flat faces of a file do not count as surface") {
  const Body body = placed_body(Family::Superellipsoid, 3, 2.5);
  const std::string text = obj_of(body);
  const Data whole = read_data(write("whole.obj", text), 1);
  std::ostringstream stray;
  stray.precision(9);
  stray << "ply\nformat ascii 1.0\nelement vertex " << whole.vertices.points.size() + 2
        << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << whole.triangles.size() + 1
        << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vector3& x : whole.vertices.points) stray << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
  const Triangle& first = whole.triangles.front();
  const Vector3 middle = (whole.vertices.points[first[0]] + whole.vertices.points[first[1]]) / 2;
  stray << middle.x() << ' ' << middle.y() << ' ' << middle.z() << "\n5 5 5\n";
  for (const Triangle& t : whole.triangles) stray << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  stray << "3 " << first[0] << ' ' << first[1] << ' ' << whole.vertices.points.size() << '\n';  // a flat face on an edge
  const Data data = read_data(write("stray.ply", stray.str()), 1);
  CHECK(data.note == "1 vertices that no triangle has are left out");
  const FitError error = find_error(std::vector<Body>{body}, data);
  CHECK_FALSE(error.is_hull);
  CHECK(error.to_body < 0.001);
  CHECK(error.data.volume == doctest::Approx(make_shape(body)->mass_properties().volume).epsilon(0.01));
}

TEST_CASE("points on a line or in a plane are refused") {
  for (const int dimensions : {1, 2}) {
    Cloud cloud;
    for (int i = 0; i < 100; ++i) cloud.points.emplace_back(i + 5.0, dimensions == 2 ? i * i : 2 * i, 3 * i);
    const std::string where = dimensions == 2 ? "in a plane" : "on a line";
    CHECK_THROWS_WITH_AS(fit_body(cloud), doctest::Contains(where.c_str()), std::invalid_argument);
    CHECK_THROWS_WITH_AS(fit_union(cloud, 2), doctest::Contains(where.c_str()), std::invalid_argument);
  }
}

TEST_CASE_FIXTURE(TemporaryFolder, "points from .xyz, .obj and .ply are equal") {
  const Data xyz = read_data(write("a.xyz", "# x y z and the normal\n1, 2, 3, 0, 0, 1.001\n4 5 6 1 0 0 # more\n"), 0.5);
  CHECK(xyz.vertices.points == std::vector<Vector3>{{0.5, 1, 1.5}, {2, 2.5, 3}});
  CHECK(xyz.vertices.normals[0] == Vector3(0, 0, 1));
  for (const std::string& other :
       {write("a.obj", "v 1 2 3\nv 4 5 6\n"), write("a.ply", ply_of({{1, 2, 3}, {4, 5, 6}}, "ascii", "float"))}) {
    const Data data = read_data(other, 0.5);
    CHECK(data.vertices.points == xyz.vertices.points);
    CHECK(data.triangles.empty());
  }
}

TEST_CASE_FIXTURE(TemporaryFolder, "a fit to a mesh of a body returns the body, with its volume and inertia") {
  const Body body = placed_body(Family::Superellipsoid, 3, 2.5);
  const Data data = read_data(write("body.obj", obj_of(body)), 1);
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

TEST_CASE("the printed lines of TOML are one grain of a catalogue") {
  const std::vector<FittedBody> fitted = {fitted_of(placed_body(Family::Superellipsoid, 3, 2.5)),
                                          fitted_of(placed_body(Family::Ellipsoid, 2, 2)),
                                          fitted_of(placed_body(Family::Superovoid, 2, 2, -0.3))};
  const auto grain_of = [&](std::span<const FittedBody> bodies) {
    toml::table grain = only_grain(toml_lines(bodies, "thing", 1200, "a \"scan\""), "thing");
    CHECK(grain["source"].value<std::string>() == "a \"scan\"");
    return grain;
  };
  const toml::table grain = grain_of(std::span(fitted).first(1));
  CHECK(numbers(grain, "half_axes") == std::vector{0.03, 0.02, 0.01});
  CHECK(grain["delta"].value<double>() == 3);
  CHECK(grain["epsilon"].value<double>() == 2.5);
  CHECK(grain["density"].value<double>() == 1200);
  CHECK_FALSE(grain.contains("taper"));
  CHECK(grain_of(std::span(fitted).subspan(1, 1))["delta"].value<double>() == 2);
  CHECK(numbers(grain_of(std::span(fitted).subspan(2)), "taper") == std::vector{-0.3, -0.3});
}

TEST_CASE("a union is printed as one grain, with the relative poses of its parts") {
  std::vector<FittedBody> fitted = {fitted_of(placed_body(Family::Superellipsoid, 3, 2.5)),
                                    fitted_of(placed_body(Family::Superovoid, 2, 2, -0.3))};
  fitted[0].body.position = {5000, 0, 0};  // far from the origin of a scanner
  fitted[1].body.position = {5000.02, 0.01, 0};
  fitted[1].body.orientation = Eigen::Quaterniond(-0.7, 0.3, 0.2, 0.5).normalized();
  const toml::table tooth = only_grain(toml_lines(fitted, "tooth", 1200, "a scan"), "tooth");
  const toml::array& parts = *tooth["parts"].as_array();
  REQUIRE(parts.size() == 2);
  const auto vector_of = [&](std::size_t part, const char* key) {
    const std::vector<double> values = numbers(*parts[part].as_table(), key);
    REQUIRE(values.size() == 3);
    return Vector3(values[0], values[1], values[2]);
  };
  CHECK((vector_of(1, "position") - vector_of(0, "position") - Vector3(0.02, 0.01, 0)).norm() < 1e-6);
  for (std::size_t k = 0; k < 2; ++k) {
    const double degrees = (*parts[k].as_table())["angle"].value_or(double{NAN});
    const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, vector_of(k, "axis").normalized());
    CHECK(Eigen::Quaterniond(turn).angularDistance(fitted[k].body.orientation) < 1e-7);
  }
}

TEST_CASE_FIXTURE(TemporaryFolder, "the printed lines of C compile and create the bodies") {
  const std::vector<FittedBody> fitted = {fitted_of(placed_body(Family::Superellipsoid, 3, 2.5)),
                                          fitted_of(placed_body(Family::Ellipsoid, 2, 2)),
                                          fitted_of(placed_body(Family::Superovoid, 2, 2, -0.3))};
  const std::string source = write("thing.c",
                                   "#include <supernormal/supernormal.h>\nvoid make(dSpaceID space, dGeomID *out);\n"
                                   "void make(dSpaceID space, dGeomID *out) {\n" +
                                       c_lines(fitted, "thing", "a */ scan", integrate_union(bodies_of(fitted)).solid, 1200) +
                                       "out[0] = geom_thing_1; out[1] = geom_thing_2; out[2] = geom_thing_3;\n}\n");
  void* const handle = compiled(*this, source);
  using Make = void (*)(dSpaceID, dGeomID*);
  const auto make = reinterpret_cast<Make>(dlsym(handle, "make"));
  REQUIRE((make != nullptr));
  dInitODE2(0);
  dGeomID geoms[3] = {};
  make(nullptr, geoms);
  dReal a = 0, b = 0, c = 0, delta = 0, epsilon = 0;
  REQUIRE(snGeomSuperellipsoidGetParams(geoms[0], &a, &b, &c, &delta, &epsilon) == 1);
  CHECK(double{delta} == doctest::Approx(3));
  // The geom and the body have the same boundary.
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

TEST_CASE_FIXTURE(TemporaryFolder, "the printed lines of C make a body whose centre of mass is its origin, whatever its name") {
  // The centre of mass of a superovoid is not its centre.
  const std::vector<FittedBody> fitted = {fitted_of(placed_body(Family::Superovoid, 2, 2, -0.3))};
  const FitError error = find_error(bodies_of(fitted), {scatter(fitted[0].body, {.points = 500}), {}, ""});
  std::ostringstream code;
  code.precision(17);
  code << "#include <supernormal/supernormal.h>\nvoid make(dSpaceID space, dBodyID body, dMass *own);\n"
       << "void make(dSpaceID space, dBodyID body, dMass *own) {\n";
  for (const char* name : {"int", "space", "body", "dGeomID", "_Bool"}) {
    code << "{\n"
         << c_lines(fitted, name, "", error.body, 1200) << "dBodySetMass(body, &mass_" << name << ");\ndBodySetPosition(body, "
         << error.body.centroid.x() << ", " << error.body.centroid.y() << ", " << error.body.centroid.z()
         << ");\ndGeomSetBody(geom_" << name << ", body);\ndGeomSetOffsetWorldPosition(geom_" << name << ", 0.3, -0.2, 0.5);\n"
         << "dGeomSetOffsetWorldQuaternion(geom_" << name << ", geom_" << name << "_orientation);\n"
         << "snMassSet(own, 1200, geom_" << name << ");\n}\n";
  }
  code << "}\n";
  void* const handle = compiled(*this, write("moving.c", code.str()));
  using Make = void (*)(dSpaceID, dBodyID, dMass*);
  const auto make = reinterpret_cast<Make>(dlsym(handle, "make"));
  REQUIRE((make != nullptr));
  dInitODE2(0);
  const dWorldID world = dWorldCreate();
  const dBodyID body = dBodyCreate(world);
  dMass own, mass;
  make(nullptr, body, &own);  // dBodySetMass ends the program if the centre of mass is elsewhere
  dBodyGetMass(body, &mass);
  // The mass of the geom, in its own frame, moved to the frame of the body.
  const dGeomID geom = dBodyGetFirstGeom(body);
  dMassRotate(&own, dGeomGetOffsetRotation(geom));
  const dReal* const place = dGeomGetOffsetPosition(geom);
  dMassTranslate(&own, place[0], place[1], place[2]);
  CHECK(double{mass.mass} == doctest::Approx(double{own.mass}));
  for (int i = 0; i < 3; ++i) CHECK(std::abs(double{own.c[i]}) < 1e-8);
  for (int i = 0; i < 12; ++i) CHECK(std::abs(double{mass.I[i] - own.I[i]}) < 1e-7 * double{mass.I[0]});
  while (const dGeomID each = dBodyGetFirstGeom(body)) dGeomDestroy(each);
  dWorldDestroy(world);
  snClose();
  dCloseODE();
  dlclose(handle);
}

TEST_CASE("printed names are valid in C and in catalogues") {
  CHECK(identifier("bunny.bin") == "bunny_bin");
  CHECK(identifier("3 stones") == "fit_3_stones");
  CHECK(identifier("gr\xc3\xb6\xc3\x9f"
                   "e") == "gr__e");  // two characters of two bytes
  CHECK(identifier("") == "fit_");
}

TEST_CASE("a picture is an SVG with all views") {
  const Body body = placed_body(Family::Superellipsoid, 3, 2.5);
  const std::string svg = draw(std::vector<Body>{body}, scatter(body, {.points = 100}), 1e-5, "a < b & c");
  CHECK(svg.find("a &lt; b &amp; c") != std::string::npos);
  std::size_t outlines = 0;
  for (std::size_t at = svg.find("<polygon"); at != std::string::npos; at = svg.find("<polygon", at + 1)) ++outlines;
  CHECK(outlines == 3);
  CHECK(svg.find("nan") == std::string::npos);
}
