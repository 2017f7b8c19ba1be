#pragma once

#include <span>
#include <string_view>

#include "lapwing/recipe/key_visitor.h"

namespace lapwing {

/// The keys of each step, in the order in which recipes are written.
void describe(DeformRequest& step, KeyVisitor& visitor);
void describe(CoatStep& step, KeyVisitor& visitor);
void describe(MixStep& step, KeyVisitor& visitor);
void describe(TransplantStep& step, KeyVisitor& visitor);
/// And of parts of them, which panels show.
void describe(DeformParameters& parameters, KeyVisitor& visitor);
void describe(CoatParameters& parameters, KeyVisitor& visitor);
void describe(CoatOptions& options, KeyVisitor& visitor);
void describe(TransplantParameters& parameters, KeyVisitor& visitor);
/// The key "weights".
void describe(LaplacianWeights& weights, KeyVisitor& visitor);
/// And of objects in them.
void describe(SettleOptions& settle, KeyVisitor& visitor);
void describe(FileSource& source, KeyVisitor& visitor);
void describe(Transition& transition, KeyVisitor& visitor);

/// One kind of step.
struct Operation {
  std::string_view name;  ///< {"op": NAME}; the command of that name
  std::string_view help;  ///< what the command does, in a few words
  Step step;              ///< with every default
};
/// All of them, in the order of Step.
std::span<const Operation> operations();

/// Throws InputError, naming the key and what it takes, for a number that a recipe would refuse.
void require_valid(DeformParameters parameters);

/// The keys of whichever step it is.
void describe(Step& step, KeyVisitor& visitor);

}  // namespace lapwing
