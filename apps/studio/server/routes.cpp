// What the page can ask, one line each.
#include "assets.h"
#include "server.h"

#include "meshtween/core/error.h"
#include "meshtween/io/json_limits.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>

#include <charconv>

namespace meshtween::studio {
namespace {

constexpr std::size_t small = 1 << 20, document_size = 16 << 20, history_size = 256 << 20;

Reply json(const Json& value) {
    return {value.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json", {}};
}

Reply binary(std::string bytes) {
    return {std::move(bytes), "application/octet-stream", {}};
}

Reply done() {
    return json({{"ok", true}});
}

std::size_t number(const std::string& text) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
        throw Error(ErrorKind::argument, "a number is needed");
    return value;
}

std::string optional_text(const Question& q, const std::string& name) {
    const auto found = q.parameters.find(name);
    return found == q.parameters.end() ? std::string() : found->second;
}

void add_page(Routes& all) {
    for (const Asset& asset : page_assets()) {
        const Route route{[asset](const Question&) {
            return Reply{std::string(asset.bytes), std::string(asset.type), {}};
        }};
        all.emplace(fmt::format("GET /{}", asset.name), route);
        if (asset.name == "index.html") all.emplace("GET /", route);
    }
}

void add_meshes(Routes& all, Session& s, std::size_t most_upload) {
    all["GET /api/mesh"] = {
        [&s](const Question& q) { return binary(s.mesh_buffer(side_of(q.at("side")), q.at("what"))); }};
    all["GET /api/fitted"] = {[&s](const Question& q) { return binary(s.fitted_buffer(q.at("what"))); }};
    all["GET /api/live"] = {[&s](const Question&) { return binary(s.live_positions()); }};
    all["GET /api/path"] = {
        [&s](const Question& q) { return binary(s.path_buffer(q.at("key"), number(q.at("node")), q.at("what"))); }};
    all["GET /api/changes"] = {[&s](const Question&) { return json(s.changes()); }};
    all["POST /api/upload"] = {
        [&s](const Question& q) { return json(s.add_model(side_of(q.at("side")), q.at("name"), q.body)); }, most_upload,
        true};
    all["POST /api/examine"] = {[&s](const Question& q) { return json(s.examine_again(side_of(q.at("side")))); }, small,
                                true};
    all["GET /api/fitted-file"] = {[&s](const Question&) { return binary(s.fitted_bytes()); }};
    all["GET /api/model"] = {[&s](const Question& q) { return binary(s.model_bytes(side_of(q.at("side")))); }};
}

// Several files in one body: a line of JSON, [{name, size}, ...], and then their bytes.
std::vector<NamedBytes> files_in(const std::string& body) {
    const std::size_t end = std::min(body.find('\n'), body.size());
    const Json list = json_or_discarded<Json>(std::string_view(body).substr(0, end));
    std::vector<NamedBytes> files;
    std::size_t at = end + 1;
    if (!list.is_array()) throw Error(ErrorKind::argument, "a list of files is needed");
    for (const Json& one : list) {
        if (!one.is_object() || !one.contains("name") || !one["name"].is_string() || !one.contains("size") ||
            !one["size"].is_number_unsigned())
            throw Error(ErrorKind::argument, "a file needs a name and a size");
        const std::size_t size = one["size"];
        if (at > body.size() || size > body.size() - at)
            throw Error(ErrorKind::argument, "the files are shorter than their list says");
        files.push_back({one["name"], body.substr(at, size)});
        at += size;
    }
    return files;
}

void add_project(Routes& all, Session& s, std::size_t most_upload) {
    all["GET /api/state"] = {[&s, most_upload](const Question&) {
        Json state = s.state();
        state["most_upload"] = most_upload;
        return json(state);
    }};
    all["GET /api/project"] = {[&s](const Question&) {
        return Reply{s.project_json().dump(2) + "\n", "application/json", "project.json"};
    }};
    const auto then_done = [&all](const std::string& name, std::size_t most, auto run) {
        all["POST /api/" + name] = {[run](const Question& q) {
                                        run(q);
                                        return done();
                                    },
                                    most, true};
    };
    then_done("document", document_size, [&s](const Question& q) {
        const std::string number_text = optional_text(q, "project");
        s.set_document(q.json(), number_text.empty() ? std::optional<int>() : int(number(number_text)));
    });
    then_done("history", history_size, [&s](const Question& q) { s.set_history(q.body); });
    then_done("picture", small, [&s](const Question& q) { s.set_picture(q.body); });
    all["GET /api/history"] = {[&s](const Question&) { return Reply{s.history(), "application/json", {}}; }};
    all["GET /api/states"] = {[&s](const Question&) { return json(s.kept_states()); }};
    all["GET /api/kept"] = {[&s](const Question& q) { return json(s.kept_document(q.at("name"))); }};
}

void add_projects(Routes& all, Session& s, std::size_t most_upload) {
    all["GET /api/projects"] = {[&s](const Question&) { return json(s.projects()); }};
    all["GET /api/projects/picture"] = {[&s](const Question& q) {
        return Reply{s.project_picture(q.at("id")), "image/png", {}};
    }};
    // A project with its models is not opened at once: until then the page can change its mind.
    all["POST /api/projects/add"] = {[&s](const Question& q) {
                                         return json({{"id", s.add_project(files_in(q.body))}});
                                     },
                                     2 * most_upload + document_size, true};
    const auto then_done = [&all](const std::string& name, auto run) {
        all["POST /api/" + name] = {[run](const Question& q) {
                                        run(q);
                                        return done();
                                    },
                                    small, true};
    };
    then_done("projects/open", [&s](const Question& q) { s.open_project(q.at("id")); });
    then_done("sample", [&s](const Question& q) { s.open_sample(q.at("name"), optional_text(q, "markers") == "yes"); });
    then_done("new", [&s](const Question&) { s.new_project(); });
}

void add_markers(Routes& all, Session& s) {
    all["POST /api/markers/import"] = {
        [&s](const Question& q) {
            const std::string side = optional_text(q, "side");
            return json(s.import_markers(files_in(q.body), side.empty() ? std::optional<Side>() : side_of(side)));
        },
        document_size};
    all["GET /api/markers/export"] = {[&s](const Question& q) { return json(s.export_markers(q.at("format"))); }};
    all["POST /api/guess"] = {[&s](const Question& q) { return json(s.guesses(side_of(q.at("from")), q.json())); },
                              small};
    all["GET /api/warnings"] = {[&s](const Question&) { return json(s.marker_warnings()); }};
    all["GET /api/suggestions"] = {[&s](const Question&) { return json(s.suggestions()); }};
}

void add_jobs(Routes& all, Session& s) {
    all["POST /api/fit"] = {[&s](const Question& q) {
                                s.start_fit(q.json());
                                return done();
                            },
                            small, true};
    all["POST /api/morph"] = {[&s](const Question& q) {
                                  s.start_path(q.json());
                                  return done();
                              },
                              small, true};
    all["POST /api/export"] = {[&s](const Question& q) {
                                   s.start_export(q.json());
                                   return done();
                               },
                               small, true};
    all["POST /api/cancel"] = {[&s](const Question&) {
                                   s.cancel();
                                   return done();
                               },
                               small};
    all["GET /api/download"] = {[&s](const Question& q) {
        const auto file = s.exported(q.at("name"));
        return Reply{read_whole(file), "application/octet-stream", file.filename().string()};
    }};
}

void add_tabs(Routes& all, Tabs& tabs, Events& events) {
    const auto tell = [&tabs, &events] {
        events.publish("tabs", {{"editor", tabs.editor()}});
        return done();
    };
    all["POST /api/take-over"] = {[&tabs, tell](const Question& q) {
                                      tabs.take_over(q.at("tab").substr(0, 64));
                                      return tell();
                                  },
                                  small};
    all["POST /api/leave"] = {[&tabs, tell](const Question& q) {
                                  tabs.leave(q.at("tab"));
                                  return tell();
                              },
                              small};
}

} // namespace

Routes routes(Session& session, Tabs& tabs, Events& events, std::size_t most_upload) {
    Routes all;
    add_page(all);
    add_meshes(all, session, most_upload);
    add_project(all, session, most_upload);
    add_projects(all, session, most_upload);
    add_markers(all, session);
    add_jobs(all, session);
    add_tabs(all, tabs, events);
    return all;
}

} // namespace meshtween::studio
