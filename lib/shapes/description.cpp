// The table of the shapes that have a description. Text, copy and equality follow from it.
#include "supernormal/shapes/description.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

#ifdef __GNUG__
#include <cxxabi.h>

#include <cstdlib>
#endif

#include "shapes/description_text.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/linear_image.hpp"
#include "supernormal/shapes/minkowski_sum.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"

namespace supernormal {
namespace {

using ShapePointer = std::shared_ptr<const Shape>;

/// An argument of the constructor of Made, and how to read it from the shape.
template <typename Made, typename Value>
struct Parameter {
  const char* name;
  Value (Made::*get)() const;
};

template <typename Made, typename... Values>
struct Kind {
  using Type = Made;
  const char* name;
  std::tuple<Parameter<Made, Values>...> parameters;
};

template <typename Made, typename... Values>
constexpr auto kind(const char* name, Parameter<Made, Values>... parameters) {
  return Kind<Made, Values...>{name, {parameters...}};
}

template <typename Made, typename Value>
constexpr auto parameter(const char* name, Value (Made::*get)() const) {
  return Parameter<Made, Value>{name, get};
}

/// The parameters are in the order of the constructor's arguments, and have the names of the Python package.
constexpr auto kKinds = std::tuple(
    kind("Sphere", parameter("radius", &Sphere::radius)), kind("Ellipsoid", parameter("half_axes", &Ellipsoid::half_axes)),
    kind("Superellipsoid", parameter("half_axes", &Superellipsoid::half_axes), parameter("delta", &Superellipsoid::delta),
         parameter("epsilon", &Superellipsoid::epsilon)),
    kind("Superovoid", parameter("half_axes", &Superovoid::half_axes), parameter("delta", &Superovoid::delta),
         parameter("epsilon", &Superovoid::epsilon), parameter("taper_x", &Superovoid::taper_x),
         parameter("taper_y", &Superovoid::taper_y)),
    kind("Box", parameter("half_lengths", &Box::half_lengths)),
    kind("Capsule", parameter("radius", &Capsule::radius), parameter("half_length", &Capsule::half_length)),
    kind("Cylinder", parameter("radius", &Cylinder::radius), parameter("half_length", &Cylinder::half_length)),
    kind("Polytope", parameter("points", &Polytope::points)),
    kind("Rounded", parameter("core", &Rounded::core), parameter("radius", &Rounded::radius)),
    kind("MinkowskiSum", parameter("first", &MinkowskiSum::first), parameter("second", &MinkowskiSum::second)),
    kind("LinearImage", parameter("shape", &LinearImage::shape), parameter("matrix", &LinearImage::matrix)));

/// Calls visit(kind) for the kinds until it returns true. Returns whether it has.
template <typename Visit>
bool visit_kinds(const Visit& visit) {
  return std::apply([&](const auto&... kinds) { return (visit(kinds) || ...); }, kKinds);
}

/// Calls visit(kind, shape as its class). Returns whether the shape is of one of the kinds.
template <typename Visit>
bool visit_shape(const Shape& shape, const Visit& visit) {
  return visit_kinds([&](const auto& kind) {
    const auto* const made = dynamic_cast<const typename std::remove_cvref_t<decltype(kind)>::Type*>(&shape);
    if (made != nullptr) visit(kind, *made);
    return made != nullptr;
  });
}

std::string names_of_kinds() {
  std::string names;
  visit_kinds([&](const auto& kind) {
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
    return false;
  });
  return names;
}

std::string class_name(const Shape& shape) {
  const std::type_info& type = typeid(shape);
#ifdef __GNUG__
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> name(abi::__cxa_demangle(type.name(), nullptr, nullptr, &status), std::free);
  if (name != nullptr) return name.get();
#endif
  return type.name();
}

/// Where a shape is among the parts of another: shape, shape.core, shape.core.first …
struct Path {
  const Path* whole;
  const char* name;
  int depth;  // 1 for the whole

  std::string text() const { return whole == nullptr ? name : whole->text() + "." + name; }
  Path part(const char* part_name) const { return {this, part_name, depth + 1}; }
};
constexpr Path kWhole = {nullptr, "shape", 1};

// A text of any depth would overflow the stack.
constexpr int kMaxDepth = 100;

std::string too_deep() { return "a shape that is nested at most " + std::to_string(kMaxDepth) + " deep"; }

[[noreturn]] void refuse_class(const Shape& shape, const Path& path, const char* what) {
  throw std::invalid_argument(path.text() + " is a " + class_name(shape) + ", which has no " + what + "; shapes with one are " +
                              names_of_kinds());
}

// --- to text

void append_points(std::string& out, std::span<const Vector3> points) {
  const char* separator = "[";
  for (const Vector3& point : points) {
    out += separator;
    append_text(out, point);
    separator = ", ";
  }
  out += "]";
}

void append_shape(std::string& out, const Shape& shape, const Path& path) {
  if (path.depth > kMaxDepth) throw std::invalid_argument(path.text() + " is not " + too_deep());
  const bool is_known = visit_shape(shape, [&](const auto& kind, const auto& made) {
    const char* separator = "(";
    const auto append = [&]<typename Made, typename Value>(const Parameter<Made, Value>& parameter) {
      out += separator;
      out += parameter.name;
      out += "=";
      if constexpr (std::is_same_v<Value, const Shape&>) {
        append_shape(out, (made.*parameter.get)(), path.part(parameter.name));
      } else if constexpr (std::is_same_v<Value, std::span<const Vector3>>) {
        append_points(out, (made.*parameter.get)());
      } else {
        append_text(out, (made.*parameter.get)());
      }
      separator = ", ";
    };
    out += kind.name;
    std::apply([&](const auto&... parameters) { (append(parameters), ...); }, kind.parameters);
    out += ")";
  });
  if (!is_known) refuse_class(shape, path, "description");
}

// --- from text

/// What a shape that is read or copied owns in place of what a parameter refers to.
template <typename Value>
struct OwnedValue {
  using Type = std::remove_cvref_t<Value>;
};
template <>
struct OwnedValue<const Shape&> {
  using Type = ShapePointer;
};
template <>
struct OwnedValue<std::span<const Vector3>> {
  using Type = std::vector<Vector3>;
};
template <typename Value>
using Owned = typename OwnedValue<Value>::Type;

struct PolytopeWithPoints {
  explicit PolytopeWithPoints(std::vector<Vector3> its_points) : points(std::move(its_points)), polytope(points) {}
  std::vector<Vector3> points;
  Polytope polytope;
};

template <typename Made, typename... Arguments>
ShapePointer make_shape(Arguments&&... arguments) {
  if constexpr (std::is_same_v<Made, Polytope>) {
    const auto owner = std::make_shared<PolytopeWithPoints>(std::forward<Arguments>(arguments)...);
    return {owner, &owner->polytope};
  } else {
    return std::make_shared<Made>(std::forward<Arguments>(arguments)...);
  }
}

ShapePointer read_nested(DescriptionReader& reader, int depth);

template <typename Value>
Owned<Value> read_value(DescriptionReader& reader, int depth) {
  using Type = Owned<Value>;
  if constexpr (std::is_same_v<Type, double>) {
    return reader.number();
  } else if constexpr (std::is_same_v<Type, Vector3>) {
    return reader.vector();
  } else if constexpr (std::is_same_v<Type, Matrix3>) {
    return reader.matrix();
  } else if constexpr (std::is_same_v<Type, ShapePointer>) {
    return read_nested(reader, depth + 1);
  } else {
    std::vector<Vector3> points;
    reader.expect("[");
    if (reader.accept(']')) return points;  // the constructor refuses it
    do points.push_back(reader.vector());
    while (reader.accept(','));
    reader.expect("]");
    return points;
  }
}

template <typename Made, typename... Values>
ShapePointer read_arguments(DescriptionReader& reader, std::size_t place, int depth, const Kind<Made, Values...>& kind) {
  const char* separator = "(";
  const auto read = [&]<typename Value>(const Parameter<Made, Value>& parameter) {
    reader.expect(separator);
    reader.expect(parameter.name);
    reader.expect("=");
    separator = ",";
    return read_value<Value>(reader, depth);
  };
  // Braces fix the order of evaluation.
  auto arguments =
      std::apply([&](const auto&... parameters) { return std::tuple<Owned<Values>...>{read(parameters)...}; }, kind.parameters);
  reader.expect(")");
  try {
    return std::apply([](auto&... argument) { return make_shape<Made>(std::move(argument)...); }, arguments);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("the " + std::string(kind.name) + " at character " + std::to_string(place) + ": " + error.what());
  }
}

ShapePointer read_nested(DescriptionReader& reader, int depth) {
  const std::size_t place = reader.place();
  if (depth > kMaxDepth) reader.refuse(place, too_deep());
  const std::string expected = "one of " + names_of_kinds();
  const std::string_view name = reader.name(expected.c_str());
  ShapePointer shape;
  const bool is_known = visit_kinds([&](const auto& kind) {
    if (name != kind.name) return false;
    shape = read_arguments(reader, place, depth, kind);
    return true;
  });
  if (!is_known) reader.refuse(place, expected);
  return shape;
}

// --- copy and equality

ShapePointer clone_part(const Shape& shape, const Path& path) {
  if (const auto* const callbacks = dynamic_cast<const CallbackShape*>(&shape)) return std::make_shared<CallbackShape>(*callbacks);
  ShapePointer copy;
  const auto clone_known = [&]<typename Made, typename... Values>(const Kind<Made, Values...>& kind, const Made& made) {
    const auto own = [&]<typename Value>(const Parameter<Made, Value>& parameter) -> Owned<Value> {
      if constexpr (std::is_same_v<Value, const Shape&>) {
        return clone_part((made.*parameter.get)(), path.part(parameter.name));
      } else if constexpr (std::is_same_v<Value, std::span<const Vector3>>) {
        const std::span<const Vector3> points = (made.*parameter.get)();
        return {points.begin(), points.end()};
      } else {
        return (made.*parameter.get)();
      }
    };
    copy = std::apply([&](const auto&... parameters) { return make_shape<Made>(own(parameters)...); }, kind.parameters);
  };
  if (!visit_shape(shape, clone_known)) refuse_class(shape, path, "copy");
  return copy;
}

template <typename Value>
bool are_equal(const Value& value1, const Value& value2) {
  return value1 == value2;
}

bool are_equal(std::span<const Vector3> points1, std::span<const Vector3> points2) { return std::ranges::equal(points1, points2); }

}  // namespace

std::string describe(const Shape& shape) {
  std::string text;
  append_shape(text, shape, kWhole);
  return text;
}

ShapePointer read_shape(std::string_view text) {
  DescriptionReader reader(text);
  ShapePointer shape = read_nested(reader, 1);
  reader.end();
  return shape;
}

ShapePointer clone(const Shape& shape) { return clone_part(shape, kWhole); }

bool operator==(const Shape& shape1, const Shape& shape2) {
  if (&shape1 == &shape2) return true;
  bool equal = false;
  visit_shape(shape1, [&]<typename Made>(const auto& kind, const Made& made1) {
    const auto* const made2 = dynamic_cast<const Made*>(&shape2);
    if (made2 == nullptr) return;
    const auto same = [&](const auto& parameter) { return are_equal((made1.*parameter.get)(), (made2->*parameter.get)()); };
    equal = std::apply([&](const auto&... parameters) { return (same(parameters) && ...); }, kind.parameters);
  });
  return equal;
}

}  // namespace supernormal
