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
/// background. Afterwards, a change of a coat's amplitude is shown immediately. A change of the
/// detail size first shows an approximation, which takes one back-substitution and uses the
/// previous transition. The exact result follows.
class LayerPreview {
 public:
  /// Takes the arguments of JobThread.
  explicit LayerPreview(JobThread::MakeKernels make_kernels, std::function<void()> wake = {});

  /// Asks for the result of `draft` on `target`. Does nothing if that was asked for last.
  void follow(std::shared_ptr<const Mesh> target, const LayerDraft& draft);
  /// Drops the request and the result.
  void stop();
  void use_kernels(JobThread::MakeKernels make_kernels);

  /// Takes finished work and starts more. Returns true if there is another result. Call this when
  /// woken, and after `follow`.
  bool update();

  /// Returns whether the requested result is still to come.
  bool is_behind() const { return busy() || (wanted_ && wanted_ != failed_ && wanted_ != shown_); }
  WorkStatus status() const { return job_.status(); }
  /// Says why the last request failed; empty if it did not.
  const std::string& message() const { return message_; }

  /// Returns whether there is a result. It stays while the next one is computed.
  bool has_result() const { return prepared_ != nullptr; }
  /// Returns the mesh of `positions`. Without remeshing it shares the target's faces.
  std::shared_ptr<const Mesh> mesh() const;
  const Positions& positions() const { return positions_; }
  /// Returns patches, maps and warnings of the result; null while the worker uses them.
  const LayeredCoat* layers() const;

 private:
  // A request, the data that its result refers to, and the result.
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
  // Whether the worker may be changing `prepared_`.
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
  std::optional<Wanted> asked_;  // the request under way
  bool changes_sizes_ = false;   // it changes sizes of `prepared_` instead of preparing
  std::optional<Wanted> shown_;  // the request of `prepared_` and `positions_`
  bool is_exact_ = false;        // whether `prepared_` is not the result of `change_sizes`
  std::optional<Wanted> failed_;
  Result prepared_;
  Positions positions_;
  std::string message_;
  Job<Result> job_;
};

}  // namespace lapwing::viewer
