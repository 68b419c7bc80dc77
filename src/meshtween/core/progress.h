// How long work tells where it stands, and how it is told to stop.
#pragma once

#include <functional>
#include <string_view>

namespace meshtween {

// Called from the thread that started the work, often (every few milliseconds of work): `fraction` in 0..1 of the whole
// job, never falling, and the stage's name in words. Returning false asks the work to stop; it then returns the best
// result so far and says that it was cancelled.
using Progress = std::function<bool(double fraction, std::string_view stage)>;

// True where there is nobody to ask, or where they say to go on.
inline bool keep_going(const Progress& progress, double fraction, std::string_view stage) {
    return !progress || progress(fraction, stage);
}

// The part `from`..`to` of a larger job's progress, for one stage of it.
inline Progress part_of(const Progress& progress, double from, double to) {
    if (!progress) return {};
    return [progress, from, to](double fraction, std::string_view stage) {
        return progress(from + (to - from) * fraction, stage);
    };
}

} // namespace meshtween
