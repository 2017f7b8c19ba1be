#pragma once

namespace lapwing::cli {

/// Exit codes of the command line.
enum ExitCode : int {
  kDone = 0,
  kFault = 1,  ///< a bug in the program
  kUsage = 2,
  kInput = 3,  ///< mesh or recipe
  kSolver = 4,
  kDevice = 5,
  kFile = 6,
  kSignalled = 128,  ///< plus the signal's number, as shells report it
  kCancelled = 130,  ///< by an interrupt
};

}  // namespace lapwing::cli
