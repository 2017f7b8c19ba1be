#pragma once

#include <memory>
#include <optional>
#include <string>

#include "lapwing/coating/layered_coat.h"
#include "state/app_state.h"
#include "work/job.h"
#include "work/layer_draft.h"

namespace lapwing::viewer {

/// Computes a preview of a coat or mix while the user edits it. The preparation runs in the
/// background. Afterwards, a change of a coat's amplitude is shown immediately. After a change of
/// the detail size, the preview first shows an approximation with the previous transition, which
/// takes one back-substitution, and later the exact result.
class LayerPreview {
 public:
  /// The arguments are those of JobThread.
  explicit LayerPreview(JobThread::MakeKernels make_kernels, std::function<void()> wake = {});

  /// Requests the result of `draft` on `target`. Does nothing if the last request was the same.
  void follow(std::shared_ptr<const Mesh> target, const LayerDraft& draft);
  /// Discards the request and the result.
  void stop();
  void use_kernels(JobThread::MakeKernels make_kernels);

  /// Fetches a finished result and starts the next computation. Returns true if the result or the
  /// message has changed. Call this after `wake` and after `follow`.
  bool update();

  /// Returns whether the requested result is not computed yet.
  bool is_behind() const { return busy() || (wanted_ && wanted_ != failed_ && wanted_ != shown_); }
  WorkStatus status() const { return job_.status(); }
  /// Returns the error of the last request, or an empty string if it did not fail.
  const std::string& message() const { return message_; }

  /// Returns whether there is a result. It remains available while the next one is computed.
  bool has_result() const { return prepared_ != nullptr; }
  /// Returns the mesh to which `positions` belongs. Without remeshing, it shares the faces of the
  /// target.
  std::shared_ptr<const Mesh> mesh() const;
  const Positions& positions() const { return positions_; }
  /// Returns the patches, maps and warnings of the result, or null while the worker changes them.
  const LayeredCoat* layers() const;

 private:
  // A request, the data to which its result refers, and the result.
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
  // Returns whether the worker may be changing `prepared_`.
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
  std::optional<Wanted> asked_;  // the request that the worker computes
  bool changes_sizes_ = false;   // whether the worker runs `change_sizes` instead of `prepare`
  std::optional<Wanted> shown_;  // the request whose result is `prepared_` and `positions_`
  bool is_exact_ = false;        // whether `prepare` has computed `prepared_`, not `change_sizes`
  std::optional<Wanted> failed_;
  Result prepared_;
  Positions positions_;
  std::string message_;
  Job<Result> job_;
};

}  // namespace lapwing::viewer
