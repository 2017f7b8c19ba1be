#pragma once

#include <functional>
#include <memory>
#include <string>

namespace lapwing {

namespace gpu {
class Context;
}

/// Calls `draw` with a context, and where that device fails (GpuError) again with a new one: of the
/// same device, which may be there again, then of each other that is usable. `first` is the context
/// to begin with; null for one of the device that "auto" chooses. What `draw` made before it failed
/// must be dropped.
///
/// Returns which device failed and which one drew, in words; empty where the first one drew. Throws
/// what went wrong on the first device where none can.
std::string draw_on_any_device(
    std::shared_ptr<gpu::Context> first,
    const std::function<void(const std::shared_ptr<gpu::Context>&)>& draw);

}  // namespace lapwing
