#pragma once

#include <string>

#include "report/report.h"

namespace lapwing::bench {

/// The report as text of at most 100 columns: a block for every mesh, size and device with a row
/// for every stage, how stages grow with the mesh, and which targets are met.
std::string table_of(const Report& report);

}  // namespace lapwing::bench
