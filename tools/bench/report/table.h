#pragma once

#include <string>

#include "report/report.h"

namespace lapwing::bench {

/// Returns a summary that fits on one screen of 100 columns. For each stage, it contains Lapwing's
/// time on the CPU and on the first other device, a peer's time, the ratios, and whether the
/// targets are met. The mesh is the Armadillo if it was measured, otherwise the largest one. The
/// last rows are stages that were measured only on other meshes; each uses the largest of these.
std::string screen_of(const Report& report);

/// Returns a table of all measurements and targets with at most 100 columns. For every mesh, size
/// and device, there is a block with a row for every stage.
std::string table_of(const Report& report);

}  // namespace lapwing::bench
