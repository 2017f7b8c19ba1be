#pragma once

#include <string>
#include <utility>

#include "editing/detail_transfer_tool.h"
#include "editing/editor.h"
#include "editing/mesh_step_tool.h"
#include "editing/transplant_tool.h"
#include "editing/wrap_tool.h"
#include "files/load_file.h"
#include "ui/doctor_banner.h"

namespace lapwing::viewer {

/// An open mesh with its edit and the desks of the tasks.
struct Document {
  Document(LoadedFile file, const std::filesystem::path& journals,
           const std::shared_ptr<gpu::Context>& context, Say say, std::function<void()> wake)
      : opened(file.opened),
        title(opened.name + " - Lapwing"),
        unsaved_title(opened.name + "* - Lapwing"),
        report(std::move(file.report)),
        closed_outward(file.closed_outward),
        editor({std::move(file.history), opened.mesh, opened.file, std::move(file.restored),
                journals, opened.colors},
               context, say, wake),
        banner(opened.name, opened.mesh, report, wake),
        desk(opened.up_axis, context, say, wake),
        mesh_steps(opened.mesh, report, context, wake),
        transplant(context, say, wake),
        wrap(opened.up_axis, context, std::move(say), std::move(wake)) {}

  OpenedMesh opened;
  /// Opens a coat, a mix, a wrap or a transplant of the edit again.
  void edit_step(std::size_t index) {
    if (desk.take_up(editor, index) || wrap.take_up(editor, index)) return;
    transplant.take_up(editor, index);
  }
  /// Opens a coat with the detail of a scan that the mesh covers.
  void coat_detail(const std::filesystem::path& scan) {
    desk.begin(editor, LayerDraft::Operation::coat);
    desk.use_source(0, scan, true);
  }
  /// Returns whether an open operation shows a preview on the surface.
  bool has_open_task() const { return desk.is_open() || transplant.is_open() || wrap.is_open(); }
  /// Returns the view of the mesh beside the edited one, or null.
  SourceView* source() {
    return wrap.is_open() ? wrap.view() : desk.is_open() ? desk.view() : nullptr;
  }
  /// Returns the titles of the two panes.
  std::pair<std::string, std::string> pane_names() const {
    if (wrap.is_open()) {
      return {"Scan: " + wrap.scan().filename().string(), "Template: " + opened.name};
    }
    const std::filesystem::path& mesh = desk.draft().sources[desk.current()].mesh;
    const char* which = desk.draft().source_count() == 1 ? "Source: "
                        : desk.current() == 0            ? "First source: "
                                                         : "Second source: ";
    return {which + (mesh.empty() ? "this mesh" : mesh.filename().string()),
            "Target: " + opened.name};
  }
  /// Names the window after the file that holds the edit.
  void set_title(const std::string& name) {
    title = name + " - Lapwing";
    unsaved_title = name + "* - Lapwing";
  }

  std::string title;  ///< of the window
  std::string unsaved_title;
  CheckReport report;
  bool closed_outward;
  Editor editor;
  DoctorBanner banner;
  DetailTransferTool desk;
  MeshStepTool mesh_steps;
  TransplantTool transplant;
  WrapTool wrap;
  /// Where Save writes without asking: chosen by the first save, so that the opened file is never
  /// replaced by accident. Empty until then.
  std::filesystem::path save_path;
};

}  // namespace lapwing::viewer
