#include "lapwing/elastic/embedding_loops.h"

namespace lapwing {
namespace {

#include "lapwing/elastic/embedding_loops.inl"

}  // namespace

extern const EmbeddingLoops kEmbeddingLoopsAvx2;
const EmbeddingLoops kEmbeddingLoopsAvx2 = {carry};

}  // namespace lapwing
