#pragma once

#include <string>
#include <vector>

#include "lapwing/deform/certificate_warnings.h"

namespace lapwing::viewer {

/// A problem of a result that the user should check.
struct CertificateWarning {
  std::string text;             ///< the problem and the next step, in one or two sentences
  std::vector<Index> vertices;  ///< vertices to show, ascending; empty for the whole edit
};

/// Returns the problems in the certificate, the most severe first. The thresholds for handles and
/// edges are those of `lapwing::warnings_of`.
std::vector<CertificateWarning> warnings_of(const Certificate& certificate,
                                            const Topology& topology);

}  // namespace lapwing::viewer
