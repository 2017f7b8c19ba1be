#pragma once

namespace lapwing::bench {

/// OpenBLAS chooses its kernels as it is loaded, by the model of the processor. Of one that is
/// newer than the library it knows nothing, and takes kernels of 2004, which make a third of what
/// the processor can: no limit to measure by, and no CHOLMOD to compare with. Where that is so this
/// starts the program again, with the kernels for the processor's vector instructions
/// (OPENBLAS_CORETYPE). To be called first; `arguments` are those of `main`.
void require_fitting_blas(char** arguments);

}  // namespace lapwing::bench
