// One exception type for bad input. Not converging and being cancelled are results, not errors.
#pragma once

#include <stdexcept>
#include <string>

namespace meshtween {

// What kind of thing is wrong; the command line's exit status is its value.
enum class ErrorKind {
    argument = 1,    // an option or argument that cannot be meant
    computation = 2, // sound input, but no answer (a singular system, markers on one line)
    file = 3,        // a file that cannot be read, understood or written
};

// The message names the file, the line or the element, and what to do about it.
class Error : public std::runtime_error {
public:
    Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
    ErrorKind kind() const { return kind_; }

private:
    ErrorKind kind_;
};

} // namespace meshtween
