#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/deform/drag_session.h"
#include "lapwing/elastic/prepared_region.h"
#include "state/app_state.h"
#include "work/attachment_cache.h"
#include "work/settled_result.h"
#include "work/worker.h"

namespace lapwing {
class BlendResponse;
}

namespace lapwing::viewer {

/// The state of the worker, for a progress bar and a line of text.
struct PreparationStatus {
  enum class Phase {
    idle,        ///< nothing to prepare, or cancelled
    previewing,  ///< prepares the preview
    solving,     ///< the preview is ready; prepares the exact solver
    ready,       ///< both are ready
    settling,    ///< both are ready; computes a result
    failed,      ///< `message` says why
  };
  Phase phase = Phase::idle;
  std::string stage;      ///< a name of the engine's stages: "factor"
  double fraction = 0.0;  ///< of the whole preparation by stages, or of settling; 0 to 1
  std::string message;    ///< of the last failure, also of settling; empty without one
};

/// The result of a drag under way.
struct LiveResult {
  std::vector<HandleMove> moves;  ///< those of the state that asked
  /// The surface at those moves, from which the drag goes on. Null for the rest shape, if nothing
  /// could be computed.
  std::shared_ptr<const DragState> pose;
  bool is_done = false;  ///< another request for the same moves would change nothing
  Bounds bounds = {};    ///< of the vertices that move, at `pose`
};

/// Time budget of a live result: what the upload of the pose and the drawing leave of the 16.7 ms
/// of a frame.
inline constexpr double kLiveBudgetMs = 12.0;
/// While the hand rests, longer frames settle sooner.
inline constexpr double kRestBudgetMs = 50.0;

/// Prepares and settles an edit on a background thread: first the preview of a drag, then the exact
/// solver. Call all members from one other thread, the window's. They return at once, except the
/// destructor, which waits for the end of a stage.
class Preparation {
 public:
  /// Called on the worker.
  using MakeKernels = std::function<std::unique_ptr<Kernels>()>;
  /// Uploads a response to the device that draws. Called on the worker.
  using Upload = std::function<std::shared_ptr<BlendResponse>(const DragResponse&)>;

  /// `wake` is called on the worker whenever the status has changed; it must not call back.
  explicit Preparation(MakeKernels make_kernels, std::function<void()> wake = {},
                       Upload upload = {});
  ~Preparation();
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;

  /// Prepares `state` if it has an ROI and a handle. Cancels earlier work if selection, parameters
  /// or rest shape differ from those followed last. On the same ROI, the next preparation reuses
  /// ordering and analysis.
  void follow(const AppState& state);

  /// Sets the handles that the next drags move; the first handle until the first call. Missing
  /// columns of the response are computed before anything that waits to be settled.
  void drag_by(std::span<const std::size_t> handles);

  /// Computes the result of the moves of `state`, the one followed, once the exact solver is ready:
  /// from the pose `from`, or without one along the path of the moves. Replaces an earlier request.
  void settle(const AppState& state, std::shared_ptr<const DragState> from = nullptr);
  /// Returns the result, once.
  std::optional<SettledResult> take_result();
  /// Returns whether a result is requested, under way or ready; false once it was cancelled or has
  /// failed.
  bool will_settle() const;

  /// Asks for the live result of `state`, which holds the moves of a drag under way. Continues from
  /// the pose `from`, the last live one or that of a settled state, for the time of kLiveBudgetMs,
  /// or kRestBudgetMs if the hand `rests`; without a pose it starts as `settle` does. Repeated
  /// until it is done, the result is that of `settle` within the tolerance. Returns false, without
  /// a request, while anything settles or a result waits to be taken.
  bool settle_live(const AppState& state, std::shared_ptr<const DragState> from,
                   bool rests = false);
  /// Returns the live result, once.
  std::optional<LiveResult> take_live_result();

  /// Cancels requests, and drops results that were not taken, live or not.
  void cancel_settling();
  /// Cancels everything and drops what is ready, until the next `follow`.
  void cancel();
  /// Cancels everything and continues with other kernels, after the device was lost.
  void use_kernels(MakeKernels make_kernels, Upload upload = {});

  PreparationStatus status() const;

  /// What was prepared; null until it is ready. Each stays usable while it is held.
  std::shared_ptr<const DragPreview> preview() const;
  std::shared_ptr<const DeformSolver> exact() const;

  /// What carried objects follow, in results and in drags.
  const std::shared_ptr<AttachmentCache>& attachment_cache() const { return attachment_cache_; }

  struct ToDragBy {
    std::shared_ptr<const DragResponse> response;
    std::shared_ptr<BlendResponse> on_device;  ///< null without Upload
    bool is_exact = false;                     ///< false for a preview
  };
  /// Returns the best response that is ready, for the handles of the last `drag_by` whose columns
  /// are computed; null until one is ready.
  ToDragBy drag_response() const;

 private:
  struct Ready {
    std::shared_ptr<const DragPreview> preview;
    std::shared_ptr<const DeformSolver> exact;
    std::shared_ptr<Kernels> exact_kernels;
    std::shared_ptr<DragSession> drag;  // used by the worker alone; null unless drags settle
    ToDragBy drag_by;
  };

  // What the worker keeps from one preparation to the next.
  struct Kept {
    explicit Kept(std::shared_ptr<const Topology> of)
        : topology(std::move(of)), region(*topology) {}
    std::shared_ptr<const Topology> topology;
    PreparedRegion region;
  };

  struct Request {
    AppState state;
    std::uint64_t ticket = 0;
    bool is_live = false;
    std::shared_ptr<const DragState> from;  // null for none
    bool rests = false;                     // the hand rests
  };

  Worker::Work next();
  void prepare(const AppState& state, std::uint64_t ticket);
  bool has_columns() const;
  std::vector<std::size_t> dragged_of(std::size_t handle_count) const;
  ToDragBy response_of(const Ready& ready, std::span<const std::size_t> handles,
                       const Progress& progress) const;
  void respond(const Ready& ready, std::uint64_t ticket);
  void settle_now(const Request& request, const Ready& ready);
  LiveResult live_result(const Request& request, const Ready& ready, const Progress& progress);
  LiveResult follow_drag(const Request& request, DragSession& drag, const Progress& progress);
  std::shared_ptr<Kept> kept_for(const AppState& state, std::uint64_t ticket);
  bool publish(std::uint64_t ticket, Ready ready, PreparationStatus::Phase phase);
  void fail(std::uint64_t ticket, PreparationStatus::Phase phase, const std::string& message);
  Ready let_go();
  std::unique_ptr<Kernels> make_kernels() const;
  std::shared_ptr<BlendResponse> upload(const DragResponse& response) const;

  const std::shared_ptr<AttachmentCache> attachment_cache_ = std::make_shared<AttachmentCache>();

  // The worker's mutex guards everything below. Work is void unless its ticket is the current one.
  MakeKernels make_kernels_;
  Upload upload_;
  std::uint64_t ticket_ = 0;
  std::uint64_t settle_ticket_ = 0;
  std::uint64_t wanted_ticket_ = 0;  // of the last request; cancelled once another is current
  std::optional<AppState> followed_;
  std::optional<AppState> to_prepare_;
  std::vector<std::size_t> dragged_{0};  // ascending
  std::optional<Request> to_settle_;
  std::optional<SettledResult> result_;
  std::optional<LiveResult> live_result_;
  PreparationStatus status_;
  std::shared_ptr<Kept> kept_;
  Ready ready_;

  std::shared_ptr<const DragState> last_live_;  // used by the worker alone
  Worker worker_;                               // last: it uses all the others
};

}  // namespace lapwing::viewer
