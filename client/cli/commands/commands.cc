#include "client/cli/commands/commands.h"

namespace truepose::cli {

// In the order in which a plant engineer meets them, which is the order of --help.
void AddAllCommands(const Command& root) {
  AddServe(root);
  AddStatus(root);
  AddRobot(root);
  AddSession(root);
  AddCalibrate(root);
  AddEvaluate(root);
  AddCompensate(root);
  AddProgram(root);
  AddTable(root);
  AddAccuracyMap(root);
  AddJob(root);
  AddCalibration(root);
  AddDrift(root);
  AddRecalibration(root);
  AddPolicy(root);
  AddRobotEvent(root);
  AddWatch(root);
  AddPlant(root);
  AddSimulate(root);
  AddModel(root);
  AddReproduce(root);
  AddAdmin(root);
  AddToken(root);
  AddVersion(root);
}

}  // namespace truepose::cli
