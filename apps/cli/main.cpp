// meshtween: morph one 3D shape into another, from the command line.
#include "console.h"
#include "inputs.h"
#include "meshtween/core/version.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"

#include <fmt/format.h>

#include <new>

int main(int argc, char** argv) {
    CLI::App app{
        "meshtween morphs one 3D shape into another of similar build.\n"
        "Exit status: 0 done, 1 wrong arguments, 2 the computation failed, 3 a bad file, 130 stopped by Ctrl-C."};
    app.set_version_flag("--version", meshtween::version());
    app.require_subcommand(1);
    app.fallthrough();
    app.footer(
        "Try: meshtween sample bow -o . && meshtween morph bow_source.ply bow_target.ply --markers bow_markers.csv -o "
        "morph.html\nmeshtween VERB --help tells each verb's options.");

    Common common;
    app.add_option("--threads", common.threads, "Threads to use; 0 means all")->check(CLI::Range(0, 4096));
    app.add_option("--seed", common.seed, "Of the random sample points with which distances are measured")
        ->capture_default_str();
    app.add_flag("--quiet", common.quiet, "Say nothing but warnings and errors");
    app.parse_complete_callback([&] { meshtween::set_threads(common.threads); });

    for (const auto add : {add_morph, add_fit, add_tween, add_blend, add_rotate, add_measure, add_check, add_sample,
                           add_studio, add_transfer})
        add(app, common);

    catch_interrupts();
    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::Success& done) { // --help, --version
        return app.exit(done);
    } catch (const CLI::ParseError& error) {
        const auto verbs = app.get_subcommands();
        if (verbs.empty() && !app.remaining().empty())
            fmt::print(stderr, "meshtween: there is no verb \"{}\"\nmeshtween --help lists them\n",
                       app.remaining().front());
        else
            fmt::print(stderr, "meshtween: {}\nmeshtween {}--help tells more\n", error.what(),
                       verbs.empty() ? "" : verbs.front()->get_name() + " ");
        return 1;
    } catch (const Interrupted&) {
        fmt::print(stderr, "meshtween: stopped; no unfinished file was left\n");
        return 130;
    } catch (const meshtween::Error& error) {
        fmt::print(stderr, "meshtween: {}\n", error.what());
        return static_cast<int>(error.kind());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "meshtween: out of memory; use smaller meshes or a larger machine\n");
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "meshtween: {}\n", error.what());
        return 2;
    }
}
