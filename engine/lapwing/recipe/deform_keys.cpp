#include <cmath>

#include "lapwing/base/errors.h"
#include "lapwing/deform/turn_tracker.h"
#include "lapwing/recipe/key_visitor.h"
#include "lapwing/recipe/step.h"

namespace lapwing {
namespace {

constexpr const char* kMirrorsInParts =
    "a matrix that mirrors cannot be divided into substeps; remove \"commit_every\"";

class Validation final : public KeyVisitor {
 public:
  void number(const StepKey& key, double& value, const Range& range) override {
    if (range.contains(value) && std::isfinite(value)) return;
    throw InputError(std::string(key.name) + ": expected " + range.words() + ", got " +
                     std::to_string(value));
  }
  void number(const StepKey& key, std::optional<double>& value, const Range& range) override {
    if (value) number(key, *value, range);
  }
  void whole(const StepKey& key, int& value, const Range& range) override {
    double count = value;
    number(key, count, range);
  }

 protected:
  bool enter(const StepKey&, bool& given, ObjectForm, bool) override { return given; }
};

void require_orientations(const DeformRequest& step, KeyVisitor& visitor) {
  const bool may_be_free = allows_free_handles(step.parameters);
  for (std::size_t k = 0; k < step.handles.size(); ++k) {
    visitor.require(
        step.handles[k].orientation == HandleOrientation::kept || may_be_free,
        "handles/" + std::to_string(k) + "/orientation",
        "a free handle requires settling with soft constraints; remove \"hard\", \"commit_every\" "
        "and \"settle\": false, or keep the orientation");
  }
}

// All paths must have the same length, because the k-th moves of all handles are applied together.
void require_paths(const DeformRequest& step, KeyVisitor& visitor) {
  const std::vector<Move>* first = nullptr;
  for (std::size_t k = 0; k < step.handles.size(); ++k) {
    const std::vector<Move>& path = step.handles[k].path;
    if (path.empty()) continue;
    const std::string place = "handles/" + std::to_string(k) + "/path";
    if (first == nullptr) first = &path;
    visitor.require(path.size() == first->size(), place,
                    "expected " + std::to_string(first->size()) +
                        " moves, as in the paths of the other handles, got " +
                        std::to_string(path.size()));
    visitor.require(!step.parameters.commit_every, place,
                    "a path excludes \"commit_every\"; remove one of the two");
  }
}

}  // namespace

bool allows_free_handles(const DeformParameters& parameters) {
  return parameters.settle && !parameters.hard && !parameters.commit_every;
}

void describe(LaplacianWeights& weights, KeyVisitor& visitor) {
  visitor.choice(
      {.name = "weights", .help = "edge weights of the Laplacian"}, weights,
      {{LaplacianWeights::uniform, "uniform"}, {LaplacianWeights::cotangent, "cotangent"}});
}

void describe(SettleOptions& settle, KeyVisitor& visitor) {
  visitor.number({.name = "tolerance",
                  .help = "settling ends when no vertex would move farther than this, in mean edge "
                          "lengths"},
                 settle.tolerance, kAboveZero);
  visitor.whole({.name = "max_iterations",
                 .help = "settling ends after this many iterations, settled or not"},
                settle.max_iterations, {.least = 1, .most = 1e6});
}

void describe(DeformParameters& parameters, KeyVisitor& visitor) {
  describe(parameters.weights, visitor);
  visitor.number({.name = "detail_length",
                  .help = "details smaller than this keep their shape; beyond it the surface bends "
                          "and stretches like an elastic sheet. A fraction of the ROI's radius, "
                          "the root mean square distance of its surface from its centroid"},
                 parameters.detail_length,
                 {.least = kLeastDetailLength,
                  .most = kMostDetailLength,
                  .slider_from = 0.01,
                  .slider_to = 1.0});
  visitor.choice({.name = "response",
                  .help = "the linear response from which a drag starts: that of the energy, or "
                          "that of the paper. With `settle` off, `rsi` solves the paper's equation "
                          "10"},
                 parameters.response,
                 {{LinearResponse::tangent, "tangent"}, {LinearResponse::rsi, "rsi"}});
  visitor.number(
      {.name = "constraint_weight",
       .help = "hold belt and handles softly, by this weight in the least-squares system: "
               "1 in the paper. Without it they reach their places",
       .absent = "none"},
      parameters.constraint_weight, kWeight);
  visitor.boolean({.name = "hard", .help = "hold belt and handles exactly"}, parameters.hard);
  visitor.object({.name = "settle",
                  .help = "minimize the energy; off keeps the linear response, which is accurate "
                          "for small angles only",
                  .off_flag = "no-settle",
                  .off_help = "keep the linear response, which is accurate for small angles only"},
                 parameters.settle, ObjectForm::boolean);
  visitor.number({.name = "commit_every",
                  .help = "divide a larger turn into equal substeps of at most this many degrees, "
                          "each the rest shape of the next",
                  .absent = "off"},
                 parameters.commit_every,
                 {.least = 0.0,
                  .most = kLargestSettledTurnDegrees,
                  .takes_least = false,
                  .reason = "beyond half a turn the opposite direction is shorter",
                  .first = 90.0});
  visitor.choice({.name = "loose",
                  .help = "components that no handle, belt or vertex outside the ROI holds: they "
                          "are carried along with the nearest surface, stay, or are an error"},
                 parameters.loose,
                 {{LoosePolicy::carry, "carry"},
                  {LoosePolicy::leave, "leave"},
                  {LoosePolicy::refuse, "refuse"}});
  visitor.choice(
      {.name = "seams",
       .help = "boundary edges that coincide but have separate vertices, as at hard edges "
               "and texture seams: they are edited as one surface and stay closed, or may "
               "move apart"},
      parameters.seams, {{SeamPolicy::join, "join"}, {SeamPolicy::leave, "leave"}});
}

void require_valid(DeformParameters parameters) {
  Validation validation;
  describe(parameters, validation);
}

void require_valid(const Move& move, const DeformParameters& parameters) {
  if (const auto* similarity = std::get_if<SimilarityMove>(&move)) {
    const auto& [translate, rotate, scale, pivot] = *similarity;
    const bool finite = translate.allFinite() && rotate.axis.allFinite() &&
                        std::isfinite(rotate.degrees) && scale.allFinite() &&
                        (!pivot || pivot->allFinite());
    if (!finite) throw InputError("move: a number is not finite; move the handle less");
    if (!(scale.minCoeff() > 0.0))
      throw InputError("move: the scale must be above 0; to mirror, use a matrix");
    if (!(rotate.axis.norm() > 0.0)) {
      throw InputError("move: the axis is zero; give a direction");
    }
  } else if (!std::get<MatrixMove>(move).matrix.allFinite()) {
    throw InputError("move: a number is not finite; move the handle less");
  }
  if (parameters.commit_every && mirrors(move)) {
    throw InputError(std::string("move: ") + kMirrorsInParts);
  }
}

void describe(DeformRequest& step, KeyVisitor& visitor) {
  visitor.region({.name = "roi",
                  .help = "the part that may move; nothing outside it does",
                  .required = true,
                  .flag_default = "all"},
                 step.roi);
  visitor.belt({.name = "belt",
                .help = "the part of the ROI that stays: the outer fraction of it, or a region"},
               step.belt);
  visitor.handles({.name = "handles",
                   .help = "the parts that you move: each a region and its move",
                   .absent = "none"},
                  step.handles, HandleForm::graded);
  visitor.targets(
      {.name = "targets",
       .help = "points of the surface and their prescribed positions: rows of vertex, x, y, "
               "z, or of px, py, pz, x, y, z for the surface point nearest to p; a weight may "
               "follow",
       .absent = "none"},
      step.targets);
  visitor.stiffness({.name = "stiffness",
                     .help = "parts that are stiffer or softer than the rest, such as bones, teeth "
                             "or armour; if several parts contain a vertex, the last one applies",
                     .absent = "none"},
                    step.stiffness);
  visitor.mirror({.name = "mirror",
                  .help = "apply ROI, belt, handles, targets and stiffness on both sides of a "
                          "plane: the plane of symmetry found from the shape, a coordinate plane "
                          "(x = 0), or any plane",
                  .absent = "none"},
                 step.mirror);
  visitor.carry({.name = "carry",
                 .help = "other files that follow the surface, each point with the part nearest to "
                         "it: meshes, point clouds, tables of x, y, z with a normal or quaternion",
                 .absent = "none"},
                step.carry);
  visitor.require(!step.handles.empty() || !step.targets.empty(), "handles",
                  "nothing is moved; give at least one handle or target");
  describe(step.parameters, visitor);
  require_orientations(step, visitor);
  require_paths(step, visitor);
  // A reflection cannot be split into substeps.
  for (std::size_t k = 0; k < step.handles.size() && step.parameters.commit_every; ++k) {
    visitor.require(!mirrors(step.handles[k].move), "handles/" + std::to_string(k) + "/move/matrix",
                    kMirrorsInParts);
  }
}

}  // namespace lapwing
