#pragma once

#include <string_view>

namespace lapwing {

class KeyVisitor;
struct StepReport;
struct StepContext;

/// The name of an operation, and its description.
struct OperationWords {
  std::string_view name;  ///< in {"op": NAME}, and of the command
  std::string_view help;  ///< what it does, in a few words
  /// Text between the name and the files of a step, as in "coat from gargoyle.off".
  std::string_view before_files = " ";
};

}  // namespace lapwing
