#pragma once

#include <memory>
#include <vector>

#include "lapwing/elastic/deform_options.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/constraints.h"
#include "lapwing/laplacian/laplacian_system.h"
#include "lapwing/laplacian/system_pattern.h"
#include "run/subject.h"

namespace lapwing::bench {

/// Number of right-hand sides of the response to one handle.
inline constexpr std::size_t kResponseColumns = 12;

/// The inputs of the stages of a preparation, for a subject's region with soft constraints of
/// weight 1 and uniform Laplacian weights.
struct EditParts {
  explicit EditParts(const Subject& subject)
      : constraints(constraints_of(subject.region, subject.mesh.topology(), 1.0, false)),
        pattern(std::make_unique<SystemPattern>(subject.mesh.topology(), subject.region.roi,
                                                constraints.unknowns)),
        weights(laplacian_weights(subject.mesh.topology(), subject.mesh.positions,
                                  LaplacianWeights::uniform)) {}

  RingProblem ring_problem(const Subject& subject) const {
    return {subject.mesh.positions, subject.mesh.topology().rings, weights, subject.region.roi};
  }
  LaplacianSystem laplacian_system(const Subject& subject) const {
    StageTimings timings;
    return {subject.mesh.positions,
            subject.mesh.topology(),
            subject.region.roi,
            constraints,
            *pattern,
            EnergyTerms{DeformOptions{}.weights, DeformOptions{}.detail_length},
            timings};
  }

  Constraints constraints;
  std::unique_ptr<SystemPattern> pattern;
  std::vector<double> weights;
};

}  // namespace lapwing::bench
