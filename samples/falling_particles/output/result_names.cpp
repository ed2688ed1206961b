#include "result_names.hpp"

#include "observe/measuring.hpp"
#include "output_files.hpp"
#include "picture.hpp"
#include "vtk_series.hpp"

namespace falling_particles {

ResultNames result_names() {
  ResultNames names{{kOutputFiles.begin(), kOutputFiles.end()},
                    {{std::string(kMeasurementFolder), ".csv"}, {std::string(VtkSeries::kFramesFolder), ".vtp"}}};
  for (const PictureFormat& format : picture_formats()) {
    names.files.insert(names.files.end(), format.files.begin(), format.files.end());
    names.files.insert(names.files.end(), format.rendered.begin(), format.rendered.end());
  }
  return names;
}

}  // namespace falling_particles
