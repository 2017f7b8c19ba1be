#include "ui/file_loader.h"

#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/device_lost.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "window/window.h"

namespace lapwing::viewer {

FileLoader::~FileLoader() {
  cancel();
  if (worker_.joinable()) worker_.join();
}

void FileLoader::start(std::string name, Load load) {
  cancel();
  if (worker_.joinable()) worker_.join();
  take();
  cancelled_ = false;
  busy_ = true;
  Job job{std::move(name), std::move(load)};
  unfinished_ = job;
  worker_ = std::thread([this, job = std::move(job), context = context_] { run(job, context); });
}

void FileLoader::use_device(std::shared_ptr<gpu::Context> context) {
  context_ = std::move(context);
  std::unique_lock lock(mutex_);
  std::optional<Job> unfinished = unfinished_;
  lock.unlock();
  if (unfinished) start(std::move(unfinished->name), std::move(unfinished->load));
}

void FileLoader::run(const Job& job, const std::shared_ptr<gpu::Context>& context) {
  const auto progress = [this, &job](std::string_view stage, double) {
    const std::scoped_lock lock(mutex_);
    stage_ = job.name + ": " + std::string(stage);
    Window::wake();
    return !cancelled_;
  };
  Outcome outcome;
  bool finished = true;
  try {
    // Kernels are one thread's: these share no more than the device with the window's.
    VulkanKernels kernels(context, Precision::automatic);
    outcome.file = job.load(kernels, progress);
  } catch (const Cancelled&) {
    // Someone asked for this: there is nothing to say.
  } catch (const gpu::DeviceLost&) {
    outcome.error = std::current_exception();
    finished = false;
  } catch (...) {
    outcome.error = std::current_exception();
  }
  {
    const std::scoped_lock lock(mutex_);
    outcome_ = std::move(outcome);
    if (finished) unfinished_.reset();
  }
  busy_ = false;
  Window::wake();
}

std::string FileLoader::stage() const {
  const std::scoped_lock lock(mutex_);
  return stage_;
}

std::optional<FileLoader::Outcome> FileLoader::take() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(outcome_, std::nullopt);
}

}  // namespace lapwing::viewer
