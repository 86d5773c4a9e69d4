#include "nonet/app/view/http_server.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <memory>
#include <sstream>
#include <stdexcept>

#include <asio.hpp>
#include <fmt/format.h>

namespace nonet::app {
namespace {

using asio::ip::tcp;

constexpr std::size_t kMaxHead = 16384;  // bytes

std::string_view statusText(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 500:
      return "Internal Server Error";
    default:
      return "Bad Request";
  }
}

// "localhost:8017" -> "localhost", "[::1]:80" -> "[::1]".
std::string_view hostName(std::string_view host) {
  if (host.starts_with('[')) return host.substr(0, host.find(']') + 1);
  return host.substr(0, host.find(':'));
}

bool isThisMachine(std::string_view host) {
  const std::string_view name = hostName(host);
  return name == "localhost" || name == "127.0.0.1" || name == "[::1]";
}

// One connection; lives as long as an operation of it is under way.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, const HttpServer::Handler& handler)
      : socket_(std::move(socket)), handler_(handler) {}

  void read() {
    asio::async_read_until(socket_, asio::dynamic_buffer(input_, kMaxHead), "\r\n\r\n",
                           [self = shared_from_this()](std::error_code error, std::size_t size) {
                             if (error) return;  // closed, or a head without end
                             self->answer(self->input_.substr(0, size));
                             self->input_.erase(0, size);
                           });
  }

 private:
  void answer(const std::string& head) {
    HttpRequest request;
    HttpResponse response;
    if (parseHttpRequest(head, request, response)) response = handled(request);
    body_ = std::move(response.body);
    head_ = fmt::format(
        "HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nCache-Control: no-store\r\n"
        "X-Content-Type-Options: nosniff\r\n\r\n",
        response.status, statusText(response.status), response.type, body_.size());
    const std::array<asio::const_buffer, 2> parts = {asio::buffer(head_), asio::buffer(body_)};
    asio::async_write(socket_, parts, [self = shared_from_this()](std::error_code error, std::size_t) {
      if (!error) self->read();
    });
  }

  // What goes wrong with one page is that page's answer, not the end of all.
  HttpResponse handled(const HttpRequest& request) const {
    try {
      return handler_(request);
    } catch (const std::exception& trouble) {
      return {500, "text/plain", fmt::format("{}\n", trouble.what())};
    }
  }

  tcp::socket socket_;
  const HttpServer::Handler& handler_;
  std::string input_;
  std::string head_;
  std::string body_;
};

}  // namespace

std::string HttpRequest::text(std::string_view name) const {
  const auto found = queries.find(name);
  if (found == queries.end()) return {};
  const std::string& coded = found->second;
  std::string text;
  for (std::size_t i = 0; i < coded.size(); ++i) {
    unsigned char letter = 0;
    const char* begin = coded.data() + i + 1;
    const bool escaped = coded[i] == '%' && i + 2 < coded.size() &&
                         std::from_chars(begin, begin + 2, letter, 16).ptr == begin + 2;
    text += escaped ? static_cast<char>(letter) : coded[i];
    if (escaped) i += 2;
  }
  return text;
}

std::size_t HttpRequest::number(std::string_view name) const {
  std::size_t value = 0;
  if (const auto found = queries.find(name); found != queries.end()) {
    std::from_chars(found->second.data(), found->second.data() + found->second.size(), value);
  }
  return value;
}

bool parseHttpRequest(const std::string& head, HttpRequest& request, HttpResponse& refusal) {
  std::istringstream lines(head);
  std::string method;
  std::string target;
  std::string line;
  lines >> method >> target;
  std::getline(lines, line);
  if (method != "GET") {
    refusal = {405, "text/plain", "only GET\n"};
    return false;
  }
  std::string host;
  while (std::getline(lines, line)) {
    constexpr std::string_view kHost = "host:";
    if (line.size() < kHost.size() ||
        !std::equal(kHost.begin(), kHost.end(), line.begin(), [](char a, char b) { return a == (b | 32); })) {
      continue;
    }
    std::istringstream(line.substr(kHost.size())) >> host;
  }
  if (!isThisMachine(host)) {
    refusal = {403, "text/plain", "this server is for the browser on its own machine\n"};
    return false;
  }
  const std::size_t question = target.find('?');
  request.path = target.substr(0, question);
  std::istringstream queries(question == std::string::npos ? "" : target.substr(question + 1));
  while (std::getline(queries, line, '&')) {
    const std::size_t sign = line.find('=');
    if (sign != std::string::npos) request.queries[line.substr(0, sign)] = line.substr(sign + 1);
  }
  return true;
}

HttpServer::HttpServer(asio::io_context& io, std::uint16_t port, Handler handler)
    : acceptor_(io), handler_(std::move(handler)) {
  const tcp::endpoint endpoint(asio::ip::address_v4::loopback(), port);
  acceptor_.open(endpoint.protocol());
  acceptor_.set_option(tcp::acceptor::reuse_address(true));
  std::error_code error;
  acceptor_.bind(endpoint, error);
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error) {
    throw std::runtime_error(
        fmt::format("cannot serve pages on port {} ({}): choose another with --port, 0 takes any free one",
                    port, error.message()));
  }
  accept();
}

void HttpServer::accept() {
  acceptor_.async_accept([this](std::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error) std::make_shared<Connection>(std::move(socket), handler_)->read();
    accept();
  });
}

}  // namespace nonet::app
