#pragma once

#include "window/app.h"
#include "window/window.h"

namespace lapwing::gpu {
class Context;
}

namespace lapwing::viewer {

/// Shows `app` in `window` until the person or the app quits. Draws only when something happened:
/// an idle window takes no time. Throws GpuError when the device cannot draw into the window.
void run_main_loop(Window& window, gpu::Context& context, App& app);

}  // namespace lapwing::viewer
