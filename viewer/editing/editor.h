#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "editing/tool_input.h"
#include "work/certificate_words.h"

namespace lapwing::viewer {

/// The edit with which an Editor starts.
struct EditStart {
  History history;
  std::shared_ptr<const Mesh> opened;            ///< the mesh before all steps, for `show_before`
  std::optional<MeshStamp> file;                 ///< see EditSession
  std::optional<InterruptedEdit> restored;       ///< the edit from which `history` was restored
  std::filesystem::path journals;                ///< see EditSession
  std::shared_ptr<const FilePaint> colors = {};  ///< null if the file has no colours
};

/// Edits one mesh in a window. Owns the session and the parts that work on it. Each part uses only
/// the members declared before it. The window calls the parts directly.
class Editor {
 public:
  /// The worker creates its kernels on `context`. It calls `wake` when its status has changed.
  Editor(EditStart start, const std::shared_ptr<gpu::Context>& context, Say say,
         const std::function<void()>& wake);
  Editor(const Editor&) = delete;
  Editor& operator=(const Editor&) = delete;

  /// Releases everything on the device, after it was lost.
  void release_device();
  /// Makes it again on `context`. Nothing else may be called in between.
  void use_device(const std::shared_ptr<gpu::Context>& context);

  /// Takes the results of the background threads and moves the surface with the drag. Call this
  /// once per frame, before drawing and after the device has finished the last frame.
  void update();

  const EditSession& session() const { return session_; }
  EditSession& session() { return session_; }
  const AppState& state() const { return session_.state(); }
  ActiveTool& tool() { return active_; }
  const ActiveTool& tool() const { return active_; }
  SurfaceView& view() { return view_; }
  const SurfaceView& view() const { return view_; }
  LiveDrag& drag() { return drag_; }
  const LiveDrag& drag() const { return drag_; }
  ActionQueue& actions() { return actions_; }
  const ActionQueue& actions() const { return actions_; }
  ToolInput& input() { return input_; }
  const ToolInput& input() const { return input_; }

  void say(Message message) const { say_(std::move(message)); }
  /// Returns the bounds of everything that is drawn.
  Bounds bounds() const { return drag_.united_with(view_.bounds()); }
  /// Returns true if nothing holds the surface against its only handle (`moves_as_a_whole`).
  bool moves_as_a_whole() const { return moves_as_a_whole_; }
  /// The problems of the result that is shown.
  const std::vector<CertificateWarning>& warnings() const { return warnings_; }

 private:
  void state_changed(bool by_result = false);

  Say say_;
  EditSession session_;
  ActiveTool active_;
  SurfaceView view_;
  LiveDrag drag_;
  ActionQueue actions_;
  ToolInput input_;
  bool moves_as_a_whole_ = false;
  std::vector<CertificateWarning> warnings_;
};

}  // namespace lapwing::viewer
