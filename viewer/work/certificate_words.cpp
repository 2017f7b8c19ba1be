#include "work/certificate_words.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "lapwing/base/counted.h"

namespace lapwing::viewer {
namespace {

// If a one-ring grows or shrinks by more than this factor, details look stretched or compressed.
constexpr double kMostRingScale = 2.0;
// If more than this fraction of the detail is lost, the difference from the rest shape is visible.
constexpr double kMostDetailLost = 0.25;

std::string formatted(const char* format, double a) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), format, a);
  return text.data();
}

// Returns the vertex and its ring, because the camera cannot zoom to a single vertex.
std::vector<Index> with_ring(Index vertex, const Topology& topology) {
  return with_ring_neighbours(std::array{vertex}, topology.rings);
}

std::vector<Index> corners_of(std::span<const Index> triangles, const Topology& topology) {
  std::vector<Index> corners;
  for (const Index t : triangles) {
    corners.insert(corners.end(), topology.triangles[t].begin(), topology.triangles[t].end());
  }
  return make_vertex_set(std::move(corners));
}

CertificateWarning not_settled(const Certificate& certificate) {
  std::string next =
      "Move the handle in smaller steps, or raise \"Max iterations\" in the solver settings.";
  std::vector<Remedy> remedies{Remedy::raise_iterations, Remedy::undo};
  if (certificate.lacks_hessian) {
    next =
        "There is not enough memory to refine. Select a smaller region, or close other programs.";
    remedies = {Remedy::select_region};
  } else if (!certificate.region_is_whole) {
    next =
        "Enlarge the region, move the handle in smaller steps, or raise \"Max iterations\" in the "
        "solver settings.";
    remedies.insert(remedies.begin(), Remedy::enlarge_region);
  }
  return {"Not fully refined after " +
              counted(static_cast<std::size_t>(certificate.settle_iterations), "iterations") +
              formatted(": the next one would move a vertex by %.2g mean edge lengths. ",
                        certificate.settle_last_step) +
              next,
          {},
          std::move(remedies)};
}

// Suggests a larger region only if the region is not the whole mesh.
std::string advice(const Certificate& certificate) {
  return certificate.region_is_whole
             ? " Move the handle less, or in smaller steps."
             : " Enlarge the region, or move the handle less or in smaller steps.";
}

// The remedies that `advice` names.
std::vector<Remedy> remedies_of(const Certificate& certificate) {
  if (certificate.region_is_whole) return {Remedy::undo};
  return {Remedy::enlarge_region, Remedy::undo};
}

CertificateWarning inside_out(const Certificate& certificate, const Topology& topology) {
  return {formatted("%.0f%% of the region is inside out.", 100.0 * certificate.inside_out_share) +
              advice(certificate),
          with_ring(certificate.inside_out_vertex, topology), remedies_of(certificate)};
}

CertificateWarning folded(const Certificate& certificate, const Topology& topology) {
  const std::size_t count = certificate.flipped_triangles;
  return {(count == 1 ? std::string("A triangle is folded over.")
                      : std::to_string(count) + " triangles are folded over.") +
              advice(certificate),
          corners_of(certificate.first_flipped_triangles, topology), remedies_of(certificate)};
}

CertificateWarning handle_missed(const Certificate& certificate) {
  return {formatted("The handle misses its target by %.2g%% of the mesh's size.",
                    100.0 * certificate.handle_error / certificate.rest_diagonal) +
              " Raise \"Constraint weight\" in the solver settings, or turn on \"Hold exactly\".",
          {},
          {Remedy::hold_exactly}};
}

}  // namespace

const char* label_of(Remedy remedy) {
  switch (remedy) {
    case Remedy::enlarge_region:
      return "Enlarge region";
    case Remedy::select_region:
      return "Select region";
    case Remedy::raise_iterations:
      return "Raise iterations";
    case Remedy::hold_exactly:
      return "Hold exactly";
    case Remedy::undo:
      return "Undo last step";
  }
  return "";
}

const char* explanation_of(Remedy remedy) {
  switch (remedy) {
    case Remedy::enlarge_region:
      return "Adds a margin around the region, with half as many vertices as the region has. The "
             "handles keep their moves.";
    case Remedy::select_region:
      return "Selects another region.";
    case Remedy::raise_iterations:
      return "Doubles \"Max iterations\" and refines again.";
    case Remedy::hold_exactly:
      return "Turns on \"Hold exactly\" in the solver settings.";
    case Remedy::undo:
      return "Undoes the last step, so that you can move the handle less.";
  }
  return "";
}

std::vector<CertificateWarning> warnings_of(const Certificate& certificate,
                                            const Topology& topology) {
  std::vector<CertificateWarning> warnings;
  if (!certificate.settled) warnings.push_back(not_settled(certificate));
  if (certificate.inside_out_share > kMostInsideOut) {
    warnings.push_back(inside_out(certificate, topology));
  } else if (certificate.flipped_triangles > 0) {
    warnings.push_back(folded(certificate, topology));
  }
  if (misses_handles(certificate)) warnings.push_back(handle_missed(certificate));
  if (certificate.detail_error > kMostDetailLost) {
    warnings.push_back({formatted("%.0f%% of the detail is lost.",
                                  std::min(100.0 * certificate.detail_error, 100.0)) +
                            advice(certificate),
                        {},
                        remedies_of(certificate)});
  }
  if (certificate.largest_scale > kMostRingScale) {
    warnings.push_back({formatted("The surface grew to %.1f times its size in one spot.",
                                  certificate.largest_scale) +
                            advice(certificate),
                        with_ring(certificate.largest_scale_vertex, topology),
                        remedies_of(certificate)});
  }
  if (certificate.smallest_scale < 1.0 / kMostRingScale) {
    warnings.push_back({formatted("The surface shrank to %.0f%% of its size in one spot.",
                                  100.0 * certificate.smallest_scale) +
                            advice(certificate),
                        with_ring(certificate.smallest_scale_vertex, topology),
                        remedies_of(certificate)});
  }
  if (1.0 + certificate.largest_edge_stretch > kLongEdge) {
    auto ends = certificate.largest_edge_stretch_vertices;
    std::sort(ends.begin(), ends.end());
    warnings.push_back(
        {formatted("An edge became %.1f times as long.", 1.0 + certificate.largest_edge_stretch) +
             advice(certificate),
         {ends.begin(), ends.end()},
         remedies_of(certificate)});
  }
  return warnings;
}

}  // namespace lapwing::viewer
