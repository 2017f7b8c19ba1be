#pragma once

#include <string>

#include "lapwing/io/mesh_file.h"
#include "lapwing/io/source_file.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

// One reader and one writer per format. A reader returns the mesh and records in `file` where the
// positions and normals are. It throws InputError, with the location, if the file is malformed. A
// writer returns a complete new file, and appends to `report` what the format cannot hold.

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
