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

/// A transplant made by hand: the parts to choose from, the one in hand, and what the editor shows
/// of it. That is the part itself while it is carried or dragged, then the result of the step.
/// Reports errors to `say`.
class TransplantTool {
 public:
  TransplantTool(const std::shared_ptr<gpu::Context>& context, Say say, std::function<void()> wake);

  PartLibraryView& library() { return library_; }
  const PartLibraryView& library() const { return library_; }

  /// Reads a part in the background and takes it in hand, in place of the last one.
  void take_part(const std::filesystem::path& file);
  /// Takes the part after the current one in the library, or the first part if there is none.
  void take_next_part();
  /// Edits the `index`th step of the recipe again. Reports an error.
  void take_up(const Editor& editor, std::size_t index);
  /// The same for the last transplant.
  void take_up_last(const Editor& editor);
  std::optional<std::size_t> taken_up() const { return taken_up_; }
  /// Drops what was not applied.
  void close(Editor& editor);

  /// Whether a part is being read or in hand.
  bool is_open() const { return begin_ || is_reading_ || has_part(); }
  bool has_part() const { return tool_.stage() != PlaceTool::Stage::empty; }
  bool is_reading() const { return begin_ || is_reading_; }
  PlaceTool& tool() { return tool_; }
  const PlaceTool& tool() const { return tool_; }
  const TransplantPreview& preview() const { return preview_; }
  /// The hole's loop in the surface; empty while it is unknown.
  std::span<const Eigen::Vector3d> hole() const;

  /// Whether the ROI is the hole, also when it changes. Otherwise the hole is a disk around the
  /// part.
  bool takes_roi() const { return takes_roi_; }
  void take_roi(bool on);

  /// Applies the step, with the preview's result if that is ready.
  void apply(Editor& editor);

  /// Call this once per frame, after the editor's update.
  void update(Editor& editor);

  void release_device();
  void use_device(const std::shared_ptr<gpu::Context>& context);

 private:
  // How to take a part in hand; runs in the background.
  struct Begin {
    std::function<AppState(const AppState& now, Kernels&, const Progress&)> host;
    std::function<TransplantDraft(const AppState& host)> draft;
  };
  struct InHand {
    TransplantDraft draft;
    TransplantHost host;
    // The surface, followed by the part as it is in its file.
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
  bool finish_applying(Editor& editor);

  Say say_;
  PartLibraryView library_;
  std::optional<Begin> begin_;  // to read once no result is awaited
  bool is_reading_ = false;
  bool lends_ = true;  // whether reading activates the tool
  std::optional<std::size_t> taken_up_;
  // The editor's surface for which the part in hand was read.
  std::shared_ptr<const Mesh> rest_;
  std::shared_ptr<const MovedVertices> settled_;

  PlaceTool tool_;
  std::shared_ptr<const Mesh> mesh_;  // as in InHand
  Positions positions_;               // of `mesh_`, with the part at its place
  bool takes_roi_ = false;
  std::vector<Eigen::Vector3d> hole_;

  Shown shown_ = Shown::nothing;
  std::uint64_t shown_version_ = 0;     // of the part's placement
  std::optional<std::size_t> applies_;  // `done()` of the history before a step under way
  TransplantPreview preview_;
  Job<InHand> reader_;
};

}  // namespace lapwing::viewer
