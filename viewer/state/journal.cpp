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

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kJournalVersion = 2;
const char* const kExtension = ".journal";

[[noreturn]] void fail(const fs::path& path, int error) {
  throw IoError("cannot write the journal " + path.string() + ": " + std::strerror(error) +
                "; make room or set XDG_CACHE_HOME to a folder that can be written");
}

// The recipe's own writer and reader serve for steps.
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

// A recipe has no step without a handle, so that one without vertices stands in for it; the line
// says how many there are, since a person may also choose a handle and take all its vertices away.
DeformRequest with_handle(DeformRequest step) {
  if (step.handles.empty()) step.handles.push_back({RegionSpec{ListedVertices{}}, {}});
  return step;
}

std::size_t common_steps(const Draft& a, const Draft& b) {
  const auto differ = std::mismatch(a.steps.begin(), a.steps.end(), b.steps.begin(), b.steps.end());
  return static_cast<std::size_t>(differ.first - a.steps.begin());
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

// The library turns any number into any type, and one beyond the type into anything.
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
  // One stood in for none.
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
    return json.dump();
  } catch (const Json::type_error&) {
    throw InputError(
        "the name of the mesh or of another file is not UTF-8, which the journal is written in, so "
        "that a crash would lose this edit; rename the file and open it again");
  }
}

MeshStamp stamp_from(const Json& json) {
  if (json.at("lapwing_journal") != kJournalVersion) throw InputError("another version");
  return {json.at("mesh").get<std::string>(), whole_number<std::uint64_t>(json.at("bytes")),
          whole_number<std::int64_t>(json.at("modified"))};
}

// Whole lines only: what follows the last line break was being written.
std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::vector<std::string> lines;
  std::size_t start = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', start)) {
    lines.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return lines;
}

// With the mesh's extension, by which its reader goes.
fs::path copy_of_mesh(fs::path journal, const fs::path& mesh) {
  return journal.replace_extension(mesh.extension());
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
    // The system gives the lock back however the program ends.
    if (::flock(file, LOCK_EX) != 0) fail(path, errno);
    return file;
  }
}

bool is_locked(const fs::path& path) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  return !file.is_open() || ::flock(file.get(), LOCK_EX | LOCK_NB) != 0;
}

// False, with errno set, when not all of it could be written.
bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::write(file, bytes.data(), bytes.size());
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(put));
  }
  return true;
}

// A file is found after a power cut only when its folder is on the disk, too.
void flush_folder(const fs::path& folder) {
  const FileDescriptor file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (file.is_open()) ::fsync(file.get());
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
  append(line_of(difference(last_, draft)));
  last_ = std::move(draft);
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
  file_.close();
}

void Journal::append(std::string line) {
  line += '\n';
  const off_t before = ::lseek(file_.get(), 0, SEEK_END);
  if (write_all(file_.get(), line) && ::fsync(file_.get()) == 0) return;
  const int error = errno;
  // Half a line, or one that is not on the disk, would spoil those that follow. Where it cannot be
  // taken back nothing may follow.
  if (::ftruncate(file_.get(), before) != 0) file_.close();
  fail(path_, error);
}

std::size_t InterruptedEdit::step_count() const {
  const bool is_moved =
      std::any_of(draft.open.handles.begin(), draft.open.handles.end(),
                  [](const MovedHandle& handle) { return handle.move != Move(SimilarityMove{}); });
  return draft.steps.size() + (is_moved ? 1 : 0);
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
  for (std::size_t k = 1; k < lines.size(); ++k) {
    try {
      const Json line = Json::parse(lines[k]);
      if (line.contains("mesh")) {
        edit.mesh = stamp_from(line.at("mesh"));
        continue;
      }
      Draft next = edit.draft;
      carry_out(line, next);
      edit.draft = std::move(next);
    } catch (const std::exception&) {
      break;  // a disk that lost power may hold a damaged end; what precedes it is good
    }
  }
  try {
    edit.mesh_is_unchanged = stamp_of(edit.mesh.path) == edit.mesh;
  } catch (const std::exception&) {
    edit.mesh_is_unchanged = false;  // it is gone, or has no name
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
  std::stable_sort(edits.begin(), edits.end(),
                   [](const auto& a, const auto& b) { return a.last_step > b.last_step; });
  return edits;
}

void discard(const InterruptedEdit& edit) {
  std::error_code ignored;
  fs::remove(edit.journal, ignored);
  fs::remove(copy_of_mesh(edit.journal, edit.opened), ignored);
}

}  // namespace lapwing::viewer
