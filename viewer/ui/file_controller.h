#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/load_file.h"
#include "ui/file_dialogs.h"
#include "work/job.h"

namespace lapwing::viewer {

/// Opens and saves documents, and asks before unsaved changes are lost. Draws the start panel and
/// the questions about unsaved and interrupted edits.
class FileController {
 public:
  /// Journals are kept in the folder `journals`. `opened` is called after another document was
  /// opened, or restored after a crash.
  FileController(std::unique_ptr<Document>& document, const std::shared_ptr<gpu::Context>& context,
                 std::filesystem::path journals, FileDialogs& dialogs, Messages& messages, Say say,
                 std::function<void(bool is_restored)> opened);

  /// Opens a file. The files in `carry` follow the surface from the first edit in the viewer on. If
  /// loading fails, the user is asked for another file for the purpose `asked_for`.
  void open(const std::filesystem::path& file, const std::vector<std::filesystem::path>& carry = {},
            std::optional<PathPurpose> asked_for = {});
  /// From now on, `take_loaded` throws the exception if a file cannot be loaded.
  void rethrow_errors() { rethrows_ = true; }
  /// Offers to restore edits that a crash interrupted.
  void offer_interrupted();
  /// Runs `action`, which closes the document. If there are unsaved changes, asks the user first.
  void leave_for(std::function<void()> action);
  /// Runs `action` once the surface has settled. If settling fails, reports that nothing was saved.
  void once_settled(std::function<void()> action);
  /// Uses a path that the user has chosen for anything but an image.
  void use(const ChosenPath& chosen);
  /// Saves the mesh where it was saved before, or asks for a path.
  void save();
  void save_carried();

  /// Shows a document that has been loaded. Call this once per frame, before the document is
  /// updated.
  void take_loaded();
  /// Performs a save that waits for the surface to settle. Warns if a saved recipe does not
  /// reproduce the surface. Call this once per frame, after the document is updated.
  void take_settled();
  void show_start() { show_start_ = true; }
  /// Whether the start panel covers a document.
  bool is_start_over_document() const { return show_start_ && document_; }
  bool is_loading() const { return loader_.status().busy; }
  /// Appends what is being loaded. Returns false if nothing is.
  bool append_status(std::string& text) const;
  /// Whether a dialog of this class waits for an answer.
  bool asks() const { return leaving_for_ || !interrupted_.empty(); }
  /// Cancels loading, and closes all dialogs of this class.
  void cancel();
  void draw_start();
  void draw_unsaved();
  /// Call this after the context was replaced.
  void use_device();

 private:
  using Load = std::function<LoadedFile(Kernels& kernels, const Progress& progress)>;
  struct Loading {
    std::filesystem::path file;
    std::optional<PathPurpose> asked_for = {};
  };
  /// Starts `load` on another thread. Cancels the previous load if it is not finished.
  void load(Loading what, Load load);
  void show(LoadedFile file);
  void go_on_with(LoadedFile replay);
  void take_recipe_check();
  /// Saves the mesh, and runs `then` if that succeeds.
  void save_to(const std::filesystem::path& path, std::function<void()> then = {});
  void save_recipe(const std::filesystem::path& path);
  void save_repaired(const std::filesystem::path& path);
  void say(const WriteReport& report) const;
  void draw_interrupted();

  std::unique_ptr<Document>& document_;
  const std::shared_ptr<gpu::Context>& context_;
  std::filesystem::path journals_;
  FileDialogs& dialogs_;
  Messages& messages_;
  Say say_;
  std::function<void(bool is_restored)> opened_;
  Job<LoadedFile> loader_;
  Loading loading_;
  std::filesystem::path template_landmarks_;  // chosen; those of the scan are asked for
  Load load_again_;  // repeats the load once if the device fails; empty afterwards
  bool rethrows_ = false;
  std::exception_ptr failure_;  // an error that another device would not fix
  bool show_start_ = true;
  std::string start_trouble_;  // why the last file could not be opened
  std::vector<InterruptedEdit> interrupted_;
  std::function<void()> saving_;       // waits for the surface to settle
  std::function<void()> leaving_for_;  // waits for the user to save or discard the edit
};

}  // namespace lapwing::viewer
