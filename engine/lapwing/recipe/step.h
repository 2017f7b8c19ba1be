#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "lapwing/coating/coat_request.h"
#include "lapwing/coating/peel.h"
#include "lapwing/deform/deform_request.h"
#include "lapwing/fill/fill_holes.h"
#include "lapwing/mesh/decimate_mesh.h"
#include "lapwing/mesh/subdivide_mesh.h"
#include "lapwing/remesh/remesh.h"
#include "lapwing/transplant/transplant_request.h"
#include "lapwing/wrap/landmarks.h"

namespace lapwing {

class KeyVisitor;

/// A coat source and the file of its mesh.
struct FileSource : CoatSource {
  /// Path as in the recipe. Empty for the edited mesh before the step.
  std::filesystem::path mesh;
  bool operator==(const FileSource&) const = default;
};

/// {"op": "coat"}: transfers the fine detail of a patch of one mesh to a patch of the edited mesh.
using CoatStep = CoatOf<FileSource>;

/// {"op": "mix"}: mixes two surfaces on a patch of the edited mesh.
using MixStep = MixOf<FileSource>;

/// {"op": "transplant"}: replaces a region of the mesh by a part of another mesh.
struct TransplantStep : TransplantRequest {
  std::filesystem::path part;  ///< path as in the recipe; empty for the mesh before the step
  bool operator==(const TransplantStep&) const = default;
};

/// {"op": "wrap"}: deforms the mesh, a template, so that it covers a scan.
struct WrapStep {
  std::filesystem::path scan = {};  ///< path as in the recipe
  LandmarkSpec landmarks = {};
  bool aligned = false;                       ///< as in WrapRequest
  std::vector<StiffnessSpec> stiffness = {};  ///< as in WrapRequest
  bool hard = false;                          ///< as in WrapRequest::landmarks
  std::optional<MirrorSpec> mirror = {};      ///< as in WrapRequest
  bool detail = false;                        ///< as in WrapRequest
  bool operator==(const WrapStep&) const = default;
};

/// One operation of a recipe. The recipe format, the commands, the reference and the panels of the
/// window are all derived from these types and their `describe` functions.
using Step = std::variant<DeformRequest, CoatStep, MixStep, TransplantStep, PeelRequest,
                          RemeshRequest, DecimateRequest, SubdivideRequest, FillRequest, WrapStep>;

/// A kind of step.
struct Operation {
  std::string_view name;  ///< NAME in {"op": NAME}, and name of the command
  std::string_view help;  ///< short description
  /// Text between the name and the files of a step, as in "coat from gargoyle.off".
  std::string_view before_files;
  Step step;  ///< with default values
};
/// All operations, in the order of Step.
std::span<const Operation> operations();
const Operation& operation_of(const Step& step);

/// Visits the keys of the step, in the order in which recipes contain them.
void describe(Step& step, KeyVisitor& visitor);
void describe(DeformRequest& step, KeyVisitor& visitor);
void describe(CoatStep& step, KeyVisitor& visitor);
void describe(MixStep& step, KeyVisitor& visitor);
void describe(TransplantStep& step, KeyVisitor& visitor);
void describe(PeelRequest& step, KeyVisitor& visitor);
void describe(RemeshRequest& step, KeyVisitor& visitor);
void describe(DecimateRequest& step, KeyVisitor& visitor);
void describe(SubdivideRequest& step, KeyVisitor& visitor);
void describe(FillRequest& step, KeyVisitor& visitor);
void describe(WrapStep& step, KeyVisitor& visitor);

/// Describe groups of keys for the panels.
void describe(DeformParameters& parameters, KeyVisitor& visitor);
void describe(SettleOptions& settle, KeyVisitor& visitor);
void describe(LaplacianWeights& weights, KeyVisitor& visitor);
void describe(CoatParameters& parameters, KeyVisitor& visitor);
void describe(CoatOptions& options, KeyVisitor& visitor);
void describe(Transition& transition, KeyVisitor& visitor);
void describe(FileSource& source, KeyVisitor& visitor);
void describe(TransplantParameters& parameters, KeyVisitor& visitor);

/// Returns the keys of an operation as a Markdown table with name, value, default and help.
/// `settle.tolerance` names the key `tolerance` of the object `settle`.
std::string key_table(const Operation& operation);

/// Returns whether handles may have a free orientation. This requires minimization without substeps
/// and with soft constraints.
bool allows_free_handles(const DeformParameters& parameters);

/// Throws InputError, naming the key and its range, if a number is outside its range.
void require_valid(DeformParameters parameters);
/// Throws InputError if a number of `move` is outside its range or if the parameters exclude the
/// move.
void require_valid(const Move& move, const DeformParameters& parameters);

}  // namespace lapwing
