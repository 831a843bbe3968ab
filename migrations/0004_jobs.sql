-- min_compatible: 1
-- Calibration jobs with their frozen input, and their results.

CREATE TABLE jobs (
  sequence INTEGER PRIMARY KEY,
  id TEXT NOT NULL UNIQUE,
  robot_id TEXT NOT NULL REFERENCES robots (id),
  state INTEGER NOT NULL,
  lease INTEGER NOT NULL DEFAULT 0,
  message BLOB NOT NULL
) STRICT;

CREATE INDEX jobs_of_robot ON jobs (robot_id, sequence);
CREATE INDEX jobs_by_state ON jobs (state, sequence);

CREATE TABLE job_sessions (
  job INTEGER NOT NULL REFERENCES jobs (sequence),
  position INTEGER NOT NULL,
  session INTEGER NOT NULL REFERENCES sessions (sequence),
  digest TEXT NOT NULL,
  PRIMARY KEY (job, position)
) STRICT, WITHOUT ROWID;

-- What is long (residuals, covariance) stands apart, so that lists don't read it.
CREATE TABLE calibrations (
  robot_id TEXT NOT NULL REFERENCES robots (id),
  number INTEGER NOT NULL CHECK (number > 0),
  job INTEGER NOT NULL UNIQUE REFERENCES jobs (sequence),
  message BLOB NOT NULL,
  detail BLOB NOT NULL,
  PRIMARY KEY (robot_id, number)
) STRICT;
