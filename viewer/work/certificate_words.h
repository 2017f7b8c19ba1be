#pragma once

#include <string>
#include <vector>

#include "lapwing/deform/certificate_warnings.h"

namespace lapwing::viewer {

/// Something about a result that a user should check.
struct CertificateWarning {
  std::string text;             ///< the problem and the next step, in one or two sentences
  std::vector<Index> vertices;  ///< to frame, ascending; empty for the whole edit
};

/// Returns the problems in the certificate, the gravest first; empty if there are none. Judges
/// handles and edges as lapwing's `warnings_of` does.
std::vector<CertificateWarning> warnings_of(const Certificate& certificate,
                                            const Topology& topology);

}  // namespace lapwing::viewer
