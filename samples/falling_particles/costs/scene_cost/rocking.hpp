// A body with a known motion, and the error of this motion for a form of limited accuracy.
#pragma once

#include "common/grain_form.hpp"

namespace scene_cost {

/// |period / exact - 1| of an ellipsoid that rocks on a dBox without friction. NaN if it does not rock.
double rocking_error(const common::GrainForm& form);

}  // namespace scene_cost
