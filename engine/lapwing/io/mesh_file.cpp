#include "lapwing/io/mesh_file.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <system_error>

#include "lapwing/base/errors.h"
#include "lapwing/base/printable_text.h"
#include "lapwing/io/gltf_patch.h"
#include "lapwing/io/gltf_scene.h"
#include "lapwing/io/gltf_writer.h"
#include "lapwing/io/material_transfer.h"
#include "lapwing/io/mesh_materials.h"
#include "lapwing/io/reading.h"
#include "lapwing/io/source_file.h"
#include "lapwing/io/stored_normals.h"
#include "lapwing/io/writing.h"

namespace lapwing {
namespace {

Mesh read_format(SourceFile& file) {
  switch (file.format()) {
    case MeshFormat::obj:
      return read_obj(file);
    case MeshFormat::off:
      return read_off(file);
    case MeshFormat::ply:
      return read_ply(file);
    case MeshFormat::stl:
      return read_stl(file);
    case MeshFormat::glb:
    case MeshFormat::gltf:
      return read_gltf(file);
  }
  return {};
}

// Returns the file that the mesh was read from, if vertices and faces are unchanged.
const SourceFile* find_source(const Mesh& mesh) {
  const SourceFile* const source = mesh.source.get();
  return source != nullptr && source->describes(mesh) ? source : nullptr;
}

// Throws InputError if the format does not have the requested encoding.
Encoding choose_encoding(MeshFormat format, const SourceFile* source, const WriteOptions& options) {
  if (format == MeshFormat::obj || format == MeshFormat::off) {
    if (options.encoding.value_or(Encoding::ascii) == Encoding::ascii) return Encoding::ascii;
    throw InputError(std::string(name_of(format)) +
                     " is only written as text; choose the encoding ascii");
  }
  if (is_gltf(format)) {
    if (options.encoding.value_or(Encoding::little_endian) == Encoding::little_endian) {
      return Encoding::little_endian;
    }
    throw InputError(std::string(name_of(format)) + " has only one encoding; do not specify one");
  }
  if (options.encoding) return *options.encoding;
  return source != nullptr && source->format() == format ? source->encoding
                                                         : Encoding::little_endian;
}

std::filesystem::path path_of(const SourceFile* origin) {
  return origin == nullptr ? std::filesystem::path() : origin->path();
}

// Returns the OBJ file. If the mesh has textures, or comes from a glTF file with materials, also
// returns a material library and its images.
std::vector<FileContent> write_obj_files(const Mesh& mesh, const std::filesystem::path& path,
                                         const SourceFile* origin, WriteReport& report) {
  Mesh with_library = with_texture_materials(mesh);
  const bool has_textures =
      with_library.attributes().materials.size() > mesh.attributes().materials.size();
  const bool is_from_gltf =
      !mesh.attributes().materials.empty() && origin != nullptr && is_gltf(origin->format());
  if (!has_textures && !is_from_gltf) return {{path, write_obj(mesh, report)}};
  std::vector<FileContent> library = mtl_files(read_materials(mesh, path_of(origin), report), path);
  std::vector<std::string>& libraries = with_library.edit_attributes().material_libraries;
  libraries.insert(libraries.begin(), library.front().path.filename().string());
  std::vector<FileContent> files{{path, write_obj(with_library, report)}};
  std::ranges::move(library, std::back_inserter(files));
  return files;
}

// OBJ, OFF and PLY files can hold vertices that are not finite, but few programs expect them.
void note_non_finite_vertices(const Mesh& mesh, WriteReport& report) {
  const auto is_broken = [](const Eigen::Vector3d& p) { return !p.allFinite(); };
  const auto first = std::ranges::find_if(mesh.positions, is_broken);
  if (first == mesh.positions.end()) return;
  report.notes.push_back(
      "non-finite vertices (" +
      grouped(static_cast<std::size_t>(std::ranges::count_if(mesh.positions, is_broken))) +
      ", the first is vertex " + std::to_string(first - mesh.positions.begin()) +
      "): remove them with `lapwing check MESH --fix OUT`");
}

// Returns the PLY file, and the images of the materials that it names as textures.
std::vector<FileContent> write_ply_files(const Mesh& mesh, const std::filesystem::path& path,
                                         Encoding encoding, const SourceFile* origin,
                                         WriteReport& report) {
  if (mesh.attributes().materials.empty()) return {{path, write_ply(mesh, encoding, report)}};
  Mesh textured = mesh;
  std::vector<FileContent> images =
      add_ply_textures(read_materials(mesh, path_of(origin), report), path, textured, report);
  std::vector<FileContent> files{{path, write_ply(textured, encoding, report)}};
  std::ranges::move(images, std::back_inserter(files));
  return files;
}

// `origin` is the file from which the mesh was made, or null if it is unknown.
std::vector<FileContent> write_new_file(const Mesh& mesh, const std::filesystem::path& path,
                                        Encoding encoding, double feature_angle_degrees,
                                        const SourceFile* origin, WriteReport& report) {
  const MeshFormat format = format_of(path);
  if (format != MeshFormat::stl && !is_gltf(format)) note_non_finite_vertices(mesh, report);
  switch (format) {
    case MeshFormat::obj:
      return write_obj_files(mesh, path, origin, report);
    case MeshFormat::off:
      return {{path, write_off(mesh, report)}};
    case MeshFormat::ply:
      return write_ply_files(mesh, path, encoding, origin, report);
    case MeshFormat::stl:
      return {{path, write_stl(mesh, encoding, report)}};
    case MeshFormat::glb:
    case MeshFormat::gltf:
      return write_gltf(with_texture_materials(mesh), path,
                        read_materials(mesh, path_of(origin), report), feature_angle_degrees,
                        report);
  }
  return {};
}

// Throws InputError, naming the vertex, if a vertex was moved to a position that is not finite and
// the format cannot hold it. Allows vertices that are not finite in the source file either.
void require_finite_moves(const SourceFile& source, const Mesh& mesh) {
  const auto is_finite = [](const Eigen::Vector3d& p) { return p.allFinite(); };
  if (source.format() != MeshFormat::stl && !is_gltf(source.format())) return;
  if (std::ranges::all_of(mesh.positions, is_finite)) return;
  const Positions rest = source_positions(source, mesh);
  for (std::size_t v = 0; v < rest.size(); ++v) {
    if (is_finite(mesh.positions[v]) || !is_finite(rest[v])) continue;
    require_float(mesh.positions[v], static_cast<Index>(v), source.format());
  }
}

// Returns the source file with the changes, or nothing if it cannot store them.
std::vector<FileContent> patch(const SourceFile& source, const Mesh& mesh,
                               const std::filesystem::path& path, const WriteOptions& options,
                               WriteReport& report) {
  if (source.gltf) return patch_gltf(source, mesh, path, options.morph_targets, report);
  auto bytes = patch_source(source, mesh);
  if (!bytes) return {};
  return {{path, std::move(*bytes)}};
}

// Recomputes the stored normals: all of them without a source file, else those that changed.
Mesh with_updated_normals(const Mesh& mesh, const SourceFile* source) {
  if (mesh.attributes().normals.empty()) return mesh;
  const Positions rest = source == nullptr ? Positions() : source_positions(*source, mesh);
  StoredNormals updated = updated_normals(mesh, rest);
  Mesh refreshed = mesh;
  refreshed.edit_attributes().normals = std::move(updated.normals);
  refreshed.edit_attributes().corner_normals = std::move(updated.corner_normals);
  return refreshed;
}

// Adds a note for each file that the file `path` names but that is not in its folder.
void note_missing_files(const std::string& what, const std::vector<std::string>& names,
                        const std::filesystem::path& path, WriteReport& report) {
  for (const std::string& name : names) {
    std::error_code error;
    if (std::filesystem::exists(path.parent_path() / name, error)) continue;
    report.notes.push_back(what + " '" + name + "' is not beside " + path.string() +
                           "; copy it there");
  }
}

// In JSON, names are UTF-8. Names of other formats need not be.
void report_names_not_utf8(const MeshAttributes& attributes, WriteReport& report) {
  std::vector<std::string> names;
  for (const auto* list : {&attributes.groups, &attributes.materials}) {
    std::ranges::copy_if(*list, std::back_inserter(names),
                         [](const std::string& name) { return !is_utf8(name); });
  }
  if (names.empty()) return;
  report.not_carried.push_back("names that are not UTF-8, " + quoted_list(names) +
                               ": glTF stores their other bytes as U+FFFD; convert the original "
                               "file to UTF-8 to keep the names");
}

}  // namespace

namespace {

std::shared_ptr<SourceFile> open_source(const std::filesystem::path& path) {
  MeshPath name = split_mesh_path(path);
  const MeshFormat format = format_of(name.file);
  return std::make_shared<SourceFile>(std::move(name), format);
}

Mesh read_from(const std::shared_ptr<SourceFile>& source) {
  Mesh mesh = read_format(*source);
  for (std::string& note : source->notes) note = printable(note);
  if (!source->defects.empty()) return mesh;
  source->remember_topology(mesh);
  mesh.source = source;
  return mesh;
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& path) {
  return read_from(open_source(path));
}

std::vector<std::string> reading_notes(const Mesh& mesh) {
  return mesh.source ? mesh.source->notes : std::vector<std::string>();
}

DamagedMesh read_damaged_mesh(const std::filesystem::path& path) {
  const auto source = open_source(path);
  source->may_be_damaged = true;
  Mesh mesh = read_from(source);
  return {std::move(mesh), source->defects, source};
}

WriteReport write_mesh(const Mesh& mesh, const std::filesystem::path& path,
                       const WriteOptions& options) {
  FileReplacements files;
  WriteReport report = write_mesh(mesh, path, files, options);
  files.commit();
  return report;
}

WriteReport write_mesh(const Mesh& mesh, const std::filesystem::path& path, FileReplacements& files,
                       const WriteOptions& options) {
  const MeshFormat format = format_of(path);
  validate_for_writing(mesh);
  const SourceFile* const source = find_source(mesh);
  const Encoding encoding = choose_encoding(format, source, options);

  const bool is_patched = source != nullptr && source->format() == format &&
                          source->encoding == encoding && !options.anew;
  if (!options.morph_targets.empty() && (!is_patched || !source->gltf)) {
    throw InputError("the morph target '" + options.morph_targets.front().name +
                     "' needs a glTF file whose triangles are unchanged; read and save files with "
                     "the same extension, .glb or .gltf");
  }
  WriteReport report;
  if (is_gltf(format)) report_names_not_utf8(mesh.attributes(), report);
  std::vector<FileContent> contents;
  if (is_patched) {
    require_finite_moves(*source, mesh);
    contents = patch(*source, mesh, path, options, report);
  }
  const SourceFile* const old = options.original_file.get();
  if (source == nullptr && old != nullptr && old->gltf && old->format() == format &&
      !options.anew && mesh.face_count() > 0 && !old->gltf->objects.empty()) {
    contents = patch(*old, with_updated_normals(mesh, nullptr), path, options, report);
  }
  if (contents.empty()) {
    contents = write_new_file(with_updated_normals(mesh, source), path, encoding,
                              options.feature_angle_degrees,
                              mesh.source != nullptr ? mesh.source.get() : old, report);
  }
  const MeshAttributes& a = mesh.attributes();
  if (format == MeshFormat::obj) {
    note_missing_files("material library", a.material_libraries, path, report);
  }
  if (format == MeshFormat::ply) note_missing_files("image", texture_names(a), path, report);
  // The files that a file needs are put in place before it.
  for (auto content = contents.rbegin(); content != contents.rend(); ++content) {
    files.add(content->path, content->bytes);
  }
  // The messages quote names from untrusted files.
  for (std::string& line : report.not_carried) line = printable(line);
  for (std::string& line : report.notes) line = printable(line);
  return report;
}

}  // namespace lapwing
