#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "lapwing/io/mesh_file.h"
#include "state/history.h"
#include "state/journal.h"
#include "tools/preparation.h"

namespace lapwing::viewer {

/// One mesh being edited: its history, the journal that follows every step, and the worker that
/// prepares and settles what the state asks for. All but the drawing.
class EditSession {
 public:
  /// `file` is what was opened; without it, for a generated mesh, nothing is journalled. `journals`
  /// is a folder. The rest is Preparation's.
  EditSession(History history, std::optional<MeshStamp> file, const std::filesystem::path& journals,
              Preparation::MakeKernels make_kernels, std::function<void()> wake = {});

  const History& history() const { return history_; }
  const AppState& state() const { return history_.state(); }
  const Preparation& preparation() const { return preparation_; }

  /// A new step. Where it asks for a result that is under way when it returns. Throws what `apply`
  /// does.
  void perform(const Command& command);
  void undo();
  void redo();
  void go_to(std::size_t steps);
  /// Gives up the result under way; the handle stays moved, and can be undone.
  void cancel_settling() { preparation_.cancel_settling(); }

  /// Performs the result that has come, if one has. Call it when woken.
  bool take_result();

  /// Writes the surface as it is. Throws what `write_mesh` does.
  WriteReport save(const std::filesystem::path& path);
  /// Writes the recipe, which names the mesh from there. Throws IoError; InputError without a file.
  void save_recipe(const std::filesystem::path& path) const;

  /// Saved or given up: nothing to restore is left.
  void close();

  /// Why the journal cannot be written, once that is so; empty otherwise. Editing goes on.
  const std::string& warning() const { return warning_; }

 private:
  void follow();

  History history_;
  std::optional<MeshStamp> file_;
  std::optional<Journal> journal_;
  std::string warning_;
  Preparation preparation_;
};

}  // namespace lapwing::viewer
