#include "lapwing/elastic/embedding_loops.h"

namespace lapwing {
namespace {

#include "lapwing/elastic/embedding_loops.inl"

}  // namespace

extern const EmbeddingLoops kEmbeddingLoopsAvx512;
const EmbeddingLoops kEmbeddingLoopsAvx512 = {carry};

}  // namespace lapwing
