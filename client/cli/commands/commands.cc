#include "client/cli/commands/commands.h"

namespace truepose::cli {

// In the order in which a plant engineer meets them, which is the order of --help.
void AddAllCommands(const Command& root) {
  AddServe(root);
  AddRobot(root);
  AddSession(root);
  AddCalibrate(root);
  AddEvaluate(root);
  AddCompensate(root);
  AddJob(root);
  AddCalibration(root);
  AddWatch(root);
  AddPlant(root);
  AddSimulate(root);
  AddModel(root);
  AddReproduce(root);
  AddVersion(root);
}

}  // namespace truepose::cli
