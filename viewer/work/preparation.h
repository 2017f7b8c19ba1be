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

/// What the worker is at, for a progress bar and a line of text.
struct PreparationStatus {
  enum class Phase {
    idle,        ///< nothing to prepare, or cancelled
    previewing,  ///< makes the preview
    solving,     ///< the preview is ready; makes the exact one
    ready,       ///< both are ready
    settling,    ///< both are ready; computes a result
    failed,      ///< `message` says why
  };
  Phase phase = Phase::idle;
  std::string stage;      ///< a name of the engine's stages: "factor"
  double fraction = 0.0;  ///< of the whole preparation by stages, or of settling; 0 to 1
  std::string message;    ///< of the last failure, of settling too; empty without
};

/// Where a drag under way has been brought.
struct LiveResult {
  std::vector<HandleMove> moves;  ///< those of the state that asked
  /// What to go on from: the surface at those moves. Null, which is the rest shape, only where
  /// nothing could be computed from there.
  std::shared_ptr<const DragState> pose;
  bool is_done = false;  ///< asked for again, nothing would move
  Bounds bounds = {};    ///< of the vertices that move, at `pose`
};

/// What a live result may take, but for what it cannot do without: of the 16.7 ms of a frame what
/// the upload of the pose and the drawing leave.
inline constexpr double kLiveBudgetMs = 12.0;
/// Where the hand rests nothing is to be followed, and longer frames settle sooner.
inline constexpr double kRestBudgetMs = 50.0;

/// Prepares an edit on a thread of its own, so that the window never waits: first the preview of a
/// drag, then the exact one; and settles. All members may be called from one other thread, the
/// window's, and return at once, but for the destructor, which waits for the end of a stage.
class Preparation {
 public:
  /// The preview and the exact one are used from two threads and get kernels of their own; called
  /// on the worker.
  using MakeKernels = std::function<std::unique_ptr<Kernels>()>;
  /// Puts a response where the window draws; called on the worker.
  using Upload = std::function<std::shared_ptr<BlendResponse>(const DragResponse&)>;

  /// `wake` is called on the worker whenever the status has changed; it must not call back. Without
  /// `upload` there is nothing to draw.
  explicit Preparation(MakeKernels make_kernels, std::function<void()> wake = {},
                       Upload upload = {});
  ~Preparation();
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;

  /// Prepares what `state` chooses. Where selection, parameters or rest shape are no longer those
  /// that were followed last, what is under way is cancelled and what was ready is let go; a mere
  /// move changes nothing. On the same ROI the next preparation orders and analyzes nothing anew.
  /// Without ROI or handle there is nothing to prepare.
  void follow(const AppState& state);

  /// Which handles the next drags move, those that the edit does not have left out: what is
  /// prepared has columns for these alone, and where it has none they are solved for, ahead of all
  /// that waits to be settled. The first handle until the first call. Costs nothing where they are
  /// there.
  void drag_by(std::span<const std::size_t> handles);

  /// Computes the result of the moves of `state`, which is the one followed, as soon as the exact
  /// one is ready: the one that the pose `from` leads to, or without one the path of the moves.
  /// Takes the place of an earlier request.
  void settle(const AppState& state, std::shared_ptr<const DragState> from = nullptr);
  /// The result that is there, once.
  std::optional<SettledResult> take_result();
  /// Whether one is asked for, under way or there; false once it was given up or has failed.
  bool will_settle() const;

  /// Follows a drag under way, whose moves `state` holds for once: a result to look at, which comes
  /// by `take_live_result`. It goes on from the pose `from`, the last live one or that of a settled
  /// state, as far as kLiveBudgetMs allows (DragSession::step), or kRestBudgetMs where the hand
  /// `rests` since the last one; from none it begins where `settle` does. Asked for again until it
  /// is done it is within the tolerance what `settle` gives. Only if nothing settles and no result
  /// waits to be taken; false otherwise, and nothing is asked for. A later `settle` takes its place
  /// at once.
  bool settle_live(const AppState& state, std::shared_ptr<const DragState> from,
                   bool rests = false);
  /// Once.
  std::optional<LiveResult> take_live_result();

  /// Gives up what is under way and what waits to be taken, live or not.
  void cancel_settling();

  /// Cancels everything, and makes what follows with other kernels: the device was lost.
  void use_kernels(MakeKernels make_kernels, Upload upload = {});

  /// Cancels everything and lets go of what is ready, until the next `follow`.
  void cancel();

  PreparationStatus status() const;

  /// What was prepared; null until it is ready. Each stays usable while it is held. The worker
  /// settles by the exact one; what the window drags by is `drag_response`.
  std::shared_ptr<const DragPreview> preview() const;
  std::shared_ptr<const DeformSolver> exact() const;

  /// What carried objects follow, as results are made and drags are shown.
  const std::shared_ptr<AttachmentCache>& attachment_cache() const { return attachment_cache_; }

  struct ToDragBy {
    std::shared_ptr<const DragResponse> response;
    std::shared_ptr<BlendResponse> on_device;  ///< null without Upload
    bool is_exact = false;                     ///< rather than a preview
  };
  /// The best that is ready, for the handles that `drag_by` named or, until those are there, for
  /// those it named before. No response until one is.
  ToDragBy drag_response() const;

 private:
  struct Ready {
    std::shared_ptr<const DragPreview> preview;
    std::shared_ptr<const DeformSolver> exact;
    std::shared_ptr<Kernels> exact_kernels;
    std::shared_ptr<DragSession> drag;  ///< the worker's alone; null unless drags settle
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
    std::shared_ptr<const DragState> from;    ///< what it goes on from; null for none
    bool rests = false;                       ///< its hand
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

  // All below is guarded by the worker's mutex. Work under a ticket that is not the current one is
  // void.
  MakeKernels make_kernels_;
  Upload upload_;
  std::uint64_t ticket_ = 0;
  std::uint64_t settle_ticket_ = 0;
  std::uint64_t wanted_ticket_ = 0;  // of the last request; given up once another is current
  std::optional<AppState> followed_;
  std::optional<AppState> to_prepare_;
  std::vector<std::size_t> dragged_{0};  // ascending
  std::optional<Request> to_settle_;
  std::optional<SettledResult> result_;
  std::optional<LiveResult> live_result_;
  PreparationStatus status_;
  std::shared_ptr<Kept> kept_;
  Ready ready_;

  std::shared_ptr<const DragState> last_live_;    // the worker's alone
  Worker worker_;                                 // last: it uses all the others
};

}  // namespace lapwing::viewer
