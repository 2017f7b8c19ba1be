#pragma once

#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/deform/certificate.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/wrap/scan_surface.h"

namespace lapwing {

/// Returns the reaches of the springs, descending from half the diagonal of the template to half
/// its mean edge length `edge`.
std::vector<double> reaches_of(const Positions& rest, double edge);

/// A template that was fitted to a scan.
struct FittedTemplate {
  Positions positions;
  Certificate certificate;  ///< of the last minimization
  int steps = 0;            ///< number of minimizations
};

/// Deforms a template toward a scan by alternating closest points and minimizations (nonrigid
/// iterative closest points: Amberg, Romdhani, Vetter 2007), as `wrap` describes. `rest` contains
/// the aligned template, and `start` the pose from which the first step begins. `region` contains
/// the vertices of the template's surface as the ROI, the landmarks as targets, and the stiffness.
/// Reports the stage "wrap", with the fraction of the reaches that are done. Throws SolverError,
/// GpuError and Cancelled.
FittedTemplate nonrigid_icp(const Topology& topology, Positions rest, Positions start,
                            const ScanSurface& scan, const EditRegion& region, Kernels& kernels,
                            const Progress& progress);

}  // namespace lapwing
