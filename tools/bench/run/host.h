#pragma once

#include "report/report.h"

namespace lapwing::bench {

/// Describes this machine.
Host this_host();

/// Returns the current time as ISO 8601 in UTC, to the second.
std::string now_utc();

/// Returns the source revision as git described it when CMake last ran, or "unknown".
std::string built_from();

/// Restarts the program with suitable OpenBLAS kernels if OpenBLAS does not know the processor.
/// When OpenBLAS is loaded, it chooses kernels by processor model. For a model newer than the
/// library it takes kernels of 2004, which reach a third of the processor's speed. With such
/// kernels the rows named `limit` would be too low, and CHOLMOD would look slower than it is. The
/// restart sets OPENBLAS_CORETYPE to kernels for the processor's vector instructions. Call this
/// first, with the arguments of `main`.
void require_fitting_blas(char** arguments);

}  // namespace lapwing::bench
