#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "editing/editor.h"
#include "editing/part_library_view.h"
#include "tools/place_tool.h"
#include "work/transplant_preview.h"

namespace lapwing::viewer {

/// Lets the user make a transplant. Holds the library of parts, the current part and its preview.
/// The preview is the part alone while the user moves it, and the result of the step afterwards.
/// Reports errors to `say`.
class TransplantTool {
 public:
  TransplantTool(const std::shared_ptr<gpu::Context>& context, Say say, std::function<void()> wake);

  PartLibraryView& library() { return library_; }
  const PartLibraryView& library() const { return library_; }

  /// Reads a part in the background and makes it the current part.
  void take_part(const std::filesystem::path& file);
  /// Takes the next readable part of the library. After the last part, or if there is no current
  /// part, takes the first one.
  void take_next_part();
  /// Opens the recipe step at `index` for editing. Does nothing if it is not a transplant.
  void take_up(const Editor& editor, std::size_t index);
  /// Likewise, for the last transplant of the recipe.
  void take_up_last(const Editor& editor);
  std::optional<std::size_t> taken_up() const { return taken_up_; }
  /// Discards the current part unless its step was applied.
  void close(Editor& editor);

  /// Returns whether there is a current part or one is being read.
  bool is_open() const { return begin_ || is_reading_ || has_part(); }
  bool has_part() const { return tool_.stage() != PlaceTool::Stage::empty; }
  bool is_reading() const { return begin_ || is_reading_; }
  PlaceTool& tool() { return tool_; }
  const PlaceTool& tool() const { return tool_; }
  const TransplantPreview& preview() const { return preview_; }
  /// Returns the boundary loop of the hole in the surface. Empty while it is unknown.
  std::span<const Eigen::Vector3d> hole() const;

  /// Returns whether the ROI is the hole. Otherwise the hole is a disk around the part.
  bool takes_roi() const { return takes_roi_; }
  void take_roi(bool on);

  /// Applies the step, with the preview's result if that is ready.
  void apply(Editor& editor);

  /// Call this once per frame, after the editor's update.
  void update(Editor& editor);

  void release_device();
  void use_device(const std::shared_ptr<gpu::Context>& context);

 private:
  // The functions that read the current part. They run in the background.
  struct Begin {
    std::function<AppState(const AppState& now, Kernels&, const Progress&)> host;
    std::function<TransplantDraft(const AppState& host)> draft;
  };
  struct InHand {
    TransplantDraft draft;
    TransplantHost host;
    // The vertices of the surface, followed by those of the part at their positions in its file.
    std::shared_ptr<const Mesh> mesh;
  };
  enum class Shown { nothing, carried, result };

  static InHand in_hand(const Begin& begin, const AppState& now, Kernels& kernels,
                        const Progress& progress);
  void start_reading(const Editor& editor);
  void take_read(Editor& editor);
  bool stands_on_other_surface(const AppState& now) const;
  void reset_history(Editor& editor);
  void take_hole(const Editor& editor);
  void show(Editor& editor);
  void show_carried(Editor& editor);
  void show_result(Editor& editor);
  void close_applied(Editor& editor);
  bool finish_applying(Editor& editor);

  Say say_;
  PartLibraryView library_;
  std::optional<Begin> begin_;  // to read once no result is awaited
  bool is_reading_ = false;
  bool lends_ = true;  // whether reading activates the tool
  std::optional<std::size_t> taken_up_;
  // The editor's surface for which the current part was read.
  std::shared_ptr<const Mesh> rest_;
  std::shared_ptr<const MovedVertices> settled_;

  PlaceTool tool_;
  std::shared_ptr<const Mesh> mesh_;  // as in InHand
  Positions positions_;               // of `mesh_`, with the part at its place
  bool takes_roi_ = false;
  std::vector<Eigen::Vector3d> hole_;

  Shown shown_ = Shown::nothing;
  std::uint64_t shown_version_ = 0;     // of the part's placement
  std::optional<std::size_t> applies_;  // `done()` of the history before the step began
  TransplantPreview preview_;
  Job<InHand> reader_;
};

}  // namespace lapwing::viewer
