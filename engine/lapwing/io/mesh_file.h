#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lapwing/io/atomic_file.h"
#include "lapwing/io/file_defects.h"
#include "lapwing/io/mesh_format.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/split_normals.h"

namespace lapwing {

/// Reads an OBJ, OFF, PLY, STL or glTF 2.0 file, including point clouds and empty meshes. The
/// extension selects the format; the content decides whether it is ascii or binary. Vertices and
/// faces keep the order of the file. Equal positions are welded to one vertex, in order of
/// appearance, in STL files and in each object of a glTF file.
///
/// For a glTF file, "FILE.glb#NAME" selects the object of that name, or all objects that show the
/// mesh of that name. Without a name, the function reads all objects of the scene in world
/// coordinates. Each object becomes a group. Skins, morph targets and animations stay in the file;
/// a mesh with a skin is read in its bind pose, and a mesh with morph targets in its base shape.
///
/// Throws IoError if the file cannot be read, and InputError if it is malformed. The message is
/// "path:line: expected ..., found ..." or, for binary files, "path: byte offset: ...". It says
/// whether `lapwing check` can repair the file (see read_damaged_mesh). Texture coordinates and
/// normals that an OBJ face names but the file lacks are left out and counted
/// (MeshAttributes::uneditable). Time and memory are linear in the file's size, whatever its header
/// says.
Mesh read_mesh(const std::filesystem::path& path);

/// Returns notes to the user about data that the reader left out, in printable lines: "a.glb: 'A'
/// has a scale of 0 ...". Call it right after reading, because an edit of the connectivity drops
/// the notes.
std::vector<std::string> reading_notes(const Mesh& mesh);

/// A mesh that was read from a file with possible defects.
struct DamagedMesh {
  Mesh mesh;
  std::vector<FileDefect> defects;  ///< what the reader left out or corrected; one per kind
  /// The source file, for use as WriteOptions::original_file.
  std::shared_ptr<const SourceFile> file;
};

/// Reads a file like `read_mesh`, but continues after the defects in FileDefectKind instead of
/// throwing. If there are defects, the mesh has no source, so that write_mesh writes a new file.
DamagedMesh read_damaged_mesh(const std::filesystem::path& path);

/// A morph target of a glTF file: a name, and the positions of all vertices at the weight 1.
struct MorphTarget {
  std::string name;
  Positions positions;
};

/// Returns the morph targets of the glTF file from which `mesh` was read, in their order. Targets
/// of several objects with the same name are one target. A target without a name is called "target
/// 2". Empty for other files. Throws InputError if a target does not fit its mesh.
std::vector<MorphTarget> read_morph_targets(const Mesh& mesh);

struct WriteOptions {
  /// If unset, as in the file that the mesh was read from, else binary if the format has it.
  std::optional<Encoding> encoding = {};
  /// Writes a new file instead of changing the source file's bytes, so that attributes set since
  /// reading are written.
  bool anew = false;
  /// If the mesh was read from a glTF file, its positions stay and these morph targets are added
  /// (see gltf_morph.h).
  std::vector<MorphTarget> morph_targets = {};
  /// The file that the mesh was made from, if the triangles have changed since. In a glTF file, the
  /// new triangles replace the old ones (see gltf_patch.h).
  std::shared_ptr<const SourceFile> original_file = {};
  /// Applies to a mesh without normals that is written to a glTF file. Edges whose faces meet at
  /// more than this angle look hard (SplitNormals).
  double feature_angle_degrees = kFeatureAngleDegrees;
};

/// Messages to the user about a file that was written, in printable lines.
struct WriteReport {
  /// Data that the format cannot hold: "texture coordinates (14,290): OFF has no place for them".
  std::vector<std::string> not_carried;
  /// Other advice: "material library 'a.mtl' is not beside out.obj; copy it there".
  std::vector<std::string> notes;
};

/// Writes `mesh` in the format of the extension of `path`, replacing the file in one step (see
/// replace_file).
///
/// If the mesh was read from the same format and its vertices and faces are unchanged, the result
/// keeps all bytes of the file that was read, except for moved coordinates and the recomputed
/// normals near them (in glTF files also tangents and bounds). Attributes set since reading are not
/// written. A .gltf file with separate buffer files is written with those as NAME.bin, unless it
/// replaces the file that was read.
///
/// Otherwise a new file is written from the mesh and its attributes. Every double is printed so
/// that it reads back exactly. If the source file is unknown, all stored normals are recomputed.
/// Throws IoError if the file cannot be written, and InputError if the mesh is inconsistent or its
/// numbers do not fit the format; the old file then stays.
WriteReport write_mesh(const Mesh& mesh, const std::filesystem::path& path,
                       const WriteOptions& options = {});
/// The same for one of several files: `files.commit()` puts it in place.
WriteReport write_mesh(const Mesh& mesh, const std::filesystem::path& path, FileReplacements& files,
                       const WriteOptions& options = {});

}  // namespace lapwing
