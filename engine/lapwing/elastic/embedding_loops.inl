// The inner loop of CoarseEmbedding (elastic/coarse_embedding.cpp). Included by
// embedding_loops_*.cpp inside an unnamed namespace. Calls no function with external linkage, for
// which the linker could use the copy of another instruction set.

// Four doubles; also efficient if a register contains only two.
typedef double Row __attribute__((vector_size(sizeof(double) * 4), may_alias));

static inline __attribute__((always_inline)) double sum_of(Row row) {
  return (row[0] + row[2]) + (row[1] + row[3]);
}

void carry(const CarriedVertices& carried, std::size_t first, std::size_t last, double* u) {
  for (std::size_t k = first; k < last; ++k) {
    const EmbeddedVertex& embedded = carried.embedded[k];
    Row motion[3] = {};
    for (std::size_t node = 0; node < kEmbeddingNodes; ++node) {
      const double weight = embedded.weights[node];
      const RowsOfMotion& own = carried.motions[embedded.nodes[node]];
      for (int a = 0; a < 3; ++a) motion[a] += weight * *reinterpret_cast<const Row*>(own.row[a]);
    }
    const std::size_t at = 3 * static_cast<std::size_t>(carried.vertices[k]);
    Row place = {0.0, 0.0, 0.0, 1.0};
    for (std::size_t a = 0; a < 3; ++a) {
      place[a] = carried.rest[at + a] - carried.origin[a] + u[at + a];
    }
    for (std::size_t a = 0; a < 3; ++a) u[at + a] += sum_of(motion[a] * place);
  }
}
