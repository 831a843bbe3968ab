/* correct TABLE q1 q2 ... : corrected joints of one target, in plain C. Joints in rad and m. */
#include <stdio.h>
#include <stdlib.h>
#include <truepose/compensation_c.h>

int main(int argc, char** argv) {
  truepose_compensation* robot = NULL;
  truepose_message message;
  truepose_table_info info;
  truepose_correction correction;
  double q[TRUEPOSE_MAX_JOINTS] = {0};
  truepose_load_status status;
  int i;

  if (argc < 3) {
    fprintf(stderr, "correct TABLE q1 q2 ...\n");
    return 2;
  }
  /* In a robot's cell, name the robot: {"its serial", NULL, NULL} instead of NULL. */
  status = truepose_compensation_load(argv[1], NULL, &robot, &message);
  if (status != TRUEPOSE_LOAD_OK) {
    fprintf(stderr, "%s: %s\n", truepose_load_status_text(status), message.text);
    return 1;
  }
  truepose_compensation_info(robot, &info);
  if (argc - 2 != info.joints) {
    fprintf(stderr, "joints: found %d, expected %d\n", argc - 2, info.joints);
    truepose_compensation_free(robot);
    return 2;
  }
  for (i = 0; i < info.joints; ++i) q[i] = atof(argv[i + 2]);

  truepose_compensation_correct_joints(robot, q, &correction);
  printf("%s:", truepose_outcome_text(correction.outcome));
  for (i = 0; i < info.joints; ++i) printf(" %.9f", correction.q[i]);
  printf("\n");
  truepose_compensation_free(robot);
  return correction.outcome == TRUEPOSE_OK ? 0 : 1; /* anything else is not to be commanded */
}
