// What the page can ask, one line each.
#include "assets.h"
#include "server.h"

#include "meshtween/core/error.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>

#include <charconv>

namespace meshtween::studio {
namespace {

constexpr std::size_t small = 1 << 20, document_size = 16 << 20;

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
    all["POST /api/upload"] = {[&s](const Question& q) {
                                   s.open_upload(side_of(q.at("side")), q.at("name"), q.body);
                                   return done();
                               },
                               most_upload, true};
    all["POST /api/reload"] = {[&s](const Question& q) {
                                   s.reload(side_of(q.at("side")));
                                   return done();
                               },
                               small, true};
    all["POST /api/sample"] = {[&s](const Question& q) {
                                   s.open_sample(q.at("name"), optional_text(q, "markers") == "yes");
                                   return done();
                               },
                               small, true};
}

void add_project(Routes& all, Session& s) {
    all["GET /api/state"] = {[&s](const Question&) { return json(s.state()); }};
    all["GET /api/project"] = {[&s](const Question&) {
        return Reply{s.project_json().dump(2) + "\n", "application/json", "project.json"};
    }};
    all["POST /api/document"] = {[&s](const Question& q) {
                                     s.set_document(q.json());
                                     return done();
                                 },
                                 document_size, true};
    all["POST /api/project"] = {[&s](const Question& q) {
                                    s.open_project(q.json());
                                    return done();
                                },
                                document_size, true};
    all["POST /api/new"] = {[&s](const Question&) {
                                s.clear();
                                return done();
                            },
                            small, true};
}

void add_markers(Routes& all, Session& s) {
    all["POST /api/markers/import"] = {
        [&s](const Question& q) {
            // Two files come one after the other; `first` says how long the first is.
            const std::string second = optional_text(q, "second");
            const std::size_t first = second.empty() ? q.body.size() : std::min(number(q.at("first")), q.body.size());
            return json(s.import_markers(q.at("name"), q.body.substr(0, first), second, q.body.substr(first)));
        },
        document_size};
    all["GET /api/markers/export"] = {[&s](const Question& q) {
        const std::string extension = plain_name(q.at("format"));
        return Reply{s.export_markers(extension), "application/octet-stream", "markers." + extension};
    }};
    all["POST /api/guess"] = {[&s](const Question& q) { return json(s.guesses(side_of(q.at("from")), q.json())); },
                              small};
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
    add_project(all, session);
    add_markers(all, session);
    add_jobs(all, session);
    add_tabs(all, tabs, events);
    return all;
}

} // namespace meshtween::studio
