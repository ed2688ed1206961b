// The cost of dCollide where bodies rest: faces on faces, with room for one contact and for eight.
#pragma once

#include <ostream>

#include "measurement.hpp"

namespace accuracy_cost {

/// Lays superellipsoids of several exponents, and ODE's dBox of the same size, on a plane, a dBox, a dTriMesh and bodies of their
/// own kind, as deep as bodies at rest overlap, times dCollide, and writes tables in Markdown of the medians and of the
/// evaluations. Bodies take turns, and each query has another pose than the last.
void write_face_costs(const Effort& effort, std::ostream& out);

}  // namespace accuracy_cost
