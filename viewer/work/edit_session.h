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

/// What carrying a step out beside the window has led to.
struct StepTaken {
  bool changed_triangles = false;  ///< then nothing is chosen any more
  std::vector<std::string> warnings;
};

/// One mesh being edited: its history, the journal that follows every step, the worker that
/// prepares and settles what the state asks for, and the one that carries whole steps out. All but
/// the drawing.
class EditSession {
 public:
  /// `file` is what was opened; without it, for a generated mesh, nothing is journalled. `journals`
  /// is a folder. The rest is Preparation's.
  EditSession(History history, std::optional<MeshStamp> file, const std::filesystem::path& journals,
              Preparation::MakeKernels make_kernels, std::function<void()> wake = {},
              Preparation::Upload upload = {});

  /// Goes on with an interrupted edit: `history` is what `restore` made of it. Journals under the
  /// name that the mesh was opened by, and keeps the results of the edit and its copy of the mesh
  /// where it has one, so that `discard(edit)` may follow unless there is a `warning`.
  EditSession(const InterruptedEdit& edit, History history, const std::filesystem::path& journals,
              Preparation::MakeKernels make_kernels, std::function<void()> wake = {},
              Preparation::Upload upload = {});

  const History& history() const { return history_; }
  const AppState& state() const { return history_.state(); }
  const Preparation& preparation() const { return preparation_; }
  /// What was opened, also of a restored edit, and not the copy that its steps start from: where
  /// saving goes. Empty for a generated mesh.
  std::filesystem::path file() const { return file_ ? file_->path : std::filesystem::path(); }

  /// A new step, or joined to the last. Throws what `apply` does. Wherever the state waits for a
  /// result, after undo and redo, too, that is under way on return.
  /// A result that it waits for is the one that the pose `shown` leads to, if there is one: the
  /// surface on the screen.
  void perform(const Command& command, Joining joining = Joining::own_step,
               std::shared_ptr<const DragState> shown = nullptr);
  void undo();
  void redo();
  void go_to(std::size_t steps);
  /// Goes on with a history that began as this one does, with steps more or fewer.
  void continue_with(History history);
  /// Gives up the result under way; the handle stays moved, and can be undone.
  void cancel_settling() { preparation_.cancel_settling(); }

  /// Gives up the preparation and all that settles, until `prepare` or the next step.
  void cancel_preparation() { preparation_.cancel(); }
  /// Starts what was given up again, with the result that the state waits for.
  void prepare(std::shared_ptr<const DragState> shown = nullptr);

  /// The device was lost: goes on with kernels on another one, prepared anew.
  void use_kernels(Preparation::MakeKernels make_kernels, Preparation::Upload upload = {});

  /// Performs the result that has come, if one has. Call it when woken.
  bool take_result();
  /// Whether the result that the state waits for is still to come; false where it was given up or
  /// failed.
  bool awaits_result() const { return needs_settling(state()) && preparation_.will_settle(); }

  /// Where the surface stands for a drag to begin from: at the result that the state has. Null for
  /// the rest shape, where the state waits for its result, and while no preview is ready.
  std::shared_ptr<const DragState> pose() const;

  /// Which handles the next drag moves (Preparation::drag_by).
  void drag_by(std::span<const std::size_t> handles) { preparation_.drag_by(handles); }

  /// Asks for the result of `moves`, one per handle, which are not in the state: those of a drag
  /// under way, brought on from the pose `from` (Preparation::settle_live). Only if nothing else
  /// settles; does nothing otherwise, so call it as often as they change. Every step, undo and redo
  /// wins over it, as `cancel_settling` does where it is given up.
  void settle_live(std::span<const HandleMove> moves, std::shared_ptr<const DragState> from,
                   bool rests = false);
  /// That result, once. Never a step of the history.
  std::optional<LiveResult> take_live_result();

  /// Carries `step` out beside the window, on the surface as it is; its result becomes one step of
  /// the history by `take_step`. Takes the place of what is being carried out. Files that it names
  /// are looked for in `folder()`. Throws InputError while a drag waits for its result.
  void carry_out(const Step& step);
  /// Takes the `index`th step of the recipe up again, as `step` is now, and carries out anew what
  /// follows it; one step of the history, likewise. Throws what `revision_of` does, and InputError
  /// while a drag waits for its result.
  void replace_step(std::size_t index, const Step& step);
  /// Reads `files` beside the window, looked for in `folder()`, to be carried along from the open
  /// step on: one step of the history each, likewise. Throws InputError while something is carried
  /// out, which would be lost.
  void carry_along(const std::vector<std::filesystem::path>& files);
  /// Gives it up; nothing has changed then.
  void cancel_step();
  /// Whether a step is, until it is taken or given up.
  bool is_carrying_out() const { return carried_out_on_.has_value(); }
  WorkStatus step_status() const { return carrying_out_.status(); }
  /// Performs what has been carried out, if something has. Throws what carrying it out threw, once,
  /// and nothing has changed then. Where meanwhile the surface has become another one, or for
  /// `replace_step` what is chosen, it was given up. Call it when woken.
  std::optional<StepTaken> take_step();

  /// Where files that steps name are looked for: the mesh file's folder, or the current one.
  std::filesystem::path folder() const;

  /// Of the result that the state shows; null without one.
  const Certificate* certificate() const;

  /// Writes the surface as it is, and before it what is carried along, as a run does beside its
  /// result at `path`. Throws what `write_mesh` does, what `require_targets` does before anything
  /// is written, and InputError while a drag waits for its result: half of a step is never saved.
  /// Also throws InputError if `path` is a file that a step reads, or the opened file is a .gltf
  /// whose numbers are in other files, which no copy of it would keep.
  WriteReport save(const std::filesystem::path& path);
  /// The same without the surface.
  WriteReport save_carried(const std::filesystem::path& path) const;
  /// Writes the recipe, which names the opened mesh relative to `path`. If `save` has replaced the
  /// opened mesh by the result, the original is first written beside the recipe, and the recipe
  /// names that copy: otherwise running it would apply the edit twice. Returns the copy's path, or
  /// an empty path. Throws IoError; InputError without a file, and while a drag waits for its
  /// result.
  std::filesystem::path save_recipe(const std::filesystem::path& path);
  /// How far the surface is from what a run of the recipe saved last makes of it, as a share of the
  /// mesh's diagonal: once, when that is known. Carried out beside the window, and only where a
  /// handle went far, since elsewhere a run ends in the same minimum. Throws what the run threw,
  /// once. Call it when woken.
  std::optional<double> take_recipe_check();

  /// Saved or given up: nothing to restore is left.
  void close();

  /// Why the journal cannot be written, once that is so; empty otherwise. Editing goes on.
  const std::string& warning() const { return warning_; }

 private:
  void start_journal(const std::filesystem::path& journals, const InterruptedEdit* restored);
  void follow(std::shared_ptr<const DragState> shown = nullptr);
  std::vector<CarriedFile> carried_for(const std::filesystem::path& path) const;
  void keep_original_of(const std::filesystem::path& path);
  void keep_step_if_wanted();

  // What comes of carrying a step out, to be performed.
  struct StepResult {
    std::vector<Command> commands;
    std::vector<std::string> warnings;
  };

  // What of the state must stay as it is while a step is carried out.
  enum class Needs { nothing, surface, surface_and_choice };

  History history_;
  std::optional<MeshStamp> file_;
  /// The opened file as it was, once `save` has replaced it.
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
