// Reads recordings of experiments: one JSON object per line, the first one a header.
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "nonet/sim/fidelity/fidelity.h"

namespace nonet::sim {

namespace {

using nlohmann::json;

/// The whole file, unpacked if it is packed.
std::string readAll(const std::filesystem::path& file) {
  const gzFile in = gzopen(file.c_str(), "rb");
  if (in == nullptr) throw std::runtime_error(fmt::format("{}: cannot be opened", file.string()));
  std::string text;
  std::array<char, 1 << 16> buffer{};
  int count = 0;
  while ((count = gzread(in, buffer.data(), buffer.size())) > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  gzclose(in);
  if (count < 0) throw std::runtime_error(fmt::format("{}: damaged compression", file.string()));
  return text;
}

Eigen::Vector3d vector(const json& numbers, std::size_t from = 0) {
  return {numbers.at(from).get<double>(), numbers.at(from + 1).get<double>(),
          numbers.at(from + 2).get<double>()};
}

std::optional<model::BodyId> bodyFromName(const std::string& name) {
  for (std::size_t i = 0; i < model::kBodyCount; ++i) {
    if (model::bodyName(model::bodyAt(i)) == name) return model::bodyAt(i);
  }
  return std::nullopt;
}

std::optional<model::BodyId> footFromName(const std::string& name) {
  if (name == "rf") return model::BodyId::RFoot;
  if (name == "lf") return model::BodyId::LFoot;
  if (name == "rf1") return model::BodyId::RToe;
  if (name == "lf1") return model::BodyId::LToe;
  return std::nullopt;
}

/// A part is a 4x4 matrix, column major, or its position alone.
RecordedRobot::Part partFrom(const json& numbers) {
  RecordedRobot::Part part;
  if (numbers.size() == 3) {
    part.position = vector(numbers);
    return part;
  }
  part.position = vector(numbers, 12);
  Eigen::Matrix3d rotation;
  for (std::size_t column = 0; column < 3; ++column) {
    rotation.col(static_cast<Eigen::Index>(column)) = vector(numbers, 4 * column);
  }
  part.rotation = rotation;
  return part;
}

RecordedRobot robotFrom(const json& row) {
  RecordedRobot robot;
  static const json kEmpty = json::object();
  const auto list = [&row](const char* name) -> const json& {
    const auto found = row.find(name);
    return found == row.end() ? kEmpty : *found;
  };
  for (const auto& [name, speed] : list("cmd").items()) {
    if (const auto joint = model::jointFromEffectorName(name)) {
      robot.speeds.emplace_back(*joint, speed.get<float>());
    }
  }
  for (const auto& [name, angle] : list("hj").items()) {
    if (const auto joint = model::jointFromPerceptorName(name)) robot.joints[*joint] = angle.get<double>();
  }
  if (row.contains("gyr") && row["gyr"].is_array()) robot.gyro = vector(row["gyr"]);
  if (row.contains("acc") && row["acc"].is_array()) robot.accelerometer = vector(row["acc"]);
  for (const auto& [name, values] : list("frp").items()) {
    if (const auto foot = footFromName(name)) robot.feet[*foot] = {vector(values), vector(values, 3)};
  }
  for (const auto& [name, matrix] : list("parts").items()) {
    if (const auto body = bodyFromName(name)) robot.parts[*body] = partFrom(matrix);
  }
  return robot;
}

RecordedCycle cycleFrom(const json& row) {
  RecordedCycle cycle;
  cycle.time = row.value("t", 0.0);
  if (row.contains("game") && row["game"].is_array()) cycle.playMode = row["game"].at(1).get<std::string>();
  cycle.robots.push_back(robotFrom(row));
  if (row.contains("agent2")) cycle.robots.push_back(robotFrom(row["agent2"]));
  if (row.contains("ball")) cycle.ball = vector(row["ball"]);
  cycle.trainer = row.value("trainer", "");
  cycle.extra = row.value("extra", "");
  cycle.message = row.value("message", "");
  return cycle;
}

/// "rsg/agent/nao/nao_hetero.rsg 3" or "... (type 3)": the last digit names the type.
int typeFrom(const json& header) {
  const std::string robot = header.value("settings", json::object()).value("robot", "");
  const auto digit = robot.find_last_of("01234");
  return digit == std::string::npos ? 0 : robot[digit] - '0';
}

}  // namespace

Recording readRecording(const std::filesystem::path& file) {
  const std::string text = readAll(file);
  Recording recording;
  std::size_t line = 0;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    std::size_t end = text.find('\n', begin);
    if (end == std::string::npos) end = text.size();
    try {
      const json row = json::parse(text.begin() + static_cast<std::ptrdiff_t>(begin),
                                   text.begin() + static_cast<std::ptrdiff_t>(end));
      if (line == 0) {
        recording.scenario = row.at("scenario").get<std::string>();
        recording.robotType = typeFrom(row);
      } else {
        recording.cycles.push_back(cycleFrom(row));
      }
    } catch (const json::exception& error) {
      throw std::runtime_error(fmt::format("{}:{}: {}", file.string(), line + 1, error.what()));
    }
    begin = end + 1;
  }
  if (recording.cycles.size() < 2) {
    throw std::runtime_error(fmt::format("{}: a recording needs at least two cycles", file.string()));
  }
  return recording;
}

}  // namespace nonet::sim
