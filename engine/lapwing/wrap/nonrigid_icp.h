#pragma once

#include <span>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/region/edit_region.h"
#include "lapwing/wrap/scan_surface.h"
#include "lapwing/wrap/template_mirror.h"

namespace lapwing {

/// Returns the reaches of the springs, descending from half the diagonal of the template to half
/// its mean edge length `edge`.
std::vector<double> reaches_of(const Positions& rest, double edge);

/// A template that was fitted to a scan.
struct FittedTemplate {
  Positions positions;
  int steps = 0;  ///< number of minimizations
};

/// A template, and the scan that it should cover.
struct FittingTask {
  const Topology& topology;
  Positions rest;   ///< the aligned template
  Positions start;  ///< the pose from which the first step begins
  /// The scan, or the scan and its mirror image, which then pull the template equally.
  std::span<const ScanSurface> scans;
  const TemplateMirror* mirror = nullptr;  ///< if not null, makes all poses symmetric
  /// The vertices of the template's surface as the ROI, the landmarks as targets, and the
  /// stiffness.
  EditRegion region;
  bool detail = false;  ///< as in WrapRequest
};

/// Deforms a template toward a scan by alternating closest points and minimizations (nonrigid
/// iterative closest points: Amberg, Romdhani, Vetter 2007), as `wrap` describes. Reports the stage
/// "wrap", with the fraction of the reaches that are done. Throws SolverError, GpuError and
/// Cancelled.
FittedTemplate nonrigid_icp(FittingTask task, Kernels& kernels, const Progress& progress);

}  // namespace lapwing
