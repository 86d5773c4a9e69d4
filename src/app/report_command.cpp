#include <fmt/format.h>

#include "nonet/app/commands.h"
#include "nonet/lab/reports/series_report.h"

namespace nonet::app {

void addReportCommand(CLI::App& app, int& exitCode) {
  CLI::App* command =
      app.add_subcommand("report", "A page about a finished series of games, for the browser");
  auto folder = std::make_shared<std::string>();
  command->add_option("FOLDER", *folder, "Folder of a series (nonet series --out)")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->footer(
      "Example:\n"
      "  nonet series own ../before --pairs 10 --out logs/now-before && nonet report logs/now-before\n"
      "Writes FOLDER/report.html, one file that needs nothing else.");
  command->callback([folder, &exitCode] {
    fmt::print("report in {}\n", lab::writeSeriesReport(*folder));
    exitCode = 0;
  });
}

}  // namespace nonet::app
