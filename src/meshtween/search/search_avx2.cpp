#define MESHTWEEN_LANES 8
#include "meshtween/search/wide_kernel.h"

namespace meshtween::search {

void search_avx2(const WideView& tree, WideQuery& query) {
    Search(tree, query).run();
}

} // namespace meshtween::search
