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
  std::string message;    ///< says why the last work failed; empty if none failed
};

/// The result of a drag under way.
struct LiveResult {
  std::vector<HandleMove> moves;  ///< those of the state that asked
  /// The surface at those moves, from which the drag continues. Null, the rest shape, if nothing
  /// could be computed.
  std::shared_ptr<const DragState> pose;
  bool is_done = false;  ///< another request for the same moves would change nothing
  Bounds bounds = {};    ///< of the vertices that move, at `pose`
};

/// Time budget of a live result. The rest of the 16.7 ms of a frame is for uploading the pose and
/// drawing.
inline constexpr double kLiveBudgetMs = 12.0;
/// Time budget while the hand rests. With longer frames, the surface settles sooner.
inline constexpr double kRestBudgetMs = 50.0;

/// Prepares and settles an edit on a background thread. Prepares the preview of a drag first, then
/// the exact solver. Call all members from the window's thread. They return at once, except the
/// destructor, which waits for the end of a stage.
class Preparation {
 public:
  /// Creates the kernels. The worker calls this function.
  using MakeKernels = std::function<std::unique_ptr<Kernels>()>;
  /// Uploads a response to the device that draws. The worker calls this function.
  using Upload = std::function<std::shared_ptr<BlendResponse>(const DragResponse&)>;

  /// `wake` is called on the worker whenever the status has changed; it must not call back.
  explicit Preparation(MakeKernels make_kernels, std::function<void()> wake = {},
                       Upload upload = {});
  ~Preparation();
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;

  /// Prepares `state` if it has an ROI and a handle. Cancels earlier work if selection, parameters
  /// or rest shape differ from those of the state followed last. On the same ROI, the next
  /// preparation reuses ordering and analysis.
  void follow(const AppState& state);

  /// Sets the handles that the next drags move. Before the first call, this is the first handle.
  /// The worker computes missing columns of the response before it settles anything.
  void drag_by(std::span<const std::size_t> handles);

  /// Computes the result of the moves of `state`, which must be the followed state, once the exact
  /// solver is ready. Starts from the pose `from`, or follows the path of the moves if that is
  /// null. Replaces an earlier request.
  void settle(const AppState& state, std::shared_ptr<const DragState> from = nullptr);
  /// Returns the result, once.
  std::optional<SettledResult> take_result();
  /// Returns whether a result is requested, under way or ready. Returns false after it was
  /// cancelled or has failed.
  bool will_settle() const;

  /// Requests the live result of `state`, which holds the moves of a drag under way. Continues from
  /// the pose `from`, which is the last live pose or that of a settled state. Without a pose,
  /// starts as `settle` does. Continuing has the time budget kLiveBudgetMs, or kRestBudgetMs if the
  /// hand `rests`. If repeated until `is_done`, the result equals that of `settle` within the
  /// tolerance. Returns false, without a request, while anything settles or a result waits to be
  /// taken.
  bool settle_live(const AppState& state, std::shared_ptr<const DragState> from,
                   bool rests = false);
  /// Returns the live result, once.
  std::optional<LiveResult> take_live_result();

  /// Cancels requests and drops all results that were not taken, including a live one.
  void cancel_settling();
  /// Cancels everything and drops what was prepared. The next `follow` prepares again.
  void cancel();
  /// Cancels everything and continues with other kernels, after the device was lost.
  void use_kernels(MakeKernels make_kernels, Upload upload = {});

  PreparationStatus status() const;

  /// Return what was prepared, or null until it is ready. It stays valid while the caller holds the
  /// pointer.
  std::shared_ptr<const DragPreview> preview() const;
  std::shared_ptr<const DeformSolver> exact() const;

  /// Returns the attachments of carried objects, which results and drags share.
  const std::shared_ptr<AttachmentCache>& attachment_cache() const { return attachment_cache_; }

  struct ToDragBy {
    std::shared_ptr<const DragResponse> response;
    std::shared_ptr<BlendResponse> on_device;  ///< null without Upload
    bool is_exact = false;                     ///< false for the preview's response
  };
  /// Returns the best response that is ready, or null. It is for the handles of the last `drag_by`
  /// whose columns are computed.
  ToDragBy drag_response() const;

 private:
  struct Ready {
    std::shared_ptr<const DragPreview> preview;
    std::shared_ptr<const DeformSolver> exact;
    std::shared_ptr<Kernels> exact_kernels;
    std::shared_ptr<DragSession> drag;  // only the worker uses it; null unless drags settle
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
    std::shared_ptr<const DragState> from;  // null without a start pose
    bool rests = false;                     // whether the hand rests
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

  // The worker's mutex guards everything below. Work counts only if its ticket is the current one.
  MakeKernels make_kernels_;
  Upload upload_;
  std::uint64_t ticket_ = 0;
  std::uint64_t settle_ticket_ = 0;
  std::uint64_t wanted_ticket_ = 0;  // of the last request, void if another is current
  std::optional<AppState> followed_;
  std::optional<AppState> to_prepare_;
  std::vector<std::size_t> dragged_{0};  // ascending
  std::optional<Request> to_settle_;
  std::optional<SettledResult> result_;
  std::optional<LiveResult> live_result_;
  PreparationStatus status_;
  std::shared_ptr<Kept> kept_;
  Ready ready_;

  std::shared_ptr<const DragState> last_live_;  // only the worker uses it
  Worker worker_;                               // declared last, because it uses all the others
};

}  // namespace lapwing::viewer
