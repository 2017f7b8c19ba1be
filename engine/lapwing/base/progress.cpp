#include "lapwing/base/progress.h"

#include "lapwing/base/errors.h"

namespace lapwing {

void report_progress(const Progress& progress, std::string_view stage, double fraction) {
  if (progress && !progress(stage, fraction)) throw Cancelled();
}

}  // namespace lapwing
