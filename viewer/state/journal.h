#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/io/file_descriptor.h"
#include "state/draft.h"
#include "state/kept_results.h"

namespace lapwing::viewer {

/// A mesh file as it was when it was opened.
struct MeshStamp {
  std::filesystem::path path;  ///< absolute
  std::uint64_t bytes = 0;
  std::int64_t modified = 0;  ///< of the file's clock, in its units

  bool operator==(const MeshStamp&) const = default;
};

/// Throws IoError when there is no such file.
MeshStamp stamp_of(const std::filesystem::path& mesh);

/// Where journals are: lapwing/ in $XDG_CACHE_HOME, or in ~/.cache.
std::filesystem::path journal_folder();

struct InterruptedEdit;

/// An append-only record of one edit, so that a crash loses no step. One JSON line each: first the
/// mesh, then what every step changed of the draft, and the place of its settled surface in the
/// results file (kept_results.h). A step is on the disk when `record` returns; its surface is, too,
/// unless it could not be written.
class Journal {
 public:
  /// Starts a journal in `folder`, which is made if it is not there, and locks it while it is open.
  /// Throws IoError when it cannot be written, and InputError when the mesh's name is no UTF-8.
  Journal(const std::filesystem::path& folder, const MeshStamp& mesh);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal() = default;  ///< leaves the file, as a crash does

  /// The edit is here now. Writes nothing where that is nothing new. Throws IoError, and InputError
  /// for a name of a file that is no UTF-8.
  void record(const AppState& state);

  /// Copies the results of an edit that is restored. Call before the first `record`.
  void keep_results_of(const InterruptedEdit& edit);

  /// The mesh file is about to be replaced by the result: a copy of it is kept beside the journal,
  /// since the steps start from there. Nothing after the first time. Throws IoError.
  void keep_mesh() { keep_mesh(mesh_.path); }
  /// The steps start from `mesh`, not from the file, which was replaced before: a copy is kept
  /// likewise, and `mesh` may go. Throws IoError.
  void keep_mesh(const std::filesystem::path& mesh);

  /// The edit is done with, saved or given up: the file goes, and those beside it.
  void close();

  const std::filesystem::path& path() const { return path_; }

 private:
  void append(const std::string& line);
  void keep_result(const Draft& draft, const MovedVertices& result);
  bool open_results();

  std::filesystem::path path_;
  FileDescriptor file_;
  FileDescriptor results_{-1};  ///< opened for the first result
  MeshStamp mesh_;
  bool mesh_is_kept_ = false;
  Draft last_;
};

/// A journal that nobody closed, whose writer is gone.
struct InterruptedEdit {
  std::filesystem::path journal;
  std::filesystem::path opened;               ///< the mesh as it was called
  MeshStamp mesh;                             ///< what the steps start from: that, or a copy of it
  bool mesh_is_unchanged = false;             ///< still what it was
  Draft draft;                                ///< for `restore`
  KeptResults results;                        ///< in the results file
  std::filesystem::file_time_type last_step;  ///< when it was recorded

  bool is_empty() const { return draft.steps.empty() && draft.open == DeformRequest{}; }
  /// Whether the file was saved over, and `mesh` is the copy of what it was.
  bool has_copy() const { return mesh.path != opened; }
  /// How many edits the recipe has: those committed, and the open one once a handle is moved.
  std::size_t step_count() const;
};

/// The kept result of the state's open step; nothing if none was kept.
std::optional<MovedVertices> kept_result(const InterruptedEdit& edit, const AppState& state);

/// What a journal says, also while its program runs; nothing where it cannot be read. A last line
/// that was not written out counts as not written.
std::optional<InterruptedEdit> read_journal(const std::filesystem::path& path);

/// The interrupted edits of `folder`, the latest first: journals that can be read, of programs that
/// no longer run.
std::vector<InterruptedEdit> find_interrupted(const std::filesystem::path& folder);

/// The edit was restored, and its steps are in a journal of their own (EditSession writes it); or
/// nobody wants it.
void discard(const InterruptedEdit& edit);

}  // namespace lapwing::viewer
