// One function a command: it describes the command's options and examples, and says what runs.
#pragma once

#include "client/cli/command_line.h"

namespace truepose::cli {

void AddAllCommands(const Command& root);

void AddServe(const Command& root);
void AddStatus(const Command& root);
void AddAdmin(const Command& root);
void AddToken(const Command& root);
void AddRobot(const Command& root);
void AddRobotExport(const Command& robot);
void AddPlant(const Command& root);
void AddSession(const Command& root);
void AddSessionExport(const Command& session);
void AddSessionImport(const Command& session);
void AddCalibrate(const Command& root);
void AddEvaluate(const Command& root);
void AddCompensate(const Command& root);
void AddTable(const Command& root);
void AddJob(const Command& root);
void AddCalibration(const Command& root);
void AddCalibrationRelease(const Command& calibration);
void AddCalibrationCompare(const Command& calibration);
void AddCalibrationExport(const Command& calibration);
void AddCalibrationConvert(const Command& calibration);
void AddDrift(const Command& root);
void AddRecalibration(const Command& root);
void AddPolicy(const Command& root);
void AddRobotEvent(const Command& root);
void AddWatch(const Command& root);
void AddSimulate(const Command& root);
void AddModel(const Command& root);
void AddAccuracyMap(const Command& root);
void AddReproduce(const Command& root);
void AddVersion(const Command& root);

}  // namespace truepose::cli
