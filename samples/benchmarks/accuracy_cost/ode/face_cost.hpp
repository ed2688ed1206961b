// The cost of dCollide for resting bodies: faces on faces, with max_contacts of one and eight.
#pragma once

#include <ostream>

#include "measurement.hpp"

namespace accuracy_cost {

/// Lays superellipsoids of several exponents, and a dBox of the same size, on a plane, a dBox, a dTriMesh and bodies of their own
/// kind. They overlap as deep as bodies at rest. Measures dCollide and writes Markdown tables of the medians and of the
/// evaluations. The bodies take turns, and each query has another pose than the preceding one.
void write_face_costs(const Effort& effort, std::ostream& out);

}  // namespace accuracy_cost
