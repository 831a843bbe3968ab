-- min_compatible: 7
-- The way of each calibration to its robot, appended. An older program would show drafts as if anybody might use them.

CREATE TABLE release_steps (
  sequence INTEGER PRIMARY KEY,
  robot_id TEXT NOT NULL,
  number INTEGER NOT NULL,
  state INTEGER NOT NULL,
  revision INTEGER NOT NULL,
  message BLOB NOT NULL,
  FOREIGN KEY (robot_id, number) REFERENCES calibrations (robot_id, number)
) STRICT;

CREATE INDEX release_steps_of_calibration ON release_steps (robot_id, number, sequence);
CREATE INDEX release_steps_of_robot ON release_steps (robot_id, state, sequence);
