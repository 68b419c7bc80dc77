// The options that the page offers, each with its explanation: one table that draws the page and reads its answers.
#pragma once

#include "events.h"

#include "meshtween/fit/fit.h"
#include "meshtween/morph/keys.h"

namespace meshtween::studio {

// [{name, label, help, type: "number" | "choice", default, min, max, choices: [name, ...], when: [name, choice]}, ...]:
// an option with `when` says something only where another one has that choice.
Json fit_schema();
Json morph_schema();

// From {name: value, ...}; what is missing keeps its default. Throws Error(argument) naming an option that is unknown,
// of another type or out of range.
FitOptions fit_options(const Json& values);
KeyOptions path_options(const Json& values);

} // namespace meshtween::studio
