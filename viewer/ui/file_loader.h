#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "lapwing/gpu/context.h"
#include "ui/load_file.h"

namespace lapwing::viewer {

/// Loads one file at a time beside the window, which is woken whenever there is news.
class FileLoader {
 public:
  explicit FileLoader(std::shared_ptr<gpu::Context> context) : context_(std::move(context)) {}
  /// Cancels, and waits until the loader has noticed.
  ~FileLoader();

  using Load = std::function<LoadedFile(Kernels& kernels, const Progress& progress)>;
  /// Begins with `load`, on a thread of its own, and calls it `name`; what is still being loaded is
  /// given up.
  void start(std::string name, Load load);
  void cancel() { cancelled_ = true; }

  /// From now on files are loaded on another device; what the old one did not finish begins anew.
  void use_device(std::shared_ptr<gpu::Context> context);

  bool busy() const { return busy_; }
  /// What is being done, in words.
  std::string stage() const;

  struct Outcome {
    std::optional<LoadedFile> file;
    std::exception_ptr error;  ///< why there is none; null if it was cancelled
  };
  /// What came of the last start, once.
  std::optional<Outcome> take();

 private:
  struct Job {
    std::string name;
    Load load;
  };
  void run(const Job& job, const std::shared_ptr<gpu::Context>& context);

  std::shared_ptr<gpu::Context> context_;
  std::thread worker_;
  std::atomic<bool> busy_ = false;
  std::atomic<bool> cancelled_ = false;
  mutable std::mutex mutex_;
  std::string stage_;               ///< under the mutex
  std::optional<Job> unfinished_;   ///< under way, or given up with a lost device; the same
  std::optional<Outcome> outcome_;  ///< under the mutex
};

}  // namespace lapwing::viewer
