#include "state/journal.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <optional>
#include <sys/file.h>
#include <unistd.h>
#include <utility>

#include <nlohmann/json.hpp>

#include "lapwing/base/errors.h"
#include "lapwing/json/parse_json.h"
#include "state/user_folder.h"
#include "state/waypoints.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::write(file, bytes.data(), bytes.size());
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(put));
  }
  return true;
}

// Appends `bytes` and flushes them to the disk. On failure, sets errno, restores the file's length
// and returns false. Otherwise the next line would be appended to a partial line.
bool append_to(FileDescriptor& file, std::string_view bytes) {
  const off_t before = ::lseek(file.get(), 0, SEEK_END);
  if (write_all(file.get(), bytes) && ::fsync(file.get()) == 0) return true;
  const int error = errno;
  if (::ftruncate(file.get(), before) != 0) file.close();
  errno = error;
  return false;
}

// Flushes the folder's directory entries, so that a new file survives a power failure.
void flush_folder(const fs::path& folder) {
  const FileDescriptor file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (file.is_open()) ::fsync(file.get());
}

constexpr int kJournalVersion = 3;
constexpr int kOldestVersion = 2;  // journals of version 2 have no results file
const char* const kExtension = ".journal";

[[noreturn]] void fail(const fs::path& path, int error) {
  throw IoError("Cannot write the recovery file " + path.string() + ": " + std::strerror(error) +
                ". Free some disk space, or set XDG_CACHE_HOME to a writable folder.");
}

// Converts the steps with the writer of recipes.
Json json_of(std::vector<Step> steps) {
  Recipe recipe;
  recipe.mesh = "mesh";
  recipe.steps = std::move(steps);
  return Json::parse(to_json(recipe)).at("steps");
}

std::vector<Step> steps_of(const Json& json) {
  const Json recipe{{"lapwing", kRecipeVersion}, {"mesh", "mesh"}, {"steps", json}};
  return parse_recipe(JsonNode::Document{recipe}, {}, "journal").steps;
}

// Adds an empty handle to a step without handles, because a recipe requires one. The journal also
// stores the number of handles, to distinguish this handle from one whose vertices were removed.
DeformRequest with_handle(DeformRequest step) {
  if (step.handles.empty()) step.handles.push_back({RegionSpec{ListedVertices{}}, {}});
  return step;
}

std::size_t common_steps(const Draft& a, const Draft& b) {
  return static_cast<std::size_t>(std::ranges::mismatch(a.steps, b.steps).in1 - a.steps.begin());
}

Json difference(const Draft& last, const Draft& next) {
  const std::size_t kept = common_steps(last, next);
  const auto first_new = next.steps.begin() + static_cast<std::ptrdiff_t>(kept);
  return {{"keep", kept},
          {"add", json_of({first_new, next.steps.end()})},
          {"open", json_of({with_handle(next.open)}).at(0)},
          {"handles", next.open.handles.size()},
          {"settled", next.settled}};
}

// Returns a whole number. Checks its range, because nlohmann-json converts any number to any type.
template <class Whole>
Whole whole_number(const Json& json) {
  const bool fits = json.is_number_unsigned() ? std::in_range<Whole>(json.get<std::uint64_t>())
                                              : json.is_number_integer() &&
                                                    std::in_range<Whole>(json.get<std::int64_t>());
  if (!fits) throw InputError("expected a whole number, found " + json.dump());
  return json.get<Whole>();
}

void carry_out(const Json& line, Draft& draft) {
  draft.steps.resize(std::min(whole_number<std::size_t>(line.at("keep")), draft.steps.size()));
  for (Step& step : steps_of(line.at("add"))) draft.steps.push_back(std::move(step));
  draft.open = std::get<DeformRequest>(steps_of(Json::array({line.at("open")})).at(0));
  // Remove the handle that `with_handle` added.
  std::vector<MovedHandle>& handles = draft.open.handles;
  handles.resize(std::min(whole_number<std::size_t>(line.at("handles")), handles.size()));
  draft.settled = line.at("settled").get<bool>();
}

Json json_of(const MeshStamp& mesh) {
  return {{"lapwing_journal", kJournalVersion},
          {"mesh", mesh.path.string()},
          {"bytes", mesh.bytes},
          {"modified", mesh.modified}};
}

std::string line_of(const Json& json) {
  try {
    return json.dump() + '\n';
  } catch (const Json::type_error&) {
    throw InputError(
        "The name of the mesh or of another file is not UTF-8, so this edit cannot be restored "
        "after a crash. Rename the file and open it again.");
  }
}

MeshStamp stamp_from(const Json& json) {
  const auto version = whole_number<int>(json.at("lapwing_journal"));
  if (version < kOldestVersion || version > kJournalVersion) throw InputError("another version");
  return {json.at("mesh").get<std::string>(), whole_number<std::uint64_t>(json.at("bytes")),
          whole_number<std::int64_t>(json.at("modified"))};
}

// Returns the complete lines of a file. A crash may have left an incomplete last line.
std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line) && !in.eof();) lines.push_back(std::move(line));
  return lines;
}

// Returns the path of the copy of `mesh`. The extension stays, because it selects the reader.
fs::path copy_of_mesh(fs::path journal, const fs::path& mesh) {
  return journal.replace_extension(mesh.extension());
}

fs::path results_of(fs::path journal) {
  return journal.replace_extension(".results");
}

Json json_of(std::uint64_t key, const KeptResult& where) {
  return {{"result", key}, {"start", where.start}, {"vertices", where.vertices}};
}

// Returns whether the journal must store the result. A step with substeps or without settling is
// bitwise reproducible and needs no stored result.
bool wants_result(const AppState& state) {
  return state.settled && state.parameters.settle && !uses_substeps(state.parameters, state.moves);
}

// Follows the drafts of a journal, to find the steps that were undone. Stores only hashes and the
// lines of the journal, because every draft contains all steps before it.
class DraftSequence {
 public:
  void add(const Draft& draft, std::size_t line) {
    const std::size_t hash = hash_of(draft);
    const auto known = std::ranges::find(hashes_, hash);
    if (known == hashes_.end()) {
      // A new step discards the undone steps.
      hashes_.resize(current_ + 1);
      lines_.resize(current_ + 1);
      hashes_.push_back(hash);
      lines_.push_back(line);
      current_ = hashes_.size() - 1;
    } else {
      current_ = static_cast<std::size_t>(known - hashes_.begin());
    }
  }
  // Returns the lines of the drafts after the current one.
  std::span<const std::size_t> undone() const { return std::span(lines_).subspan(current_ + 1); }

 private:
  static std::size_t hash_of(const Draft& draft) {
    return std::hash<std::string>{}(difference(Draft{}, draft).dump());
  }

  std::vector<std::size_t> hashes_{hash_of(Draft{})};
  std::vector<std::size_t> lines_{0};
  std::size_t current_ = 0;
};

// Returns the drafts after these lines of a journal. `wanted` is ascending, and the lines up to its
// last entry must be valid.
std::vector<Draft> drafts_at(std::span<const std::size_t> wanted,
                             const std::vector<std::string>& lines) {
  std::vector<Draft> drafts;
  Draft draft;
  for (std::size_t k = 1; drafts.size() < wanted.size(); ++k) {
    const Json line = Json::parse(lines[k]);
    if (line.contains("keep")) carry_out(line, draft);
    if (k == wanted[drafts.size()]) drafts.push_back(draft);
  }
  return drafts;
}

int create_locked(const fs::path& folder, fs::path& path) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail(folder, error.value());
  for (int serial = 0;; ++serial) {
    path = folder / ("edit-" + std::to_string(::getpid()) + "-" + std::to_string(serial));
    path += kExtension;
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0600);
    if (file < 0 && errno == EEXIST) continue;
    if (file < 0) fail(path, errno);
    // The operating system releases the lock when the program ends, even after a crash.
    if (::flock(file, LOCK_EX) != 0) fail(path, errno);
    return file;
  }
}

bool is_locked(const fs::path& path) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  return !file.is_open() || ::flock(file.get(), LOCK_EX | LOCK_NB) != 0;
}

}  // namespace

MeshStamp stamp_of(const fs::path& mesh) {
  std::error_code error;
  MeshStamp stamp{fs::absolute(mesh)};
  stamp.bytes = fs::file_size(mesh, error);
  if (!error) stamp.modified = fs::last_write_time(mesh, error).time_since_epoch().count();
  if (error) throw IoError("cannot read " + mesh.string() + ": " + error.message());
  return stamp;
}

fs::path journal_folder() {
  return user_folder("XDG_CACHE_HOME", ".cache");
}

Journal::Journal(const fs::path& folder, const MeshStamp& mesh) : file_(-1), mesh_(mesh) {
  const std::string first = line_of(json_of(mesh));
  file_.reset(create_locked(folder, path_));
  append(first);
  flush_folder(folder);
}

void Journal::record(const AppState& state) {
  Draft draft = draft_of(state);
  if (draft == last_) return;
  record(std::move(draft));
  if (wants_result(state)) keep_result(last_, *state.settled);
}

void Journal::record(Draft draft) {
  append(line_of(difference(last_, draft)));
  last_ = std::move(draft);
}

// Ignores write errors, because a step without a stored result can be carried out again.
void Journal::keep_result(const Draft& draft, const MovedVertices& result) {
  if (!open_results()) return;
  const auto start = static_cast<std::uint64_t>(::lseek(results_.get(), 0, SEEK_END));
  if (!append_to(results_, bytes_of(result))) return;
  append_to(file_, line_of(json_of(result_key(draft), {start, result.vertices.size()})));
}

bool Journal::open_results() {
  if (results_.is_open()) return true;
  const fs::path path = results_of(path_);
  results_.reset(::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
  if (results_.is_open()) flush_folder(path.parent_path());
  return results_.is_open();
}

void Journal::continue_from(const InterruptedEdit& edit) {
  if (!edit.undone.empty()) {
    // In this order, the later drafts are again those that were undone.
    record(edit.draft);
    for (const Draft& undone : edit.undone) record(undone);
    record(edit.draft);
  }
  if (edit.results.empty()) return;
  std::error_code error;
  fs::copy_file(results_of(edit.journal), results_of(path_), error);
  if (error || !open_results() || ::fsync(results_.get()) != 0) return;
  for (const auto& [key, where] : edit.results) {
    append_to(file_, line_of(json_of(key, where)));
  }
}

void Journal::keep_mesh(const fs::path& mesh) {
  if (mesh_is_kept_) return;
  const fs::path copy = copy_of_mesh(path_, mesh_.path);
  std::error_code error;
  fs::copy_file(mesh, copy, fs::copy_options::overwrite_existing, error);
  if (error) fail(copy, error.value());
  const FileDescriptor written(::open(copy.c_str(), O_RDONLY | O_CLOEXEC));
  if (!written.is_open() || ::fsync(written.get()) != 0) fail(copy, errno);
  append(line_of(Json{{"mesh", json_of(stamp_of(copy))}}));
  mesh_is_kept_ = true;
}

void Journal::close() {
  std::error_code ignored;
  fs::remove(path_, ignored);
  fs::remove(copy_of_mesh(path_, mesh_.path), ignored);
  fs::remove(results_of(path_), ignored);
  file_.close();
  results_.close();
}

void Journal::append(const std::string& line) {
  if (!append_to(file_, line)) fail(path_, errno);
}

std::size_t InterruptedEdit::step_count() const {
  const bool is_moved = std::ranges::any_of(draft.open.handles, [](const MovedHandle& handle) {
    return handle.move != Move(SimilarityMove{});
  });
  return draft.steps.size() + (is_moved ? 1 : 0);
}

std::optional<MovedVertices> kept_result(const InterruptedEdit& edit, const AppState& state) {
  if (!state.parameters.settle) return std::nullopt;
  const auto where = edit.results.find(result_key(draft_of(state)));
  if (where == edit.results.end()) return std::nullopt;
  auto result = read_result(results_of(edit.journal), where->second);
  const std::size_t count = state.rest->vertex_count();
  if (!result || (!result->vertices.empty() && result->vertices.back() >= count)) {
    return std::nullopt;
  }
  return result;
}

std::optional<InterruptedEdit> read_journal(const fs::path& path) {
  const std::vector<std::string> lines = lines_of(path);
  if (lines.empty()) return std::nullopt;
  InterruptedEdit edit;
  edit.journal = path;
  try {
    edit.mesh = stamp_from(Json::parse(lines.front()));
    edit.opened = edit.mesh.path;
  } catch (const std::exception&) {
    return std::nullopt;
  }
  DraftSequence sequence;
  for (std::size_t k = 1; k < lines.size(); ++k) {
    try {
      const Json line = Json::parse(lines[k]);
      if (line.contains("mesh")) {
        edit.mesh = stamp_from(line.at("mesh"));
        continue;
      }
      if (line.contains("result")) {
        edit.results[whole_number<std::uint64_t>(line.at("result"))] = {
            whole_number<std::uint64_t>(line.at("start")),
            whole_number<std::uint64_t>(line.at("vertices"))};
        continue;
      }
      Draft next = edit.draft;
      carry_out(line, next);
      edit.draft = std::move(next);
      sequence.add(edit.draft, k);
    } catch (const std::exception&) {
      break;  // a power failure may have damaged the end; the lines before it are valid
    }
  }
  edit.undone = drafts_at(sequence.undone(), lines);
  try {
    edit.mesh_is_unchanged = stamp_of(edit.mesh.path) == edit.mesh;
  } catch (const std::exception&) {
    edit.mesh_is_unchanged = false;  // the file does not exist, or the path is empty
  }
  return edit;
}

std::vector<InterruptedEdit> find_interrupted(const fs::path& folder) {
  std::vector<InterruptedEdit> edits;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() != kExtension || is_locked(entry.path())) continue;
    if (auto edit = read_journal(entry.path())) {
      edit->last_step = entry.last_write_time(error);
      edits.push_back(*std::move(edit));
    }
  }
  std::ranges::stable_sort(edits, std::greater{}, &InterruptedEdit::last_step);
  return edits;
}

void discard(const InterruptedEdit& edit) {
  std::error_code ignored;
  fs::remove(edit.journal, ignored);
  fs::remove(copy_of_mesh(edit.journal, edit.opened), ignored);
  fs::remove(results_of(edit.journal), ignored);
}

}  // namespace lapwing::viewer
