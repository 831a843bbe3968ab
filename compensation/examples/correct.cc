// correct TABLE q1 q2 ... : corrected joints of one target, in C++. Joints in rad and m.
#include <cstdio>
#include <cstdlib>
#include <truepose/compensation.h>
#include <vector>

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "correct TABLE q1 q2 ...\n");
    return 2;
  }
  truepose::Compensation robot;
  // In a robot's cell, name the robot: Load(path, {"its serial", nullptr, nullptr}).
  if (const truepose::LoadResult loaded = robot.Load(argv[1]); !loaded) {
    std::fprintf(stderr, "%s: %s\n", truepose_load_status_text(loaded.status),
                 loaded.message.text);
    return 1;
  }
  std::vector<double> q;
  for (int i = 2; i < argc; ++i) q.push_back(std::atof(argv[i]));

  const truepose::Correction correction = robot.CorrectJoints(q);
  std::printf("%s:", truepose_outcome_text(correction.outcome));
  for (int i = 0; i < robot.Info().joints; ++i) std::printf(" %.9f", correction.q[i]);
  std::printf("\n");
  return correction.outcome == TRUEPOSE_OK ? 0 : 1;  // anything else is not to be commanded
}
