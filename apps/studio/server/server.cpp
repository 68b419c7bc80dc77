#include "server.h"

#include "meshtween/core/error.h"
#include "meshtween/io/json_limits.h"

#include <fmt/format.h>
#include <httplib.h>

#include <charconv>
#include <new>

namespace meshtween::studio {
namespace {

constexpr int most_streams = 8, threads = 24; // a stream of events holds a thread

// What an exception of another kind says is for the terminal, not for the page.
constexpr const char* unexpected =
    "something went wrong that this program did not expect; nothing was changed, and its "
    "terminal says more";

std::string only_header(const httplib::Request& request, const char* name) {
    const auto count = request.get_header_value_count(name);
    return count == 0 ? "" : count == 1 ? request.get_header_value(name) : "(several)";
}

Asked asked(const httplib::Request& request) {
    return {request.path, only_header(request, "Host"), only_header(request, "Origin"),
            only_header(request, "Sec-Fetch-Site")};
}

void refuse(httplib::Response& response, int status, const std::string& why) {
    response.status = status;
    response.set_content(Json{{"error", why}}.dump(-1, ' ', false, Json::error_handler_t::replace), "application/json");
}

httplib::Headers safe_headers() {
    return {
        {"Cache-Control", "no-store"},
        {"X-Content-Type-Options", "nosniff"},
        {"X-Frame-Options", "DENY"},
        {"Referrer-Policy", "no-referrer"},
        {"Cross-Origin-Opener-Policy", "same-origin"},
        {"Cross-Origin-Resource-Policy", "same-origin"},
        {"Content-Security-Policy",
         "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; font-src 'self'; "
         "connect-src 'self'; worker-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"}};
}

std::string percent_encoded(std::string_view text) {
    std::string encoded;
    for (const char c : text) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
                           c == '-' || c == '_';
        encoded += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return encoded;
}

Question question_of(const httplib::Request& request, std::string body) {
    Question question;
    for (const auto& [name, value] : request.params) question.parameters.emplace(name, value);
    question.body = std::move(body);
    return question;
}

} // namespace

const std::string& Question::at(const std::string& name) const {
    const auto found = parameters.find(name);
    if (found == parameters.end()) throw Error(ErrorKind::argument, fmt::format("the request lacks {}", name));
    return found->second;
}

Json Question::json() const {
    Json json = json_or_discarded<Json>(body);
    if (json.is_discarded()) throw Error(ErrorKind::argument, "this is no JSON, or only a part of it");
    return json;
}

Server::Server(Session& session, Events& events, int port, std::size_t most_upload)
    : events_(events), routes_(routes(session, tabs_, events, most_upload)),
      http_(std::make_unique<httplib::Server>()) {
    http_->set_address_family(AF_INET);
    http_->set_tcp_nodelay(true);
    http_->set_keep_alive_max_count(1000);
    http_->set_keep_alive_timeout(1); // seconds: stopping waits for connections that idle
    http_->set_read_timeout(30);
    http_->set_payload_max_length(2 * most_upload + (std::size_t(16) << 20)); // two models and their project
    http_->set_default_headers(safe_headers());
    http_->new_task_queue = [] { return new httplib::ThreadPool(threads); };
    // Without SO_REUSEPORT, which is the default: a second studio must not share the port.
    http_->set_socket_options([](socket_t socket) {
        const int yes = 1;
        setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    guard_.token = random_token();
    if (port == 0)
        guard_.port = http_->bind_to_any_port("127.0.0.1");
    else
        guard_.port = http_->bind_to_port("127.0.0.1", port) ? port : -1;
    if (guard_.port <= 0)
        throw Error(ErrorKind::argument,
                    fmt::format("cannot listen on port {} of this machine; another program has it, choose another "
                                "with --port",
                                port));
    wire();
}

Server::~Server() {
    stop();
}

void Server::listen() {
    http_->listen_after_bind();
}

void Server::stop() {
    events_.close();
    http_->stop();
}

void Server::wire() {
    // First of all, and before any body is read: may this request come in, and is there such a route?
    http_->set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
        const std::string path = guard_.admitted_path(asked(request));
        if (path.empty()) {
            refuse(response, 403, "this address needs the whole link that meshtween studio printed");
        } else if (path == "/api/events" && request.method == "GET") {
            stream_events(request, response);
        } else if (const auto route = routes_.find(request.method + " " + path); route == routes_.end()) {
            refuse(response, 404, "there is nothing here");
        } else if (request.method == "GET") {
            answer(request, response, {});
        } else {
            return httplib::Server::HandlerResponse::Unhandled;
        }
        return httplib::Server::HandlerResponse::Handled;
    });
    http_->Post(
        ".*", [this](const httplib::Request& request, httplib::Response& response, const httplib::ContentReader& read) {
            const Route& route = routes_.at("POST " + guard_.admitted_path(asked(request)));
            std::string body;
            const bool multipart = request.is_multipart_form_data();
            const bool whole = !multipart && read([&](const char* data, std::size_t length) {
                if (body.size() + length > route.most_bytes) return false;
                body.append(data, length);
                return true;
            });
            if (!whole) {
                if (response.status != 413) response.status = multipart ? 415 : 413;
                return refuse(response, response.status,
                              fmt::format("the request is too large; {} bytes at most", route.most_bytes));
            }
            answer(request, response, std::move(body));
        });
}

void Server::answer(const httplib::Request& request, httplib::Response& response, std::string body) const {
    const Route& route = routes_.at(request.method + " " + guard_.admitted_path(asked(request)));
    if (route.edits && only_header(request, "X-Tab") != tabs_.editor())
        return refuse(response, 409, "another tab is editing this project");
    try {
        Reply reply = route.run(question_of(request, std::move(body)));
        if (!reply.download.empty())
            response.set_header("Content-Disposition",
                                "attachment; filename*=UTF-8''" + percent_encoded(reply.download));
        response.status = 200;
        response.body = std::move(reply.body);
        response.set_header("Content-Type", reply.type);
    } catch (const Error& error) {
        refuse(response, 400, error.what());
    } catch (const std::bad_alloc&) {
        refuse(response, 500, "out of memory; use smaller meshes or a larger machine");
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: {}\n", request.path.substr(request.path.rfind('/')), error.what());
        refuse(response, 500, unexpected);
    }
}

void Server::stream_events(const httplib::Request& request, httplib::Response& response) {
    const std::string tab = request.get_param_value("tab");
    if (tab.empty() || tab.size() > 64) return refuse(response, 400, "a stream of events needs a tab");
    if (streams_.fetch_add(1) >= most_streams) {
        --streams_;
        return refuse(response, 503, "too many pages are open");
    }
    // A browser whose stream broke says which message was its last.
    const std::string last = only_header(request, "Last-Event-ID");
    std::uint64_t first = events_.end(), seen = 0;
    if (std::from_chars(last.data(), last.data() + last.size(), seen).ec == std::errc() && seen < first)
        first = seen + 1;
    tabs_.join(tab);
    events_.publish("tabs", {{"editor", tabs_.editor()}});
    response.set_chunked_content_provider(
        "text/event-stream",
        [this, next = first, idle = 0](std::size_t, httplib::DataSink& sink) mutable {
            std::string text = events_.wait(next, std::chrono::milliseconds(250));
            if (events_.closed() || !sink.is_writable()) return false;
            if (text.empty() && ++idle % 4 == 0) text = ":\n\n"; // so that a page that has gone is noticed
            return text.empty() || sink.write(text.data(), text.size());
        },
        [this, tab](bool) {
            --streams_;
            tabs_.leave(tab);
            events_.publish("tabs", {{"editor", tabs_.editor()}});
        });
    response.status = 200;
}

} // namespace meshtween::studio
