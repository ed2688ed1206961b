#include "enums.hpp"

#include <initializer_list>
#include <map>
#include <string>
#include <utility>

#include "bindings.hpp"
#include "supernormal/proximity/derivatives.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

/// The IntEnums by name, kept until the interpreter ends. The module cannot be asked for them while it is being built.
std::map<std::string, py::handle>& int_enums() {
  static std::map<std::string, py::handle> types;
  return types;
}

template <typename Enum>
void add_int_enum(py::module_& m, const char* name, const char* doc, std::initializer_list<std::pair<const char*, Enum>> members) {
  py::list items;
  for (const auto& [member, value] : members) items.append(py::make_tuple(member, static_cast<int>(value)));
  const py::object type = py::module_::import("enum").attr("IntEnum")(name, items, py::arg("module") = "supernormal._core");
  type.attr("__doc__") = doc;
  m.attr(name) = type;
  int_enums()[name] = type.inc_ref();
}

}  // namespace

py::object enum_member(const char* name, int value) { return int_enums().at(name)(value); }

void bind_enums(py::module_& m) {
  add_int_enum<Solver>(m, "Solver",
                       "The methods that find the common normal of two bodies.\n\n"
                       "HYBRID: globally convergent ascent of the gap function; the default.\n"
                       "NEWTON: Algorithm I of Roemer's paper, no safeguard.\n"
                       "FIXED_POINT: Algorithm II of Roemer's paper, no derivatives, no safeguard.",
                       {{"HYBRID", Solver::Hybrid}, {"NEWTON", Solver::Newton}, {"FIXED_POINT", Solver::FixedPoint}});
  add_int_enum<Status>(m, "Status",
                       "How a query ended.\n\n"
                       "CONVERGED: the error is within the tolerance.\n"
                       "APART: stopped early, as requested. The bodies are apart by at least `gap`.\n"
                       "STALLED: no further ascent is possible in double precision, but the error exceeds the tolerance.\n"
                       "EVALUATION_LIMIT: Settings.max_evaluations reached.\n"
                       "DIVERGED: an unguarded solver left the domain.\n"
                       "INVALID_INPUT: a shape returned a number that is not finite. Queries raise ValueError instead.",
                       {{"CONVERGED", Status::Converged},
                        {"APART", Status::Apart},
                        {"STALLED", Status::Stalled},
                        {"EVALUATION_LIMIT", Status::EvaluationLimit},
                        {"DIVERGED", Status::Diverged},
                        {"INVALID_INPUT", Status::InvalidInput}});
  add_int_enum<ImpactStatus>(m, "ImpactStatus",
                             "How the search for an impact ended.\n\n"
                             "APART: no impact until the horizon (proved).\n"
                             "HITS: the gap falls to the tolerance at `time`, and not before (proved).\n"
                             "OVERLAPPING: the bodies overlap by more than the tolerance at time 0.\n"
                             "NOT_CONVERGED: a limit was reached, or a query stalled. There is no impact before `apart_until`.\n"
                             "INVALID_INPUT: a number is not finite. Queries raise ValueError instead.",
                             {{"APART", ImpactStatus::Apart},
                              {"HITS", ImpactStatus::Hits},
                              {"OVERLAPPING", ImpactStatus::Overlapping},
                              {"NOT_CONVERGED", ImpactStatus::NotConverged},
                              {"INVALID_INPUT", ImpactStatus::InvalidInput}});
  add_int_enum<DerivativeStatus>(
      m, "DerivativeStatus",
      "Why a derivative exists or not.\n\n"
      "SMOOTH: all derivatives are defined.\n"
      "ACTIVE_SET: all are defined while the witness points stay on their face, edge or vertex.\n"
      "DEGENERATE: a witness point is at the border of its face or edge: only the gradient of the gap is defined.\n"
      "FREE_ON_FACE: faces or edges share more than a point: only the derivatives of the gap by displacements are defined.\n"
      "SINGULAR_CURVATURE: the normal may not be unique, as between two vertices.\n"
      "SEVERAL_MAXIMA: the opposite normal has the same gap.\n"
      "NO_HESSIAN: a shape has no Hessian: only the gradient of the gap is known.\n"
      "NOT_CONVERGED: the answer's normal is not a common normal.\n"
      "INVALID_INPUT: a number is not finite. Queries raise ValueError instead.",
      {{"SMOOTH", DerivativeStatus::Smooth},
       {"ACTIVE_SET", DerivativeStatus::ActiveSet},
       {"DEGENERATE", DerivativeStatus::Degenerate},
       {"FREE_ON_FACE", DerivativeStatus::FreeOnFace},
       {"SINGULAR_CURVATURE", DerivativeStatus::SingularCurvature},
       {"SEVERAL_MAXIMA", DerivativeStatus::SeveralMaxima},
       {"NO_HESSIAN", DerivativeStatus::NoHessian},
       {"NOT_CONVERGED", DerivativeStatus::NotConverged},
       {"INVALID_INPUT", DerivativeStatus::InvalidInput}});
}

}  // namespace supernormal::python
