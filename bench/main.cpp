// Runs the benchmarks in an order that spreads the machine's noise over all of them, and closes with a table of ratios
// between the least times of each.
#include "compare.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <vector>

namespace {

struct Row {
    std::string what, peer, ours;
    double wanted;
};
std::vector<Row>& rows() {
    static std::vector<Row> all;
    return all;
}

// Prints as usual and keeps each benchmark's least CPU time, which other work on the machine disturbs least.
class Reporter : public benchmark::ConsoleReporter {
public:
    Reporter() : ConsoleReporter(OO_Tabular) {}
    void ReportRuns(const std::vector<Run>& runs) override {
        std::vector<Run> single; // without means and deviations, which the noise makes meaningless
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration) continue;
            single.push_back(run);
            failed = failed || run.error_occurred;
            if (run.error_occurred) continue;
            const double seconds = run.cpu_accumulated_time / static_cast<double>(run.iterations);
            const auto [it, first] = least.try_emplace(run.run_name.function_name, seconds);
            it->second = std::min(it->second, seconds);
        }
        ConsoleReporter::ReportRuns(single);
    }
    std::map<std::string, double> least;
    bool failed = false;
};

} // namespace

bool compare(std::string what, std::string peer, std::string ours, double wanted) {
    rows().push_back({std::move(what), std::move(peer), std::move(ours), wanted});
    return true;
}

int main(int argc, char** argv) {
    std::vector<char*> arguments(argv, argv + argc);
    std::string repetitions = "--benchmark_repetitions=3", interleaved = "--benchmark_enable_random_interleaving=true";
    arguments.insert(arguments.begin() + 1, {repetitions.data(), interleaved.data()}); // the user's own come later
    int count = static_cast<int>(arguments.size());
    benchmark::Initialize(&count, arguments.data());
    if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 1;
    Reporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
    std::printf("\n%-64s %10s %10s %7s %7s\n", "the peer's time over ours, least of all repetitions", "peer, s",
                "ours, s", "ratio", "wanted");
    for (const Row& row : rows()) {
        const auto peer = reporter.least.find(row.peer), ours = reporter.least.find(row.ours);
        if (peer == reporter.least.end() || ours == reporter.least.end()) continue;
        std::printf("%-64s %10.4f %10.4f %7.2f %7.2f\n", row.what.c_str(), peer->second, ours->second,
                    peer->second / ours->second, row.wanted);
    }
    return reporter.failed ? 1 : 0;
}
