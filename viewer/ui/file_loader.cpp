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

void FileLoader::start(const std::filesystem::path& path) {
  cancel();
  if (worker_.joinable()) worker_.join();
  take();
  cancelled_ = false;
  busy_ = true;
  unfinished_ = path;
  worker_ = std::thread([this, path, context = context_] { load(path, context); });
}

void FileLoader::use_device(std::shared_ptr<gpu::Context> context) {
  context_ = std::move(context);
  std::unique_lock lock(mutex_);
  const std::filesystem::path unfinished = unfinished_;
  lock.unlock();
  if (!unfinished.empty()) start(unfinished);
}

void FileLoader::load(const std::filesystem::path& path,
                      const std::shared_ptr<gpu::Context>& context) {
  const auto progress = [this, name = path.filename().string()](std::string_view stage, double) {
    const std::scoped_lock lock(mutex_);
    stage_ = name + ": " + std::string(stage);
    Window::wake();
    return !cancelled_;
  };
  Outcome outcome;
  bool finished = true;
  try {
    // Kernels are one thread's: these share no more than the device with the window's.
    VulkanKernels kernels(context, Precision::automatic);
    outcome.file = load_file(path, kernels, progress);
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
    if (finished) unfinished_.clear();
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
