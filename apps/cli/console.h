// How the program talks while it works: a bar, notes, and Ctrl-C. All of it goes to standard error.
#pragma once

#include "meshtween/core/progress.h"

#include <string>
#include <vector>

// From here on Ctrl-C (SIGINT) and SIGTERM ask running work to stop instead of ending the program at once.
void catch_interrupts();
bool interrupted();

// Thrown where work was stopped on request; main turns it into exit status 130.
struct Interrupted {};
void stop_if_interrupted();

class Console {
public:
    explicit Console(bool quiet);
    ~Console();
    // Draws a bar where standard error is a terminal; asks work to stop after Ctrl-C.
    meshtween::Progress progress();
    void note(const std::string& text); // a line, unless quiet
    void warn(const std::string& text); // a line, always
    void warn(const std::string& prefix, const std::vector<std::string>& texts);

private:
    void clear();
    bool quiet_, terminal_, drawn_ = false;
};
