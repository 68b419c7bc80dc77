// The methods behind morph(), each in its own file. They expect checked input. Not for callers outside this folder.
#pragma once

#include "meshtween/morph/morph.h"

#include <mutex>

namespace meshtween {

Morph rigid_morph(const Mesh& from, const Points& to, const MorphOptions& options, const Progress& progress);
Morph linear_morph(const Points& from, const Points& to);
Morph laplacian_morph(const Mesh& from, const Points& to);
Morph dual_morph(const Mesh& from, const Points& to, const MorphOptions& options, const Progress& progress);
Morph dual_as_printed_morph(const Mesh& from, const Points& to, const MorphOptions& options);
Morph edges_morph(const Mesh& from, const Points& to);
Morph dual_mesh_morph(const Mesh& from, const Points& to, const MorphOptions& options);

// The report of the solve with the most sweeps, kept while several threads solve.
class MostLaborious {
public:
    void add(const SolveReport& report);
    SolveReport get() const;

private:
    mutable std::mutex mutex_;
    SolveReport report_;
};

} // namespace meshtween
