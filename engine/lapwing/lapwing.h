#pragma once

/// Lapwing's operations on meshes in memory, and its mesh files.
#include "lapwing/coating/coat.h"
#include "lapwing/coating/peel.h"
#include "lapwing/deform/deform.h"
#include "lapwing/deform/modifiers/attachments.h"
#include "lapwing/deform/prepared_deform.h"
#include "lapwing/fill/fill_holes.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/decimate_mesh.h"
#include "lapwing/mesh/subdivide_mesh.h"
#include "lapwing/parameterize/parameterize.h"
#include "lapwing/remesh/remesh.h"
#include "lapwing/transfer/transfer.h"
#include "lapwing/transplant/transplant.h"
#include "lapwing/wrap/landmarks.h"
#include "lapwing/wrap/wrap.h"
