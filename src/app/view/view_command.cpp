#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include <asio.hpp>
#include <fmt/format.h>

#include "nonet/app/commands.h"
#include "nonet/app/data_folder.h"
#include "nonet/app/option_checks.h"
#include "nonet/app/view/http_server.h"
#include "nonet/app/view/live_monitor.h"
#include "nonet/app/view/trace_folder.h"
#include "nonet/app/view/track.h"
#include "nonet/app/view/web_files.h"

namespace nonet::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint16_t kDefaultPort = 8017;
constexpr double kLiveStep = 0.04;  // s between two messages of a server (facts 5.1)

struct ViewArguments {
  std::string source;
  std::string traces;  // folder; empty: none
  std::uint16_t port = kDefaultPort;
};

std::string_view typeOf(const fs::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".html") return "text/html; charset=utf-8";
  if (extension == ".js") return "text/javascript; charset=utf-8";
  if (extension == ".css") return "text/css; charset=utf-8";
  if (extension == ".svg") return "image/svg+xml";
  return "application/octet-stream";
}

HttpResponse ownFile(std::string_view path) {
  if (path == "/") path = "/index.html";
  for (const WebFile& file : webFiles()) {
    if (file.path == path) return {200, std::string(typeOf(path)), std::string(file.text)};
  }
  return {404, "text/plain", "no such page\n"};
}

// Only names that cannot climb out of the folder of three.js.
HttpResponse threeFile(const std::string& folder, std::string_view path) {
  const bool harmless = path.find("..") == std::string_view::npos && path.ends_with(".js");
  std::ifstream file(harmless ? folder + std::string(path) : "", std::ios::binary);
  if (!file) return {404, "text/plain", "no such file of three.js\n"};
  return {200, "text/javascript; charset=utf-8", {std::istreambuf_iterator<char>(file), {}}};
}

class Viewer {
 public:
  Viewer(const ViewArguments& arguments, const std::string& three)
      : track_(kLiveStep), source_(arguments.source), three_(three) {
    if (fs::exists(source_)) {
      openLog();
    } else {
      follow();
    }
    if (!arguments.traces.empty()) {
      traces_.emplace(arguments.traces);
      fmt::print("view: traces of {} robots\n", traces_->size());
    }
    server_.emplace(io_, arguments.port, [this](const HttpRequest& request) { return answer(request); });
  }

  void run() {
    fmt::print("view: open http://localhost:{}/ in a browser; Ctrl+C ends\n", server_->port());
    std::fflush(stdout);
    asio::signal_set signals(io_, SIGINT, SIGTERM);
    signals.async_wait([this](std::error_code, int) { io_.stop(); });
    io_.run();
  }

 private:
  void openLog() {
    std::string problem;
    track_ = readMonitorLog(source_, &problem);
    fmt::print("view: {}, {:.0f} s, {} events\n", source_,
               static_cast<double>(track_.frames()) * track_.step(), track_.events().size());
    if (!problem.empty()) fmt::print(stderr, "nonet view: {}\n", problem);
  }

  void follow() {
    const std::size_t colon = source_.rfind(':');
    const bool two = colon != std::string::npos && colon > 0;
    if (!two || !portFrom(std::string_view(source_).substr(colon + 1)))
      throw std::runtime_error(
          fmt::format("{}: neither a file nor HOST:PORT of a server with a port from 1 to 65535", source_));
    live_.emplace(io_, source_.substr(0, colon), source_.substr(colon + 1), track_);
  }

  std::string traceOf(const std::string& team, int unum) {
    if (!traces_) return "[]";
    std::string problem;
    std::string cycles = traces_->cycles(team, unum, &problem);
    if (!problem.empty() && told_.insert(problem).second) fmt::print(stderr, "nonet view: {}\n", problem);
    return cycles;
  }

  HttpResponse answer(const HttpRequest& request) {
    constexpr std::string_view kThree = "/three/";
    if (request.path == "/track") {
      const std::string state = live_ ? live_->state() : "";
      return {200, "application/octet-stream",
              track_.message(request.number("from"), request.number("events"), source_, state)};
    }
    if (request.path == "/trace") {
      return {
          200, "application/json",
          traceOf(request.text("team"), static_cast<int>(std::min<std::size_t>(request.number("unum"), 99)))};
    }
    if (request.path == "/shapes") return {200, "application/json", robotShapes().dump()};
    if (request.path.starts_with(kThree)) return threeFile(three_, request.path.substr(kThree.size() - 1));
    return ownFile(request.path);
  }

  asio::io_context io_;
  Track track_;
  std::string source_;
  std::string three_;  // folder
  std::optional<TraceFolder> traces_;
  std::set<std::string> told_;  // of traces that are torn or damaged
  std::optional<LiveMonitor> live_;
  std::optional<HttpServer> server_;
};

int runView(const ViewArguments& arguments) {
  const std::string three = findThree(executablePath(), NONET_THREE_DIR);
  if (!fs::exists(three + "/build/three.module.js")) {
    throw std::runtime_error(
        fmt::format("three.js is not in {}: install Debian's libjs-three (scripts/setup.sh does)", three));
  }
  Viewer(arguments, three).run();
  return 0;
}

}  // namespace

void addViewCommand(CLI::App& app, int& exitCode) {
  CLI::App* command =
      app.add_subcommand("view", "Shows a match in the browser, in 3D: live or from a monitor log");
  auto arguments = std::make_shared<ViewArguments>();
  command
      ->add_option("source", arguments->source,
                   "A monitor log (nonet match --monitor-log FILE), or HOST:PORT of a server's monitor port")
      ->required();
  command
      ->add_option("--trace", arguments->traces,
                   "Folder of decision traces (nonet match --trace): draws what the followed robot believes "
                   "beside the truth and lists why it acts")
      ->check(CLI::ExistingDirectory);
  command->add_option("--port", arguments->port, "Port of the page on this machine, 0: any free one")
      ->capture_default_str()
      ->check(ownPort());
  command->footer(
      "Examples:\n"
      "  nonet match --in-process --minutes 1 --monitor-log logs/match.mon && nonet view logs/match.mon\n"
      "  nonet view localhost:3200            a running server, ours or rcssserver3d\n"
      "Needs no network: three.js comes from Debian's libjs-three.");
  command->callback([arguments, &exitCode] { exitCode = runView(*arguments); });
}

}  // namespace nonet::app
