#include "files/file_purpose.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <unistd.h>

#include "files/path_text.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;
using Wants = PathWords::Wants;

// The extensions that `format_of` accepts.
constexpr std::array<std::string_view, 9> kMesh{".glb", ".gltf", ".obj",  ".off",  ".ply",
                                                ".stl", ".coff", ".noff", ".cnoff"};
constexpr std::array<std::string_view, 1> kRecipe{".json"};
constexpr std::array<std::string_view, 1> kPicture{".png"};
constexpr std::array<std::string_view, 4> kTurntable{".mp4", ".webm", ".gif", ".png"};
constexpr std::array<std::string_view, 10> kMeshOrRecipe{
    ".glb", ".gltf", ".obj", ".off", ".ply", ".stl", ".coff", ".noff", ".cnoff", ".json"};
constexpr std::array<std::string_view, 15> kCarried{
    ".glb",   ".gltf", ".obj", ".off", ".ply", ".stl",  ".coff",    ".noff",
    ".cnoff", ".csv",  ".txt", ".tsv", ".npy", ".fcsv", ".mrk.json"};

constexpr std::array<std::string_view, 7> kLandmarkFile{".csv",  ".txt",  ".tsv",     ".npy",
                                                        ".fcsv", ".json", ".mrk.json"};
constexpr std::array<std::string_view, 1> kTable{".csv"};

constexpr FileKind kAll{"All files", {}};
constexpr std::array kMeshes{FileKind{"Meshes", kMesh}, kAll};
constexpr std::array kRecipes{FileKind{"Recipes", kRecipe}, kAll};
constexpr std::array kLandmarks{FileKind{"Landmarks", kLandmarkFile}, kAll};
constexpr std::array kTables{FileKind{"Tables", kTable}, kAll};
constexpr std::array kPictures{FileKind{"Images", kPicture}, kAll};
constexpr std::array kTurntables{FileKind{"Videos and image sequences", kTurntable}, kAll};
constexpr std::array kOpened{FileKind{"Meshes and recipes", kMeshOrRecipe},
                             FileKind{"Meshes", kMesh}, FileKind{"Recipes", kRecipe}, kAll};
constexpr std::array kFollowers{FileKind{"Meshes, point clouds and tables", kCarried}, kAll};

constexpr std::string_view kFormats =
    "The extension sets the format: glb, gltf, obj, off, ply or stl.";

// The texts of each PathPurpose, in the order of the enumeration.
constexpr std::array<PathWords, 16> kWords{{
    {"Open", "A mesh, or a recipe to run.", "Open", Wants::file, kOpened},
    {"Save mesh", kFormats, "Save", Wants::new_file, kMeshes},
    {"Save repaired mesh", kFormats, "Save and open", Wants::new_file, kMeshes},
    {"Save recipe", "The steps, stored in a file that can be replayed on another mesh.", "Save",
     Wants::new_file, kRecipes},
    {"Replay recipe", "Runs the recipe's steps on the open mesh.", "Replay", Wants::file, kRecipes},
    {"Choose source mesh", "You select a patch of this mesh in the view beside the open mesh.",
     "Open", Wants::file, kMeshes},
    {"Open scan", "The open mesh is deformed so that it covers this mesh or point cloud.", "Open",
     Wants::file, kMeshes},
    {"Load landmarks",
     "Pairs of points, or the points of the template (3D Slicer). They replace the current "
     "landmarks.",
     "Load", Wants::file, kLandmarks},
    {"Load landmarks of the scan",
     "The points of the scan that correspond to those of the template.", "Load", Wants::file,
     kLandmarks},
    {"Save landmarks", "A table (csv) with a row for each pair of points.", "Save", Wants::new_file,
     kTables},
    {"Attach object", "A mesh, point cloud or table of points that follows the surface.", "Attach",
     Wants::file, kFollowers},
    {"Save image", "The view without panels.", "Save", Wants::new_file, kPictures},
    {"Save turntable", "A video (mp4, webm, gif; requires ffmpeg), or an image sequence (png).",
     "Save", Wants::new_file, kTurntables},
    {"Choose parts folder",
     "The Transplant tab lists the meshes in this folder.",
     "Use this folder",
     Wants::folder,
     {}},
    {"Use part from file", "A mesh with a hole. The part is joined along its rim.", "Use",
     Wants::file, kMeshes},
    {"Add part", "A mesh with a hole. It is copied to the parts folder.", "Add", Wants::file,
     kMeshes},
}};

std::string lower_extension(const fs::path& file) {
  return lower_case(file.extension().string());
}

// Returns a list such as "obj, off, ply or stl".
std::string listed(std::span<const std::string_view> extensions) {
  std::string text;
  for (std::size_t k = 0; k < extensions.size(); ++k) {
    if (k > 0) text += k + 1 == extensions.size() ? " or " : ", ";
    text += extensions[k].substr(1);
  }
  return text;
}

std::string trouble_with_new(const fs::path& path, const PathWords& words) {
  std::error_code error;
  const fs::path folder = path.parent_path();
  if (fs::is_directory(path, error)) return path.string() + " is a folder. Add a file name.";
  if (!fs::is_directory(folder, error)) {
    return "There is no folder " + folder.string() + ". Create it first, or choose another one.";
  }
  const fs::path touched = fs::exists(path, error) ? path : folder;
  if (access(touched.c_str(), W_OK) != 0) {
    return touched.string() +
           " cannot be written to. Change its permissions, or choose another location.";
  }
  const FileKind& kind = words.kinds.front();
  if (!kind.holds(path)) {
    return path.filename().string() + " has an unsupported format. Choose a name that ends in " +
           listed(kind.extensions) + ".";
  }
  return {};
}

std::string trouble_with_old(const fs::path& path, const PathWords& words) {
  std::error_code error;
  if (!fs::exists(path, error)) {
    return "There is no file " + path.string() +
           ". Correct the name, or choose a file from the list.";
  }
  if (fs::is_directory(path, error)) return path.string() + " is a folder. Choose a file in it.";
  if (access(path.c_str(), R_OK) != 0) {
    return path.string() + " cannot be read. Change its permissions, or choose another file.";
  }
  const FileKind& kind = words.kinds.front();
  if (!kind.holds(path)) {
    return path.filename().string() + " has an unsupported format. Choose a file that ends in " +
           listed(kind.extensions) + ".";
  }
  return {};
}

}  // namespace

bool FileKind::holds(const fs::path& file) const {
  const std::string lower_name = lower_case(file.filename().string());
  return extensions.empty() || std::ranges::any_of(extensions, [&](std::string_view extension) {
           return lower_name.ends_with(extension);
         });
}

const PathWords& words_of(PathPurpose purpose) {
  return kWords[static_cast<std::size_t>(purpose)];
}

fs::path with_extension(fs::path typed, PathPurpose purpose, const fs::path& suggested) {
  const PathWords& words = words_of(purpose);
  if (words.wants != Wants::new_file || typed.filename().empty()) return typed;
  if (words.kinds.front().holds(typed)) return typed;
  // Append an extension to "hand.v2", but not to "hand.fbx", so that this format is rejected.
  const std::string extension = lower_extension(typed);
  const bool looks_like_format = extension.size() > 1 && extension.size() <= 5 &&
                                 std::all_of(extension.begin() + 1, extension.end(),
                                             [](unsigned char c) { return std::isalpha(c) != 0; });
  if (!looks_like_format) typed += suggested.extension();
  return typed;
}

std::string trouble_with(const fs::path& path, PathPurpose purpose) {
  const PathWords& words = words_of(purpose);
  std::error_code error;
  switch (words.wants) {
    case Wants::new_file:
      return trouble_with_new(path, words);
    case Wants::file:
      return trouble_with_old(path, words);
    case Wants::folder:
      if (fs::is_directory(path, error)) return {};
      return "There is no folder " + path.string() + ". Create it first, or choose another one.";
  }
  return {};
}

}  // namespace lapwing::viewer
