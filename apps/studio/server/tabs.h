// Which of several open pages may edit: the first; another can take over.
#pragma once

#include <mutex>
#include <string>
#include <vector>

namespace meshtween::studio {

class Tabs {
public:
    void join(const std::string& tab); // the first to join, or to join an empty house, edits
    void leave(const std::string& tab);
    void take_over(const std::string& tab);
    std::string editor() const; // empty where no page is open

private:
    mutable std::mutex mutex_;
    std::vector<std::string> open_; // the editor first
};

} // namespace meshtween::studio
