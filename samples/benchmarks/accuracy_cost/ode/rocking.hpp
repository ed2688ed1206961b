// One body whose motion is known, and the error that the accuracy of a form brings to it.
#pragma once

#include "grain_form.hpp"

namespace accuracy_cost {

/// |period / exact - 1| of an ellipsoid that rocks on a dBox without friction; NaN when it does not rock.
double rocking_error(const Form& form);

}  // namespace accuracy_cost
