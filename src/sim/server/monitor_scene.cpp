#include "sim/server/monitor_scene.h"

#include <array>

#include <fmt/format.h>

namespace nonet::sim {

namespace {

constexpr int kLines = 21;  // pieces of the lines of the field

std::string transformAt(double x, double y, double z) {
  return fmt::format("(SLT 1 0 0 0 0 1 0 0 0 0 1 0 {:g} {:g} {:g} 1)", x, y, z);
}

std::string staticMesh(std::string_view options, std::string_view file, std::string_view scale,
                       std::string_view materials) {
  return fmt::format("(nd StaticMesh (setVisible 1) {}(load models/{}) (sSc {})(resetMaterials {}))", options,
                     file, scale, materials);
}

std::string lightsFieldAndSky(const Settings& s) {
  const std::string flat =
      "(SLT -1 -8.74228e-08 -3.82137e-15 0 0 -4.37114e-08 1 0 -8.74228e-08 1 4.37114e-08 -0 0 0 0 1)";
  std::string text =
      "(nd TRF (SLT 1 0 0 0 0 1 0 0 0 0 1 0 -10 10 10 1)(nd Light (setDiffuse 1 1 1 1) (setAmbient 0.8 0.8 "
      "0.8 1) "
      "(setSpecular 0.1 0.1 0.1 1)))"
      "(nd TRF (SLT 1 0 0 0 0 1 0 0 0 0 1 0 10 -10 10 1)(nd Light (setDiffuse 1 1 1 1) (setAmbient 0 0 0 1) "
      "(setSpecular 0.1 0.1 0.1 1)))";
  text += "(nd TRF " + flat +
          staticMesh("", "naosoccerfield.obj",
                     fmt::format("{:g} 1 {:g}", s.fieldLength / 12.0, s.fieldWidth / 8.0),
                     "None_rcs-naofield.png") +
          ")";
  std::string sky;
  for (int i = 1; i <= 6; ++i) sky += fmt::format("{}Material_skyrender_000{}.tif", i == 1 ? "" : " ", i);
  text += "(nd TRF " + flat + staticMesh("", "skybox.obj", "10 10 10", sky) + ")";
  return text;
}

std::string goals(const Settings& s) {
  std::string text;
  const double goalX = s.fieldLength / 2.0 + s.goalDepth / 2.0;
  const double wall = 0.02;  // half the thickness of the goal's walls
  for (const bool left : {true, false}) {
    text += "(nd TRF ";
    text += left ? transformAt(-goalX, 0.0, s.goalHeight / 2.0)
                 : fmt::format("(SLT -1 -8.74228e-08 -0 -0 8.74228e-08 -1 0 0 0 0 1 0 {:g} 0 {:g} 1)", goalX,
                               s.goalHeight / 2.0);
    text += fmt::format(
        "(nd TRF (SLT -4.37114e-08 1 4.37114e-08 0 0 -4.37114e-08 1 0 1 4.37114e-08 1.91069e-15 0 {:g} 0 "
        "{:g} 1)",
        s.goalDepth / 2.0, -s.goalHeight / 2.0);
    text +=
        staticMesh("(setTransparent) ", left ? "leftsoccergoal.obj" : "rightsoccergoal.obj",
                   fmt::format("{:g} {:g} {:g}", s.goalWidth + 0.08, s.goalHeight + 0.08, s.goalDepth + 0.08),
                   left ? "naogoalnet yellow" : "naogoalnet sky-blue");
    text += ")";
    const double side = s.goalWidth / 2.0 + wall;
    const double post = s.goalWidth / 2.0;
    for (const auto& [x, y, z] :
         {std::array{0.0, -side, 0.0}, std::array{0.0, side, 0.0},
          std::array{-s.goalDepth / 2.0 + wall, 0.0, 0.0}, std::array{0.0, 0.0, s.goalHeight / 2.0 + wall},
          std::array{s.goalDepth / 2.0, post, s.goalHeight / 2.0},
          std::array{s.goalDepth / 2.0, -post, s.goalHeight / 2.0}}) {
      text += "(nd TRF " + transformAt(x, y, z) + ")";
    }
    text += ")";
  }
  return text;
}

std::string walls(const Settings& s) {
  std::string text;
  const double borderX = s.fieldLength * 0.333;
  const double borderY = s.fieldWidth * 0.75;
  const double sideX = s.fieldLength / 2.0 + borderX;
  const double sideY = s.fieldWidth / 2.0 + borderY;
  const auto box = [&](double x, double y, double sizeX, double sizeY) {
    text += "(nd TRF " + transformAt(x, y, 0.0) +
            fmt::format("(nd SMN (setVisible 1) (load StdUnitBox) (sSc {:g} {:g} 1) (sMat matGrey)))", sizeX,
                        sizeY);
  };
  const double lengthX = 1.0 + s.fieldLength + 2.0 * borderX;
  const double lengthY = 1.0 + s.fieldWidth + 2.0 * borderY;
  box(-sideX, 0.0, 1.0, lengthY);
  box(sideX, 0.0, 1.0, lengthY);
  box(0.0, sideY, lengthX, 1.0);
  box(0.0, -sideY, lengthX, 1.0);
  return text;
}

std::string flagsAndLines(const Settings& s) {
  std::string text;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {1.0, -1.0}) {
      text += "(nd TRF " + transformAt(x * s.fieldLength / 2.0, y * s.fieldWidth / 2.0, 0.0) + ")";
    }
  }
  for (int line = 0; line < kLines; ++line) text += fmt::format("(nd TRF {})", kIdentity);
  return text;
}

}  // namespace

// Server facts 5.2, points 1 to 5.
std::string staticScene(const Settings& settings) {
  return lightsFieldAndSky(settings) + goals(settings) + walls(settings) + flagsAndLines(settings);
}

std::string staticDifference(bool visibility) {
  const std::string visible = visibility ? " (setVisible 1)" : "";
  const std::string mesh = "(nd StaticMesh" + visible + ")";
  std::string text = "(nd(nd))(nd(nd))(nd" + mesh + ")(nd" + mesh + ")";
  for (int goal = 0; goal < 2; ++goal) text += "(nd(nd" + mesh + ")(nd)(nd)(nd)(nd)(nd)(nd))";
  for (int wall = 0; wall < 4; ++wall) text += "(nd(nd SMN" + visible + "))";
  for (int node = 0; node < 4 + kLines; ++node) text += "(nd)";
  return text;
}

}  // namespace nonet::sim
