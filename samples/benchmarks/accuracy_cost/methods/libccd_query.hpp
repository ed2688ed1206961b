// A libccd query for any kind of body.
#pragma once

#include <ccd/ccd.h>

#include "method.hpp"

namespace accuracy_cost {

/// ccdGJKPenetration or ccdMPRPenetration.
using Penetration = int (*)(const void*, const void*, const ccd_t*, ccd_real_t*, ccd_vec3_t*, ccd_vec3_t*);

/// Settings for two bodies of one class.
ccd_t ccd_settings(ccd_support_fn support_of, ccd_center_fn centre_of, double tolerance);

/// The answer, without the number of evaluations.
Answer ask_libccd(Penetration penetration, const ccd_t& settings, const void* body1, const void* body2);

}  // namespace accuracy_cost
