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
     "fewer than three corners, or one vertex named twice: the part without extent is ignored",
     kFixIt, Severity::warning, Element::face, true},
    {"repeated_face", "repeated faces",
     "the same vertices as an earlier face: counted twice in normals and cotangent weights", kFixIt,
     Severity::warning, Element::face, true},
    {"zero_area_face", "zero-area faces",
     "the corners lie on one line: the face has no normal and no cotangent weights",
     "edit with uniform weights, or remesh around it", Severity::warning, Element::face, false},
    {"loose_vertex", "loose vertices",
     "no face holds the vertex: nothing carries it along with an edit", kFixIt, Severity::warning,
     Element::vertex, true},
    {"duplicate_vertex", "duplicate vertices",
     "at the position of an earlier vertex, but not joined to it: off a seam an edit can move them "
     "apart",
     "`lapwing check MESH --fix OUT` welds those along unwelded seams and leaves the others",
     Severity::info, Element::vertex, false},
    {"unwelded_seam", "unwelded seam edges",
     "boundary edges at one place with different vertices: `deform` edits them as one surface, any "
     "other operation as a boundary",
     "weld them with `lapwing check MESH --fix OUT`", Severity::warning, Element::edge, true},
    {"non_manifold_edge", "edges with more than two faces",
     "legal to edit: all its faces move together, and the normal there is their mean", "",
     Severity::warning, Element::edge, false},
    {"bow_tie_vertex", "bow-tie vertices",
     "surfaces touch at one vertex only: legal to edit, but one mean of both stands for their "
     "shape",
     "give each surface its own vertex with `lapwing check MESH --fix OUT`; they can then move "
     "apart",
     Severity::warning, Element::vertex, true},
    {"inconsistent_orientation", "edges between faces of opposite orientation",
     "neighbouring faces disagree about which side is out: normals cancel and shading is wrong",
     kFixIt, Severity::warning, Element::edge, true},
    {"one_sided_surface", "edges where a one-sided surface turns over",
     "no orientation fits, as on a Moebius strip: legal to edit, but normals flip along these "
     "edges",
     "cut the surface open there if its normals matter", Severity::warning, Element::edge, false},
    {"point_ring", "vertices with all neighbours at one point",
     "no local shape to fit: the surface there neither turns nor scales with an edit",
     "merge the vertices in a modelling tool, or leave them out of the region of interest",
     Severity::warning, Element::vertex, false},
    {"collinear_ring", "vertices with all neighbours on one line",
     "the turn about that line is not determined: the edit picks the smallest",
     "leave them out of the region of interest, or remesh around them", Severity::warning,
     Element::vertex, false},
    {"several_components", "components", "pieces without a common edge move independently",
     "give each piece that an edit should move or hold a handle or a belt", Severity::info,
     Element::component, false},
    {"self_intersection", "faces that cut through others",
     "parts of the surface go through or lie on each other: legal to edit, but no solid has such a "
     "surface",
     "pull them apart with an edit, or remodel there", Severity::warning, Element::face, false},
}};

}  // namespace

const DefectInfo& describe(DefectKind kind) {
  return kDefects[static_cast<std::size_t>(kind)];
}

}  // namespace lapwing
