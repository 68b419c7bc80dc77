#include "inputs.h"

#include "studio.h"

#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

using namespace meshtween;

void add_studio(CLI::App& app, const Common& common) {
    auto* verb = app.add_subcommand("studio", "Place markers, fit and morph in the browser, on this machine alone");
    verb->footer("Example: meshtween studio igea.ply planck.obj\n"
                 "Without meshes the last project is opened again. Ctrl-C ends the studio; all work is saved as it is "
                 "done.");
    const auto options = std::make_shared<studio::StudioOptions>();
    verb->add_option("MESHES", options->meshes, "Source and target")->expected(2)->option_text("SOURCE TARGET");
    verb->add_option("--port", options->port, "Port to listen on; 0 takes a free one")
        ->check(CLI::Range(0, 65535))
        ->capture_default_str();
    verb->add_flag_callback(
        "--no-browser", [options] { options->browser = false; }, "Print the address without opening it");
    verb->add_option("--project", options->project,
                     "Project file to work on; by default one that belongs to the two meshes, in the state folder");
    verb->callback([options, &common] {
        Console console(common.quiet);
        options->stop_wanted = interrupted;
        options->ready = [&](const std::string& address) {
            fmt::print("{}\n", address);
            std::fflush(stdout);
            console.note("The studio runs until Ctrl-C. Everything stays on this machine.");
        };
        studio::run_studio(*options);
    });
}
