// The part of explain_pair that needs C++: the hard cases and the methods of the literature, as JSON on stdout.
//   pair_data list                        names and reasons of the hard cases
//   pair_data case NAME                   a hard case
//   pair_data literature                  the paths of the methods, for a pair on stdin
// Exit code: 0 done; 1 failed; 2 bad input.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/input_error.hpp"
#include "common/nearest_word.hpp"
#include "literature/method.hpp"
#include "support/hard_cases/catalogue.hpp"

namespace {

using common::InputError;
using nlohmann::json;
using supernormal::Matrix3;
using supernormal::Pose;
using supernormal::Vector3;
using supernormal::samples::Body;
using supernormal::samples::HardCase;

json numbers(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

Vector3 vector_of(const json& numbers) { return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()}; }

/// The kinds in the order of Body::Kind.
constexpr std::array kKinds = {"ellipsoid", "superellipsoid", "superovoid", "box", "capsule", "cylinder", "polytope"};

json json_of(const Body& body) {
  json points = json::array();
  for (const Vector3& point : body.points) points.push_back(numbers(point));
  return {{"kind", kKinds.at(static_cast<std::size_t>(body.kind))},
          {"lengths", numbers(body.lengths)},
          {"exponents", {body.delta, body.epsilon}},
          {"tapers", {body.taper_x, body.taper_y}},
          {"points", points},
          {"rounding", body.rounding},
          {"is_callback", body.is_callback}};
}

json json_of(const Pose& pose) {
  json rows = json::array();
  for (int row = 0; row < 3; ++row) rows.push_back(numbers(pose.rotation.row(row)));
  return {{"position", numbers(pose.position)}, {"rotation", rows}};
}

json list_of_hard_cases() {
  json list = json::array();
  for (const HardCase& one : supernormal::samples::hard_cases()) list.push_back({one.name, one.reason});
  return list;
}

json hard_case(const std::string& name) {
  const std::vector<HardCase> cases = supernormal::samples::hard_cases();
  const auto found = std::ranges::find(cases, name, &HardCase::name);
  if (found == cases.end()) {
    std::vector<std::string> names(cases.size());
    std::ranges::transform(cases, names.begin(), &HardCase::name);
    throw InputError("--case: \"" + name + "\" is no hard case; allowed: one of the " + std::to_string(names.size()) +
                     " names that --list prints" + common::did_you_mean(name, names));
  }
  return {{"bodies", {json_of(found->body1), json_of(found->body2)}},
          {"poses", {json_of(found->pose1), json_of(found->pose2)}},
          {"first_normal", found->first_normal ? numbers(*found->first_normal) : json()}};
}

Pose pose_of(const json& pose) {
  Matrix3 rotation;
  for (int row = 0; row < 3; ++row) rotation.row(row) = vector_of(pose["rotation"][static_cast<std::size_t>(row)]);
  return {vector_of(pose["position"]), rotation};
}

std::shared_ptr<const supernormal::Shape> superellipsoid_of(const json& body) {
  return make_shape(supernormal::samples::superellipsoid(vector_of(body["lengths"]), body["exponents"][0], body["exponents"][1]));
}

const char* name_of(literature::Outcome outcome) {
  return outcome == literature::Outcome::Found ? "converged" : outcome == literature::Outcome::Apart ? "apart" : "diverged";
}

/// `pair`: the JSON of a hard case, and the tolerance.
json literature_paths(const json& pair) {
  constexpr double kUnit = 1e-9;  // far above rounding; an iterate without a normal has zero or NaN
  const auto shape1 = superellipsoid_of(pair["bodies"][0]), shape2 = superellipsoid_of(pair["bodies"][1]);
  const Pose pose1 = pose_of(pair["poses"][0]);
  const literature::Bodies bodies(*shape1, pose1, *shape2, pose_of(pair["poses"][1]));
  Vector3 first;
  if (!pair["first_normal"].is_null()) first = vector_of(pair["first_normal"]);
  json paths = json::array();
  for (const auto& [name, solve] : literature::methods()) {
    std::vector<Vector3> normals;
    const literature::CommonNormal found = solve(
        bodies,
        {.tolerance = pair["tolerance"], .first_normal = pair["first_normal"].is_null() ? nullptr : &first, .path = &normals});
    const bool is_found = found.outcome == literature::Outcome::Found;
    json path = {
        {"name", name}, {"status", name_of(found.outcome)}, {"evaluations", found.evaluations}, {"normals", json::array()}};
    path["gap"] = is_found ? json(found.gap) : json();
    for (const Vector3& n : normals) {
      if (!(std::abs(n.squaredNorm() - 1) <= kUnit)) break;  // the method left its domain
      path["normals"].push_back(numbers(pose1.rotation * n));
    }
    paths.push_back(path);
  }
  return paths;
}

json answer_to(const std::string& question, const std::vector<std::string>& arguments) {
  if (question == "list") return list_of_hard_cases();
  if (question == "case") return hard_case(arguments.at(0));
  if (question == "literature") return literature_paths(json::parse(std::cin));
  throw InputError("\"" + question + "\" is no question; allowed: list, case, literature");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    std::puts(answer_to(arguments.at(0), {arguments.begin() + 1, arguments.end()}).dump().c_str());
    return 0;
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "explain_pair: %s\n", error.what());
    return 1;
  }
}
