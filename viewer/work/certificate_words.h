#pragma once

#include <string>
#include <vector>

#include "lapwing/deform/certificate.h"

namespace lapwing::viewer {

/// Something about a result that a user should check.
struct CertificateWarning {
  std::string text;             ///< the problem and the next step, in one or two sentences
  std::vector<Index> vertices;  ///< to frame, ascending; empty for the whole edit
};

/// Largest factor by which a ring may grow or shrink. Beyond it details are crowded or pulled
/// apart.
inline constexpr double kMostRingScale = 2.0;
/// Largest share of lost details. Above it the difference from the rest shape is visible.
inline constexpr double kMostDetailLost = 0.25;

/// Returns the problems in the certificate, the gravest first; empty if there are none. Judges
/// handles and edges as lapwing's `warnings_of` does.
std::vector<CertificateWarning> warnings_of(const Certificate& certificate,
                                            const Topology& topology);

}  // namespace lapwing::viewer
