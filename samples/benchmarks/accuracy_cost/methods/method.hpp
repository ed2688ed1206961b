// A method that solves the query of a pair.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ode/mesh.hpp"
#include "pairs.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace accuracy_cost {

struct Answer {
  enum class Kind {
    None,   ///< the method gave up
    Apart,  ///< the bodies do not overlap; their distance was not asked for, or the method cannot tell
    Gap,    ///< the signed gap is known
  };
  Kind kind = Kind::None;
  double gap = 0;                                               ///< m
  supernormal::Vector3 normal = supernormal::Vector3::UnitX();  ///< from body 1 to body 2, world frame; set for Kind::Gap
  double evaluations = 0;                                       ///< evaluations of both bodies; 0: not counted
  std::optional<supernormal::Vector3> contact = std::nullopt;   ///< m; where the force acts
};

class Method {
 public:
  /// `accuracy` is the value of the method's own parameter of accuracy.
  explicit Method(std::string name, std::string accuracy = "") : name_(std::move(name)), accuracy_(std::move(accuracy)) {}
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;
  virtual ~Method() = default;

  virtual Answer query(const Pair& pair) const = 0;
  const std::string& name() const { return name_; }
  const std::string& accuracy() const { return accuracy_; }

 private:
  std::string name_, accuracy_;
};

using Methods = std::vector<std::unique_ptr<Method>>;

/// Writes a tolerance as text: "1e-06".
std::string power_of_ten(double tolerance);

inline constexpr const char* kHybrid = "hybrid";
inline constexpr const char* kHybridWarm = "hybrid, warm";
inline constexpr const char* kHybridEarlyOut = "hybrid, early out";
inline constexpr const char* kNewton = "Newton";
inline constexpr const char* kFixedPoint = "fixed point";
inline constexpr const char* kCcdEpa = "libccd GJK+EPA 1e-6";
inline constexpr const char* kCcdMpr = "libccd MPR 1e-4";
inline constexpr const char* kPointCost = "h and r";
inline constexpr const char* kCurvatureCost = "h and r and H";  // no commas: they are cells of CSV
inline constexpr const char* kFloorCost = "logarithms and exponentials";

/// Whether the method measures the unit of cost instead of solving a query.
inline bool is_unit_of_cost(const Method& method) {
  return method.name() == kPointCost || method.name() == kCurvatureCost || method.name() == kFloorCost;
}

/// Our solvers, cold except for the one named warm, at the default tolerance of 1e-9.
Methods supernormal_methods();

/// libccd's methods with our shapes as support functions.
Methods libccd_methods();

/// One of our solvers that stops at `tolerance`, from the first guess or from Pair::warm_normal.
enum class Start { Cold, Warm };
std::unique_ptr<Method> supernormal_method(std::string name, supernormal::Solver solver, Start start, double tolerance);

/// The hybrid at its default tolerance, which ends at the first normal that proves the bodies apart.
std::unique_ptr<Method> early_out(std::string name, Start start);

/// libccd's GJK and EPA, or its MPR, that stops at `tolerance` (m).
std::unique_ptr<Method> ccd_epa(std::string name, double tolerance);
std::unique_ptr<Method> ccd_mpr(std::string name, double tolerance);

/// A library whose methods are measured if its Debian package was found, with the version.
struct Library {
  std::string name;
  std::string version;  ///< "" if it was missing at the build
};
std::vector<Library> libraries();

/// Bullet's GJK and EPA, with our shapes as support functions; empty if Bullet is missing, and likewise below.
Methods bullet_methods();

/// Pairs that stay where they are, or that move: what a method prepares for a pair, outside of the measured time, or for every query.
enum class Motion { None, Moves };

/// Signed distance and contact of ellipsoids, by their own shapes, at several tolerances.
Methods fcl_methods(Motion motion = Motion::None);
Methods simbody_methods();

/// The mesh of a superellipsoid or ellipsoid.
Mesh mesh_of(const supernormal::Shape& shape, MeshSize size);

/// libccd's GJK and EPA with a mesh of the body as its support function: a convex hull.
std::unique_ptr<Method> ccd_hull(MeshSize size);

/// ODE's own colliders of polyhedra whose vertices are on the bodies. A query without contacts says that the bodies are apart.
Methods ode_mesh_methods();

/// The methods of samples/benchmarks/literature at this tolerance of theirs, from their own start or from Pair::warm_normal.
Methods literature_methods(Start start, double tolerance);

/// Meshes of 160, 960 and 3840 triangles, by ODE's trimesh and, as convex hulls, by libccd's GJK and EPA.
Methods literature_mesh_methods(Motion motion = Motion::None);

/// The unit of cost instead of a query: the gap function at Pair::normals, up to this order.
std::unique_ptr<Method> evaluation_cost(supernormal::Order order);

/// The floor of the cost: the eight logarithms and eight exponentials, of the C library, that an evaluation of two
/// superellipsoids needs (a power is one of each).
std::unique_ptr<Method> floor_cost();

}  // namespace accuracy_cost
