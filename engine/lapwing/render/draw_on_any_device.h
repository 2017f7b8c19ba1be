#pragma once

#include <functional>
#include <memory>
#include <string>

namespace lapwing {

namespace gpu {
class Context;
}

/// Calls `draw` with a context. If the device fails (GpuError), calls it again with a new context:
/// first of the same device, which may have recovered, then of each other usable device. `first` is
/// the context to begin with, or null for the device that "auto" chooses. `draw` must drop what it
/// made before it failed.
///
/// Returns a message that names the device that failed and the one that drew, or an empty string if
/// the first one drew. If none can draw, throws the error of the first device.
std::string draw_on_any_device(
    std::shared_ptr<gpu::Context> first,
    const std::function<void(const std::shared_ptr<gpu::Context>&)>& draw);

}  // namespace lapwing
