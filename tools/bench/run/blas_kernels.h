#pragma once

namespace lapwing::bench {

/// Restarts the program with suitable OpenBLAS kernels if OpenBLAS does not know the processor.
/// When OpenBLAS is loaded, it chooses kernels by processor model. For a model newer than the
/// library it takes kernels of 2004, which reach a third of the processor's speed. With such
/// kernels the rows named `limit` would be too low, and CHOLMOD would look slower than it is. The
/// restart sets OPENBLAS_CORETYPE to kernels for the processor's vector instructions. Call this
/// first, with the arguments of `main`.
void require_fitting_blas(char** arguments);

}  // namespace lapwing::bench
