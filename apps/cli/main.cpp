// meshtween: morph one 3D shape into another, from the command line.
#include "console.h"
#include "inputs.h"
#include "result_files.h"
#include "spelling.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/core/version.h"

#include <fmt/format.h>

#include <new>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace {

std::string perhaps(const std::string& word, const std::vector<std::string>& names) {
    const std::string name = nearest_name(word, names);
    return name.empty() ? "" : fmt::format("; did you mean {}?", name);
}

std::string no_such_verb(const CLI::App& app, const std::string& word) {
    std::vector<std::string> names;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(verb->get_name());
    return fmt::format("there is no verb \"{}\"{}\nmeshtween --help lists them", word, perhaps(word, names));
}

// An option that does not exist is told before what is missing: it is mostly the same thing.
std::string misused(const CLI::App& app, const CLI::App& verb, const std::string& problem) {
    std::vector<std::string> names;
    for (const CLI::App* taker : {&verb, &app})
        for (const CLI::Option* option : taker->get_options())
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    std::string what = problem;
    for (const CLI::App* taker : {&verb, &app})
        for (const std::string& word : taker->remaining()) {
            const std::string name = word.substr(0, word.find('='));
            if (name.starts_with("--"))
                what = fmt::format("{} has no option {}{}", verb.get_name(), name, perhaps(name, names));
        }
    return fmt::format("{}\nmeshtween {} --help tells more", what, verb.get_name());
}

// Large arrays come and go many times a second: memory that was given back to the system each time would be wiped each
// time.
void keep_memory() {
#if defined(__GLIBC__)
    constexpr int mebibyte = 1 << 20;
    mallopt(M_MMAP_THRESHOLD, 32 * mebibyte);
    mallopt(M_TRIM_THRESHOLD, 1024 * mebibyte);
#endif
}

} // namespace

int main(int argc, char** argv) {
    keep_memory();
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
    for (CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
        verb->parse_complete_callback([verb] { check_result_files(*verb); });

    catch_interrupts();
    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::Success& done) { // --help, --version
        return app.exit(done);
    } catch (const CLI::ParseError& error) {
        const auto verbs = app.get_subcommands();
        const std::string what = !verbs.empty() ? misused(app, *verbs.front(), error.what())
                                 : !app.remaining().empty()
                                     ? no_such_verb(app, app.remaining().front())
                                     : fmt::format("{}\nmeshtween --help tells more", error.what());
        fmt::print(stderr, "meshtween: {}\n", what);
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
