#pragma once

#include <functional>
#include <memory>

#include "lapwing/deform/drag.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/vulkan/blend_response.h"

namespace lapwing::viewer {

/// Returns a function that makes kernels on `context`. They continue on the CPU if the device fails
/// (FallbackKernels). Compiles the shaders at its first call. Any thread may call it, but kernels
/// belong to one thread.
std::function<std::unique_ptr<Kernels>()> kernels_like(
    const std::shared_ptr<gpu::Context>& context);

/// Returns a function that uploads a response to the device of `context`, to drag surfaces there.
/// Any thread may call it.
std::function<std::shared_ptr<BlendResponse>(const DragResponse&)> upload_to(
    const std::shared_ptr<gpu::Context>& context);

}  // namespace lapwing::viewer
