#include "ui/file_loader.h"

#include <utility>

#include "lapwing/base/errors.h"
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
  worker_ = std::thread([this, name = std::move(name), load = std::move(load)] { run(name, load); });
}

void FileLoader::run(const std::string& name, const Load& load) {
  const auto progress = [this, &name](std::string_view stage, double) {
    const std::scoped_lock lock(mutex_);
    stage_ = name + ": " + std::string(stage);
    Window::wake();
    return !cancelled_;
  };
  Outcome outcome;
  try {
    // Kernels are one thread's: these share no more than the device with the window's.
    VulkanKernels kernels(context_, Precision::automatic);
    outcome.file = load(kernels, progress);
  } catch (const Cancelled&) {
    // Someone asked for this: there is nothing to say.
  } catch (...) {
    outcome.error = std::current_exception();
  }
  {
    const std::scoped_lock lock(mutex_);
    outcome_ = std::move(outcome);
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
