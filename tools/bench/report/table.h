#pragma once

#include <string>

#include "report/report.h"

namespace lapwing::bench {

/// Returns one screen of at most 100 columns. For each stage it has Lapwing's time on the processor
/// and on the first other device, a peer's time, the ratios, and whether the targets are met. The
/// mesh is the Armadillo if it was measured, or else the largest one. Stages without a measurement
/// on this mesh follow, on the largest mesh that has one.
std::string screen_of(const Report& report);

/// Returns all measurements and the targets, in at most 100 columns. Every mesh, size and device
/// has a block with a row for every stage.
std::string table_of(const Report& report);

}  // namespace lapwing::bench
