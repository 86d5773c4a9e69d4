// A small HTTP server for one's own browser: GET only, on the loopback interface only.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>

namespace nonet::app {

struct HttpRequest {
  std::string path;                                         // "/track", without the query
  std::map<std::string, std::string, std::less<>> queries;  // "?from=3" gives from: 3

  /// The query as a number, 0 if it is missing or makes no sense.
  std::size_t number(std::string_view name) const;
  /// The query as text, with %XX decoded.
  std::string text(std::string_view name) const;
};

struct HttpResponse {
  int status = 200;
  std::string type = "text/plain";
  std::string body;
};

/// The request in these header lines, nothing if they are no GET that a browser on this machine would send.
/// `refusal` then says why. A page from elsewhere that points a name of its own at this machine is refused by
/// the Host line.
bool parseHttpRequest(const std::string& head, HttpRequest& request, HttpResponse& refusal);

class HttpServer {
 public:
  using Handler = std::function<HttpResponse(const HttpRequest&)>;

  /// Serves while `io` runs. Port 0: any free one. Throws std::runtime_error if the port is taken.
  HttpServer(asio::io_context& io, std::uint16_t port, Handler handler);

  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

 private:
  void accept();

  asio::ip::tcp::acceptor acceptor_;
  Handler handler_;
};

}  // namespace nonet::app
