// What the program measures: queries, and dCollide at every class of ODE, at rest, and beside libccd.
#pragma once

#include <cstdint>
#include <ostream>

#include "common/measured_tables.hpp"
#include "measurement.hpp"

namespace accuracy_cost {

/// Measures all solvers at all their tolerances, with a task for each class of bodies and situation, each with `pairs` pairs.
common::MeasuredTable query_costs(std::size_t pairs, std::uint64_t seed, const Effort& effort);

/// The same for the literature methods and our solvers.
common::MeasuredTable literature_costs(std::size_t pairs, std::uint64_t seed, const Effort& effort);

/// Places every body at every collider `poses` times, overlapping by 2 %, and measures dCollide. Writes a Markdown table of the
/// medians. The bodies take turns on each pose, so that a disturbance of the machine affects all of them. Consecutive queries
/// differ by 1e-3 (m and rad), as in a simulation, so a warm start has its usual effect.
void write_collider_costs(std::size_t poses, std::uint64_t seed, const Effort& effort, std::ostream& out);

/// Lays superellipsoids of several exponents, and a dBox of the same size, on a plane, a dBox, a dTriMesh and bodies of their own
/// kind. They overlap as deep as bodies at rest. Measures dCollide and writes Markdown tables of the medians and of the
/// evaluations. The bodies take turns, and each query has another pose than the preceding one.
void write_face_costs(const Effort& effort, std::ostream& out);

/// Writes a Markdown table: dCollide without a warm start and with room for one contact, beside libccd GJK+EPA with the same
/// support functions, on the same random pairs. `pairs`: of each class and situation.
void write_pair_costs(std::size_t pairs, std::uint64_t seed, const Effort& effort, std::ostream& out);

}  // namespace accuracy_cost
