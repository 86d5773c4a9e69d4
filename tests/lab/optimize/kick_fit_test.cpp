// What the fit promises is looked at by others: the check that kicks begin by, the player that stretches
// curves whose joints would be too fast, and a ball and a foot made of points.
#include "nonet/lab/optimize/kick_fit.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "nonet/math/angle.h"
#include "nonet/model/kinematics.h"
#include "nonet/motion/limbs.h"
#include "nonet/motion/skill_player.h"
#include "nonet/motion/walk/engine.h"

#include "lab/trial_setup.h"

namespace nonet::lab {
namespace {

constexpr int kType = 0;

// Too fast, too far to the left for the weight, and out of reach at its end.
constexpr const char* kTooMuch = R"(
skill kick_test {
  parameter time = 0.06s in 0.05s..0.6s
  parameter footY = 45mm in 0mm..80mm  # the right foot from the torso: the weight is over it at 0
  parameter x1 = -240mm in -300mm..-180mm
  parameter x2 = -150mm in -200mm..-100mm
  parameter x3 = 40mm in -120mm..60mm
  parameter y1 = 30mm in -50mm..50mm
  parameter y2 = 0mm in -50mm..50mm
  parameter y3 = -30mm in -50mm..50mm
  parameter z1 = 0mm in -40mm..60mm
  parameter z2 = -10mm in -40mm..60mm
  parameter z3 = 20mm in -40mm..60mm
  parameter unused = 1s in 0.5s..2s
  parameter fixedPart = 0.3s
  kick { ball (0.17m, 5cm) within (2cm, 2cm) distance 1m..3m contact 0.3s from stand }
  move over fixedPart { foot left at (-60mm, 0.11m, -0.29m) foot right at (0, -1 * footY, -0.32m) }
  curve left foot over time from ball {
    point (x1, y1, z1)
    point (x2, y2, z2)
    point (x3, y3, z3)
  }
  wait unused
}
skill kick_joints {
  kick { ball (0.17m, 5cm) distance 1m..3m contact 0.3s from stand }
  move over 0.3s { left.knee -1rad }
}
skill kick_rigid {
  kick { ball (0.17m, 5cm) distance 1m..3m contact 0.3s from stand }
  curve left foot over 0.3s from ball { point (-0.2m, 0, 0) point (-0.15m, 0, 0) }
}
)";

class KickFits : public testing::Test {
 protected:
  KickFits() {
    std::filesystem::create_directories(folder_);
    std::ofstream(folder_ / "kick_test.skl") << kTooMuch;
  }
  ~KickFits() override { std::filesystem::remove_all(folder_); }

  KickFitSettings settingsFor(const std::string& kick) const {
    KickFitSettings settings;
    settings.kick = kick;
    settings.starts = 2;
    settings.agent = agentOfType(kType);
    settings.agent.skillFolder = folder_.string();
    settings.agent.parameters.motion.skills = motion::declareSkillParameters(folder_.string());
    return settings;
  }
  static KickFitSettings with(KickFitSettings settings, const KickFit& fit) {
    config::overlayText(settings.agent.parameters, kickFitToml(fit), "fit");
    return settings;
  }
  static model::JointArray standOf(const KickFitSettings& settings) {
    const auto& motion = settings.agent.parameters.motion;
    return motion::WalkEngine::standAngles(model::robotModel(kType),
                                           motion.sets.of(motion.selection.standSet()));
  }
  static double after(const KickFit& fit, const std::string& name) {
    for (const FittedParameter& parameter : fit.parameters)
      if (parameter.name == name) return parameter.after;
    ADD_FAILURE() << name;
    return 0.0;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("nonet_kick_fit_" + std::to_string(getpid()));
};

// A kick of a skill folder, as motion has it.
struct Loaded {
  explicit Loaded(const KickFitSettings& settings, const model::JointArray& stand)
      : library(settings.agent.skillFolder, settings.agent.parameters.motion.skills),
        catalogue(library, kType),
        check(model::robotModel(kType), library, stand) {}
  const motion::KickOption& option(const std::string& name) const {
    for (const motion::KickOption& option : catalogue.options())
      if (option.name == name && option.foot == model::Side::Left) return option;
    throw std::runtime_error("no such kick");
  }
  motion::SkillLibrary library;
  motion::KickCatalogue catalogue;
  motion::CurveCheck check;
};

TEST_F(KickFits, BringACurveWithinItsLimits) {
  KickFitSettings settings = settingsFor("kick_test");
  settings.starts = 6;
  const KickFit fit = fitKick(settings);
  EXPECT_FALSE(fit.heldBefore);
  ASSERT_TRUE(fit.holds) << kickFitTable(fit);
  EXPECT_FALSE(fit.kept);

  const model::JointArray stand = standOf(settings);
  const Loaded before(settings, stand);
  EXPECT_FALSE(before.check.check(before.option("kick_test"), {0.17, 0.05}).allows());
  const KickFitSettings fitted = with(settings, fit);
  const Loaded now(fitted, stand);
  // As well for a ball that lies not quite in its place.
  for (const double ahead : {-0.012, 0.0, 0.012})
    for (const double aside : {-0.012, 0.0, 0.012})
      EXPECT_TRUE(now.check.check(now.option("kick_test"), {0.17 + ahead, 0.05 + aside}).allows());
  EXPECT_LT(std::abs(angleDifference(fit.after.contact.direction, 0.0)), toRadians(3.0));
  EXPECT_GT(fit.after.contact.speed, 0.8);
}

// The player takes longer for a curve with joints that are too fast. Nothing is shifted before the curve in
// a player without physics, so the text's own posture is where it begins.
TEST_F(KickFits, LeaveThePlayerNothingToStretch) {
  const KickFitSettings settings = settingsFor("kick_test");
  const KickFitSettings fitted = with(settings, fitKick(settings));
  const auto stretched = [&](const KickFitSettings& which) {
    const Loaded loaded(which, standOf(which));
    const model::RobotModel& robot = model::robotModel(kType);
    motion::SkillPlayer player(robot, loaded.library, standOf(which));
    motion::JointTargets targets;
    targets.angles = standOf(which);
    targets.stiffness.fill(1.0);
    const motion::PlannedCurve planned = *loaded.check.plan(loaded.option("kick_test"), {0.17, 0.05});
    world::WorldState world;
    world.body.cycleTime = kCycleTime;
    // The ball as a level torso above the planned origin sees it.
    world.body.torsoHeight = 0.042 - planned.curve.origin().z();
    world.ball.known = true;
    world.ball.p_RB = planned.curve.origin().head<2>();
    player.start("kick_test", false, targets.angles, motion::KickAim{world.ball.p_RB, 0.0, {0, 0}, 3.0});
    while (player.update(world, targets) == motion::SkillPlayer::Result::Running) continue;
    return player.stretch().has_value();
  };
  EXPECT_TRUE(stretched(settings));
  EXPECT_FALSE(stretched(fitted));
}

TEST_F(KickFits, KeepACurveThatIsAsGoodAsItCanBe) {
  KickFitSettings settings = settingsFor("kick_test");
  // Until nothing is gained any more; then once more.
  KickFit fit = fitKick(settings);
  for (int i = 0; i < 6 && !fit.kept; ++i) {
    settings = with(settings, fit);
    const double before = fit.after.contact.speed;
    fit = fitKick(settings);
    EXPECT_TRUE(fit.heldBefore);
    EXPECT_GE(fit.after.contact.speed, 0.99 * before);
  }
  EXPECT_TRUE(fit.kept);
  for (const FittedParameter& parameter : fit.parameters)
    EXPECT_EQ(parameter.before, parameter.after) << parameter.name;
}

TEST_F(KickFits, MoveOnlyWhatMovesTheCurveAndMayMove) {
  const KickFit fit = fitKick(settingsFor("kick_test"));
  EXPECT_EQ(after(fit, "unused"), 1.0);
  EXPECT_EQ(after(fit, "fixedPart"), 0.3);
  EXPECT_GT(after(fit, "time"), 0.06);
  EXPECT_LT(after(fit, "footY"), 0.045);
}

TEST_F(KickFits, WriteAFileThatGivesTheSameKick) {
  const KickFitSettings settings = settingsFor("kick_test");
  const KickFit fit = fitKick(settings);
  const KickFitSettings fitted = with(settings, fit);
  for (const FittedParameter& parameter : fit.parameters)
    EXPECT_EQ(fitted.agent.parameters.motion.skills.find("kick_test", parameter.name), parameter.after);
}

// A swing follows the curve and meets the ball: the curve comes within reach and does not touch it.
TEST_F(KickFits, LeadTheFootToTheBallWhereASwingMeetsIt) {
  std::string text = kTooMuch;
  text.resize(text.find("skill kick_joints"));
  text.replace(text.find("kick_test"), 9, "kick_lead");
  text.replace(text.find("wait unused"), 11, "swing over unused { left.hipPitch 60deg }");
  text.replace(text.find("x2 = -150mm"), 11, "x2 = -190mm");
  text.replace(text.find("x3 = 40mm in -120mm"), 19, "x3 = -120mm in -250mm");
  text.replace(text.find("in -200mm..-100mm"), 9, "in -250mm");
  std::ofstream(folder_ / "kick_lead.skl") << text;
  const KickFitSettings settings = settingsFor("kick_lead");
  const KickFit fit = fitKick(settings);
  EXPECT_FALSE(fit.heldBefore);
  ASSERT_TRUE(fit.holds) << kickFitTable(fit);
  EXPECT_GT(fit.after.contact.gap, 0.0);
  const KickFitSettings fitted = with(settings, fit);
  const Loaded now(fitted, standOf(fitted));
  EXPECT_TRUE(now.check.check(now.option("kick_lead"), {0.17, 0.05}).allows());
  EXPECT_TRUE(fitKick(fitted).kept);
}

TEST_F(KickFits, SayWhatCannotBeFitted) {
  const auto message = [&](const std::string& kick) -> std::string {
    try {
      fitKick(settingsFor(kick));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message("kick_joints"), testing::HasSubstr("no curve from ball"));
  EXPECT_THAT(message("kick_rigid"), testing::HasSubstr("no parameter"));
  EXPECT_THAT(message("kick_none"), testing::HasSubstr("no kick 'kick_none'"));
}

// The foot as a grid of points on its surface, the curve in ten thousand steps.
TEST_F(KickFits, ContactIsWhereAFootOfPointsFirstComesUpToTheBall) {
  const KickFitSettings settings = settingsFor("kick_test");
  const KickFitSettings fitted = with(settings, fitKick(settings));
  const Loaded loaded(fitted, standOf(fitted));
  const model::RobotModel& robot = model::robotModel(kType);
  const motion::PlannedCurve planned = *loaded.check.plan(loaded.option("kick_test"), {0.17, 0.05});
  const CurveMeasures measures = measureCurve(robot, planned);
  const Vector3 half = 0.5 * robot.body(model::BodyId::LFoot).shape.size;
  const auto distanceAt = [&](double share) {
    model::LegAngles leg{};
    model::legInverseKinematics(robot, model::Side::Left, planned.curve.at(share), leg);
    model::JointArray joints = planned.posture;
    model::setLegAngles(model::Side::Left, leg, joints);
    model::BodyPoses bodies = model::identityPoses();
    model::forwardKinematics(robot, joints, bodies);
    const Vector3 p = bodies[model::index(model::BodyId::LFoot)].inverse() * planned.curve.origin();
    double least = 1.0;
    for (int i = -40; i <= 40; ++i)
      for (int j = -20; j <= 20; ++j)
        for (int k = -5; k <= 5; ++k)
          least = std::min(least, (p - Vector3(i / 40.0, j / 20.0, k / 5.0).cwiseProduct(half)).norm());
    return least;
  };
  ASSERT_EQ(measures.contact.gap, 0.0);
  EXPECT_NEAR(distanceAt(measures.contact.share), 0.042, 5e-4);
  for (double share = 0.0; share < measures.contact.share - 0.02; share += 0.02)
    EXPECT_GT(distanceAt(share), 0.042) << share;
  // The speed at which the gap closes, from two distances and the time between them.
  const double ahead = 0.01;
  const double closed = distanceAt(measures.contact.share - ahead) - distanceAt(measures.contact.share);
  EXPECT_NEAR(closed / (ahead * planned.instruction->value), measures.contact.speed,
              0.1 * measures.contact.speed);
}

}  // namespace
}  // namespace nonet::lab
