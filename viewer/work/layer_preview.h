#pragma once

#include <memory>
#include <optional>
#include <string>

#include "lapwing/coating/layered_coat.h"
#include "state/app_state.h"
#include "work/job.h"
#include "work/layer_draft.h"

namespace lapwing::viewer {

/// What a coat or mix comes to while a person still changes it. Prepared beside the window; then
/// the amplitude of a coat is at once, and another detail size first by one back-substitution,
/// which leaves the transition as it was, and once nothing else is wanted exactly. What is asked
/// for meanwhile is done as soon as the worker is free, or in place of what is under way.
class LayerPreview {
 public:
  /// JobThread's.
  explicit LayerPreview(JobThread::MakeKernels make_kernels, std::function<void()> wake = {});

  /// Wants the result of `draft` on `target`. Nothing happens where that is what was wanted last.
  void follow(std::shared_ptr<const Mesh> target, const LayerDraft& draft);
  /// Wants nothing any more.
  void stop();
  void use_kernels(JobThread::MakeKernels make_kernels);

  /// Takes what the worker has, and gives it more to do. True if there is another result. Call it
  /// when woken, and after `follow`.
  bool update();

  /// Whether what is wanted is still to come.
  bool is_behind() const { return busy() || (wanted_ && wanted_ != failed_ && wanted_ != shown_); }
  /// Whether the result is that of the step, bit for bit, but for `is_behind`.
  bool is_exact() const { return is_exact_; }
  WorkStatus status() const { return job_.status(); }
  /// Why the last thing wanted cannot be had; empty if it can.
  const std::string& message() const { return message_; }

  /// Whether there is a result. It holds while the next one is made.
  bool has_result() const { return prepared_ != nullptr; }
  /// Whose vertices `positions` are. Where nothing was remeshed it shares the target's faces.
  std::shared_ptr<const Mesh> mesh() const;
  const Positions& positions() const { return positions_; }
  /// Patches, maps and warnings of the result; null while the worker has them.
  const LayeredCoat* layers() const;

 private:
  // The request, what its result refers to, and what came of it.
  struct Prepared {
    std::shared_ptr<Kernels> kernels;
    std::shared_ptr<const Mesh> target;
    LayerDraft draft;
    std::unique_ptr<LayeredCoat> layers;
  };
  struct Wanted {
    std::shared_ptr<const Mesh> target;
    LayerDraft draft;

    bool operator==(const Wanted& other) const {
      return target == other.target && draft == other.draft;
    }
  };
  using Result = std::shared_ptr<Prepared>;

  bool busy() const { return asked_.has_value(); }
  // Whether the worker may be changing what is prepared.
  bool is_lent() const { return busy() && changes_sizes_; }
  bool take_result();
  bool go_on();
  bool slide();
  void prepare(const Wanted& wanted);
  void change_sizes(const Wanted& wanted);
  bool place();
  static Result prepared(const Wanted& wanted, const std::shared_ptr<Kernels>& kernels,
                         const Progress& progress);

  std::optional<Wanted> wanted_;
  std::optional<Wanted> asked_;  // of the worker:
  bool changes_sizes_ = false;   // of what is prepared, rather than preparing anew
  std::optional<Wanted> shown_;  // what is prepared, and `positions_` are
  bool is_exact_ = false;
  std::optional<Wanted> failed_;
  Result prepared_;
  Positions positions_;
  std::string message_;
  Job<Result> job_;
};

}  // namespace lapwing::viewer
