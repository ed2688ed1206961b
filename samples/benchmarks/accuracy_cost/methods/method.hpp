// A method for the query of a pair.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/measured_tables.hpp"
#include "common/polyhedron.hpp"
#include "pairs.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace accuracy_cost {

struct Answer {
  enum class Kind {
    None,   ///< the method gave up
    Apart,  ///< the bodies do not overlap; their distance was not requested or is unknown
    Gap,    ///< the signed gap is known
  };
  Kind kind = Kind::None;
  double gap = 0;                                               ///< m
  supernormal::Vector3 normal = supernormal::Vector3::UnitX();  ///< from body 1 to body 2, world frame; set for Kind::Gap
  double evaluations = 0;                                       ///< evaluations of both bodies; 0: not counted
  std::optional<supernormal::Vector3> contact = std::nullopt;   ///< m; contact point
};

class Method {
 public:
  /// `accuracy`: the value of the method's own accuracy parameter.
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

/// Formats a tolerance: "1e-06".
inline std::string power_of_ten(double tolerance) { return common::text("%.0e", tolerance); }

inline constexpr const char* kCcdEpa = "libccd GJK+EPA 1e-6";
inline constexpr const char* kCcdMpr = "libccd MPR 1e-4";

/// The methods of libccd, with our shapes as support functions.
Methods libccd_methods();

/// One of our solvers at `tolerance`, started from its first guess or from Pair::warm_normal.
enum class Start { Cold, Warm };
std::unique_ptr<Method> supernormal_method(std::string name, supernormal::Solver solver, Start start, double tolerance);

/// The hybrid at its default tolerance, stopped at the first normal that proves the bodies apart.
std::unique_ptr<Method> early_out(std::string name, Start start);

/// GJK with EPA, or MPR, of libccd at `tolerance` (m).
std::unique_ptr<Method> ccd_epa(std::string name, double tolerance);
std::unique_ptr<Method> ccd_mpr(std::string name, double tolerance);

/// GJK and EPA of Bullet, with our shapes as support functions. Empty if Bullet was missing at build time.
#ifdef ACCURACY_COST_BULLET_VERSION
Methods bullet_methods();
#else
inline Methods bullet_methods() { return {}; }
#endif

/// Whether the bodies of a pair move. A method places moving bodies again in every query. Others it places once, outside the
/// measured time.
enum class Motion { None, Moves };

/// The methods of samples/benchmarks/literature at this tolerance, started in their own way or from Pair::warm_normal.
Methods literature_methods(Start start, double tolerance);

/// Trimeshes of ODE with 160, 960 and 3840 triangles, whose vertices are on the bodies. A query without contacts means that the
/// bodies are apart.
Methods literature_mesh_methods(Motion motion = Motion::None);

}  // namespace accuracy_cost
