#pragma once

#include <string>
#include <vector>

#include "lapwing/deform/certificate_warnings.h"

namespace lapwing::viewer {

/// A remedy for a problem, which the window applies at one click.
enum class Remedy { enlarge_region, select_region, raise_iterations, hold_exactly, undo };

/// Returns the label of the button, such as "Enlarge region".
const char* label_of(Remedy remedy);
/// Returns a sentence for the button's tooltip.
const char* explanation_of(Remedy remedy);

/// A problem of a result that the user should check.
struct CertificateWarning {
  std::string text;             ///< the problem and the next step, in one or two sentences
  std::vector<Index> vertices;  ///< vertices to show, ascending; empty for the whole edit
  std::vector<Remedy> remedies;  ///< at least one; the user should try the first one first
};

/// Returns the problems in the certificate, the most severe first. The thresholds for handles and
/// edges are those of `lapwing::warnings_of`.
std::vector<CertificateWarning> warnings_of(const Certificate& certificate,
                                            const Topology& topology);

}  // namespace lapwing::viewer
