#include "lapwing/io/mesh_file.h"

#include <memory>
#include <system_error>

#include "lapwing/base/errors.h"
#include "lapwing/base/printable_text.h"
#include "lapwing/io/formats.h"
#include "lapwing/io/source_patch.h"
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
  }
  return {};
}

// The file that the mesh was read from, if it still has the mesh's vertices and faces.
const SourceFile* find_source(const Mesh& mesh) {
  const SourceFile* const source = mesh.source.get();
  return source != nullptr && source->describes(mesh) ? source : nullptr;
}

// OBJ and OFF are text, whatever is asked for.
Encoding choose_encoding(MeshFormat format, const SourceFile* source, const WriteOptions& options) {
  if (format == MeshFormat::obj || format == MeshFormat::off) {
    if (options.encoding.value_or(Encoding::ascii) == Encoding::ascii) return Encoding::ascii;
    throw InputError(std::string(name_of(format)) + " has no binary form here; write ascii");
  }
  if (options.encoding) return *options.encoding;
  return source != nullptr && source->format() == format ? source->encoding
                                                         : Encoding::little_endian;
}

std::string write_anew(const Mesh& mesh, MeshFormat format, Encoding encoding,
                       WriteReport& report) {
  switch (format) {
    case MeshFormat::obj:
      return write_obj(mesh, report);
    case MeshFormat::off:
      return write_off(mesh, report);
    case MeshFormat::ply:
      return write_ply(mesh, encoding, report);
    case MeshFormat::stl:
      return write_stl(mesh, encoding, report);
  }
  return {};
}

// A mesh whose stored normals fit its positions: those of a mesh whose file is unknown may not.
std::string write_with_new_normals(const Mesh& mesh, const SourceFile* source, MeshFormat format,
                                   Encoding encoding, WriteReport& report) {
  if (mesh.attributes().normals.empty()) return write_anew(mesh, format, encoding, report);
  const Positions rest = source == nullptr ? Positions() : source_positions(*source, mesh);
  StoredNormals updated = updated_normals(mesh, rest);
  Mesh refreshed = mesh;
  refreshed.edit_attributes().normals = std::move(updated.normals);
  refreshed.edit_attributes().corner_normals = std::move(updated.corner_normals);
  return write_anew(refreshed, format, encoding, report);
}

void note_missing_libraries(const Mesh& mesh, const std::filesystem::path& path,
                            WriteReport& report) {
  for (const std::string& library : mesh.attributes().material_libraries) {
    std::error_code error;
    if (std::filesystem::exists(path.parent_path() / library, error)) continue;
    report.notes.push_back("material library '" + library + "' is not beside " + path.string() +
                           "; copy it there");
  }
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& path) {
  const auto source = std::make_shared<SourceFile>(path, format_of(path));
  Mesh mesh = read_format(*source);
  source->remember_topology(mesh);
  mesh.source = source;
  return mesh;
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

  WriteReport report;
  std::optional<std::string> bytes;
  if (source != nullptr && source->format() == format && source->encoding == encoding &&
      !options.anew) {
    bytes = patch_source(*source, mesh);
  }
  if (!bytes) bytes = write_with_new_normals(mesh, source, format, encoding, report);
  if (format == MeshFormat::obj) note_missing_libraries(mesh, path, report);
  files.add(path, *bytes);
  // They quote names out of files.
  for (std::string& line : report.not_carried) line = printable(line);
  for (std::string& line : report.notes) line = printable(line);
  return report;
}

}  // namespace lapwing
