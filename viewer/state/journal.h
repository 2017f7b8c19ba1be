#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/io/file_bytes.h"
#include "state/draft.h"
#include "state/kept_results.h"

namespace lapwing::viewer {

/// The path, size and modification time of a mesh file when it was opened.
struct MeshStamp {
  std::filesystem::path path;  ///< absolute
  std::uint64_t bytes = 0;
  std::int64_t modified = 0;  ///< in the units of the file clock

  bool operator==(const MeshStamp&) const = default;
};

/// Throws IoError if there is no such file.
MeshStamp stamp_of(const std::filesystem::path& mesh);

/// Returns the folder of journals: lapwing/ in $XDG_CACHE_HOME, or in ~/.cache.
std::filesystem::path journal_folder();

struct InterruptedEdit;

/// Records one edit in an append-only file, so that a crash loses no step. Each line is JSON. The
/// first line describes the mesh. A later line stores the change of the draft by one step, the
/// position of a settled surface in the results file (kept_results.h), or a new path of the mesh.
/// When `record` returns, the step is on the disk.
class Journal {
 public:
  /// Creates a journal in `folder`, and creates the folder if necessary. The file remains locked
  /// while the journal exists. Throws IoError. Throws InputError if the mesh's name is not UTF-8.
  Journal(const std::filesystem::path& folder, const MeshStamp& mesh);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal() = default;  ///< does not delete the file

  /// Records the current state. Writes nothing if it has not changed since the last call. Throws
  /// IoError. Throws InputError if the name of a file is not UTF-8.
  void record(const AppState& state);

  /// Copies the results and the undone steps of a restored edit. Call this before the first
  /// `record`. Throws IoError.
  void continue_from(const InterruptedEdit& edit);

  /// Copies the opened mesh file into the journal's folder, because the steps start from this mesh.
  /// Call this before the result overwrites the file. Further calls do nothing. Throws IoError.
  void keep_mesh() { keep_mesh(mesh_.path); }
  /// Copies `mesh` instead. Use this if the opened file has already been overwritten.
  void keep_mesh(const std::filesystem::path& mesh);

  /// Deletes the journal and the files beside it. Call this when the edit is saved or discarded.
  void close();

  const std::filesystem::path& path() const { return path_; }

 private:
  void append(const std::string& line);
  void record(Draft draft);
  void keep_result(const Draft& draft, const MovedVertices& result);
  bool open_results();

  std::filesystem::path path_;
  FileDescriptor file_;
  FileDescriptor results_{-1};  ///< opened for the first result
  MeshStamp mesh_;
  bool mesh_is_kept_ = false;
  Draft last_;
};

/// The contents of a journal that was not closed by `Journal::close`.
struct InterruptedEdit {
  std::filesystem::path journal;
  std::filesystem::path opened;               ///< the mesh file that was opened
  MeshStamp mesh;                             ///< the mesh before the steps: `opened` or a copy
  bool mesh_is_unchanged = false;             ///< whether the file at `mesh.path` matches `mesh`
  Draft draft;                                ///< the steps for `restore_after_crash`
  std::vector<Draft> undone;                  ///< the drafts that redo could reach, in order
  KeptResults results;                        ///< positions in the results file
  std::filesystem::file_time_type last_step;  ///< time at which the last step was recorded

  /// Returns true if nothing was done and nothing was undone.
  bool is_empty() const { return draft == Draft{} && undone.empty(); }
  /// Returns whether `mesh` is a copy, because the result was saved to the opened file.
  bool has_copy() const { return mesh.path != opened; }
  /// Returns the number of committed edits, plus one if a handle of the open edit has moved.
  std::size_t step_count() const;
};

/// Returns the stored result of the state's open step, or nullopt if there is none.
std::optional<MovedVertices> kept_result(const InterruptedEdit& edit, const AppState& state);

/// Reads a journal; the program that writes it may still be running. Returns nullopt if the journal
/// cannot be read. Ignores an incomplete last line.
std::optional<InterruptedEdit> read_journal(const std::filesystem::path& path);

/// Returns the interrupted edits in `folder`, the latest first. Skips unreadable journals and those
/// of running programs.
std::vector<InterruptedEdit> find_interrupted(const std::filesystem::path& folder);

/// Deletes the journal of the edit and the files beside it. Call this if the user discards the
/// edit, or after the restored edit has a new journal.
void discard(const InterruptedEdit& edit);

}  // namespace lapwing::viewer
