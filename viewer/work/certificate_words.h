#pragma once

#include <string>
#include <vector>

#include "lapwing/deform/certificate.h"

namespace lapwing::viewer {

/// Something about a result that a person should look at.
struct CertificateWarning {
  std::string text;             ///< one sentence or two: what it is, and what to do
  std::vector<Index> vertices;  ///< to frame, ascending; empty where all of the edit is meant
};

/// A ring that grew or shrank by more than this factor: beyond it details are crowded or pulled
/// apart.
inline constexpr double kMostRingScale = 2.0;
/// Above this part of the details lost the difference shows beside the rest shape.
inline constexpr double kMostDetailLost = 0.25;

/// What the certificate says that is not as it should be, the gravest first, handles and edges as
/// lapwing's `warnings_of` judges them; empty when all is well.
std::vector<CertificateWarning> warnings_of(const Certificate& certificate,
                                            const Topology& topology);

}  // namespace lapwing::viewer
