#include "lapwing/doctor/defects.h"

#include <array>
#include <cstddef>

namespace lapwing {
namespace {

constexpr std::string_view kFixIt = "repair it with `lapwing check MESH --fix OUT`";

// In the order of DefectKind.
constexpr std::array<DefectInfo, kDefectKindCount> kDefects{{
    {"no_faces", "no usable face",
     "no face has three different, finite vertices: there is no surface to edit",
     "export the mesh again with its faces", Severity::error, Element::none, false},
    {"non_finite_vertex", "non-finite vertices",
     "a coordinate is infinite or not a number: no edit can include the vertex or its neighbours",
     "correct it in the file, or remove it and its faces with `lapwing check MESH --fix OUT`",
     Severity::error, Element::vertex, true},
    {"degenerate_face", "faces that repeat a vertex",
     "the face has fewer than three corners, or names a vertex twice: the part without area is "
     "ignored",
     kFixIt, Severity::warning, Element::face, true},
    {"repeated_face", "repeated faces",
     "the face has the vertices of an earlier face: normals and cotangent weights count both",
     kFixIt, Severity::warning, Element::face, true},
    {"zero_area_face", "zero-area faces",
     "the corners lie on one line: the face has no normal and no cotangent weights",
     "edit with uniform weights, or remesh around it", Severity::warning, Element::face, false},
    {"loose_vertex", "loose vertices",
     "no face holds the vertex: nothing carries it along with an edit", kFixIt, Severity::warning,
     Element::vertex, true},
    {"duplicate_vertex", "duplicate vertices",
     "the vertex is at the position of an earlier vertex, but not joined to it: an edit can move "
     "them apart unless they lie on a seam",
     "`lapwing check MESH --fix OUT` welds those along unwelded seams and leaves the others",
     Severity::info, Element::vertex, false},
    {"unwelded_seam", "unwelded seam edges",
     "boundary edges coincide but have different vertices: `deform` edits them as one surface, "
     "every other operation as a boundary",
     "weld them with `lapwing check MESH --fix OUT`", Severity::warning, Element::edge, true},
    {"non_manifold_edge", "edges with more than two faces",
     "editing works: all faces move together, and the normal there is their mean", "",
     Severity::warning, Element::edge, false},
    {"bow_tie_vertex", "bow-tie vertices",
     "surfaces touch at one vertex only: editing works, but the local shape is the mean of both",
     "give each surface its own vertex with `lapwing check MESH --fix OUT`; they can then move "
     "apart",
     Severity::warning, Element::vertex, true},
    {"inconsistent_orientation", "edges between faces of opposite orientation",
     "neighbouring faces disagree about which side is out: normals cancel and shading is wrong",
     kFixIt, Severity::warning, Element::edge, true},
    {"one_sided_surface", "edges where a one-sided surface turns over",
     "no orientation is consistent, as on a Moebius strip: editing works, but normals flip along "
     "these edges",
     "cut the surface open there if its normals matter", Severity::warning, Element::edge, false},
    {"point_ring", "vertices with all neighbours at one point",
     "no local shape to fit: the surface there neither turns nor scales with an edit",
     "merge the vertices in a modelling tool, or leave them out of the region of interest",
     Severity::warning, Element::vertex, false},
    {"collinear_ring", "vertices with all neighbours on one line",
     "the rotation about that line is undetermined: the edit chooses the smallest",
     "leave them out of the region of interest, or remesh around them", Severity::warning,
     Element::vertex, false},
    {"several_components", "components", "pieces without a common edge move independently",
     "add a handle or a belt to each piece that an edit should move or hold", Severity::info,
     Element::component, false},
    {"self_intersection", "faces that cut through others",
     "parts of the surface intersect or overlap: editing works, but the surface bounds no solid",
     "pull the parts apart with an edit, or remodel them", Severity::warning, Element::face, false},
}};

}  // namespace

const DefectInfo& describe(DefectKind kind) {
  return kDefects[static_cast<std::size_t>(kind)];
}

}  // namespace lapwing
