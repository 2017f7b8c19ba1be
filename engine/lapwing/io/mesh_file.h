#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/io/atomic_file.h"
#include "lapwing/io/mesh_format.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Reads an OBJ, OFF, PLY, STL or glTF 2.0 file; the extension says which, the content whether it
/// is ascii or binary. Vertex and face order are the file's; STL vertices, and those of each object
/// of a glTF file, are welded where their positions are equal, in order of appearance. Of a glTF
/// file, "FILE.glb#NAME" is the object (node or mesh) of that name; without a name all objects of
/// the scene are read, in the world's coordinates, each mesh once. Its skins, morph targets and
/// animations stay in the file: a mesh with a skin is read as it was bound to it. Point clouds and
/// empty files of the format are read too. Throws IoError when the file cannot be read, InputError "path:line: expected ..., found ..." (binary:
/// "path: byte offset: ...") when it is malformed. Time and memory are linear in the file's size,
/// whatever its header promises. Texture coordinates and normals that a face of an OBJ names and
/// the file does not have are left out, and counted (MeshAttributes::uneditable).
Mesh read_mesh(const std::filesystem::path& path);

struct WriteOptions {
  /// Unset: as in the file the mesh was read from, else binary where the format has it.
  std::optional<Encoding> encoding = {};
  /// Makes the file anew where it would come back byte for byte, so that attributes set since it
  /// was read are written.
  bool anew = false;
  /// Of a glTF file that the mesh was read from: its positions stay, and how the mesh differs from
  /// them is added as a morph target of this name (see gltf_morph.h).
  std::string morph_target = {};
  /// The file that the mesh was made from, where its triangles are others than those of that file.
  /// Of glTF: they take the place of the old ones in it (see gltf_splice.h).
  std::shared_ptr<const SourceFile> made_from = {};
};

/// What the user should know about a file that was written, in printable lines.
struct WriteReport {
  /// What the format has no place for: "texture coordinates (14,290): OFF has no place for them".
  std::vector<std::string> not_carried;
  /// What else to look after: "material library 'a.mtl' is not beside out.obj; copy it there".
  std::vector<std::string> notes;
};

/// Writes `mesh` in the format that the extension of `path` names, replacing the file in one step
/// (see replace_file). A mesh read from the same format, with its vertices and faces unchanged,
/// comes back as the file it was read from, byte for byte, but for the coordinates that moved and
/// the stored normals there, which are recomputed (in glTF files tangents and bounds, too);
/// attributes set since then are not written. A .gltf file that keeps its numbers in files beside it
/// is written with those, as NAME.bin, unless it replaces the one that was read.
/// Otherwise the file is made anew from the mesh and its attributes, with every double printed so
/// that it reads back exactly; the stored normals of a mesh whose file is unknown are all
/// recomputed. Throws IoError when the file cannot be written and InputError when the mesh is
/// inconsistent or its numbers do not fit the format; the old file is then still there.
WriteReport write_mesh(const Mesh& mesh, const std::filesystem::path& path,
                       const WriteOptions& options = {});
/// The same for one of several files: it is in its place once `files` are committed.
WriteReport write_mesh(const Mesh& mesh, const std::filesystem::path& path, FileReplacements& files,
                       const WriteOptions& options = {});

}  // namespace lapwing
