#include "lapwing/io/mesh_materials.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_format.h"
#include "lapwing/io/paths.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

// Finds the materials of a mesh in the libraries that the mesh names.
class MaterialSearch {
 public:
  MaterialSearch(const MeshAttributes& attributes, const fs::path& path,
                 std::vector<std::string>& notes)
      : attributes_(attributes), path_(path), notes_(notes) {}

  std::vector<std::optional<FoundMaterial>> run() {
    read_libraries();
    if (attributes_.materials.empty() && !known_.empty()) {
      notes_.push_back(path_.string() +
                       " does not assign materials of its library to faces (usemtl); export it "
                       "again with them");
    }
    std::vector<std::optional<FoundMaterial>> found(attributes_.materials.size());
    std::vector<char> has_faces(found.size(), 0);
    for (const Index material : attributes_.face_materials) {
      if (material != kNoIndex) has_faces[material] = 1;
    }
    for (std::size_t m = 0; m < found.size(); ++m) {
      const std::string& name = attributes_.materials[m];
      if (has_faces[m] == 0) continue;
      const auto known = known_.find(name);
      if (known != known_.end()) {
        found[m] = known->second;
      } else if (!known_.empty()) {
        notes_.push_back("material '" + name + "' is not in the libraries of " + path_.string() +
                         "; its faces have no colour until it is added");
      }
    }
    return found;
  }

 private:
  void read_libraries() {
    if (is_gltf(format_of(split_mesh_path(path_).file))) {
      return add_materials(read_gltf_materials, path_);
    }
    for (const std::string& names : attributes_.material_libraries) {
      // The line may be one name with blanks, or several names.
      if (read_library(names)) continue;
      bool found = false;
      for (std::size_t at = 0; at < names.size();) {
        const std::size_t end = std::min(names.find(' ', at), names.size());
        if (end > at) found = read_library(names.substr(at, end - at)) || found;
        at = end + 1;
      }
      if (!found && !attributes_.materials.empty()) read_library_of_same_name(names);
    }
    if (attributes_.material_libraries.empty()) {
      notes_.push_back(path_.string() +
                       " names materials but no library (mtllib); export it again with one");
    }
  }

  bool read_library(const std::string& name) {
    const auto path = find_named_file(path_.parent_path(), name);
    if (path) add_materials(read_material_library, *path);
    return path.has_value();
  }

  void read_library_of_same_name(const std::string& missing) {
    const std::string own = path_.stem().string() + ".mtl";
    std::string note =
        "material library '" + missing + "' is not beside " + path_.string() + "; put it there";
    if (read_library(own)) note += " (" + own + " was read in its place)";
    notes_.push_back(std::move(note));
  }

  // Adds the materials that read(path, notes) returns. Of two materials with one name, the first is
  // used.
  template <class Read>
  void add_materials(const Read& read, const fs::path& path) {
    try {
      for (Material& material : read(path, notes_)) {
        std::string name = material.name;
        known_.try_emplace(std::move(name), FoundMaterial{std::move(material), path});
      }
    } catch (const Error& error) {
      notes_.emplace_back(error.what());
    }
  }

  const MeshAttributes& attributes_;
  const fs::path& path_;
  std::vector<std::string>& notes_;
  std::unordered_map<std::string, FoundMaterial> known_;
};

}  // namespace

std::vector<std::string> texture_names(const MeshAttributes& attributes) {
  std::vector<std::string> names;
  for (const std::string& comment : attributes.comments) {
    if (comment.starts_with(kTextureComment))
      names.push_back(comment.substr(kTextureComment.size()));
  }
  return names;
}

std::vector<Index> textures_of_faces(const Mesh& mesh, std::size_t count) {
  std::vector<Index> of_faces(mesh.face_count(), count > 0 ? 0 : kNoIndex);
  const std::vector<ExtraAttribute>& extras = mesh.attributes().face_extras;
  const auto numbers = std::ranges::find(extras, kTextureNumber, &ExtraAttribute::name);
  if (numbers == extras.end()) return of_faces;
  for (std::size_t f = 0; f < of_faces.size(); ++f) {
    const double number = numbers->values[f];
    const bool is_known = number >= 0.0 && number < static_cast<double>(count);
    of_faces[f] = is_known ? static_cast<Index>(number) : kNoIndex;
  }
  return of_faces;
}

std::vector<std::optional<FoundMaterial>> find_materials(const Mesh& mesh, const fs::path& path,
                                                         std::vector<std::string>& notes) {
  return MaterialSearch(mesh.attributes(), path, notes).run();
}

std::optional<fs::path> find_image(const std::string& name, const fs::path& namer,
                                   const fs::path& mesh, std::vector<std::string>& notes) {
  std::optional<fs::path> path = find_named_file(namer.parent_path(), name);
  if (!path) path = find_named_file(mesh.parent_path(), name);
  if (!path) {
    notes.push_back("image '" + name + "' is not beside " + namer.string() + "; put it there");
  }
  return path;
}

}  // namespace lapwing
