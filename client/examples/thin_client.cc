// A PC at a robot: submits what was measured, waits for the calibration, and asks the active one
// which joints to command:  thin_client ADDRESS ROBOT READINGS Q1 Q2...
// READINGS is a text file that a measuring program appends to: joints (rad), x y z (m), qx qy qz qw
// a line. READINGS.ids, made here, names its uploads. Start it again after any failure: it goes on.
#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

#include "client/client.h"
#include "client/reading_upload.h"
#include "client/token_file.h"
#include "client/uuid.h"
#include "client/wait_for_job.h"

namespace v1 = truepose::v1;
namespace client = truepose::client;

// The value, or the end of the program with the reason.
template <typename T>
T Demand(absl::StatusOr<T> result) {
  if (result.ok()) return *std::move(result);
  std::cerr << "thin_client: " << result.status().message() << "\n";
  std::exit(1);
}

// The file is the spool: line n is sequence n, and nothing is ever taken out.
struct FileSpool : client::ReadingSpool {
  FileSpool(const std::string& path, size_t joints, std::string in) : session(std::move(in)) {
    std::ifstream file(path);
    if (!file) Demand(absl::StatusOr<int>(absl::NotFoundError(path + " can't be read")));
    for (std::string line; std::getline(file, line) && !file.eof();) {  // whole lines only
      std::istringstream numbers(line);
      const std::vector<double> values(std::istream_iterator<double>(numbers), {});
      if (values.size() != joints + 7)
        Demand(absl::StatusOr<int>(absl::InvalidArgumentError(path + " has a bad line: " + line)));
      v1::Reading reading;
      const auto pose = values.begin() + joints;
      reading.mutable_joints_commanded()->Assign(values.begin(), pose);
      auto& p = *reading.mutable_position_m();
      p.set_x(pose[0]), p.set_y(pose[1]), p.set_z(pose[2]);
      v1::Quaternion& q = *reading.mutable_orientation();
      q.set_x(pose[3]), q.set_y(pose[4]), q.set_z(pose[5]), q.set_w(pose[6]);
      readings.push_back(reading);
    }
  }
  int64_t last_sequence() const override { return readings.size(); }
  absl::StatusOr<client::SpooledReadings> Read(int64_t sequence, int most) override {
    const auto first = readings.begin() + (sequence - 1);
    return client::SpooledReadings{session,
                                   {first, first + std::min(most, int(readings.end() - first))}};
  }
  void SetDurable(int64_t sequence) override { std::cout << sequence << " readings are safe\n"; }

  std::string session;
  std::vector<v1::Reading> readings;
};

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 4) return std::cerr << "thin_client ADDRESS ROBOT READINGS Q1...\n", 2;
  const std::string robot = "robots/" + arguments[1], readings = arguments[2];
  const client::ClientOptions options{.token = Demand(client::FindToken(""))};
  const client::Client server = Demand(client::Client::Connect(arguments[0], options));
  v1::CompensateRequest compensate;
  auto& target = *compensate.add_targets();
  for (size_t i = 3; i < arguments.size(); ++i) target.add_joints(std::stod(arguments[i]));

  // Ids of our own making: whatever is repeated below has one effect.
  std::string source, session, job;
  if (!(std::ifstream(readings + ".ids") >> source >> session >> job)) {
    source = client::RandomUuid(), session = client::RandomUuid(), job = client::RandomUuid();
    std::ofstream(readings + ".ids") << source << "\n" << session << "\n" << job << std::endl;
  }
  v1::CreateSessionRequest create_session;
  create_session.set_session_id(session), create_session.mutable_session()->set_robot(robot);
  const std::string name = Demand(server.CreateSession(create_session)).name();
  FileSpool spool(readings, target.joints_size(), name);
  v1::SealSessionRequest seal;
  seal.set_name(name);
  seal.set_reading_count(static_cast<int>(Demand(client::UploadSpool(server, source, spool))));
  Demand(server.SealSession(seal));

  v1::CreateCalibrationJobRequest create_job;
  create_job.set_job_id(job), create_job.set_robot(robot);
  create_job.add_sessions(name), create_job.mutable_options()->set_split("even-odd");
  job = Demand(server.CreateCalibrationJob(create_job)).name();
  std::cout << "calibration: " << Demand(client::WaitForJob(server, job)).calibration() << "\n";

  v1::GetRobotRequest get_robot;
  get_robot.set_name(robot);
  compensate.set_calibration(Demand(server.GetRobot(get_robot)).active_calibration());
  if (compensate.calibration().empty()) return std::cout << "none is active yet\n", 0;
  std::cout << "active: " << compensate.calibration() << "\ncommand:";
  const v1::CompensateResponse answer = Demand(server.Compensate(compensate));
  for (const double q : answer.targets(0).joints()) std::cout << " " << q;
  std::cout << std::endl;
}
