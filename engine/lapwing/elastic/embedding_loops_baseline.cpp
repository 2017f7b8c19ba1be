#include "lapwing/elastic/embedding_loops.h"

namespace lapwing {
namespace {

#include "lapwing/elastic/embedding_loops.inl"

}  // namespace

extern const EmbeddingLoops kEmbeddingLoopsBaseline;
const EmbeddingLoops kEmbeddingLoopsBaseline = {carry};

}  // namespace lapwing
