#include "tabs.h"

#include <algorithm>

namespace meshtween::studio {

void Tabs::join(const std::string& tab) {
    const std::lock_guard lock(mutex_);
    if (std::find(open_.begin(), open_.end(), tab) == open_.end()) open_.push_back(tab);
}

void Tabs::leave(const std::string& tab) {
    const std::lock_guard lock(mutex_);
    std::erase(open_, tab);
}

void Tabs::take_over(const std::string& tab) {
    const std::lock_guard lock(mutex_);
    std::erase(open_, tab);
    open_.insert(open_.begin(), tab);
}

std::string Tabs::editor() const {
    const std::lock_guard lock(mutex_);
    return open_.empty() ? std::string() : open_.front();
}

} // namespace meshtween::studio
