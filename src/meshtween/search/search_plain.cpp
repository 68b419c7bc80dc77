#define MESHTWEEN_LANES 4
#include "meshtween/search/wide_kernel.h"

namespace meshtween::search {

void search_plain(const WideView& tree, WideQuery& query) {
    Search(tree, query).run();
}

} // namespace meshtween::search
