#pragma once

namespace lapwing::cli {

/// What the command line returns.
enum ExitCode : int {
  kDone = 0,
  kFault = 1,  ///< of the program itself
  kUsage = 2,
  kInput = 3,  ///< mesh or recipe
  kSolver = 4,
  kDevice = 5,
  kFile = 6,
  kSignalled = 128,  ///< and the signal's number, as a shell reports it
  kCancelled = 130,  ///< by an interrupt
};

}  // namespace lapwing::cli
