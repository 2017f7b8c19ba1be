#include "lapwing/deform/embedding_loops.h"

namespace lapwing {
namespace {

#include "lapwing/deform/embedding_loops.inl"

}  // namespace

extern const EmbeddingLoops kEmbeddingLoopsBaseline;
const EmbeddingLoops kEmbeddingLoopsBaseline = {carry};

}  // namespace lapwing
