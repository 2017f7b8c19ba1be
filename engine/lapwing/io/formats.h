#pragma once

#include <string>

#include "lapwing/io/mesh_file.h"
#include "lapwing/io/source_file.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

// One reader and one writer per format. A reader fills the mesh and notes in `file` where the
// positions and normals stand; it throws InputError through `file`. A writer returns the whole
// file made anew, and appends to `report` what it could not carry.

Mesh read_obj(SourceFile& file);
Mesh read_off(SourceFile& file);
Mesh read_ply(SourceFile& file);
Mesh read_stl(SourceFile& file);
Mesh read_gltf(SourceFile& file);

std::string write_obj(const Mesh& mesh, WriteReport& report);
std::string write_off(const Mesh& mesh, WriteReport& report);
std::string write_ply(const Mesh& mesh, Encoding encoding, WriteReport& report);
std::string write_stl(const Mesh& mesh, Encoding encoding, WriteReport& report);

}  // namespace lapwing
