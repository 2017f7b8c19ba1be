#pragma once

#include <string_view>

namespace lapwing {

class KeyVisitor;
struct StepReport;
struct StepRun;

/// How an operation is called.
struct OperationWords {
  std::string_view name;  ///< {"op": NAME}; the command of that name
  std::string_view help;  ///< what it does, in a few words
  /// Between the name and the files of a step: "coat from gargoyle.off".
  std::string_view before_files = " ";
};

}  // namespace lapwing
