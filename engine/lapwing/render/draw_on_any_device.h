#pragma once

#include <functional>
#include <memory>
#include <string>

namespace lapwing {

namespace gpu {
class Context;
}

/// Calls `draw` with a context. If the device fails (GpuError), calls `draw` again with a new
/// context: first on the same device, which may have recovered, then on every other usable device.
/// If `first` is null, starts with the device that "auto" chooses. A failed `draw` must release all
/// objects that it created.
///
/// Returns an empty string if the first call succeeded. Otherwise returns a message that names the
/// device that drew and the first error. If no device can draw, throws the first error.
std::string draw_on_any_device(
    std::shared_ptr<gpu::Context> first,
    const std::function<void(const std::shared_ptr<gpu::Context>&)>& draw);

}  // namespace lapwing
