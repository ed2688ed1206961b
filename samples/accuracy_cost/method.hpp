// A way to answer the question of a pair.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pairs.hpp"
#include "supernormal/solvers/proximity.hpp"

namespace accuracy_cost {

struct Answer {
  enum class Kind {
    None,   ///< gave up
    Apart,  ///< the bodies do not overlap; how far apart they are was not asked, or the method cannot tell
    Gap,    ///< the signed gap
  };
  Kind kind = Kind::None;
  double gap = 0;                                               ///< m
  supernormal::Vector3 normal = supernormal::Vector3::UnitX();  ///< from body 1 to body 2, world frame; of Kind::Gap
  double evaluations = 0;                                       ///< of both bodies
};

class Method {
 public:
  explicit Method(std::string name) : name_(std::move(name)) {}
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;
  virtual ~Method() = default;

  virtual Answer query(const Pair& pair) const = 0;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

using Methods = std::vector<std::unique_ptr<Method>>;

inline constexpr const char* kHybrid = "hybrid";
inline constexpr const char* kHybridWarm = "hybrid, warm";
inline constexpr const char* kHybridEarlyOut = "hybrid, early out";
inline constexpr const char* kNewton = "Newton";
inline constexpr const char* kFixedPoint = "fixed point";
inline constexpr const char* kCcdEpa = "libccd GJK+EPA 1e-6";
inline constexpr const char* kCcdMpr = "libccd MPR 1e-4";
inline constexpr const char* kPointCost = "h, r";
inline constexpr const char* kCurvatureCost = "h, r, H";

/// Our solvers, cold but for the one named warm, at the default tolerance of 1e-9.
Methods supernormal_methods();

/// libccd with our shapes as its support functions.
Methods libccd_methods();

/// One of our solvers that stops at `tolerance`, from the first guess or from Pair::warm_normal.
enum class Start { Cold, Warm };
std::unique_ptr<Method> supernormal_method(std::string name, supernormal::Solver solver, Start start, double tolerance);

/// libccd's GJK and EPA, or its MPR, that stops at `tolerance` (m).
std::unique_ptr<Method> ccd_epa(std::string name, double tolerance);
std::unique_ptr<Method> ccd_mpr(std::string name, double tolerance);

/// Not a question but its unit of cost: the gap function at Pair::normals, up to this order.
std::unique_ptr<Method> evaluation_cost(supernormal::Order order);

}  // namespace accuracy_cost
