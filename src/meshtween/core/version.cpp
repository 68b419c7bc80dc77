#include "meshtween/core/version.h"

namespace meshtween {

const char* version() {
    return MESHTWEEN_VERSION; // the project's, from CMake
}

} // namespace meshtween
