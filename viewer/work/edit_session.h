#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "lapwing/io/file_bytes.h"
#include "lapwing/io/mesh_file.h"
#include "state/history.h"
#include "state/journal.h"
#include "state/revision.h"
#include "work/job.h"
#include "work/preparation.h"

namespace lapwing::viewer {

/// The effect of a step that was carried out in the background.
struct StepTaken {
  bool changed_triangles = false;  ///< if true, the selection was cleared
  std::vector<std::string> warnings;
};

/// Edits one mesh without drawing it. Owns the history, the journal and two background threads. One
/// thread prepares and settles deformations, and the other carries out whole steps.
class EditSession {
 public:
  /// `file` is the opened mesh file. A generated mesh has neither a file nor a journal. `journals`
  /// is the folder of the journals. If `restored` is not null, `history` must be the result of
  /// `restore_after_crash` for that edit. The constructor then copies the stored results and the
  /// mesh of that edit to the new journal. If `warning` is empty afterwards, the caller may
  /// `discard` the restored edit. The other arguments are those of Preparation.
  EditSession(History history, std::optional<MeshStamp> file, const std::filesystem::path& journals,
              Preparation::MakeKernels make_kernels, std::function<void()> wake = {},
              Preparation::Upload upload = {}, const InterruptedEdit* restored = nullptr);

  const History& history() const { return history_; }
  const AppState& state() const { return history_.state(); }
  const Preparation& preparation() const { return preparation_; }
  /// Returns the path of the opened file, which is the default for saving. Empty for a generated
  /// mesh.
  std::filesystem::path file() const { return file_ ? file_->path : std::filesystem::path(); }

  /// Performs a command. If the new state has no result for its moves, requests this result, as
  /// undo and redo also do. The computation starts from the displayed pose `shown` if it is not
  /// null. Throws the errors of `apply`.
  void perform(const Command& command, Joining joining = Joining::own_step,
               std::shared_ptr<const DragState> shown = nullptr);
  void undo();
  void redo();
  void go_to(std::size_t steps);
  /// Replaces the history by one that has the same start, but more or fewer steps.
  void continue_with(History history);
  /// Cancels the computation of the result. The handle stays moved, and the move can be undone.
  void cancel_settling() { preparation_.cancel_settling(); }

  /// Cancels preparation and settling. They restart after `prepare` or the next step.
  void cancel_preparation() { preparation_.cancel(); }
  /// Starts the preparation. If the state needs a result, requests it, starting from `shown`.
  void prepare(std::shared_ptr<const DragState> shown = nullptr);

  /// Prepares again with kernels on another device. Call this after the device was lost.
  void use_kernels(Preparation::MakeKernels make_kernels, Preparation::Upload upload = {});

  /// If the result is computed, adds it to the history and returns true. Call this after `wake`.
  bool take_result();
  /// Returns whether the result of the state's moves is being computed. Returns false after the
  /// computation was cancelled or has failed.
  bool awaits_result() const { return needs_settling(state()) && preparation_.will_settle(); }

  /// Returns the pose from which a drag starts, which is the state's result. Returns null if the
  /// state has no result or no preview is ready; a drag then starts from the rest shape.
  std::shared_ptr<const DragState> pose() const;

  /// Sets the handles that the next drag will move (Preparation::drag_by).
  void drag_by(std::span<const std::size_t> handles) { preparation_.drag_by(handles); }

  /// Requests the settled surface for the current frame of a drag (Preparation::settle_live).
  /// `moves` has one entry per handle. Does nothing while another result is computed, so call this
  /// in every frame. Steps, undo, redo and `cancel_settling` cancel the request.
  void settle_live(std::span<const HandleMove> moves, std::shared_ptr<const DragState> from,
                   bool rests = false);
  /// Returns the result of `settle_live`, once. This result is never added to the history.
  std::optional<LiveResult> take_live_result() { return preparation_.take_live_result(); }

  /// Carries out `step` on the current surface on the background thread. Cancels the previous step
  /// if it is still being carried out. `take_step` adds the result to the history as one step. File
  /// paths in `step` are relative to `folder()`. Throws InputError if the result of a drag is not
  /// yet computed.
  void carry_out(const Step& step);
  /// Replaces step `index` of the recipe by `step`. Carries out this step and all later steps on
  /// the background thread, like `carry_out`. Also throws the errors of `revision_of`.
  void replace_step(std::size_t index, const Step& step);
  /// Reads `files`, relative to `folder()`, on the background thread. Their points and meshes
  /// follow the surface, starting with the open step. Each file becomes one step of the history.
  /// Throws InputError while a step is being carried out.
  void carry_along(const std::vector<std::filesystem::path>& files);
  /// Cancels the current background step. The state does not change.
  void cancel_step();
  /// Returns true from the start of a background step until `take_step` returns it or it is
  /// cancelled.
  bool is_carrying_out() const { return carried_out_on_.has_value(); }
  WorkStatus step_status() const { return carrying_out_.status(); }
  /// If the background thread has finished a step, adds it to the history. If the step has failed,
  /// rethrows its exception once. A change of the surface cancels the step. A change of the
  /// selection or the parameters also cancels a step that was started by `replace_step`. Call this
  /// after `wake`.
  std::optional<StepTaken> take_step();

  /// Returns the folder of the mesh file, or the current folder for a generated mesh.
  std::filesystem::path folder() const;

  /// Returns the certificate of the state's result, or null without a result.
  const Certificate* certificate() const;

  /// Writes the surface to `path`, and the carried files to the same folder, as a run of the recipe
  /// does. Throws the errors of `write_mesh` and `require_targets`. Throws InputError if the result
  /// of a drag is not yet computed, or if a step reads `path`. Also throws InputError if `path` is
  /// the opened file and a .gltf file with external buffers, because a copy of the original would
  /// not include these buffers.
  WriteReport save(const std::filesystem::path& path);
  /// Writes only the carried files, to the folder of `path`.
  WriteReport save_carried(const std::filesystem::path& path) const;
  /// Writes the recipe to `path`. The recipe names the opened mesh file relative to `path`. If
  /// `save` has overwritten this file, a run of the recipe would apply the edit twice. The recipe
  /// then starts from a copy of the original, which is written beside the recipe. Returns the path
  /// of this copy, or an empty path if there is none. Throws IoError. Throws InputError if the mesh
  /// has no file, or if the result of a drag is not yet computed.
  std::filesystem::path save_recipe(const std::filesystem::path& path);
  /// If a handle has a path, `save_recipe` also runs the recipe in the background. Returns, once,
  /// the largest distance between a vertex of the surface and the same vertex of this run's result,
  /// divided by the diagonal of the mesh. If the run fails, rethrows its exception once. Call this
  /// after `wake`.
  std::optional<double> take_recipe_check();

  /// Deletes the journal and cancels all background work. Call this when the user has saved or
  /// discarded the edit.
  void close();

  /// Returns the reason why the journal cannot be written, or an empty string. The user can
  /// continue the edit without a journal.
  const std::string& warning() const { return warning_; }

 private:
  void start_journal(const std::filesystem::path& journals, const InterruptedEdit* restored);
  void follow(std::shared_ptr<const DragState> shown = nullptr);
  std::vector<AttachmentFile> carried_for(const std::filesystem::path& path) const;
  void keep_original_of(const std::filesystem::path& path);
  void keep_step_if_wanted();

  // The result of background work: commands that apply it to the state, and warnings.
  struct StepResult {
    std::vector<Command> commands;
    std::vector<std::string> warnings;
  };

  // The parts of the state that must not change while a step is carried out.
  enum class Needs { nothing, surface, surface_and_choice };

  History history_;
  std::optional<MeshStamp> file_;
  /// The original contents of the opened file. Set when `save` replaces the file.
  std::optional<FileBytes> original_;
  std::optional<Journal> journal_;
  std::string warning_;
  std::optional<AppState> carried_out_on_;
  Needs needs_ = Needs::nothing;
  Preparation preparation_;
  Job<StepResult> carrying_out_;
  Job<double> checking_recipe_;
};

}  // namespace lapwing::viewer
