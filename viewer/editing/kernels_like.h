#pragma once

#include <functional>
#include <memory>

#include "lapwing/deform/drag.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/vulkan/blend_response.h"

namespace lapwing::viewer {

/// Makes kernels on `context`, which go on on the CPU where its device fails (FallbackKernels); may
/// be called on any thread: kernels are one thread's.
std::function<std::unique_ptr<Kernels>()> kernels_like(
    const std::shared_ptr<gpu::Context>& context);

/// Puts a response on the device of `context`, for surfaces there to be dragged by; on any thread.
std::function<std::shared_ptr<BlendResponse>(const DragResponse&)> upload_to(
    const std::shared_ptr<gpu::Context>& context);

}  // namespace lapwing::viewer
